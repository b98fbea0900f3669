"""The bodies, meshes, models and cases of README.md, and what the literature has."""

import math

SHELLS = {
    "coarse": "((0.4 4) (1.2 3) (3 2) (5 1))",
    "medium": "((0.2 4) (0.6 3) (1.5 2) (3 1))",
    "wake": "((0.3 4) (1.2 3) (2.5 2) (5 1))",
    "wide": "((0.6 4) (1.8 3) (3.5 2) (6 1))",
    "fine": "((0.15 5) (0.35 4) (0.9 3) (2 2) (4 1))",
}


def mesh(background, level, shells, layers, ratio="1.3", thickness="0.5"):
    return {"backgroundCells": background, "surfaceLevel": level, "refinementShells": SHELLS[shells], "layers": layers,
            "layerRatio": ratio, "layerThickness": thickness,
            "leastDeterminant": "0.001" if layers < 5 else "1e-9",
            "leastTetQuality": "1e-15" if layers < 5 else "-1e30", "leastTwist": "0.02" if layers < 5 else "-1"}


MESHES = {
    "coarse": mesh(10, 4, "coarse", 2),
    "medium": mesh(20, 4, "medium", 3),
    "fine": mesh(20, 5, "fine", 4),
    "coarse layered": mesh(10, 4, "coarse", 9, "1.4"),
    "medium layered": mesh(20, 4, "medium", 9, "1.4"),
    "medium thinly layered": mesh(20, 4, "medium", 13, "1.4"),
    "medium bare": mesh(20, 4, "medium", 0),
    "wake layered": mesh(20, 4, "wake", 13, "1.4"),
    "wide layered": mesh(20, 4, "wide", 9, "1.4"),
    "fine layered": mesh(20, 5, "fine", 8, "1.4"),
}

# Whose solution on another mesh a case starts from, as in a bake; the others start from the undisturbed flow.
MESH_BEFORE = {"fine": "medium", "fine layered": "medium layered", "wake layered": "medium layered",
               "wide layered": "medium layered"}

RESOLVED = {"nutAtWall": "nutLowReWallFunction", "kAtWall": "fixedValue"}
FIRST_ORDER = {"convection": "limitedLinear 1", "turbulenceConvection": "upwind"}
STEADY = {**FIRST_ORDER, "turbulenceMeans": "no", "stationarity": "0.02", "mostIterations": 400, "acceptedError": "0.03"}
LINEAR = "linearUpwind grad(U)"


# "inflow": turbulence intensity, and eddy viscosity over the fluid's, where they are not the template's 1 % and 1.
def unsteady(step, steps):
    return {**FIRST_ORDER, "turbulenceMeans": "no", "solver": "pimpleFoam", "rateOfChange": "backward", "timeStep": step, "roundIterations": 200,
            "leastIterations": steps, "mostIterations": steps, "stationarity": "0.02"}


MODELS = {
    "kEpsilon": STEADY,
    "laminar": {**STEADY, "simulationType": "laminar"},
    "laminar linearUpwind": {**STEADY, "simulationType": "laminar", "convection": LINEAR},
    "kOmegaSST": {**STEADY, **RESOLVED, "closure": "kOmegaSST"},
    "kOmegaSST linearUpwind": {**STEADY, **RESOLVED, "closure": "kOmegaSST", "convection": LINEAR},
    "kOmegaSST wall functions": {**STEADY, "closure": "kOmegaSST"},
    "kOmegaSSTLM": {**STEADY, **RESOLVED, "closure": "kOmegaSSTLM"},
    "kOmegaSSTLM linearUpwind": {**STEADY, **RESOLVED, "closure": "kOmegaSSTLM", "convection": LINEAR},
    "kOmegaSSTLM linearUpwind quiet": {**STEADY, **RESOLVED, "closure": "kOmegaSSTLM", "convection": LINEAR,
                                         "inflow": (1e-3, 1), "inflowReThetat": 1137},
    "unsteady laminar": {**unsteady("0.03", 1000), "simulationType": "laminar", "convection": LINEAR},
    "unsteady kOmegaSSTLM": {**unsteady("0.03", 1000), **RESOLVED, "closure": "kOmegaSSTLM", "convection": LINEAR},
    "kOmegaSSTDDES": {**unsteady("0.03", 1000), **RESOLVED, "simulationType": "LES", "closure": "kOmegaSSTDDES",
                      "convection": LINEAR},
}


def brown_lawler(reynolds):
    return 24 / reynolds * (1 + 0.150 * reynolds ** 0.681) + 0.407 / (1 + 8710 / reynolds)


class Body:
    """Convex, of triangles, scaled to the area pi. `length` and `area`: those of the literature's Re and C_D; no length: L."""

    def __init__(self, triangles, length, area, literature, direction=(1.0, 0.0, 0.0)):
        total = sum(norm(cross(minus(b, a), minus(c, a))) / 2 for a, b, c in triangles)
        scale = math.sqrt(math.pi / total)
        self.triangles = [[tuple(scale * x for x in point) for point in triangle] for triangle in triangles]
        self.length = scale * length if length else 1.0
        self.area = scale * scale * area
        self.literature = literature
        self.direction = direction

    def direction_text(self, sign):
        return "(" + " ".join(f"{sign * x + 0.0:.8g}" for x in self.direction) + ")"

    def write(self, path):
        with open(path, "w") as file:
            file.write("solid body\n")
            for triangle in self.triangles:
                a, b, c = triangle
                normal = cross(minus(b, a), minus(c, a))
                if sum(n * x for n, x in zip(normal, a)) < 0:
                    triangle = (a, c, b)
                file.write("facet normal 0 0 0\nouter loop\n")
                file.writelines("vertex {:.9g} {:.9g} {:.9g}\n".format(*point) for point in triangle)
                file.write("endloop\nendfacet\n")
            file.write("endsolid body\n")


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(sum(x * x for x in a))


