"""Pictures of one body's motion: silhouettes with time series, phase portraits, and maps of landings.

Those of one fall take a dict with name, run of runs, copy of copies (counted from 0), measures (as BodyMotion.measure
gives them) and fall [begin, end] (s); lists have an entry for each frame. SI units, radians, world axes with z up.
"""

import math
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from .silhouettes import FRONT, SIDE, Silhouettes, chosen_frames, rotations
from .style import (BLACK, BLUE, BOTTOM, GRAY, GREEN, LEFT, ORANGE, PINK, RIGHT, TOP, Lengths, airy, colored_line,
                    count_angles, heading,
                    label, new_figure, number, panel, set_limits, shade, shares, time_color)

_PORTRAIT = (LEFT + 10, BOTTOM, 985.0, TOP - BOTTOM)
_SERIES_LEFT = 1270.0
_GAP = 60.0  # between the two views
_LONGEST_ARROW = 110.0  # pixels
_WIDEST, _NARROWEST = 900.0, 250.0  # pixels: both views with their gap, one view
_SMOOTH_SWING = 12.0  # frames: of fewer the curve shows corners


def _title(figure: Any, data: dict[str, Any]) -> None:
    measures = data["measures"]
    if measures["rms_angular_speed"] == 0.0 and not any(measures["mean_velocity"]):
        rest = ": at rest"
    else:
        speed = measures["descent_speed"]
        rest = f": {measures['regime']}, {'rises' if speed < 0.0 else 'descends'} at {number(abs(speed), 3)} m/s"
    below = [f"{one} {data[one]} of {data[all_of_them]}" for one, all_of_them in (("run", "runs"), ("copy", "copies"))
             if data[all_of_them] > 1]
    if measures["frequency"] is not None:
        below.append(f"{number(measures['frequency'], 3)} Hz")
    begin, end = measures["window"]
    below.append(f"inclination 95 % below {math.degrees(measures['inclination_amplitude']):.0f}°")
    below.append(f"measured from {begin:.2f} s to {end:.2f} s (shaded)")
    heading(figure, data["name"], rest, "  ·  ".join(below))


def _time_range(times: Any) -> tuple[float, float]:
    return (times[0], times[-1]) if times[-1] > times[0] else (times[0] - 0.5, times[0] + 0.5)


def _of_frames(times: Any) -> dict[str, Any]:
    """How a curve is drawn: a dot where there is one frame alone."""
    return {} if len(times) > 1 else {"marker": "o", "ms": 4}


def strip(data: dict[str, Any]) -> Any:
    """Draws the body's silhouettes along its path, from the front and from the side, beside its time series.

    `data`: also times, position [x, y, z] of the centre of mass, orientation [x, y, z, w] from shape to world axes,
    descent_speed, inclination, angular_velocity [x, y, z]; vertices (shape axes, about the centre of mass) and
    triangles (numbers of three vertices, anticlockwise from outside).
    """
    return _along_path(data, (), _series)


_FORCES = {"drag": ORANGE, "lift": BLUE, "inertia": GREEN, "noise": PINK, "buoyancy": GRAY}
_ARROWS = ("drag", "lift", "inertia")


def forces(data: dict[str, Any]) -> Any:
    """Draws the fluid's forces as arrows at the body's silhouettes, and over time.

    `data`: that of strip(), and in force and moment (about the centre of mass) for each of buoyancy, inertia, drag, lift
    and noise the vector [x, y, z] of each frame (N, N m).
    """
    return _along_path(data, _ARROWS, _force_series)


def _along_path(data: dict[str, Any], arrows: tuple[str, ...], series: Any) -> Any:
    """Draws silhouettes along the path, with arrows of these forces, beside the time series that `series` draws."""
    times = np.asarray(data["times"], dtype=float)
    position = np.asarray(data["position"], dtype=float)
    rotation = rotations(data["orientation"])
    vertices, triangles = np.asarray(data["vertices"], dtype=float), np.asarray(data["triangles"], dtype=int)
    begin, end = (int(np.searchsorted(times, time - 1e-9)) for time in data["fall"])
    last = min(end, len(times) - 1)
    first, frames = chosen_frames(position, rotation, vertices, min(begin, last), last)
    figure = new_figure()
    figure.shown = {"silhouettes": len(frames), "strip": [times[first], times[last]]}
    _title(figure, data)
    length = times[last] - times[first]
    share = (times - times[first]) / length if length > 0.0 else np.zeros(len(times))
    vectors = {name: np.asarray(data["force"][name], dtype=float) for name in arrows}
    right = _views(figure, position, rotation, Silhouettes(vertices, triangles, len(frames)), times, share, first, last,
                   frames, vectors)
    series(figure, data, times, share, frames, right + 110.0)
    return figure


