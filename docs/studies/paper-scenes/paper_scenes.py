#!/usr/bin/python3
"""The paper's figures 1 and 3 with the project's scenes, and its process beside full CFD: pictures and the tables of README.md.

    paper_scenes.py BIN BODIES FOLDER

BIN: the folder of the programs; BODIES: of rubber.body.h5 and airplane.body.h5, the ready-baked ellipsoid and airplane;
FOLDER: gets the pictures. Run from the project's folder.
"""

import glob
import math
import os
import statistics
import sys
import tempfile

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from falls_report import compared, run  # noqa: E402
from report_tables import mark, write_tables  # noqa: E402
from test_falls_report import FOLDER as FALLS  # noqa: E402
from study_pictures import GRAY, ellipsoid_outline, flights, key, new_figure, save, turned  # noqa: E402

SCENES = "docs/scenes"
RUNS = 20
FRONT_TURN = math.radians(20)  # how far the nose dips before it comes up to level again
SIDE_TURN = math.radians(45)   # how far the course turns

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


def bare(figure, place, x, y):
    """Axes without a frame on a place (left, bottom, width, height: shares) between two ends of each direction."""
    axes = figure.add_axes(place)
    axes.set_axis_off()
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    return axes


def scale_bar(axes, begin, end, text):
    """A line with ends from one place to another, and what it is as long as."""
    axes.annotate("", begin, end, annotation_clip=False, arrowprops={"arrowstyle": "|-|,widthA=0.3,widthB=0.3", "lw": 1.2, "shrinkA": 0, "shrinkB": 0})
    axes.text(0.5 * (begin[0] + end[0]), 0.5 * (begin[1] + end[1]) + 0.02, text, ha="center", va="bottom")


def rubber_picture(motions, picture):
    """Each motion as a strip from the front and from the side, and the inclinations beside them."""
    width, height = 2300, 1320
    scale = 1200.0 / (FALLEN + 0.09)  # pixels a metre
    figure = new_figure(width, height, 16)
    left = 20.0
    for name, (title, poses, interval) in motions.items():
        shown = [pose for pose in poses if pose.position[2] > -FALLEN]
        every = round(interval / (poses[1].time - poses[0].time))
        figure.text(left / width + 0.004, 0.972, title, color=COLOURS[name])
        for axis, side in enumerate(("front", "side")):
            outlines = [ellipsoid_outline(SEMI_AXES, pose, axis) for pose in shown[::every]]
            across = [point[0] for outline in outlines for point in outline]
            middle, half = (min(across) + max(across)) / 2, max(0.058, (max(across) - min(across)) / 2 + 0.008)
            axes = bare(figure, (left / width, 0.015, 2 * half * scale / width, 1200.0 / height), (middle - half, middle + half), (-FALLEN - 0.04, 0.05))
            for outline in outlines:
                axes.fill(*zip(*outline), fc=COLOURS[name] + "40", ec=COLOURS[name], lw=1)
            axes.plot([pose.position[axis] for pose in shown], [pose.position[2] for pose in shown], color="#1a1a1a", lw=0.8)
            axes.text(0.5, 0.995, side, transform=axes.transAxes, ha="center", va="center", color=GRAY)
            left += 2 * half * scale + (14 if axis == 0 else 34)
    bar = bare(figure, (left / width, 0.03, 50 / width, 0.1 * scale / height), (0, 1), (0, 1))
    scale_bar(bar, (0, 0), (0, 1), "")
    bar.text(0.2, 0.5, "0.1 m, in all", rotation=90, va="center")
    left = (left + 90) / width
    for number, (name, (title, poses, _)) in enumerate(motions.items()):
        axes = figure.add_axes((left, 0.93 - number * 0.31 - 0.235, 0.99 - left, 0.235))
        early = [pose for pose in poses if pose.time <= 4.0]
        axes.plot([pose.time for pose in early], [inclination(pose) for pose in early], color=COLOURS[name], lw=2)
        axes.set(title=f"{title.split(':')[0]}: inclination, degrees", xlim=(0, 4), ylim=(0, 90), xlabel="time, s" if number == 2 else "")
        axes.set_xticks(range(5))
        axes.set_yticks([0, 30, 60, 90])
    save(figure, picture)


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


def edges_of(all_flights):
    """Between which places across the view the flights lie, with room for the airplane and for a title."""
    across = [seen(pose.position)[0] for poses in all_flights for pose in poses]
    middle, half = (min(across) + max(across)) / 2, (max(across) - min(across)) / 2
    half = max(half + 0.1, 0.3)
    return middle - half, middle + half


