"""Pictures of a bake: what a scene's plan visits, the meshes, and how the cases settled."""

from typing import Any

import numpy as np
from matplotlib.collections import LineCollection

from .style import (BLUE, BOTTOM, GRAY, ORANGE, TOP, WIDTH, airy, count_logarithmically, empty, heading, label,
                    new_figure,
                    panel, quarter)

_HISTORIES = (("drag", "Drag coefficient"), ("moment", "Moment coefficient, its size"), ("k", "k/U² near the body"),
              ("residuals", "Residual of the pressure, last round"))
_SETTLING = 0.1  # share of a history that may leave the panel, while the flow starts


def plan(data: dict[str, Any]) -> Any:
    """Draws where a body moves in its own axes: both halves of the sphere of directions, equal in area, with the
    planned cases.

    `data`: name, visited and cases, unit vectors.
    """
    figure = new_figure()
    heading(figure, data["name"], ": directions of motion in the body's axes",
            "equal-area maps of both halves: the density of dots is proportional to time",
            words=[("visited", BLUE), ("case or its image", ORANGE)])
    visited, cases = (np.asarray(data[key], dtype=float).reshape(-1, 3) for key in ("visited", "cases"))
    for column, upper in enumerate((True, False)):
        axes = panel(figure, (45.0 + column * 0.5 * WIDTH, BOTTOM - 60.0, 0.5 * WIDTH - 90.0, TOP - BOTTOM + 60.0), "")
        axes.set_axis_off()
        axes.set_aspect("equal")
        axes.set_xlim(-1.15, 1.15)
        axes.set_ylim(-1.15, 1.15)
        label(figure, (0.25 + 0.5 * column) * WIDTH, TOP + 30.0, f"along {'+' if upper else '−'}z", ha="center",
              fontweight="bold")
        circle = np.linspace(0.0, 2.0 * np.pi, 181)
        axes.plot(np.cos(circle), np.sin(circle), color="#999999", lw=1.0)
        for directions, style in ((visited, {"marker": "o", "ms": 2.2, "mew": 0, "color": BLUE, "alpha": 0.6}),
                                  (cases, {"marker": "o", "ms": 9, "mfc": "none", "mec": ORANGE, "mew": 1.4})):
            height = directions[:, 2] if upper else -directions[:, 2]
            here = directions[height >= -1e-9]
            scale = np.sqrt(1.0 / (1.0 + np.abs(here[:, 2])))
            axes.plot(scale * here[:, 0], scale * here[:, 1], ls="none", clip_on=False, **style)
        axes.text(1.07, 0.0, "x", ha="center", va="center", color=GRAY)
        axes.text(0.0, 1.07, "y", ha="center", va="center", color=GRAY)
    return figure


def meshes(data: dict[str, Any]) -> Any:
    """Draws one to four meshes where a plane cuts them, the body's surface strong.

    `data`: name and meshes: title, cells and body (pieces [x, y, x, y]), half_width and half_height of what is shown.
    """
    figure = new_figure()
    heading(figure, data["name"], ": the meshes around the body",
            "in the plane of the shortest (up) and the longest axis")
    many = len(data["meshes"])
    for place, mesh in enumerate(data["meshes"]):
        left, bottom, wide, tall = quarter(place % 2, place // 2)
        if many <= 2:
            bottom, tall = BOTTOM, TOP - BOTTOM
        if many == 1:
            wide = sum(quarter(1, 0)[::2]) - left
        axes = panel(figure, (left, bottom, wide, tall), mesh["title"])
        axes.set_xticks([])
        axes.set_yticks([])
        for spine in axes.spines.values():
            spine.set_visible(False)
        for key, color, width in (("cells", "#8795a3", 0.5), ("body", ORANGE, 1.2)):
            pieces = np.asarray(mesh[key], dtype=float).reshape(-1, 2, 2)
            axes.add_collection(LineCollection(pieces, colors=color, linewidths=width, gid=key, capstyle="round"),
                                autolim=False)
        axes.set_aspect("equal", anchor="NW")
        axes.set_xlim(-mesh["half_width"], mesh["half_width"])
        axes.set_ylim(-mesh["half_height"], mesh["half_height"])
    return figure


def histories(data: dict[str, Any]) -> Any:
    """Draws drag, moment, k and residuals of all cases over their iterations, over each other.

    `data`: name and cases: iterations, drag, moment and k at these (or none), residual_iterations and residuals.
    """
    figure = new_figure()
    heading(figure, data["name"], ": convergence of the cases",
            f"one line for each of {len(data['cases'])} cases  ·  means over the last halves")
    for place, (key, title) in enumerate(_HISTORIES):
        axes = panel(figure, quarter(place % 2, place // 2), title, "iteration")
        logarithmic = key == "residuals"
        settled = [] if logarithmic else [0.0]
        first, last = np.inf, -np.inf
        for one in data["cases"]:
            values = np.asarray(one[key], dtype=float)
            iterations = np.asarray(one["residual_iterations" if logarithmic else "iterations"],
                                    dtype=float)[:len(values)]
            if not values.size:
                continue
            if logarithmic:
                values = np.where(values > 0.0, values, np.nan)
            axes.plot(iterations, values, color=BLUE, lw=0.6, alpha=0.7)
            first, last = min(first, iterations[0]), max(last, iterations[-1])
            rest = values[int(_SETTLING * len(values)):]
            settled += list(rest[np.isfinite(rest)])
        if not last > first or not settled:
            empty(axes, "not in the folder")
            continue
        axes.set_xlim(min(first, 0.97 * first), last)
        if logarithmic:
            axes.set_yscale("log")
            axes.set_ylim(10.0 ** np.floor(np.log10(min(settled))), 10.0 ** np.ceil(np.log10(max(settled)) + 1e-9))
            count_logarithmically(axes.yaxis)
        else:
            axes.set_ylim(airy(settled))
    return figure