def box(a, b, c):
    """Edges a, b, c."""
    triangles = []
    for axis in range(3):
        for sign in (-1, 1):
            corners = []
            for p, q in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                point = [0.0] * 3
                point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = sign, p, q
                corners.append(tuple(x * edge / 2 for x, edge in zip(point, (a, b, c))))
            triangles += [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
    return triangles


def sphere(a=1.0, b=1.0, c=1.0, cuts=24):
    """The cube's faces, each cut into cuts x cuts squares, blown up to an ellipsoid of axes a, b, c."""
    def blown(axis, sign, i, j):
        point = [0.0] * 3
        point[axis] = sign
        point[(axis + 1) % 3], point[(axis + 2) % 3] = (math.tan(math.pi / 4 * (2 * x / cuts - 1)) for x in (i, j))
        size = norm(point)
        return tuple(x / size * axis_length / 2 for x, axis_length in zip(point, (a, b, c)))

    triangles = []
    for axis in range(3):
        for sign in (-1, 1):
            for i in range(cuts):
                for j in range(cuts):
                    p, q, r, s = (blown(axis, sign, i + di, j + dj) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)))
                    triangles += [(p, q, r), (p, r, s)]
    return triangles


def disc(diameter, thickness, corners=96):
    """Its axis along x."""
    rim = [(diameter / 2 * math.cos(2 * math.pi * i / corners), diameter / 2 * math.sin(2 * math.pi * i / corners))
           for i in range(corners)]
    triangles = []
    h = thickness / 2
    for (y1, z1), (y2, z2) in zip(rim, rim[1:] + rim[:1]):
        triangles += [((h, 0, 0), (h, y1, z1), (h, y2, z2)), ((-h, 0, 0), (-h, y1, z1), (-h, y2, z2)),
                      ((h, y1, z1), (-h, y1, z1), (-h, y2, z2)), ((h, y1, z1), (-h, y2, z2), (h, y2, z2))]
    return triangles


def constant(value):
    return lambda reynolds: value


BODIES = {
    "sphere": Body(sphere(), 1, math.pi / 4, brown_lawler),
    "cube": Body(box(1, 1, 1), 1, 1, constant(1.05)),
    "disc": Body(disc(1, 0.03), 1, math.pi / 4, constant(1.17)),
    "plate": Body(box(0.03, 1, 1), 1, 1, constant(1.17)),
    "ellipsoid broadside": Body(sphere(1, 2, 4), None, 2 * math.pi, constant(0.77)),
    "ellipsoid at 45": Body(sphere(1, 2, 4), None, math.pi / 4 * math.sqrt(34), constant(0.78), (math.sqrt(0.5), 0, math.sqrt(0.5))),
    "ellipsoid end on": Body(sphere(1, 2, 4), None, math.pi / 2, constant(0.29), (0, 0, 1)),
}

REYNOLDS_NUMBERS = (50, 200, 1e3, 1e4, 2.3e4, 1e5)


def each(body, reynolds_numbers, models, mesh):
    return [(body, reynolds, model, mesh) for model in models for reynolds in reynolds_numbers]


SST = "kOmegaSST linearUpwind"
ELLIPSOIDS = ("ellipsoid broadside", "ellipsoid at 45", "ellipsoid end on")
SHARP = ("cube", "disc", "plate")

LM = "kOmegaSSTLM linearUpwind"
QUIET = "kOmegaSSTLM linearUpwind quiet"

STUDY = [
    *each("sphere", REYNOLDS_NUMBERS, ("kEpsilon",), "medium"),
    *each("sphere", REYNOLDS_NUMBERS, ("laminar linearUpwind", "kOmegaSST", SST, LM), "medium layered"),
    *each("sphere", (1e5,), (SST, LM), "medium thinly layered"),
    *each("sphere", (1e5, 1e4), (QUIET,), "medium thinly layered"),
    *each("sphere", (1e3, 2.3e4, 1e5), ("kOmegaSSTLM",), "medium thinly layered"),
    *each("sphere", (1e4,), (LM, SST, "kOmegaSST"), "coarse layered"),
    *each("sphere", (1e3, 1e4), (LM,), "fine layered"),
    *each("sphere", (1e3, 1e4), (LM,), "wide layered"),
    *each("sphere", (1e3, 1e4, 2.3e4, 1e5), (LM,), "wake layered"),
    *each("sphere", (2.3e4,), (QUIET,), "wake layered"),
    *each("sphere", (1e4,), ("kEpsilon",), "fine"),
    *each("sphere", (1e4,), ("kOmegaSST wall functions",), "medium"),
    *each("sphere", (1e4,), ("laminar",), "medium layered"),
    *each("sphere", (1e4,), (SST,), "medium bare"),
    *(case for body in SHARP for case in (*each(body, (1e4,), ("kEpsilon",), "medium"),
                                          *each(body, (1e4,), (SST, LM), "medium layered"))),
    *(case for body in ELLIPSOIDS for case in (*each(body, (10300,), ("kEpsilon",), "medium"),
                                               *each(body, (10300,), (SST, LM), "medium layered"))),
    *each("cube", (1e4,), (LM,), "wake layered"),
    *each("ellipsoid at 45", (10300,), (LM,), "wake layered"),
    *each("ellipsoid broadside", (10300,), (LM,), "wake layered"),
    *each("sphere", (1e4,), ("kOmegaSSTDDES",), "medium layered"),
    *each("sphere", (1e3,), ("unsteady laminar",), "medium layered"),
    *each("sphere", (2.3e4,), ("unsteady kOmegaSSTLM",), "wake layered"),
]