def _force_series(figure: Any, data: dict[str, Any], times: Any, _share: Any, _frames: list[int], left: float) -> None:
    gap = 95.0
    tall = (TOP - BOTTOM - 2 * gap) / 3.0
    force = {name: np.asarray(data["force"][name], dtype=float) for name in _FORCES}
    moment = {name: np.asarray(data["moment"][name], dtype=float) for name in _FORCES}
    rows = (("Forces (N)", {name: np.linalg.norm(force[name], axis=1) for name in _FORCES}),
            ("Upward parts (N)", {name: force[name][:, 2] for name in _FORCES}),
            ("Moments (N m)", {name: np.linalg.norm(moment[name], axis=1) for name in _FORCES if name != "drag"}))
    for row, (title, values) in enumerate(rows):
        axes = panel(figure, (left, BOTTOM + (2 - row) * (tall + gap), RIGHT - left, tall), title,
                     "time (s)" if row == 2 else "", [(name, _FORCES[name]) for name in _FORCES] if row == 0 else "")
        axes.set_xlim(_time_range(times))
        shade(axes, data["measures"]["window"])
        for name, one in values.items():
            axes.plot(times, one, color=_FORCES[name], lw=1.0, **_of_frames(times))
        axes.set_ylim(_with_zero(np.concatenate(list(values.values()))))


def _views(figure: Any, position: Any, rotation: Any, body: Silhouettes, times: Any, share: Any, first: int, last: int,
           frames: list[int], forces: dict[str, Any]) -> float:
    """Draws both views to one scale, with forces as arrows; returns where their last text ends (pixels)."""
    path = position[first:last + 1]
    shown = np.concatenate([path, *(position[i] + body.vertices @ rotation[i].T for i in frames)])
    low, high = shown.min(axis=0), shown.max(axis=0)
    size = high - low
    margin = 0.035 * max(size[2], 0.5 * (size[0] + size[1]), 1e-9)
    low, size = low - margin, size + 2.0 * margin
    tall = TOP - BOTTOM
    pixel = max(size[2] / tall, (size[0] + size[1]) / (_WIDEST - _GAP))
    if min(size[:2]) < _NARROWEST * pixel:
        pixel = max(size[2] / tall, max(size[:2]) / (_WIDEST - _GAP - _NARROWEST))
    wide = np.maximum(size[:2] / pixel, _NARROWEST)
    middle = low + 0.5 * size
    heights = Lengths(middle[2] - 0.5 * tall * pixel, middle[2] + 0.5 * tall * pixel, tall, 75.0)
    left = float(LEFT)
    for axis, (view, name, title) in enumerate(((FRONT, "x", "From the front"), (SIDE, "y", "From the side"))):
        half = 0.5 * wide[axis] * pixel
        across = Lengths(middle[axis] - half, middle[axis] + half, wide[axis], 90.0)
        axes = panel(figure, (left, BOTTOM, wide[axis], tall), title, across.title(name))
        across.apply(axes.xaxis)
        heights.apply(axes.yaxis)
        if axis == 0:
            height_title(figure, heights, left)
        else:
            axes.tick_params(labelleft=False)
        axes.plot(across.of(path[:, axis]), heights.of(path[:, 2]), color="#9a9a9a", lw=0.8, gid=f"path_{name}")
        polygons, colors = zip(*(body.painted(position[i], rotation[i], view, time_color(share[i]), 1.4 * pixel)
                                 for i in frames))
        places = np.concatenate(polygons)
        places = np.stack([across.of(places[..., 0]), heights.of(places[..., 1])], axis=-1)
        axes.add_collection(PolyCollection(places, facecolors=np.concatenate(colors), edgecolors="none", lw=0, zorder=3,
                                           gid=f"silhouettes_{name}"), autolim=False)
        greatest = max((float(np.linalg.norm(vectors[frames], axis=1).max()) for vectors in forces.values()), default=0.0)
        for name, vectors in forces.items():
            scale = _LONGEST_ARROW * pixel / greatest if greatest > 0.0 else 0.0
            for i in frames:
                tip = position[i] + scale * vectors[i]
                axes.annotate("", (float(across.of(tip[axis])), float(heights.of(tip[2]))),
                              (float(across.of(position[i][axis])), float(heights.of(position[i][2]))),
                              arrowprops={"arrowstyle": "-|>", "color": _FORCES[name], "lw": 1.0, "shrinkA": 0.0,
                                          "shrinkB": 0.0, "mutation_scale": 6.0}, zorder=5)
        left += wide[axis] + _GAP
    edge = left - _GAP
    taken: list[float] = []
    for i in frames:
        y = BOTTOM + (position[i][2] - (middle[2] - 0.5 * tall * pixel)) / pixel
        if all(abs(y - other) > 34.0 for other in taken):
            taken.append(y)
            label(figure, edge + 14.0, y, f"{times[i]:.2f} s", color=0.8 * np.asarray(time_color(share[i]))[:3])
    return edge + 115.0


