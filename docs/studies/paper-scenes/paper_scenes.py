#!/usr/bin/env python3
"""The paper's figures 1 and 3 with the project's scenes: pictures and the tables of README.md.

    paper_scenes.py BIN BODIES FOLDER

BIN: the folder of the programs; BODIES: of rubber.body.h5 and airplane.body.h5, the ready-baked ellipsoid and airplane;
FOLDER: gets the pictures. Run from the project's folder.
"""

import glob
import math
import os
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import run  # noqa: E402
from gnuplot_picture import block, draw, ellipsoid_outline, flights, turned  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402

SCENES = "docs/scenes"
RUNS = 20
FRONT_TURN = math.radians(20)  # how far the nose dips before it comes up to level again
SIDE_TURN = math.radians(45)   # how far the course turns

STYLE = '''set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set key off
'''


def flown(programs, folder, scene, work, runs=1):
    """The motion file of a scene and what `samara simulate` says of its one body."""
    motion = os.path.join(work, f"{scene}.h5")
    told = run([f"{programs}/samara", "simulate", f"{SCENES}/{scene}.toml", "-o", motion, "--bodies", folder, "--runs",
                str(runs), "--json"])
    return motion, told["bodies"][0]


def body_line(told):
    """What the body flew with, and how sure its tables are along the flight."""
    errors = told["table_errors"]
    return (f"\n{told['models'][0].upper() + told['models'][1:]}. The tables' standard error along the flight: {100 * errors['force']:.0f} % of the force, "
            f"{100 * errors['turbulent_kinetic_energy']:.0f} % of k.\n")


# The rubber ellipsoid.

SEMI_AXES = (0.01, 0.02, 0.04)  # m, along the shape's x, y, z
FALLEN = 0.82                   # m: how much of each fall is shown
COLOURS = {"full CFD": "#d98c1f", "inertia only": "#7a7a7a", "full model": "#2a6f97"}


def inclination(pose):
    """Degrees between the short axis and the vertical, folded to 0-90."""
    return math.degrees(math.acos(min(1.0, abs(pose.rotation[2][0]))))


def rubber_picture(motions, picture):
    """Each motion as a strip from the front and from the side, and the inclinations beside them."""
    width, height = 2300, 1320
    scale = 1200.0 / (FALLEN + 0.09)  # pixels a metre
    commands = f'set terminal pngcairo size {width}, {height} font "DejaVu Sans,16" linewidth 1.6\nset output "{picture}"\n'
    commands += STYLE + "set multiplot\nunset border\nunset tics\n"
    left = 20.0
    for number, (name, (title, poses, interval)) in enumerate(motions.items()):
        shown = [pose for pose in poses if pose.position[2] > -FALLEN]
        every = round(interval / (poses[1].time - poses[0].time))
        for side, axis in enumerate((0, 1)):
            outlines = [ellipsoid_outline(SEMI_AXES, pose, axis) for pose in shown[::every]]
            across = [point[0] for outline in outlines for point in outline]
            middle, half = (min(across) + max(across)) / 2, max(0.058, (max(across) - min(across)) / 2 + 0.008)
            right = left + 2 * half * scale
            commands += block(f"outlines{number}{side}", [outline + outline[:1] for outline in outlines])
            commands += block(f"path{number}{side}", [[(pose.position[axis], pose.position[2]) for pose in shown]])
            commands += f"set lmargin at screen {left / width}\nset rmargin at screen {right / width}\n"
            commands += f"set bmargin at screen 0.015\nset tmargin at screen {(20.0 + 1200.0) / height}\n"
            commands += f"set xrange [{middle - half}:{middle + half}]\nset yrange [{-FALLEN - 0.04}:0.05]\n"
            if side == 0:
                commands += f'set label 1 "{title}" at screen {left / width + 0.004}, screen 0.972 tc rgb "{COLOURS[name]}"\n'
            else:
                commands += "unset label 1\n"
            commands += f'set label 2 "{("front", "side")[side]}" at graph 0.5, 0.995 center tc rgb "#6b6b6b"\n'
            commands += (f'plot $outlines{number}{side} with filledcurves closed fc rgb "{COLOURS[name]}" fs transparent solid 0.25 '
                         f'noborder, "" with lines lc rgb "{COLOURS[name]}" lw 1, $path{number}{side} with lines lc rgb "#1a1a1a" lw 0.8\n')
            left = right + (14 if side == 0 else 34)
    commands += "unset label 1\nunset label 2\n"
    place, bar = left / width, 0.1 * scale / height
    commands += (f'set arrow 1 from screen {place}, screen 0.03 to screen {place}, screen {0.03 + bar} heads size screen 0.003, 90 '
                 f'lc rgb "#1a1a1a" lw 1.2\nset label 1 "0.1 m, in all" at screen {place + 0.008}, screen {0.03 + bar / 2} center rotate\n')
    commands += "set border 3\nset tics nomirror\nset grid lc rgb '#e4e4e4' lt 1 lw 0.8\n"
    left = (left + 90) / width
    for number, (name, (title, poses, _)) in enumerate(motions.items()):
        top = 0.93 - number * 0.31
        commands += block(f"inclination{number}", [[(pose.time, inclination(pose)) for pose in poses if pose.time <= 4.0]])
        commands += f"set lmargin at screen {left}\nset rmargin at screen 0.99\nset tmargin at screen {top}\nset bmargin at screen {top - 0.235}\n"
        commands += 'set xrange [0:4]\nset yrange [0:90]\nset ytics 30\nset xtics 1\n'
        commands += f'set title "{title.split(":")[0]}: inclination, degrees" offset 0, -0.6\n'
        commands += 'set xlabel "time, s" offset 0, 0.5\n' if number == 2 else "unset xlabel\n"
        commands += f'plot $inclination{number} with lines lc rgb "{COLOURS[name]}" lw 2\n'
        commands += "unset arrow 1\nunset label 1\n"
    draw(commands + "unset multiplot\n")


