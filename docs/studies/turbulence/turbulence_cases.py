"""The bodies, meshes and models of README.md, and how a case is set up and solved."""

import glob
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from closures_report import make_case, run, set_parameters  # noqa: E402
from case_files import read_record  # noqa: E402
from closures_study import RESOLVED, Body, mesh, sphere, unsteady  # noqa: E402
from noise_report import BODIES as NOISE_BODIES, CASES as NOISE_CASES, STEP, STEPS, vector, wake_radius  # noqa: E402


def capsule(diameter, length):
    """Its axis along z: a sphere cut into two halves."""
    shift = (length - diameter) / 2
    return [[(x, y, z + math.copysign(shift, z)) for x, y, z in triangle] for triangle in sphere(diameter, diameter, diameter)]


BODIES = {name: (triangles, reynolds) for name, (triangles, reynolds, _) in NOISE_BODIES.items()}
BODIES["capsule"] = (capsule(15, 60), 9300)
DIRECTIONS = {
    **NOISE_CASES,
    "capsule-67": ("capsule", (math.sin(math.radians(23)), 0.0, math.cos(math.radians(23)))),
    "capsule-0": ("capsule", (1, 0, 0)),
}
BLUNT = ("disc-0", "disc-45", "sheet-0", "sheet-45", "cube-0", "cube-45", "ellipsoid-0", "capsule-0", "box-0", "box-45",
         "spheroid-0")

# As a bake solves k and epsilon (bake_quality.cpp), to its tolerance.
STEADY = {"roundIterations": 50, "leastIterations": 150, "mostIterations": 600, "stationarity": 0.01}
OMEGA = {"solvesForOmega": "yes", "dissipationField": "turbulenceProperties:epsilon"}
MODELS = {
    "kEpsilon": STEADY,
    "LUST": {**STEADY, "convection": "LUST grad(U)"},
    "upwind": {**STEADY, "convection": "limitedLinear 1", "turbulenceConvection": "upwind"},
    "wall": STEADY,  # production by the wall function in laminar layers too
    "realizableKE": {**STEADY, "closure": "realizableKE"},
    "kOmegaSST": {**STEADY, **OMEGA, "closure": "kOmegaSST"},
    "DDES": {**unsteady(f"{STEP}", STEPS), **RESOLVED, "simulationType": "LES", "closure": "kOmegaSSTDDES",
             "convection": "LUST grad(U)", "turbulenceConvection": "upwind", "turbulenceMeans": "no"},
}
MESHES = {
    **{f"F{cells}": {**mesh(cells, 4, "medium", 3), "refinementShells": "((1.0 4) (2.2 3) (3.5 2) (5 1))"}
       for cells in (10, 14, 20, 28)},
    "medium": mesh(20, 4, "medium", 3),  # these two as tables had them before: fine at the surface, coarse behind
    "fine": mesh(20, 5, "fine", 4),
    "wake": mesh(20, 4, "medium", 9, "1.4"),  # and a fine cylinder behind the body: a mesh for each direction
}
WAKE_LENGTH, AVERAGED_FROM = 2.5, 24
SPACING = 0.25  # of the probes, L


def probe_places(direction):
    """In the wake: (place, steps along the flow and along two axes across)."""
    axis = (0.0, 1.0, 0.0) if abs(direction[1]) < 0.9 else (1.0, 0.0, 0.0)
    second = (direction[1] * axis[2] - direction[2] * axis[1], direction[2] * axis[0] - direction[0] * axis[2],
              direction[0] * axis[1] - direction[1] * axis[0])
    return [([SPACING * (-i * d + j * a + k * b) for d, a, b in zip(direction, axis, second)], (i, j, k))
            for i in range(0, 9) for j in range(-4, 5) for k in range(-4, 5)]


def function_objects(direction):
    """Of a case in time: means of velocity, its stresses and the modelled k, and velocities at the probes."""
    places = "\n".join("            " + vector(place) for place, _ in probe_places(direction))
    return f"""
functions
{{
    means
    {{
        type            fieldAverage;
        libs            ("libfieldFunctionObjects.so");
        writeControl    writeTime;
        timeStart       {AVERAGED_FROM};
        restartOnRestart false;
        fields
        (
            U {{ mean on; prime2Mean on; base time; }}
            k {{ mean on; prime2Mean off; base time; }}
        );
    }}
    probes
    {{
        type            probes;
        libs            ("libsampling.so");
        writeControl    timeStep;
        writeInterval   4;
        timeStart       {AVERAGED_FROM};
        fields          (U);
        probeLocations
        (
{places}
        );
    }}
}}
"""


def is_done(folder):
    record = read_record(os.path.join(folder, "rounds.json"))
    attempts = record.get("attempts", [])
    return record.get("verdict") is not None or bool(attempts) and attempts[-1]["iterations"] >= STEPS


def folder_of(work, name, on, model):
    return os.path.join(work, f"{name}_{on}_{model}")


def change_file(path, change):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(change(text))


def write_surface(folder, body):
    os.makedirs(os.path.join(folder, "constant/triSurface"), exist_ok=True)
    body.write(os.path.join(folder, "constant/triSurface/body.stl"))


def link_mesh(work, folder, shape, body, on):
    """One mesh for all directions of a body."""
    shared = os.path.join(work, f"mesh_{shape}_{on}")
    if not os.path.exists(os.path.join(shared, "constant/polyMesh/points")):
        make_case(shared)
        write_surface(shared, body)
        set_parameters(shared, MESHES[on])
        run(["./Allrun", "mesh"], shared)
    os.symlink(os.path.relpath(os.path.join(shared, "constant/polyMesh"), os.path.join(folder, "constant")),
               os.path.join(folder, "constant/polyMesh"))


def solve(work, name, on, model, before=None):
    """Solves the case where it is not solved; `before`: the mesh whose solution it starts from. Returns its folder."""
    folder = folder_of(work, name, on, model)
    if is_done(folder):
        return folder
    shape, direction = DIRECTIONS[name]
    triangles, reynolds = BODIES[shape]
    body = Body(triangles, None, math.pi / 4, None, direction)
    if not os.path.exists(os.path.join(folder, "parameters")):
        make_case(folder)
        write_surface(folder, body)
        if model == "DDES":
            change_file(os.path.join(folder, "system/controlDict"), lambda text: text + function_objects(direction))
        if model == "wall":
            change_file(os.path.join(folder, "0.orig/epsilon"), lambda text: text.replace("lowReCorrection on", "lowReCorrection off"))
        entries = {**MESHES[on], "direction": vector(direction), "flowVelocity": vector([-x for x in direction]),
                   "reynoldsNumber": f"{reynolds:g}", "viscosity": f"{1 / reynolds:.8g}",
                   "inflowEpsilon": f"{0.09 * 1.5e-4 ** 2 * reynolds:.6g}", "inflowNut": f"{1 / reynolds:.8g}",
                   "inflowOmega": f"{1.5e-4 * reynolds:.6g}", **MODELS[model]}
        if on == "wake":
            entries |= {"wakeLevel": 4, "wakeRadius": f"{wake_radius(body, direction):.4g}",
                        "wakeEnd": vector([-WAKE_LENGTH * x for x in direction])}
        else:
            link_mesh(work, folder, shape, body, on)
        if before:
            entries["startFrom"] = os.path.basename(folder_of(work, name, before, model))
            with open(os.path.join(work, entries["startFrom"], "provenance.json"), "a", encoding="utf-8"):
                pass  # by which the template knows a solved case
        set_parameters(folder, entries)
    run(["./Allrun"], folder)
    return folder
