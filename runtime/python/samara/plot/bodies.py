"""Pictures of a body's tables: polars, maps over all directions, convergence."""

from typing import Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.ticker import FuncFormatter

from .style import (BLUE, COLORS, GRAY, HEIGHT, ORANGE, WIDTH, airy, count_angles, count_logarithmically, empty,
                    heading,
                    label, new_figure, number, panel, quarter, time_color)

_POLARS = (("drag", "Drag coefficient", 0.01), ("lift", "Lift coefficient, towards growing angles", 0.01),
           ("moment", "Moment coefficient, about the plane's normal", 0.01),
           ("k", "Turbulent kinetic energy k/U²", 1e-4))
_LAYERS = (("drag", "Drag coefficient", ""), ("moment", "Moment coefficient, its size", ""),
           ("k", "Turbulent kinetic energy k/U²", ""), ("error", "Standard error of the force over the force", " %"))


def polars(data: dict[str, Any]) -> Any:
    """Draws drag, lift, moment and k against the direction of motion in the planes of the principal axes.

    `data`: name, reynolds_number, shown_angle (degrees), spherical (whether all planes are alike) and arcs: name,
    angles (degrees), drag, lift, moment, k at these, each with its standard error (drag_error, ...), and cases, the
    solved ones in the plane: angles, drag, k (or None).
    """
    figure = new_figure()
    names = ["any plane"] if data["spherical"] and len(data["arcs"]) == 1 else [arc["name"] for arc in data["arcs"]]
    heading(figure, data["name"], f": polars at Reynolds number {number(data['reynolds_number'])}",
            "0°: along the first axis  ·  bands: standard errors  ·  dots: solved cases",
            words=list(zip(names, COLORS)))
    most = data["shown_angle"]
    for place, (key, title, least) in enumerate(_POLARS):
        box = quarter(place % 2, place // 2, own_axes=False)
        axes = panel(figure, box, title, "direction of motion (°)" if place >= 2 else "")
        shown = [0.0, least]
        for arc, color in zip(data["arcs"], COLORS):
            angles, values, errors = (np.asarray(arc[what], dtype=float) for what in ("angles", key, key + "_error"))
            if errors.any():
                axes.fill_between(angles, values - errors, values + errors, color=color, alpha=0.13, lw=0)
                shown += [*(values - errors), *(values + errors)]
            axes.plot(angles, values, color=color, lw=1.3, gid=f"{key}_{arc['name']}")
            shown += list(values)
            solved = np.asarray(arc["cases"].get(key, []), dtype=float)
            axes.plot(arc["cases"]["angles"][:len(solved)], solved, "o", color=color, ms=4.5, mec="white", mew=0.5,
                      clip_on=False, zorder=4)
            shown += list(solved)
        axes.axhline(0.0, color="#b0b0b0", lw=0.5, zorder=1)
        axes.set_xlim(0.0, most)
        axes.set_ylim(airy(shown))
        count_angles(axes.xaxis, most / 6)
    figure.shown = {"arcs": len(data["arcs"])}
    return figure


def sphere(data: dict[str, Any]) -> Any:
    """Draws the tables over all directions of motion, in Hammer's projection: poles along the short axis, middle along
    the long.

    `data`: name, reynolds_number, drag, moment, k and error (of the force, per cent) over a grid of as many rows of
    latitudes from the lower pole and columns of longitudes from the map's left as each holds numbers; is_planned over
    the same grid; solved_directions [right, into the map's middle, up] as unit vectors; has_images.
    """
    figure = new_figure()
    cases = np.asarray(data["solved_directions"], dtype=float).reshape(-1, 3)
    planned = np.asarray(data["is_planned"], dtype=bool)
    below = ["over all directions of motion", "middle: along the long axis, poles: along the short"]
    if len(cases):
        below.append("dots: solved, their images by symmetry" if data["has_images"] else "dots: solved")
    if not planned.all():
        below.append("pale: extrapolated")
    heading(figure, data["name"], f": tables at Reynolds number {number(data['reynolds_number'])}", "  ·  ".join(below))
    rows, columns = planned.shape
    longitudes, latitudes = np.linspace(-np.pi, np.pi, columns + 1), np.linspace(-np.pi / 2, np.pi / 2, rows + 1)
    colors = ListedColormap(time_color(np.linspace(0.0, 1.0, 256)))
    for place, (key, title, unit) in enumerate(_LAYERS):
        left, bottom, wide, tall = (45.0, 1010.0)[place % 2], (655.0, 95.0)[place // 2], 770.0, 385.0
        axes = panel(figure, (left, bottom, wide, tall), "", projection="hammer")
        label(figure, left, bottom + tall + 50.0, title, fontweight="bold")
        values = np.asarray(data[key], dtype=float)
        low, high = values.min(), values.max()
        flat = high - low <= 0.03 * max(abs(high), abs(low))  # what differs is interpolation between the tables' nodes
        limits = (low - 1.0, low + 1.0) if flat else (low, high)
        mesh = axes.pcolormesh(longitudes, latitudes, values, cmap=colors, vmin=limits[0], vmax=limits[1],
                               rasterized=True)
        if not planned.all():
            axes.pcolormesh(longitudes, latitudes, np.where(planned, np.nan, 1.0), cmap=ListedColormap(["white"]),
                            alpha=0.7,
                            rasterized=True)
        _grid(axes)
        if len(cases):
            at, up = np.arctan2(cases[:, 0], cases[:, 1]), np.arcsin(np.clip(cases[:, 2], -1.0, 1.0))
            axes.plot(at, up, "o", color=ORANGE, ms=4.5, mec="white", mew=0.9, clip_on=False, zorder=5)
        label(figure, left + 0.5 * wide, bottom + tall + 18.0, "short axis", ha="center", color=GRAY)
        label(figure, left + 0.5 * wide, bottom + 0.5 * tall - 26.0, "long", ha="center", color="white")
        if flat:
            label(figure, left + wide + 25.0, bottom + 0.5 * tall, number(high, 3) + unit)
            continue
        bar = figure.colorbar(mesh, cax=figure.add_axes(((left + wide + 25.0) / WIDTH, (bottom + 40.0) / HEIGHT,
                                                         22.0 / WIDTH,
                                                         (tall - 80.0) / HEIGHT)),
                                                         ticks=[low, 0.5 * (low + high), high])
        bar.outline.set_visible(False)
        bar.ax.tick_params(length=0)
        bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _, unit=unit: number(value, 3) + unit))
    return figure