def turning(poses):
    """The rms rate of turning about the body's x, y and z axes (rad/s) over the poses."""
    rates = [[sum(pose.rotation[row][axis] * pose.angular_velocity[row] for row in range(3)) for axis in range(3)]
             for pose in poses]
    return [math.sqrt(sum(rate[axis] ** 2 for rate in rates) / len(rates)) for axis in range(3)]


def rubber_row(title, falls):
    """Figures of one or several falls over the last two thirds of 4 s; means over the falls."""
    figures = []
    for poses in falls:
        late = [pose for pose in poses if 4.0 / 3.0 <= pose.time <= 4.0]
        speed = (late[0].position[2] - late[-1].position[2]) / (late[-1].time - late[0].time)
        aside = [100 * max(abs(pose.position[axis]) for pose in poses if pose.time <= 4.0) for axis in (0, 1)]
        figures.append([speed, max(map(inclination, late))] + turning(late) + aside)
    speed, steepest, short, middle, long, x, y = (sum(column) / len(falls) for column in zip(*figures))
    return f"| {title} | {speed:.3f} | {steepest:.0f} degrees | {short:.2f} / {middle:.2f} / {long:.2f} | {x:.1f} / {y:.1f} |"


def rubber(programs, bodies, work, folder):
    """Figure 3; returns its table."""

    def falls_of(motion):
        return list(flights(programs, motion).values())

    motion, told = flown(programs, bodies, "rubber-ellipsoid", work, RUNS)
    noisy = falls_of(motion)
    inertia = falls_of(flown(programs, bodies, "rubber-ellipsoid-inertia", work)[0])
    truth = falls_of("docs/studies/falls/ellipsoid-tilted.h5")
    still = os.path.join(work, "still.h5")  # the scene of the ground truth is the same without noise
    os.symlink(os.path.abspath(os.path.join(bodies, "rubber.body.h5")), os.path.join(work, "ellipsoid-tilted.body.h5"))
    run([f"{programs}/samara", "simulate", "docs/studies/falls/ellipsoid-tilted.toml", "-o", still, "--bodies", work, "--json"])
    motions = {"full CFD": ("(a) full CFD: every 0.25 s", truth[0], 0.25),
               "inertia only": ("(b) inertia only: every 0.1 s", inertia[0], 0.1),
               "full model": ("(c) full model: every 0.25 s", noisy[0], 0.25)}
    rubber_picture(motions, f"{folder}/rubber-three-ways.png")
    return "\n".join([
        "| | descent, m/s | largest inclination | rms turning about the short / middle / long axis, rad/s | largest way aside, x / y, cm |",
        "|---|---|---|---|---|",
        rubber_row("(a) full CFD", truth), rubber_row("full CFD from a compound tilt", falls_of("docs/studies/falls/ellipsoid-compound.h5")),
        rubber_row("(b) inertia only", inertia), rubber_row("(c) full model, the run of the picture", noisy[:1]),
        rubber_row(f"full model, mean of {RUNS} runs", noisy), rubber_row("full model without noise", falls_of(still))]) + "\n" + body_line(told)