def airplane_panel(axes, title, all_flights, interval):
    """All flights as lines, and the airplane along the first at even times."""
    shown = all_flights[0]
    every = max(1, round(interval / (shown[1].time - shown[0].time)))
    for poses in all_flights[1:]:
        axes.plot(*zip(*(seen(pose.position)[:2] for pose in poses[::4])), color="#c9c9c9", lw=0.8)
    axes.plot(*zip(*(seen(pose.position)[:2] for pose in shown)), color="#1a1a1a", lw=1)
    faces = []
    for pose in shown[::every]:
        for face, shade in zip(FACES, SHADES):
            corners = [seen([p + q for p, q in zip(pose.position, turned(pose.rotation, corner))]) for corner in face]
            faces.append((sum(corner[2] for corner in corners), shade, [corner[:2] for corner in corners]))
    for order, (_, shade, corners) in enumerate(sorted(faces)):
        axes.fill(*zip(*corners), fc=shade + "d9", ec="#16384d", lw=0.4, zorder=3 + order)
    axes.set_title(title)


def airplane_picture(flights_of, picture):
    figure = new_figure(2000, 1050, 16)
    titles = {"wake": "the wake's slip (default)", "body-velocity": "equation 8"}
    edges = {form: edges_of(all_flights) for form, all_flights in flights_of.items()}
    scale = min(0.6 / sum(high - low for low, high in edges.values()), 0.86 * 1050 / 2000 / 2.35)  # screens a metre
    left, tall = 0.005, 2.35 * scale * 2000 / 1050
    for number, (form, all_flights) in enumerate(flights_of.items()):
        low, high = edges[form]
        axes = bare(figure, (left, 0.92 - tall, scale * (high - low), tall), (low, high), (-2.2, 0.15))
        airplane_panel(axes, titles[form], all_flights, (0.1, 0.3)[number])
        if number == 0:
            scale_bar(axes, (high - 0.55, -2.1), (high - 0.05, -2.1), "0.5 m, in both")
        left += scale * (high - low) + 0.02
    axes = figure.add_axes((0.66, 0.2, 0.325, 0.7))
    for all_flights, name, face in zip(flights_of.values(), ("the wake", "equation 8"), ("#2a6f97", "none")):
        ends = [poses[-1].position[:2] for poses in all_flights]
        axes.plot(*zip(*ends), "o", mfc=face, mec="#2a6f97" if face != "none" else "#c0392b", mew=1.6, ms=8, label=name)
    axes.plot(0, 0, "+", color="#1a1a1a", ms=12, mew=2, label="start")
    axes.set(title="where they land, m from the start (it flies to the left)", xlim=(-1.6, 0.8), ylim=(-1.2, 1.2), xlabel="x", ylabel="y")
    key(figure, (axes,), 3, (0.82, 0.03))
    save(figure, picture)


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


# The paper's process beside full CFD.

BODIES = ("cube", "sheet", "ellipsoid")  # ready-baked, with test falls of their shape
FORMS = {
    "no noise": ("off", {}),
    "the wake (default)": ("on", {}),
    "the stream, `seen-fluid`": ("on", {"langevin": "seen-fluid"}),
    "equation 8, `body-velocity`": ("on", {"langevin": "body-velocity"}),
    "equation 8, with its drag coefficient": ("on", {"langevin": "body-velocity", "loads": "coefficients"}),
}


def forms(programs, work):
    """A line for each form: how far its test falls are from full CFD, in the mean."""
    lines = ["| form | falls | descent off by, mean | descent, median | rms angular speed off by a factor of | regimes right |", "|---|---|---|---|---|---|"]
    scenes = [(scene, body) for body in BODIES for scene in sorted(os.listdir(FALLS))
              if scene.startswith(f"{body}-") and scene.endswith(".toml")]
    for form, (noise, keys) in FORMS.items():
        descents, spins, right = [], [], 0
        for scene, body in scenes:
            name = scene.removesuffix(".toml")
            told = compared(programs, f"runtime/bodies/{body}.body.h5", name, work, noise, FALLS, keys)
            descents.append(told["measures"]["descent_speed"]["relative_difference"])
            spins.append(abs(math.log(1 + told["measures"]["rms_angular_speed"]["relative_difference"])))
            right += told["motion"]["regime"] == told["reference"]["regime"]
        lines.append(f"| {form} | {len(scenes)} | {100 * statistics.mean(map(abs, descents)):.0f} % | {100 * statistics.median(descents):+.0f} % | "
                     f"{math.exp(statistics.mean(spins)):.2f} | {right} |")
    return "\n".join(lines) + "\n"


def main(words):
    if len(words) != 4:
        sys.stderr.write(__doc__)
        return 2
    programs, bodies, folder = words[1:4]
    with tempfile.TemporaryDirectory() as work:
        tables = [rubber(programs, bodies, work, folder), airplane(programs, bodies, work, folder), forms(programs, work)]
    write_tables(f"{folder}/README.md", tables, mark("scenes"))
    print(f"Written: README.md, rubber-three-ways.png and paper-airplane.png in {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
