"""What all pictures share: the page, its type and colours, headings, panels and axes of lengths."""

import io
import math
from collections.abc import Iterable, Sequence
from typing import Any, Optional, Union

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, Locator

WIDTH, HEIGHT = 2000, 1300  # pixels of a picture
DPI = 200
LEFT, RIGHT, BOTTOM, TOP = 130, WIDTH - 45, 112, 1095  # pixels: of all panels
BLACK, GRAY, PALE, SHADE = "#1a1a1a", "#6b6b6b", "#e4e4e4", "#eef2f7"
BLUE, ORANGE, GREEN, PINK, YELLOW = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"  # Okabe and Ito's
COLORS = (BLUE, ORANGE, GREEN, PINK, YELLOW)

_STYLE = {
    "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "font.size": 8.64, "text.parse_math": False,
    "text.color": BLACK, "axes.edgecolor": "#808080", "axes.linewidth": 0.6, "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True, "axes.labelcolor": BLACK,
    "grid.color": PALE, "grid.linewidth": 0.4, "xtick.color": "#808080", "ytick.color": "#808080",
    "xtick.labelcolor": BLACK, "ytick.labelcolor": BLACK, "xtick.major.width": 0.5, "ytick.major.width": 0.5,
    "lines.linewidth": 1.0, "lines.solid_capstyle": "round", "svg.fonttype": "none", "svg.hashsalt": "samara",
    "savefig.dpi": DPI, "figure.dpi": DPI,
}


class page:
    """The matplotlib settings of all pictures for a `with` block; those of the user come back after it."""

    def __enter__(self) -> None:
        self._context = matplotlib.rc_context()
        self._context.__enter__()
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_STYLE)

    def __exit__(self, *ended: Any) -> None:
        self._context.__exit__(*ended)


def new_figure(width: float = WIDTH, height: float = HEIGHT) -> Any:
    """Makes an empty figure of a size in pixels; `shown` is a dict of what it is going to show."""
    figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.shown = {}
    figure._repr_png_ = lambda: _png(figure)  # for notebooks that do not know matplotlib
    return figure


def _png(figure: Any) -> bytes:
    file = io.BytesIO()
    write(figure, file, "png")
    return file.getvalue()


def write(figure: Any, file: Any, picture_format: str) -> None:
    """Writes a figure into a file (a name or an open file), "png" or "svg"; the same bytes for the same figure."""
    with page():
        metadata = {"Date": None, "Creator": "samara"} if picture_format == "svg" else {"Software": "samara"}
        figure.savefig(file, format=picture_format, dpi=DPI, metadata=metadata)


def number(value: float, digits: int = 6) -> str:
    """A number as people read it, with a true minus sign."""
    return f"{value:.{digits}g}".replace("-", "−")


def time_color(share: Any) -> Any:
    """The colours of shares from 0 to 1 of the time shown: viridis without its pale end, which is lost on white."""
    return matplotlib.colormaps["viridis"](0.85 * np.clip(share, 0.0, 1.0))


def shares(values: Any) -> Any:
    """Where values lie between their least (0) and their most (1); 0.5 where they are all alike."""
    values = np.asarray(values, dtype=float)
    low, size = values.min(), np.ptp(values)
    return (values - low) / size if size > 0.0 else np.full(len(values), 0.5)


def airy(values: Any, share: float = 0.08) -> tuple[float, float]:
    """From the least to the most of the finite values with some air at both ends."""
    finite = np.asarray(values, dtype=float)
    finite = finite[np.isfinite(finite)]
    if not finite.size:
        return 0.0, 1.0
    size = np.ptp(finite) if np.ptp(finite) > 1e-12 else 1.0
    return float(finite.min() - share * size), float(finite.max() + share * size)


# Texts of the page


def _width(figure: Any, text: str, size: float, weight: str = "bold") -> float:
    """How wide a text is (pixels)."""
    probe = figure.text(0, 0, text, fontsize=size, fontweight=weight)
    width = probe.get_window_extent(figure.canvas.get_renderer()).width
    probe.remove()
    return float(width)


def _shortened(figure: Any, text: str, size: float, room: float, keep_end: bool = False) -> str:
    """The text, or as much of its beginning (or end) as fits into so many pixels with an ellipsis."""
    if _width(figure, text, size) <= room:
        return text
    fits, too_long = 0, len(text)
    while too_long - fits > 1:
        count = (fits + too_long) // 2
        kept = "…" + text[-count:] if keep_end else text[:count] + "…"
        fits, too_long = (count, too_long) if _width(figure, kept, size) <= room else (fits, count)
    return "…" + text[len(text) - fits:] if keep_end else text[:fits] + "…"