# The paper airplane.

# The dart of meshes/shapes/airplane.geo as three flat faces, m, shape axes.
WING = ((0.015, 0.0, 0.0), (0.0415, 0.0261, 0.0046), (0.083, 0.0261, 0.0046), (0.083, 0.0, 0.0))
FACES = (WING, tuple((x, -y, z) for x, y, z in WING),
         ((0.0, 0.0, -0.015), (0.015, 0.0, 0.0), (0.083, 0.0, 0.0), (0.083, 0.0, -0.015)))
SHADES = ("#2a6f97", "#5d9cc0", "#1b4a66")
AZIMUTH, ELEVATION = math.radians(-60), math.radians(18)  # of the view


def seen(point):
    """A point of the world as it is seen: right, up, and how near it is."""
    x, y, z = point
    right = -math.sin(AZIMUTH) * x + math.cos(AZIMUTH) * y
    near = math.cos(AZIMUTH) * x + math.sin(AZIMUTH) * y
    return right, math.cos(ELEVATION) * z - math.sin(ELEVATION) * near, math.cos(ELEVATION) * near + math.sin(ELEVATION) * z


def landed(poses, ground=-2.0):
    """The poses until the airplane touches the ground."""
    flying = [pose for pose in poses if pose.position[2] > ground + 0.06]
    return poses[:len(flying)]


def turns(poses):
    """Whether the airplane turns front and aside, and the time of each (s) or None."""
    front, dipped = None, False
    side, begin = None, None
    for pose in poses:
        pitch = math.asin(max(-1.0, min(1.0, -pose.rotation[2][0])))
        dipped = dipped or pitch < -FRONT_TURN
        if dipped and pitch >= 0 and front is None:
            front = pose.time
        if math.hypot(*pose.velocity[:2]) < 0.2:
            continue
        course = math.atan2(pose.velocity[1], pose.velocity[0])
        begin = course if begin is None else begin
        if side is None and abs(math.remainder(course - begin, 2 * math.pi)) > SIDE_TURN:
            side = pose.time
    return front, side


def scale_bar(left, height, length=0.5):
    """What a length across the view is as long as; both views have one scale."""
    return (f'set arrow from {left}, {height} to {left + length}, {height} heads size screen 0.004, 90 front lc rgb "#1a1a1a" lw 1.2\n'
            f'set label "{length:g} m, in both" at {left + 0.5 * length}, {height + 0.07} center tc rgb "#1a1a1a"\n')


def edges_of(all_flights):
    """Between which places across the view the flights lie, with room for the airplane and for a title."""
    across = [seen(pose.position)[0] for poses in all_flights for pose in poses]
    middle, half = (min(across) + max(across)) / 2, (max(across) - min(across)) / 2
    half = max(half + 0.1, 0.3)
    return middle - half, middle + half


def airplane_panel(number, title, all_flights, interval, edges):
    left, right, bottom, top, low, high = edges
    shown = all_flights[0]
    every = max(1, round(interval / (shown[1].time - shown[0].time)))
    commands = block(f"others{number}", [[seen(pose.position)[:2] for pose in poses[::4]] for poses in all_flights[1:]])
    commands += block(f"path{number}", [[seen(pose.position)[:2] for pose in shown]])
    faces = []
    for pose in shown[::every]:
        for face, shade in zip(FACES, SHADES):
            corners = [seen([p + q for p, q in zip(pose.position, turned(pose.rotation, corner))]) for corner in face]
            faces.append((sum(corner[2] for corner in corners), shade, [corner[:2] for corner in corners]))
    commands += f'set lmargin at screen {left}\nset rmargin at screen {right}\nset bmargin at screen {bottom}\nset tmargin at screen {top}\n'
    commands += f'set title "{title}" offset 0, -0.5\nset xrange [{low}:{high}]\nunset border\nunset tics\nset yrange [-2.2:0.15]\n'
    for place, (_, shade, corners) in enumerate(sorted(faces), 1):
        text = " to ".join(f"{x:.5f}, {y:.5f}" for x, y in corners + corners[:1])
        commands += f'set object {place} polygon from {text} fc rgb "{shade}" fs solid 0.85 border lc rgb "#16384d" lw 0.4 front\n'
    commands += scale_bar(high - 0.55, -2.0) if number == 0 else ""
    commands += f'plot $others{number} with lines lc rgb "#c9c9c9" lw 0.8, $path{number} with lines lc rgb "#1a1a1a" lw 1\n'
    return commands + "unset arrow\nunset label\n" + "".join(f"unset object {place}\n" for place in range(1, len(faces) + 1))


