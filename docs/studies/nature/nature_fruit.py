"""The mass of the printed fruits of fruit.geo: plastic, the lead in the pod and the water that fills it."""

import math

# Millimetres, as in the CAD file that the authors published.
POD_RADIUS, POD_WALL = 10.0, 1.0
CHORD, PITCH, CAMBER_RADIUS, THICKNESS = 16.072, math.radians(15), 20.0, 0.819
OFFSET, STRAIGHT, CURVED = 2.0, 15.0, 60.0
# kg/m^3. Of the print it is an assumption: polylactide, which the payloads' descent speeds bear out (README.md).
PLASTIC, LEAD, WATER = 1240.0, 11340.0, 998.2
PACKING = 0.6  # share of the lead's shot in the space that it takes
STEPS = (150, 24, 3)  # along, across and through a wing


def wing_elements(angle, radius):
    """(volume in mm^3, place) of the pieces of the wing that stands out along +x; z is up, the spin's axis."""
    along, across, through = STEPS
    half_angle = math.asin(CHORD / 2 / CAMBER_RADIUS)
    rise = CAMBER_RADIUS * math.cos(half_angle)
    length, theta = STRAIGHT + CURVED, math.radians(angle)
    x, z = OFFSET, 0.0
    step = length / along
    for i in range(along):
        bend = 1 / radius if (i + 0.5) * step > STRAIGHT else 0.0
        theta += bend * step / 2
        x, z = x + math.sin(theta) * step / 2, z + math.cos(theta) * step / 2
        for j in range(across):
            turn = half_angle * (2 * (j + 0.5) / across - 1)
            for k in range(through):
                arc = CAMBER_RADIUS - THICKNESS * (k + 0.5) / through
                chordwise, camber = arc * math.sin(turn), rise - arc * math.cos(turn)
                y = chordwise * math.cos(PITCH) + camber * math.sin(PITCH)
                off = camber * math.cos(PITCH) - chordwise * math.sin(PITCH)
                volume = step * (1 - off * bend) * (arc * 2 * half_angle / across) * THICKNESS / through
                yield volume, (x + off * math.cos(theta), y, z - off * math.sin(theta))
        x, z = x + math.sin(theta) * step / 2, z + math.cos(theta) * step / 2
        theta += bend * step / 2


def wings(angle, radius):
    """Both wings, as far as they stand out of the pod."""
    for volume, (x, y, z) in wing_elements(angle, radius):
        if x * x + y * y + z * z > POD_RADIUS ** 2:
            yield volume, (x, y, z)
            yield volume, (-x, -y, z)


def ball(radius):
    return 4 / 3 * math.pi * radius ** 3


def plastic_volume(angle, radius):
    return sum(volume for volume, _ in wings(angle, radius)) + ball(POD_RADIUS) - ball(POD_RADIUS - POD_WALL)


def outer_volume(angle, radius):
    return plastic_volume(angle, radius) + ball(POD_RADIUS - POD_WALL)


def cap_centre(volume):
    """How far below the pod's middle the middle of so much shot lies in its lower end."""
    hollow, low, high = POD_RADIUS - POD_WALL, 0.0, POD_RADIUS - POD_WALL
    for _ in range(60):
        height = (low + high) / 2
        low, high = (height, high) if math.pi * height ** 2 * (hollow - height / 3) < volume else (low, height)
    return 3 * (2 * hollow - height) ** 2 / (4 * (3 * hollow - height))


def mass_properties(angle, radius, payload):
    """Mass (kg), centre of mass (m) and inertia about it (kg m^2), in the shape's axes, with the water in the pod."""
    hollow = POD_RADIUS - POD_WALL
    grams = 1e-6  # of a mm^3 at a density of 1 kg/m^3
    lead_volume = payload / (LEAD * grams)
    depth = cap_centre(lead_volume / PACKING)
    parts = [(volume * PLASTIC * grams, place) for volume, place in wings(angle, radius)]
    # The lead takes the place of water.
    parts.append((payload - lead_volume * WATER * grams, (0.0, 0.0, -depth)))
    shell = (ball(POD_RADIUS) - ball(hollow)) * PLASTIC * grams
    filling = ball(hollow) * WATER * grams
    total = sum(mass for mass, _ in parts) + shell + filling
    centre = tuple(sum(mass * place[i] for mass, place in parts) / total for i in range(3))
    # Of ball and shell about the pod's middle.
    own = 0.4 * (shell * (POD_RADIUS ** 5 - hollow ** 5) / (POD_RADIUS ** 3 - hollow ** 3) + filling * hollow ** 2)
    inertia = [[own if i == j else 0.0 for j in range(3)] for i in range(3)]
    parts.append((-total, centre))  # to the centre of mass
    for mass, place in parts:
        for i in range(3):
            for j in range(3):
                inertia[i][j] += mass * ((sum(x * x for x in place) if i == j else 0.0) - place[i] * place[j])
    return total * 1e-3, tuple(x * 1e-3 for x in centre), [[x * 1e-9 for x in row] for row in inertia]