def label(figure: Any, x: float, y: float, text: str, **options: Any) -> Any:
    """Writes a text at pixels from the figure's lower left corner, as it is."""
    width, height = figure.get_size_inches() * figure.dpi
    return figure.text(x / width, y / height, text, **{"va": "center", **options})


def heading(figure: Any, name: str, rest: str, below: str = "",
            sides: Sequence[tuple[str, str, str]] = (), words: Sequence[tuple[str, str]] = ()) -> None:
    """Writes the head of a picture: a name and what is said of it in large type, below that a gray line; at the right
    ends of the two lines `sides` (name, rest, colour), or in the lower one the `words` of a key (text, colour). Names
    too long are cut."""
    width, height = figure.get_size_inches() * figure.dpi
    left, right, upper, lower = 45.0, width - 45.0, height - 55.0, height - 108.0
    room = [right - left, right - left]
    for line, (side, more, color) in enumerate(sides):
        text = _shortened(figure, side, 8.64, 620.0 - _width(figure, more, 8.64), keep_end=True) + more
        label(figure, right, (upper, lower)[line], text, ha="right", fontweight="bold", color=color)
        room[line] -= _width(figure, text, 8.64) + 40.0
    for text, color in reversed(words):
        label(figure, right, lower, text, ha="right", fontweight="bold", color=color)
        right -= _width(figure, text, 8.64) + 35.0
    size = 13.5
    title = _shortened(figure, name, size, max(room[0] - _width(figure, rest, size), 250.0)) + rest
    size *= min(1.0, room[0] / _width(figure, title, size))
    label(figure, left, upper, title, fontsize=size, fontweight="bold")
    label(figure, left, lower, below, color=GRAY,
          fontsize=8.64 * min(1.0, room[1] / max(1.0, _width(figure, below, 8.64, "normal"))))


# Panels


def quarter(column: int, row: int, own_axes: bool = True) -> tuple[float, float, float, float]:
    """The place (left, bottom, width, height in pixels) of one of four panels; `own_axes`: the upper ones have titles
    below."""
    wide, gap = 0.5 * (RIGHT - LEFT - 155.0), 190.0 if own_axes else 110.0
    tall = 0.5 * (TOP - BOTTOM - gap)
    return LEFT + column * (wide + 155.0), BOTTOM + (1 - row) * (tall + gap), wide, tall


def panel(figure: Any, box: Sequence[float], title: str, across: str = "",
          aside: Union[str, Sequence[tuple[str, Any]]] = "",
          aside_color: str = GRAY, **options: Any) -> Any:
    """Makes axes on a box (left, bottom, width, height in pixels) with a bold title above, `across` below, and above
    their right end a text or a row of bold words in colours."""
    width, height = figure.get_size_inches() * figure.dpi
    left, bottom, wide, tall = box
    axes: Any = figure.add_axes((left / width, bottom / height, wide / width, tall / height), **options)
    label(figure, left, bottom + tall + 30.0, title, fontweight="bold")
    words = [(aside, aside_color)] if isinstance(aside, str) else list(aside)
    right = left + wide
    for text, color in reversed(words):
        weight = "normal" if color == GRAY else "bold"
        label(figure, right, bottom + tall + 30.0, text, ha="right", color=color, fontweight=weight)
        right -= _width(figure, text, 8.64, weight) + 24.0
    if options.get("projection") is None:
        axes.xaxis.set_major_locator(RoundLocator(wide / 110.0))
        axes.yaxis.set_major_locator(RoundLocator(tall / 58.0))
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda value, _: number(value)))
        axes.tick_params(labelbottom=bool(across))
        label(figure, left + 0.5 * wide, bottom - 78.0, across, ha="center")
    return axes


class RoundLocator(Locator):  # type: ignore[misc]
    """Places numbers at multiples of 1, 2 or 5 times a power of ten, at least two."""

    def __init__(self, most: float) -> None:
        """`most`: how many steps between numbers fit on the axis."""
        self.most = most

    def __call__(self) -> Any:
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin: float, vmax: float) -> Any:
        """Returns the places between two ends, which are finite."""
        low, high = min(vmin, vmax), max(vmin, vmax)
        if not high > low:
            return np.array([low])
        power = math.floor(math.log10((high - low) / self.most))
        steps = [factor * 10.0**(power + more) for more in (0, 1) for factor in (1, 2, 5)]
        smallest = next(step for step in steps if step >= (high - low) / self.most * (1.0 - 1e-9))
        between = [factor * 10.0**power for factor in (1.5, 2.5, 3, 4, 6, 7.5, 8, 12, 15)]
        closer = [smallest / factor for factor in (2.0, 5.0, 10.0)]
        for step in [smallest, *(step for step in between if step >= smallest), *closer]:
            places = step * np.arange(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)
            if len(places) > 1:
                return places
        return np.array([low, high])


