"""What a solved case of turbulence_cases.py says of k and epsilon in the near wake, and of its eddies."""

import os
import re
import subprocess

import numpy
from scipy.spatial import cKDTree

from turbulence_cases import BODIES, DIRECTIONS, SPACING, Body, probe_places
from case_files import time_folders

LIST = re.compile(rb"internalField\s+nonuniform\s+List<(\w+)>\s*(\d+)\s*\(", re.MULTILINE)
WIDTH = {b"scalar": 1, b"vector": 3, b"symmTensor": 6}
NEAR, FAR = 0.2, 1.5  # distances from the body, L: the near wake of foam-cases/templates/body-flow
FEWEST_ROWS = 300


def field(folder, name):
    """The values of a binary field, one row a cell."""
    with open(os.path.join(folder, name), "rb") as file:
        data = file.read()
    found = LIST.search(data)
    width = WIDTH[found.group(1)]
    values = numpy.frombuffer(data, count=width * int(found.group(2)), offset=found.end())
    return values if width == 1 else values.reshape(-1, width)


def distances(triangles, places, spacing=0.03):
    """From places to a surface, by points on it."""
    points = []
    for a, b, c in numpy.array(Body(triangles, None, 1.0, None).triangles):
        longest = max(numpy.linalg.norm(b - a), numpy.linalg.norm(c - a), numpy.linalg.norm(c - b))
        n = max(1, int(numpy.ceil(longest / spacing)))
        i, j = numpy.array([(i, j) for i in range(n + 1) for j in range(n + 1 - i)]).T
        points.append(a + numpy.outer(i / n, b - a) + numpy.outer(j / n, c - a))
    return cKDTree(numpy.concatenate(points)).query(places)[0]


def last_fields(case):
    times = time_folders(case)
    folder = times[max(times)]
    if not os.path.exists(os.path.join(folder, "C")):
        subprocess.run(["postProcess", "-func", "writeCellCentres", "-latestTime"], cwd=case, check=True, capture_output=True,
                       env={"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ})
    return folder


def near_wake(case, name, model):
    """k, epsilon (None of DDES, whose k is resolved plus modelled) and the resolved share of k, weighted by k; and the mean of k over
    the shell of earlier tables."""
    folder = last_fields(case)
    places, volume = field(folder, "C"), field(folder, "V")
    distance = numpy.full(len(volume), numpy.inf)
    close = numpy.linalg.norm(places, axis=1) < 6
    distance[close] = distances(BODIES[DIRECTIONS[name][0]][0], places[close])
    where = (distance > NEAR) & (distance < FAR)
    shell = (distance > 0.05) & (distance < 0.25)
    if model == "DDES":
        stress = field(folder, "UPrime2Mean")
        resolved = 0.5 * (stress[:, 0] + stress[:, 3] + stress[:, 5])
        k, epsilon = resolved + field(folder, "kMean"), None
    else:
        k = field(folder, "k")
        resolved = 0 * k
        epsilon = field(folder, "epsilon") if os.path.exists(os.path.join(folder, "epsilon")) else 0.09 * field(folder, "omega") * k
    weight = (k * volume)[where]
    return ((weight * k[where]).sum() / weight.sum(),
            None if epsilon is None else (weight * epsilon[where]).sum() / weight.sum(),
            (resolved * volume)[where].sum() / weight.sum(), (k * volume)[shell].sum() / volume[shell].sum())


def read_probes(case):
    """Times, and velocities of all probes at each."""
    times, rows = [], []
    for path in time_folders(os.path.join(case, "postProcessing/probes")).values():
        with open(os.path.join(path, "U"), encoding="utf-8") as file:
            for line in file:
                if line.startswith("#"):
                    continue
                numbers = numpy.array(re.sub(r"[()]", " ", line).split(), dtype=float)
                while times and times[-1] >= numbers[0] - 1e-9:
                    times.pop()
                    rows.pop()
                times.append(numbers[0])
                rows.append(numbers[1:].reshape(-1, 3))
    return numpy.array(times), numpy.array(rows)


def weighted(k):
    return (k * k).sum() / k.sum()


def eddies(case, name):
    """Of the resolved fluctuation at the probes in the near wake: k weighted by k of the first and the second half of the times, the
    integral time (L/U) and the integral length across the flow (L), each to the first zero of the correlation, weighted by k."""
    times, velocity = read_probes(case)
    shape, direction = DIRECTIONS[name]
    places = numpy.array([place for place, _ in probe_places(direction)])
    steps = numpy.array([step for _, step in probe_places(direction)])
    distance = distances(BODIES[shape][0], places)
    inside = numpy.all(numpy.abs(velocity[0]) < 1e3, axis=1) & (distance > NEAR) & (distance < FAR)
    velocity, steps = velocity[:, inside], steps[inside]
    x = velocity - velocity.mean(0)
    k = 0.5 * (x ** 2).mean(0).sum(1)
    halves = [weighted(0.5 * ((half - half.mean(0)) ** 2).mean(0).sum(1)) for half in numpy.array_split(x, 2)]
    count = len(times)
    correlation = numpy.zeros(count // 2)
    for axis in range(3):
        spectrum = numpy.abs(numpy.fft.rfft(x[:, :, axis], 2 * count, axis=0)) ** 2
        lagged = numpy.fft.irfft(spectrum, axis=0)[:count // 2] / numpy.arange(count, count - count // 2, -1)[:, None]
        correlation += (lagged * k).sum(1)
    return (*halves, (times[1] - times[0]) * to_first_zero(correlation / correlation[0]),
            numpy.mean([SPACING * to_first_zero(across(x, steps, axis)) for axis in (1, 2)]))


def across(x, steps, axis):
    """The correlation of the fluctuations over 0, 1, 2, ... steps along an axis."""
    index = {tuple(step): i for i, step in enumerate(steps)}
    found = []
    for count in range(7):
        pairs = [(i, index[other]) for step, i in index.items()
                 for other in [tuple(s + count * (a == axis) for a, s in enumerate(step))] if other in index]
        one, other = x[:, [i for i, _ in pairs]], x[:, [j for _, j in pairs]]
        found.append((one * other).mean(0).sum() / (0.5 * ((one ** 2).mean(0).sum() + (other ** 2).mean(0).sum())))
    return numpy.array(found)


def to_first_zero(correlation):
    """Its integral by the trapezoidal rule in steps."""
    below = numpy.flatnonzero(correlation <= 0)
    return correlation[:below[0] if len(below) else len(correlation)].sum() - 0.5