def airplane_picture(flights_of, picture):
    commands = f'set terminal pngcairo size 2000, 1050 font "DejaVu Sans,16" linewidth 1.6\nset output "{picture}"\n' + STYLE
    commands += "set multiplot\nset size ratio -1\n"
    titles = {"wake": "the wake's slip (default)", "body-velocity": "equation 8"}
    edges = {form: edges_of(all_flights) for form, all_flights in flights_of.items()}
    scale = min(0.6 / sum(high - low for low, high in edges.values()), 0.86 * 1050 / 2000 / 2.35)  # screens a metre
    left = 0.005
    for number, (form, all_flights) in enumerate(flights_of.items()):
        low, high = edges[form]
        right = left + scale * (high - low)
        commands += airplane_panel(number, titles[form], all_flights, (0.1, 0.3)[number], (left, right, 0.06, 0.92, low, high))
        left = right + 0.02
    commands += "set border 3\nset tics nomirror\nset grid lc rgb '#e4e4e4' lt 1 lw 0.8\n"
    commands += "set lmargin at screen 0.66\nset rmargin at screen 0.985\nset bmargin at screen 0.2\nset tmargin at screen 0.9\n"
    commands += 'set title "where they land, m from the start (it flies to the left)"\nset xrange [-1.6:0.8]\nset yrange [-1.2:1.2]\nset xtics 0.5\nset ytics 0.5\n'
    commands += 'set key at screen 0.82, 0.04 center bottom maxrows 1 Left reverse samplen 1 width 1\nset xlabel "x"\nset ylabel "y"\n'
    for number, (form, all_flights) in enumerate(flights_of.items()):
        commands += block(f"ends{number}", [[poses[-1].position[:2] for poses in all_flights]])
    commands += ('plot $ends0 with points pt 7 ps 1.6 lc rgb "#2a6f97" title "the wake", '
                 '$ends1 with points pt 6 ps 1.6 lc rgb "#c0392b" title "equation 8", '
                 '"+" using (0):(0) every ::0::0 with points pt 1 ps 2 lc rgb "#1a1a1a" title "start"\n')
    draw(commands + "unset multiplot\n")


def airplane_row(title, told, all_flights):
    landing = told["landing"]
    found = [turns(poses) for poses in all_flights]
    fronts = [front for front, _ in found if front is not None]
    sides = [side for _, side in found if side is not None]
    mean = lambda times: f", after {sum(times) / len(times):.2f} s" if times else ""
    spread = "-" if not landing else f"[{landing['mean'][0]:.2f}, {landing['mean'][1]:.2f}] m, {landing['spread']:.2f} m"
    duration = sum(poses[-1].time for poses in all_flights) / len(all_flights)
    return (f"| {title} | {len(all_flights)} | {duration:.1f} s | {told['descent_speed']:.2f} m/s | {spread} | "
            f"{len(fronts)} of {len(all_flights)}{mean(fronts)} | {len(sides)} of {len(all_flights)}{mean(sides)} | "
            + ", ".join(f"{count} {name}" for name, count in told["regimes"].items() if count) + " |")


def airplane(programs, bodies, work, folder):
    """Figure 1; returns its table."""
    lines = ["| form | runs | in the air | descent | landing: mean, rms distance from it | turns front | turns aside | regimes |",
             "|---|---|---|---|---|---|---|---|"]
    flights_of, body = {}, ""
    for form, scene, title in (("wake", "paper-airplane", "the wake's slip (default)"),
                               ("body-velocity", "paper-airplane-equation-8", "equation 8, body velocity"),
                               (None, "paper-airplane-still", "no turbulence")):
        motion, told = flown(programs, bodies, scene, work, RUNS if form else 1)
        all_flights = [landed(poses) for poses in flights(programs, motion).values()]
        lines.append(airplane_row(title, told, all_flights))
        if form:
            flights_of[form] = all_flights
            body = body or body_line(told)
    airplane_picture(flights_of, f"{folder}/paper-airplane.png")
    return "\n".join(lines) + "\n" + body


def main(words):
    if len(words) != 4:
        sys.stderr.write(__doc__)
        return 2
    programs, bodies, folder = words[1:4]
    with tempfile.TemporaryDirectory() as work:
        tables = [rubber(programs, bodies, work, folder), airplane(programs, bodies, work, folder)]
    write_tables(f"{folder}/README.md", tables, mark("scenes"))
    print(f"Written: README.md, rubber-three-ways.png and paper-airplane.png in {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
