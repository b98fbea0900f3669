"""The picture of a motion compared with a reference."""

from typing import Any

import numpy as np

from .motions import height_title, inclination_axis
from .style import (BLUE, BOTTOM, GRAY, LEFT, ORANGE, RIGHT, TOP, Lengths, count_angles, heading, new_figure, number,
                    panel, shade)

_FAINT = {BLUE: "#bcd8ea", ORANGE: "#f5d3b8"}
_PATH_RIGHT, _SERIES_LEFT = 690.0, 800.0
_LEAST_POWER = 1e-6  # 1/Hz: less is no swing that can be seen


def comparison(data: dict[str, Any]) -> Any:
    """Draws both paths from the front and the side, laid on their release points, the inclination over time, both
    spectra of the swings and both distributions of the inclination; of several falls one strong and the others faint.

    `data`: name; motion and reference: file, regime, distinct (falls), falls (times since the release, paths [x, y, z]
    and inclinations; the first is drawn strong), spectrum over steps of spectrum_step (Hz), frequency (or None),
    distribution (shares of time, evenly over 90 degrees); end (until when falls are drawn), window [begin, end],
    differences (name, relative, error; or None), first_swing_end (or None), distance, probability (or None) of the
    distributions; judges_inclination, regimes_agree, agrees, certain.
    """
    figure = new_figure()
    motion, reference = data["motion"], data["reference"]
    agree = data["regimes_agree"] or not data["judges_inclination"]
    rest = f": {motion['regime']}" + ("" if agree else f" against {reference['regime']}")
    rest += ", agrees with the reference" if data["agrees"] else ", differs from the reference"
    rest += "" if data["certain"] else " (not certain)"
    below = []
    for one in data["differences"]:
        if one["relative"] is not None:
            error = "" if one["error"] is None else f" ± {100.0 * one['error']:.0f}"
            sign = "−" if one["relative"] < 0.0 else "+"
            below.append(f"{one['name']} {sign}{abs(100.0 * one['relative']):.0f}{error} %")
    below.append(f"{data['window'][0]:.2f} s to {data['window'][1]:.2f} s of fall")
    heading(figure, data["name"], rest, "  ·  ".join(below),
            [(side["file"], "" if side["distinct"] == 1 else f" ({side['distinct']} falls)", color)
             for side, color in ((motion, BLUE), (reference, ORANGE))])
    lines = [(fall, _FAINT[color], 0.5) for side, color in ((motion, BLUE), (reference, ORANGE))
             for fall in side["falls"][1:]]
    lines += [(side["falls"][0], color, 1.2) for side, color in ((motion, BLUE), (reference, ORANGE))]
    _paths(figure, lines)
    _inclinations(figure, data, lines)
    half = 0.5 * (RIGHT - _SERIES_LEFT - 110.0)
    _spectra(figure, (motion, reference), (_SERIES_LEFT, BOTTOM, half, 500.0 - BOTTOM))
    _distributions(figure, data, (RIGHT - half, BOTTOM, half, 500.0 - BOTTOM))
    return figure


def _paths(figure: Any, lines: list[tuple[dict[str, Any], str, float]]) -> None:
    paths = [np.asarray(fall["paths"], dtype=float).reshape(-1, 3) for fall, _, _ in lines]
    everything = np.concatenate([np.zeros((1, 3)), *paths])
    low, high = everything.min(axis=0), everything.max(axis=0)
    middle, size = 0.5 * (low + high), 1.08 * (high - low)
    tall, wide = TOP - BOTTOM, 0.5 * (_PATH_RIGHT - LEFT - 55.0)
    pixel = max(size[2] / tall, max(size[:2]) / wide, 1e-9)
    most = pixel * wide / max(size[0], size[1]) if max(size[:2]) > 0.0 else 1.0
    stretch = max([1.0] + [factor for factor in (2.0, 5.0, 10.0, 20.0, 50.0, 100.0) if factor <= most])
    heights = Lengths(middle[2] - 0.5 * pixel * tall, middle[2] + 0.5 * pixel * tall, tall, 75.0)
    for axis, (name, title) in enumerate((("x", "From the front"), ("y", "From the side"))):
        half = 0.5 * pixel * wide / stretch
        across = Lengths(middle[axis] - half, middle[axis] + half, wide, 95.0)
        below = across.title(name) + (f", stretched {number(stretch)}:1" if stretch > 1.0 else "")
        axes = panel(figure, (LEFT + axis * (wide + 55.0), BOTTOM, wide, tall), title, below)
        across.apply(axes.xaxis)
        heights.apply(axes.yaxis)
        axes.tick_params(labelleft=axis == 0)
        for path, (_, color, width) in zip(paths, lines):
            axes.plot(across.of(path[:, axis]), heights.of(path[:, 2]), color=color, lw=width)
    height_title(figure, heights, LEFT)


