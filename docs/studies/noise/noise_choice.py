#!/usr/bin/env python3
"""How the form of the wake's noise was chosen (README.md): what forms make of the tables' slopes, beside full CFD.

    noise_choice.py BIN    fits the forms' numbers to the cases of noise_report.py that the choice is by, and prints by what
                           factor each is off in the mean, there and on the other cases, all of ready-baked bodies; then the
                           chosen form, refitted without each body, on that body, and with a body's own numbers; and how
                           long the loads last. BIN: the folder of the programs. Run from the project's folder.

A load's rms is that of table(w - u) for small slips u, to the first order; flights average over 0.24 L/U besides. Factors are
means of |log|; a load that is off by more than e^2 counts as that in the fit, and by no more than e^5 in the mean.
"""

import glob
import json
import math
import os
import subprocess
import sys

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from closures_study import Body, cross, minus  # noqa: E402
from noise_report import BODIES, CASES, COMPONENTS, FITTED, file_of, judged, read_rows  # noqa: E402

SMALL = 0.03        # of the speed: the slopes' differences
USUAL = 0.08        # sqrt(2k/3) over |w|: forms by |w| and by k have like numbers so
STRENGTHS = {"|w|": lambda u: USUAL, "k": lambda u: u, "root of both": lambda u: math.sqrt(USUAL * u)}
# What the pressure on the sides goes with, beside their area; `drag` is over the body's own shadow.
SIDES = {"none": None, "|w|": lambda u, drag: 1.0, "drag": lambda u, drag: drag, "drag^2": lambda u, drag: drag ** 2,
         "k^1/2": lambda u, drag: u / USUAL, "drag k^1/2": lambda u, drag: drag * u / USUAL, "k": lambda u, drag: (u / USUAL) ** 2}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Case:
    """A direction of a body: the slopes of its loads by the velocity along the path and along two axes across it."""

    def __init__(self, programs, name, rows):
        self.shape, direction = CASES[name]
        triangles, reynolds, _ = BODIES[self.shape]
        axis = (0.0, 1.0, 0.0) if abs(direction[1]) < 0.9 else (1.0, 0.0, 0.0)
        self.axes = (direction, axis, cross(direction, axis))
        loads, energy, dissipation = self.table(programs, direction, reynolds)
        self.chi = dissipation / energy
        self.fluctuation = math.sqrt(2 * energy / 3)
        self.slopes = []
        for axis in self.axes:
            up, down = (self.table(programs, [x + sign * SMALL * y for x, y in zip(direction, axis)], reynolds)[0]
                        for sign in (1, -1))
            self.slopes.append([(a - b) / (2 * SMALL) for a, b in zip(up, down)])
        self.shadows = [self.shadow(Body(triangles, None, 1.0, None).triangles, axis)
                        for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
        self.drag = -dot(loads[:3], direction) / self.shadow(Body(triangles, None, 1.0, None).triangles, direction)
        self.rms = [(COMPONENTS.index(row.component), row.cfd_rms) for row in rows if row.case == name]

    def table(self, programs, velocity, reynolds):
        words = [f"{programs}/samara", "info", file_of(self.shape), "--json", "--reynolds-number", str(reynolds),
                 "--direction", ",".join(f"{x:.9g}" for x in velocity)]
        entry = json.loads(subprocess.run(words, check=True, capture_output=True).stdout)
        loads = [dot(velocity, velocity) * x for x in entry["force"] + entry["moment"]]
        return loads, entry["turbulent_kinetic_energy"], entry["dissipation_rate"]

    @staticmethod
    def shadow(triangles, axis):
        """Over pi L^2/4, of a convex body."""
        return sum(abs(dot(cross(minus(b, a), minus(c, a)), axis)) / 4 for a, b, c in triangles) / (math.pi / 4)

    def model(self, form, numbers):
        """The rms of the six loads: strengths of the slip along and across the path, and of the sides' pressure."""
        across, side = form
        along_slip, across_slip, *rest = numbers
        squares = [0.0] * 6
        for i, (axis, slopes) in enumerate(zip(self.axes, self.slopes)):
            slip = along_slip * self.fluctuation if i == 0 else across_slip * STRENGTHS[across](self.fluctuation)
            pressed = [0.0] * 6
            if SIDES[side] and i > 0:
                pushed = [rest[0] * slip * SIDES[side](self.fluctuation, self.drag) * s * x for s, x in zip(self.shadows, axis)]
                along = dot(pushed, self.axes[0])
                pressed[:3] = [x - along * d for x, d in zip(pushed, self.axes[0])]
            for k in range(6):
                squares[k] += (pressed[k] - slip * slopes[k]) ** 2
        return [math.sqrt(square) for square in squares]


def misses(form, numbers, cases):
    return [max(-5.0, min(5.0, math.log(max(model[i], 1e-9) / rms)))
            for case in cases for model in [case.model(form, numbers)] for i, rms in case.rms]


def factor(form, numbers, cases):
    off = misses(form, numbers, cases)
    return math.exp(sum(map(abs, off)) / len(off))


def fitted(form, cases, alike):
    """The numbers that miss least: by a search along each in turn from several starts. `alike`: one slip for all directions."""
    def all_numbers(free):
        return [free[0], *free] if alike else free

    def cost(free):
        return sum(min(x * x, 4.0) for x in misses(form, all_numbers(free), cases))

    best = None
    for start in (0.15, 0.3, 0.6):
        free = [start] * ((1 if alike else 2) + (0 if SIDES[form[1]] is None else 1))
        least, step = cost(free), 0.5
        while step > 0.01:
            tries = [free[:i] + [free[i] * change] + free[i + 1:] for i in range(len(free)) for change in (1 + step, 1 / (1 + step))]
            value, found = min((cost(one), one) for one in tries)
            if value < least:
                least, free = value, found
            else:
                step /= 2
        if best is None or least < best[0]:
            best = (least, free)
    return all_numbers(best[1])


def own_numbers(form, cases):
    """What a body's own numbers would gain: of bodies with several directions, each direction by numbers from the other
    bodies, by those from the body's other directions, and by those from all of its directions, itself among them."""
    off = {"other bodies": [], "the body's other directions": [], "all of the body's directions": []}
    for case in cases:
        of_body = [one for one in cases if one.shape == case.shape]
        if len(of_body) < 2:
            continue
        sets = ([one for one in cases if one.shape != case.shape], [one for one in of_body if one is not case], of_body)
        for which, some in zip(off, sets):
            off[which] += misses(form, fitted(form, some, True), [case])
    for which, some in off.items():
        print(f"numbers from {which}: off by a factor of {math.exp(sum(map(abs, some)) / len(some)):.2f}")


def print_times(rows, cases):
    """The times of the loads over L/U and over k/epsilon: geometric means, and by what factor they scatter."""
    for title, unit in (("L/U", lambda case: 1.0), ("k/epsilon", lambda case: 1 / case.chi)):
        logs = {test: [math.log(row.cfd_time / unit(cases[row.case])) for row in rows if (row.case in FITTED) != test] for test in (False, True)}
        middle = sum(logs[False]) / len(logs[False])
        for test, some in logs.items():
            print(f"lasting over {title}, {'test' if test else 'choice'}: {math.exp(sum(some) / len(some)):.2f}, "
                  f"scattering by {math.exp(math.sqrt(sum((x - middle) ** 2 for x in some) / len(some))):.2f}")


def main(programs):
    rows = [row for row in judged(read_rows()) if os.path.exists(file_of(CASES[row.case][0]))]
    cases = {name: Case(programs, name, rows) for name in CASES if any(row.case == name for row in rows)}
    choice = [case for name, case in cases.items() if name in FITTED]
    test = [case for name, case in cases.items() if name not in FITTED]
    print("slip across by, sides by: slip along, across, sides; off by a factor of, choice, test")
    for form in [(across, side) for across in STRENGTHS for side in SIDES]:
        numbers = fitted(form, choice, False)
        print(f"{form[0]:>12}, {form[1]:<10}", *(f"{x:.3g}" for x in numbers), f"{factor(form, numbers, choice):.2f} {factor(form, numbers, test):.2f}")
    chosen = ("k", "|w|")
    numbers = fitted(chosen, choice, True)
    print("one slip by k, sides by it:", *(f"{x:.3g}" for x in numbers[1:]), f"{factor(chosen, numbers, choice):.2f} {factor(chosen, numbers, test):.2f}")
    before = ("|w|", "none"), [0.5, 0.05 / USUAL]
    print(f"the form before (0.5 by k along, 0.05 |w| across): {factor(*before, choice):.2f} {factor(*before, test):.2f}")
    for name, case in cases.items():
        if name not in FITTED:
            print(f"{name}: {factor(chosen, numbers, [case]):.2f}, by the form before {factor(*before, [case]):.2f}")
    whole, count = 0.0, 0
    for body in dict.fromkeys(case.shape for case in choice):
        numbers = fitted(chosen, [case for case in choice if case.shape != body], True)
        off = misses(chosen, numbers, [case for case in choice if case.shape == body])
        whole, count = whole + sum(map(abs, off)), count + len(off)
        print(f"without the {body}:", *(f"{x:.3g}" for x in numbers[1:]), f"{math.exp(sum(map(abs, off)) / len(off)):.2f} on it")
    print(f"all left out: {math.exp(whole / count):.2f}")
    own_numbers(chosen, list(cases.values()))
    print_times(rows, cases)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