def height_title(figure: Any, heights: Lengths, left: float) -> None:
    """Names the upright axis beside the head of a panel, or above it where the name is long."""
    title = heights.title("z")
    if title == "z (m)":
        label(figure, left - 12.0, TOP + 30.0, title, ha="right")
    else:
        label(figure, 45.0, TOP + 63.0, title)


def _series(figure: Any, data: dict[str, Any], times: Any, share: Any, frames: list[int], left: float) -> None:
    measures = data["measures"]
    gap = 95.0
    tall = (TOP - BOTTOM - 2 * gap) / 3.0
    colors = time_color(share[frames])

    def begin(row: int, title: str, aside: Any, across: str = "") -> Any:
        axes = panel(figure, (left, BOTTOM + (2 - row) * (tall + gap), RIGHT - left, tall), title, across, aside)
        axes.set_xlim(_time_range(times))
        shade(axes, measures["window"])
        return axes

    def scalar(axes: Any, values: Any, mean: float) -> None:
        axes.plot(times, values, color="#333333", lw=1.0, **_of_frames(times))
        axes.scatter(times[frames], values[frames], color=colors, s=10, zorder=3)
        axes.plot(measures["window"], [mean, mean], color=ORANGE, lw=1.0, dashes=(3, 2))

    speed = np.asarray(data["descent_speed"], dtype=float)
    axes = begin(0, "Descent speed (m/s)", f"mean {number(measures['descent_speed'], 3)}")
    scalar(axes, speed, measures["descent_speed"])
    axes.set_ylim(_with_zero(speed))

    inclination = np.degrees(np.asarray(data["inclination"], dtype=float))
    axes = begin(1, "Inclination (°)", f"mean {math.degrees(measures['mean_inclination']):.1f}, 95 % below "
                                       f"{math.degrees(measures['inclination_amplitude']):.1f}")
    scalar(axes, inclination, math.degrees(measures["mean_inclination"]))
    inclination_axis(axes, inclination.max())

    spin = np.asarray(data["angular_velocity"], dtype=float)
    axes = begin(2, "Angular velocity (rad/s)", [("x", ORANGE), ("y", GREEN), ("z", BLUE),
                                                 (f"  rms {number(measures['rms_angular_speed'], 3)}", GRAY)],
                                                 "time (s)")
    for axis, color in enumerate((ORANGE, GREEN, BLUE)):
        axes.plot(times, spin[:, axis], color=color, **_of_frames(times))
    axes.set_ylim(_with_zero(spin))


def inclination_axis(axes: Any, steepest: float) -> None:
    """From 0 to 90 degrees, or to a round number above the steepest of a body that stays flat."""
    highest = 90.0 if steepest > 60.0 else max(10.0, 10.0 * math.ceil(0.105 * steepest))
    axes.set_ylim(0.0, highest)
    count_angles(axes.yaxis, 30.0 if highest > 60.0 else 10.0 if highest > 10.0 else 5.0)