def set_limits(axis: Any, low: float, high: float) -> None:
    """Sets the ends of an axis, whichever of the two it is."""
    (axis.axes.set_xlim if axis.axis_name == "x" else axis.axes.set_ylim)(low, high)


def count_angles(axis: Any, step: float) -> None:
    """Numbers an axis in multiples of a step."""
    low, high = axis.get_view_interval()
    axis.set_ticks(np.arange(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1) * step)


def count_logarithmically(axis: Any) -> None:
    """Numbers a logarithmic axis at 1, 2 and 5 times the powers of ten, or at the powers alone where they are many."""
    low, high = axis.get_view_interval()
    powers = range(math.floor(math.log10(low)), math.floor(math.log10(high)) + 1)
    factors = (1, 2, 5) if len(powers) < 4 else (1,)
    places = [factor * 10.0**power for power in powers for factor in factors]
    axis.set_ticks([place for place in places if low <= place <= high])
    axis.set_ticks([], minor=True)
    axis.set_major_formatter(FuncFormatter(
        lambda value, _: number(value) if 9e-5 < value < 1.1e6 else "10" + superscript(round(math.log10(value)))))


def superscript(exponent: int) -> str:
    """An exponent in small raised digits."""
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def empty(axes: Any, message: str) -> None:
    """Leaves axes bare but for a gray sentence."""
    axes.set_axis_off()
    axes.text(0.0, 0.5, message, transform=axes.transAxes, color=GRAY)


def shade(axes: Any, window: Iterable[float]) -> None:
    """Shades a stretch of time behind the curves."""
    begin, end = window
    if end > begin:
        axes.axvspan(begin, end, color=SHADE, lw=0, zorder=0)


def colored_line(axes: Any, x: Any, y: Any, share: Any, breaks: Optional[Any] = None) -> None:
    """Draws a curve whose colour follows the shares of time at its points; `breaks`: points that it does not reach from
    the point before."""
    points = np.column_stack([x, y])
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    keep = np.ones(len(pieces), bool) if breaks is None else ~np.asarray(breaks, bool)[1:]
    axes.add_collection(LineCollection(pieces[keep], colors=time_color(share)[1:][keep], linewidths=1.1,
                                       capstyle="round"))


class Lengths:
    """How lengths along an axis are written so that their numbers stay short: less an origin, where they differ by
    little of their size, and in units of a power of ten, where they are very large or small."""

    def __init__(self, low: float, high: float, pixels: float, apart: float = 90.0, letters: int = 6) -> None:
        """`low`, `high`: the axis' ends (m); `pixels`: its length; `apart`: the least between its numbers."""
        self.low, self.high = low, high
        self._locator = RoundLocator(pixels / apart)
        size = high - low
        step = 10.0 ** math.ceil(math.log10(size)) if size > 0.0 else 1.0
        origin = step * round(0.5 * (low + high) / step)
        power = 3 * math.floor(math.log10(max(abs(low), abs(high), 1e-300)) / 3.0)
        for self.origin, self.exponent in ((0.0, 0), (0.0, power), (origin, 0)):
            if self._fits(letters):
                return
        self.exponent = 3 * math.floor(math.log10(size) / 3.0) if size > 0.0 else 0

    def _places(self) -> Any:
        return self._locator.tick_values(float(self.of(self.low)), float(self.of(self.high)))

    def _fits(self, letters: int) -> bool:
        places = self._places()
        texts = [number(place) for place in places]
        return len(set(texts)) == len(texts) and all("e" not in text and len(text) <= letters for text in texts)

    def of(self, length: Any) -> Any:
        """The numbers of lengths (m)."""
        return (np.asarray(length, dtype=float) - self.origin) / 10.0**self.exponent

    def title(self, name: str) -> str:
        """What the axis is called: "x (m)", "x − 54320 (m)", "x (10⁶ m)"."""
        if self.origin:
            name += f" {'+' if self.origin < 0.0 else '−'} {abs(self.origin):.12g}"
        return name + (f" (10{superscript(self.exponent)} m)" if self.exponent else " (m)")

    def apply(self, axis: Any) -> None:
        """Sets an axis' ends and numbers."""
        set_limits(axis, float(self.of(self.low)), float(self.of(self.high)))
        axis.set_ticks(self._places())
        axis.set_major_formatter(FuncFormatter(lambda value, _: number(value)))
