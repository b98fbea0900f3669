"""What is measured of a fall for README.md. Poses are those of study_pictures.flights: SI units, world axes, z up.

Each function returns the value and its error. The error of a mean is half the difference between the means of the two halves of
its stretch: how far it still drifts or swings, and no more than that.
"""

import math

# Shares of the fall that are left out before a mean: of what settles, and of what swings (as in the figures of `samara info`).
SETTLED, SWINGING = 0.8, 1 / 3
# Shares of the frames after the release between which an acceleration is read: full CFD's first steps have a jolt that rings.
JOLT, WINDOW = 0.3, 0.9


def mean(values):
    return sum(values) / len(values)


def mean_with_error(values):
    half = len(values) // 2
    return mean(values), abs(mean(values[:half]) - mean(values[half:])) / 2


def stretch(poses, left_out):
    begin = poses[0].time + left_out * (poses[-1].time - poses[0].time)
    return [pose for pose in poses if pose.time >= begin]


def line_through(points):
    """Value at zero and slope of the straight line that is nearest, and the slope's standard error."""
    x, y = (mean([point[i] for point in points]) for i in (0, 1))
    spread = sum((p - x) ** 2 for p, _ in points)
    slope = sum((p - x) * (q - y) for p, q in points) / spread
    rest = sum((q - y - slope * (p - x)) ** 2 for p, q in points)
    return y - slope * x, slope, math.sqrt(rest / max(1, len(points) - 2) / spread)


def first_acceleration(poses):
    """Downwards, at the release: of the slopes of the speed after the jolt, drawn back to t = 0 along a straight line over t^2, for drag
    goes as the square of the speed, which goes as t."""
    first, last = (round(share * (len(poses) - 1)) for share in (JOLT, WINDOW))
    width = max(1, (last - first) // 8)
    slopes = []
    for begin, end in zip(poses[first:last - width], poses[first + width:last]):
        time = (begin.time + end.time) / 2 - poses[0].time
        slopes.append((time * time, (begin.velocity[2] - end.velocity[2]) / (end.time - begin.time)))
    value, _, error = line_through(slopes)
    return value, error * mean([square for square, _ in slopes])


def settled_descent(poses):
    return mean_with_error([-pose.velocity[2] for pose in stretch(poses, SETTLED)])


def swinging_descent(poses):
    return mean_with_error([-pose.velocity[2] for pose in stretch(poses, SWINGING)])


def peak_speed(poses):
    return max(-pose.velocity[2] for pose in poses), 0.0


def mean_velocity(poses):
    return [mean([pose.velocity[i] for pose in poses]) for i in range(3)]


def over_halves(poses, function):
    """A function of a stretch of poses, with half its difference between the halves."""
    half = len(poses) // 2
    return function(poses), abs(function(poses[:half]) - function(poses[half:])) / 2


def horizontal_speed(poses, left_out=SWINGING):
    """Of the mean velocity: swings to and fro do not count."""
    return over_halves(stretch(poses, left_out), lambda part: math.hypot(*mean_velocity(part)[:2]))


def drift(poses):
    """The angle between the mean path and the vertical (degrees)."""
    def angle(part):
        x, y, z = mean_velocity(part)
        return math.degrees(math.atan2(math.hypot(x, y), -z))
    return over_halves(stretch(poses, SETTLED), angle)


def turning_rate(poses):
    """Of the mean angular velocity (rad/s): of what turns over in one sense; rocking does not count."""
    def rate(part):
        return math.hypot(*(mean([pose.angular_velocity[i] for pose in part]) for i in range(3)))
    return over_halves(stretch(poses, SWINGING), rate)


def spin(poses):
    """Turns in a second about the vertical."""
    return over_halves(stretch(poses, SWINGING),
                       lambda part: abs(mean([pose.angular_velocity[2] for pose in part])) / (2 * math.pi))


def coning(poses):
    """How far the wing, along the shape's x axis, stands above the level (degrees)."""
    return mean_with_error([math.degrees(math.asin(max(-1.0, min(1.0, pose.rotation[2][0])))) for pose in stretch(poses, SWINGING)])


MEASURES = {
    "first acceleration": first_acceleration, "peak speed": peak_speed, "speed without walls": settled_descent,
    "horizontal speed": horizontal_speed, "drift": drift, "turning rate": turning_rate, "spin": spin, "coning": coning,
}


def measured(case, quantity, poses):
    if quantity == "descent speed":
        return (settled_descent if case.group == "spheres" else swinging_descent)(poses)
    if quantity == "horizontal speed" and case.group == "spheres":
        return horizontal_speed(poses, SETTLED)
    return MEASURES[quantity](poses)