def _with_zero(values: Any) -> tuple[float, float]:
    """The range of values with zero and some air."""
    low, high = min(float(values.min()), 0.0), max(float(values.max()), 0.0)
    size = high - low
    if size <= 1e-12:
        return -1.0, 1.0
    return (low - 0.1 * size if low < 0.0 else low), (high + 0.1 * size if high > 0.0 else high)


def phase(data: dict[str, Any]) -> Any:
    """Draws how far the body leans in the plane in which it swings most against the rate of that, and both over time.

    `data`: also times, angle (of the shortest axis' upper end from the vertical, signed), rate, continues (whether the
    curve goes on from the frame before), frames_in_swing (or None).
    """
    times, rate = np.asarray(data["times"], dtype=float), np.asarray(data["rate"], dtype=float)
    angle, breaks = np.degrees(np.asarray(data["angle"], dtype=float)), ~np.asarray(data["continues"], dtype=bool)
    share = shares(times) if len(times) > 1 else np.zeros(1)
    highest = np.abs(rate).max()
    shown_rate = min(highest, 1.25 * np.percentile(np.abs(rate), 99.0))
    shown_rate = 1.08 * shown_rate if shown_rate > 1e-9 else 1.0
    steepest = np.abs(angle).max()
    shown_angle = 92.0 if steepest > 60.0 else 1.08 * steepest if steepest > 1e-9 else 1.0

    def angles(axes: Any, axis: Any) -> None:
        set_limits(axis, -shown_angle, shown_angle)
        if steepest > 60.0:
            count_angles(axis, 30.0)

    figure = new_figure()
    _title(figure, data)
    middle = [(f"{times[0] + part * (times[-1] - times[0]):.2f} s", tuple(0.9 * np.asarray(time_color(part))[:3]))
              for part in (0.0, 0.5, 1.0)]
    axes = panel(figure, _PORTRAIT, "Rate of the tilt (rad/s)", "tilt in the plane of the swing (°)", middle)
    angles(axes, axes.xaxis)
    axes.set_ylim(-shown_rate, shown_rate)
    axes.axhline(0.0, color="#b0b0b0", lw=0.6, zorder=1)
    axes.axvline(0.0, color="#b0b0b0", lw=0.6, zorder=1)
    colored_line(axes, angle, rate, share, breaks)
    axes.plot(angle[:1], rate[:1], "o", ms=6, mfc="none", mec=BLACK, mew=1.2, zorder=4)

    gap = 100.0
    tall = 0.5 * (TOP - BOTTOM - gap)
    for upper, (values, title) in ((True, (angle, "Tilt (°)")), (False, (rate, "Rate (rad/s)"))):
        aside = ""
        swing = data["frames_in_swing"]
        if upper and swing is not None and swing < _SMOOTH_SWING:
            aside = f"{number(swing, 2)} frames a swing: raise frame_rate"
        elif not upper and highest > shown_rate:
            aside = f"not shown: up to {number(highest, 3)}"
        box = (_SERIES_LEFT, BOTTOM + (tall + gap if upper else 0.0), RIGHT - _SERIES_LEFT, tall)
        axes = panel(figure, box, title, "" if upper else "time (s)", aside)
        axes.set_xlim(_time_range(times))
        if upper:
            angles(axes, axes.yaxis)
        else:
            axes.set_ylim(-shown_rate, shown_rate)
        shade(axes, data["measures"]["window"])
        if len(times) > 1:
            colored_line(axes, times, values, share, breaks)
        else:
            axes.plot(times, values, "o", ms=4, color=time_color(0.0))
    return figure