def _inclinations(figure: Any, data: dict[str, Any], lines: list[tuple[dict[str, Any], str, float]]) -> None:
    axes = panel(figure, (_SERIES_LEFT, 715.0, RIGHT - _SERIES_LEFT, TOP - 715.0), "Inclination (°)",
                 "time since the release (s)",
                 "shaded: the window of all metrics")
    steepest = 0.0
    for fall, color, width in lines:
        inclinations = np.degrees(np.asarray(fall["inclinations"], dtype=float))
        axes.plot(fall["times"], inclinations, color=color, lw=width)
        steepest = max(steepest, inclinations.max())
    end = data["end"]
    axes.set_xlim(0.0, end)
    inclination_axis(axes, steepest)
    begin, last = data["window"]
    shade(axes, (begin, min(end, last)) if begin < end else (0.0, 0.0))
    swing = data["first_swing_end"]
    if swing is not None and swing < end:
        axes.axvline(swing, color=GRAY, lw=0.8, dashes=(1, 2))
        left = swing < 0.5 * end
        axes.annotate("first swing", (swing, 0.94), (6 if left else -6, 0), xycoords=("data", "axes fraction"),
                      textcoords="offset points", ha="left" if left else "right", va="center", color=GRAY, zorder=6,
                      bbox={"fc": "white", "ec": "none", "pad": 1.5})


def _spectra(figure: Any, sides: tuple[dict[str, Any], dict[str, Any]], box: tuple[float, float, float, float]) -> None:
    powers = [np.asarray(side["spectrum"], dtype=float) for side in sides]
    highest = max((power.max() for power in powers if power.size), default=0.0)
    swings = highest > _LEAST_POWER
    axes = panel(figure, box, "Spectrum (1/Hz)", "frequency (Hz), half that of the inclination",
                 "dashed: by the minima" if swings else "no swings")
    frequencies = [side["frequency"] for side in sides if side["frequency"] is not None]
    steps = [side["spectrum_step"] for side in sides]
    end = max((3.0 * frequency for frequency in frequencies), default=0.0) or steps[1] * max(1,
                                                                                             len(powers[1]) - 1) or 1.0
    for side, power, step, color in zip(sides, powers, steps, (BLUE, ORANGE)):
        axes.plot(step * np.arange(len(power)), power, color=color, lw=1.2)
        if side["frequency"] is not None:
            axes.axvline(side["frequency"], color=color, lw=0.9, dashes=(3, 2))
    axes.set_xlim(0.0, end)
    axes.set_ylim(0.0, 1.1 * highest if swings else 1.0)


def _distributions(figure: Any, data: dict[str, Any], box: tuple[float, float, float, float]) -> None:
    aside = f"{100.0 * data['distance']:.0f} % apart"
    if data["probability"] is not None:
        aside += f", p {number(data['probability'], 1)}"
    axes = panel(figure, box, "Time below (%)", "inclination (°)", aside)
    below = []
    for side, color in ((data["motion"], BLUE), (data["reference"], ORANGE)):
        shares = np.asarray(side["distribution"], dtype=float)
        below.append(np.concatenate([[0.0], 100.0 * np.cumsum(shares)]))
        axes.plot(np.linspace(0.0, 90.0, len(below[-1])), below[-1], color=color, lw=1.2)
    widest = int(np.argmax(np.abs(below[0] - below[1])))
    if widest > 0:
        angle = 90.0 * widest / (len(below[0]) - 1)
        axes.annotate("", (angle, below[0][widest]), (angle, below[1][widest]),
                      arrowprops={"arrowstyle": "<->", "color": "#333333", "lw": 0.8, "shrinkA": 0, "shrinkB": 0})
    axes.set_xlim(0.0, 90.0)
    axes.set_ylim(0.0, 100.0)
    count_angles(axes.xaxis, 30.0)
    count_angles(axes.yaxis, 25.0)
