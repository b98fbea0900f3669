"""Tests whether a case is statistically stationary, by the quantities of the tables.

These are force, moment, and the means of k and epsilon over the near wake. Residuals are not used: that of the pressure settles long
before k, and never where the wake oscillates. Means are taken over the last half of the iterations. A quantity is
stationary when half the difference between the means of the window's two halves (a drift) and the standard error from
six batches (an oscillation) are both within the tolerance.
"""

import math

from case_files import Failure, CaseError, history, word

# The tolerance of k and epsilon relative to that of forces: they settle later and are less certain in any case.
TURBULENCE_TOLERANCES = 3.0
BATCHES = 6
# Loads below these are noise: coefficients relative to rho U^2 A/2 and rho U^2 A L/2.
LEAST_FORCE = 0.1
LEAST_MOMENT = 0.2
# The largest force coefficient that is no sign of divergence: a plate broadside has 2.5; and in creeping flow, times the Reynolds
# number: a sphere has 24.
LARGEST_FORCE = 20.0
LARGEST_CREEPING_FORCE = 100.0
AREA_UNIT = math.pi / 8  # rho U^2 A/2 with rho = U = L = 1 and A = pi L^2/4


class Diverged(Failure):
    """The iterations diverged."""


def mean(values):
    return math.fsum(values) / len(values)


def unsteadiness(values):
    """Returns the larger of the drift and the standard error by batches."""
    half = len(values) // 2
    drift = abs(mean(values[half:]) - mean(values[:half])) / 2
    length = len(values) // BATCHES
    batches = [mean(values[i * length:(i + 1) * length]) for i in range(BATCHES)]
    center = mean(batches)
    squares = math.fsum((batch - center) ** 2 for batch in batches)
    return max(drift, math.sqrt(squares / (BATCHES * (BATCHES - 1))))


def has_turbulence_means(parameters):
    """Whether a case with the text of a file `parameters` averages k and epsilon near the body."""
    return word(parameters, "turbulenceMeans") == "yes"


def whole_history(folder, name, file, last, time_step=1.0):
    """Returns the history, one row [iteration, values...] for each iteration up to `last`. Raises CaseError where one is missing.

    `time_step`: the case's time per iteration."""
    rows = history(folder, name, file)
    for iteration in range(1, int(last) + 1):
        if len(rows) < iteration or abs(rows[iteration - 1][0] / time_step - iteration) > 0.01:
            raise CaseError(f"postProcessing/{name}: {file} has no iteration {iteration} of {last:g}; was the disk full? "
                        "./Allclean starts over")
    return [[iteration, *row[1:]] for iteration, row in enumerate(rows, 1)]


def whole_histories(folder, last, turbulent, time_step=1.0):
    """Returns the histories of force, moment, and k and epsilon (empty where not `turbulent`). Raises CaseError as whole_history."""
    return (whole_history(folder, "forces", "force.dat", last, time_step),
            whole_history(folder, "forces", "moment.dat", last, time_step),
            whole_history(folder, "nearWake", "volFieldValue.dat", last, time_step) if turbulent else [])


def worst_quantity(folder, first, last, tolerance, turbulent, time_step=1.0, viscosity=0.0):
    """Returns (unsteadiness relative to its tolerance, name, first iteration of the window) of the worst quantity.

    `first`: the iteration after which the current settings are used; `last`: the last iteration; `viscosity`: the inverse of the
    Reynolds number. Raises Diverged where values are
    not finite, not positive (k, epsilon) or too large, CaseError where a history is not whole."""
    forces, moments, means = whole_histories(folder, last, turbulent, time_step)
    for row in forces + moments + means:
        if not all(map(math.isfinite, row)):
            raise Diverged(f"a value at iteration {row[0]:g} is not finite")
    start = int(first + (last - first) // 2 + 1)

    def window(rows, column, unit=1.0):
        return [row[column] / unit for row in rows if row[0] >= start]

    weights = {}
    for name, rows, least in (("force", forces, LEAST_FORCE), ("moment", moments, LEAST_MOMENT)):
        components = [window(rows, i, AREA_UNIT) for i in (1, 2, 3)]
        scale = max(least, math.hypot(*map(mean, components)))
        if scale > LARGEST_FORCE + LARGEST_CREEPING_FORCE * viscosity:
            raise Diverged(f"the {name} coefficient reached {scale:.3g}")
        weights[name] = math.hypot(*map(unsteadiness, components)) / (tolerance * scale)
    for i, name in enumerate(("k", "epsilon") if turbulent else (), 1):
        values = window(means, i)
        if mean(values) <= 0.0:
            raise Diverged(f"the mean of {name} is not positive")
        weights[name] = unsteadiness(values) / (TURBULENCE_TOLERANCES * tolerance * mean(values))
    worst = max(weights, key=weights.get)
    return weights[worst], worst, start