def landing(data: dict[str, Any]) -> Any:
    """Draws where all copies and runs come down, from above, and the distributions of distance and time.

    `data`: name, runs, copies, samples (their product), landed (how many; of 0 the places are those at the time `end`),
    mean [x, y, z], spread (rms distance from it), median, radius (of the body), places [x, y] with their values (time
    of landing; where none landed the distance descended), paths (lists of [x, y]).
    """
    places, values = np.asarray(data["places"], dtype=float), np.asarray(data["values"], dtype=float)
    mean = np.asarray(data["mean"], dtype=float)[:2]
    spread, landed, samples = data["spread"], data["landed"], data["samples"]
    figure = new_figure()
    what = f"{landed} of {samples} landed" if landed else f"{samples} in the air"
    below = [f"{data[word]} {word}" for word in ("runs", "copies") if data[word] > 1]
    below.append(f"half within {number(data['median'], 3)} m of the mean "
                 f"({number(mean[0], 3)}, {number(mean[1], 3)}) m")
    if not landed:
        below.append(f"at {data['end']:.2f} s")
    heading(figure, data["name"], f": {what}, spread {number(spread, 3)} m", "  ·  ".join(below))

    wide, tall = _PORTRAIT[2], float(_PORTRAIT[3])
    radius = max(spread, data["radius"])
    around = np.concatenate([places, [mean - radius, mean + radius]])
    low, high = around.min(axis=0), around.max(axis=0)
    air = 0.08 * np.maximum(high - low, 1e-12)
    low, high = low - air, high + air
    pixel = max((high[0] - low[0]) / wide, (high[1] - low[1]) / tall)
    centre = 0.5 * (low + high)
    x = Lengths(centre[0] - 0.5 * pixel * wide, centre[0] + 0.5 * pixel * wide, wide, 120.0)
    y = Lengths(centre[1] - 0.5 * pixel * tall, centre[1] + 0.5 * pixel * tall, tall, 75.0)
    axes = panel(figure, _PORTRAIT, y.title("y") + ", from above", x.title("x"),
                 "dark: first to land" if landed else "dark: least descended")
    x.apply(axes.xaxis)
    y.apply(axes.yaxis)
    paths = [np.column_stack([x.of(path[:, 0]), y.of(path[:, 1])])
             for path in (np.asarray(p, dtype=float) for p in data["paths"])]
    axes.add_collection(LineCollection(paths, colors="#d0d0d0", linewidths=0.5, gid="paths"), autolim=False)
    axes.scatter(x.of(places[:, 0]), y.of(places[:, 1]), color=time_color(shares(values)), s=14, lw=0, zorder=3,
                 gid="places")
    circle = np.linspace(0.0, 2.0 * np.pi, 181)
    axes.plot(x.of(mean[0] + spread * np.cos(circle)), y.of(mean[1] + spread * np.sin(circle)), color=ORANGE, lw=1.2,
              zorder=4)
    axes.plot(x.of(mean[0]), y.of(mean[1]), "+", color=ORANGE, ms=10, mew=1.6, zorder=5)

    gap, tall = 190.0, 0.5 * (TOP - BOTTOM - 190.0)
    distances = np.linalg.norm(places - mean, axis=1)
    axes = panel(figure, (_SERIES_LEFT, BOTTOM + tall + gap, RIGHT - _SERIES_LEFT, tall), "Places within (%)",
                 "distance from the mean (m)", "normal", ORANGE)
    _distribution(axes, distances, len(distances))
    farthest = max(1.05 * distances.max(), 1e-9)
    line = np.linspace(0.0, farthest, 300)
    axes.plot(line, 100.0 * (1.0 - np.exp(-((line / max(spread, 1e-12)) ** 2))), color=ORANGE, dashes=(4, 3))
    axes.set_xlim(0.0, farthest)
    axes = panel(figure, (_SERIES_LEFT, BOTTOM, RIGHT - _SERIES_LEFT, tall),
                 "Landed by, of all (%)" if landed else "Descended less (%)", "time of landing (s)" if landed
                 else "distance descended (m)")
    _distribution(axes, values, samples)
    axes.set_xlim(airy(values))
    return figure


def _distribution(axes: Any, values: Any, samples: int) -> None:
    values = np.sort(values)
    axes.step(np.concatenate([values[:1], values]), 100.0 * np.arange(len(values) + 1) / samples, where="post",
              color="#333333", lw=1.2)
    axes.set_ylim(0.0, 100.0)
    axes.set_yticks([0, 20, 40, 60, 80, 100])