def _grid(axes: Any) -> None:
    """Meridians and circles of latitude every 45 degrees."""
    axes.grid(False)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.spines["geo"].set_edgecolor("white")
    line = np.linspace(-1.0, 1.0, 91)
    for i in range(-3, 4):
        axes.plot(np.full(91, i * np.pi / 4), line * np.pi / 2, color="white", alpha=0.5, lw=0.4)
    for i in (-1, 0, 1):
        axes.plot(line * np.pi, np.full(91, i * np.pi / 4), color="white", alpha=0.5, lw=0.4)


def convergence(data: dict[str, Any]) -> Any:
    """Draws drag and k over the meshes of each direction, the errors by source, and the drag over the Reynolds numbers.

    `data`: name, reynolds_number, meshes (how many), ladders (of a direction: cells, drag, k or None), axes (name, drag
    and error at each of the reynolds_numbers), error_sources (source, place: of its colour; force, moment, k, epsilon).
    """
    figure = new_figure()
    heading(figure, data["name"], f": convergence at Reynolds number {number(data['reynolds_number'])}",
            f"each line on the left: one direction on {data['meshes']} meshes")
    _ladders(figure, data, "drag", "Drag coefficient", 0)
    _ladders(figure, data, "k", "Turbulent kinetic energy k/U²", 1)
    _over_reynolds_numbers(figure, data)
    _error_sources(figure, data["error_sources"])
    return figure


def _logarithmic(axes: Any, values: Any) -> None:
    """Makes the lower axis logarithmic, wide enough for two numbers."""
    low, high = min(values), max(values)
    factor = max(1.35, (high / low) ** 0.08) * max(1.0, (5.0 * low / high) ** 0.5)
    axes.set_xscale("log")
    axes.set_xlim(low / factor, high * factor)
    count_logarithmically(axes.xaxis)


def _ladders(figure: Any, data: dict[str, Any], key: str, title: str, row: int) -> None:
    axes = panel(figure, quarter(0, row), title, "cells of the mesh")
    shown, cells = [0.0], []
    for ladder in data["ladders"]:
        pairs = [(count, value) for count, value in zip(ladder["cells"], ladder[key]) if value is not None]
        if pairs:
            axes.plot(*zip(*pairs), "o-", color=BLUE, ms=3.5)
            cells += [count for count, _ in pairs]
            shown += [value for _, value in pairs]
    if not cells:
        return empty(axes, "the body file has no such cases")
    _logarithmic(axes, cells)
    axes.set_ylim(airy(shown))
    return None


def _over_reynolds_numbers(figure: Any, data: dict[str, Any]) -> None:
    names = [(axis["name"], color) for axis, color in zip(data["axes"], COLORS)]
    axes = panel(figure, quarter(1, 0), "Drag along the axes", "Reynolds number U L/ν", names)
    numbers, shown = np.asarray(data["reynolds_numbers"], dtype=float), [0.0]
    for place, (axis, (_, color)) in enumerate(zip(data["axes"], names)):
        drag, error = np.asarray(axis["drag"], dtype=float), np.asarray(axis["error"], dtype=float)
        beside = numbers * 1.05 ** (place - 1)  # bars beside each other, where all axes have the same numbers
        axes.errorbar(beside, drag, error if error.any() else None, color=color, marker="o", ms=4, capsize=3,
                      elinewidth=0.7, lw=1.0)
        shown += [*(drag - error), *(drag + error)]
    _logarithmic(axes, numbers)
    axes.set_ylim(airy(shown))


def _error_sources(figure: Any, sources: list[dict[str, Any]]) -> None:
    names = [(source["source"], COLORS[source["place"] % len(COLORS)]) for source in sources]
    axes = panel(figure, quarter(1, 1), "Standard errors by source (%, rms)", "")
    if not sources:
        return empty(axes, "the body file has no errors by source")
    quantities = ("force", "moment", "k", "epsilon")
    wide = 0.8 / len(sources)
    for place, (source, (_, color)) in enumerate(zip(sources, names)):
        values = [100.0 * source[quantity] for quantity in quantities]
        axes.bar(np.arange(4) - 0.4 + wide * (place + 0.5), values, 0.9 * wide, color=color, zorder=2)
    axes.set_xlim(-0.6, 3.6)
    axes.set_xticks(range(4), quantities)
    axes.tick_params(labelbottom=True)
    axes.grid(False, axis="x")
    left, bottom, width, _ = quarter(1, 1)
    right = left + width
    for text, color in reversed(names):
        word = label(figure, right, bottom - 82.0, text, ha="right", color=color, fontweight="bold")
        right -= word.get_window_extent(figure.canvas.get_renderer()).width + 35.0
    return None
