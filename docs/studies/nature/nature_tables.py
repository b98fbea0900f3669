#!/usr/bin/python3
"""nature.csv, nature.png and the tables of README.md, from what nature_report.py wrote and published.csv.

    nature_tables.py ROWS.csv FOLDER

FOLDER: of these. Reads costs.csv beside ROWS.csv too.
"""

import csv
import glob
import math
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from nature_families import NATURE, STRIPS, fruits_table, strips_table, transition  # noqa: E402
from nature_report import FULL_CFD, SURFACE, TABLES, write  # noqa: E402
from nature_study import CARDS, CASES, REGIME, SPHERES, STRIP_FROUDE_NUMBERS, card_name, strip_name  # noqa: E402
from report_tables import mark, table, write_tables  # noqa: E402
from study_pictures import new_figure, save  # noqa: E402

MODELS = {SURFACE: "surface", TABLES: "tables", FULL_CFD: "cfd"}
HEADS = ("runtime, surface", "runtime, tables", "full CFD")
COLUMNS = ("case", "group", "quantity", "published", "uncertainty", "unit", "verified",
           *(f"{column}{what}" for column in MODELS.values() for what in ("", "_error", "_ratio")))
GROUPS = ("acceleration", "spheres", "plates", "discs", "fruits")
# What is worked out from several cases, with the group that it stands in.
DERIVED = {"onset": ("spheres", "onset of the path's asymmetry"), "rising": ("spheres", "rising spheres"),
           "strips": ("plates", "strips"), "cards": ("plates", "cards")}
WITHOUT_CASE = ("fixed", "zigzags")  # words of the quantities that no scene here measures
EXACT_LIMIT = 0.03  # of the figures that have no uncertainty of their own because they are exact
STRAIGHT = 1.0  # degrees of drift
ROUNDING = 1e-6  # below that it is none


def rows_from(path):
    if not os.path.exists(path):
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def as_number(text):
    try:
        return float(text)
    except ValueError:
        return None


def bracket(points, low, high):
    """'between a and b' of points (x, what there is): the last that is low before the first that is high; None where it is open."""
    lows = [x for x, what in points if what == low]
    highs = [x for x, what in points if what == high]
    if not lows and not highs:
        return None
    if not highs:
        return f"above {max(lows):g}"
    if not lows:
        return f"below {min(highs):g}"
    if max(lows) > min(highs):
        return f"not sharp: {low} at {max(lows):g}, {high} at {min(highs):g}"
    return f"between {max(lows):g} and {min(highs):g}"


def exponent(found, first, second, ratio):
    """Of a quantity that goes as a power of what the two cases differ by."""
    a, b = (found.get((name, "turning rate")) for name in (first, second))
    return f"{math.log(b / a) / math.log(ratio):.3g}" if a and b else None


def derived(values):
    """{(case, quantity): text} of one model's {(case, quantity): number or regime}."""
    drifts = [(galileo, values.get((f"sphere-ga-{galileo}", "drift"))) for galileo in SPHERES]
    strips = [(froude, values.get((strip_name(froude), REGIME))) for froude in STRIP_FROUDE_NUMBERS]
    card, thicker, wider = (card_name(*each) for each in CARDS)
    figures = {
        ("onset", "Galileo number"): bracket([(galileo, "aslant" if angle > STRAIGHT else "straight")
                                              for galileo, angle in drifts if angle is not None], "straight", "aslant"),
        ("strips", "Froude number of the transition"): bracket([point for point in strips if point[1]], "fluttering", "tumbling"),
        ("cards", "exponent of the thickness"): exponent(values, card, thicker, CARDS[1][1] / CARDS[0][1]),
        ("cards", "exponent of the width"): exponent(values, card, wider, CARDS[2][0] / CARDS[0][0]),
    }
    return {key: text for key, text in figures.items() if text is not None}


def in_its_unit(case, quantity, unit, row):
    """(value, error) of a measured row in the unit that is published."""
    if quantity == REGIME:
        return row["value"], float(row["error"] or 0)
    scale = case.scales.get(unit, 1.0)
    return tuple(0.0 if abs(number) < ROUNDING else number for number in (float(row["value"]) / scale, float(row["error"]) / scale))


def merged(published, rows, before, strips=()):
    """The rows of nature.csv: every published figure, with what is measured of it; what these rows have not stays as it was
    before, for no folder holds all that was ever solved. `strips`: rows of the family over Froude numbers, which the surface's
    transition is read from."""
    cases = {case.name: case for case in CASES}
    found = {(row["case"], row["quantity"], row["model"]): row for row in rows}
    values = {model: {(row["case"], row["quantity"]): as_number(row["value"]) if row["quantity"] != REGIME else row["value"]
                      for row in rows if row["model"] == model} for model in MODELS}
    together = {model: derived(values[model]) for model in MODELS}
    if strips:
        together[SURFACE]["strips", "Froude number of the transition"] = transition(strips)
    order = {name: place for place, name in enumerate([case.name for case in CASES] + list(DERIVED))}
    kept = {(row["case"], row["quantity"]): row for row in before}
    result = []
    for figure in sorted(published, key=lambda row: order[row["case"]]):
        name, quantity, unit = figure["case"], figure["quantity"], figure["unit"]
        row = dict.fromkeys(COLUMNS, "") | {
            "case": name, "group": cases[name].group if name in cases else DERIVED[name][0], "quantity": quantity,
            "published": figure["value"], "uncertainty": figure["uncertainty"], "unit": unit, "verified": figure["verified"]}
        for model, column in MODELS.items():
            if (name, quantity) in together[model]:
                row[column] = together[model][name, quantity]
            elif (name, quantity, model) in found:
                value, error = in_its_unit(cases[name], quantity, unit, found[name, quantity, model])
                row[column] = value if quantity == REGIME else f"{value:.4g}"
                row[f"{column}_error"] = f"{error:.2g}"
            elif (name, quantity) in kept:
                row |= {key: kept[name, quantity][key] for key in (column, f"{column}_error")}
            ratio = ratio_of(row, column)
            row[f"{column}_ratio"] = "" if ratio is None else f"{ratio:.4g}"
        result.append(row)
    return result


def ratio_of(row, column):
    value, published = as_number(row[column]), as_number(row["published"])
    return value / published if value is not None and published else None


def misses(row, column):
    """Whether a measured figure lies outside the published one's uncertainty and its own error; None where that cannot be said."""
    if not row[column]:
        return None
    published, value = as_number(row["published"]), as_number(row[column])
    if published is None:
        return row[column] != row["published"] if row["quantity"] == REGIME and row["published"] != "at the transition" else None
    between = re.match(r"between (\S+) and (\S+)$", row[column])
    if (value is None and not between) or not row["uncertainty"]:
        return None
    allowed = EXACT_LIMIT * published if row["verified"] == "exact" else float(row["uncertainty"])
    if between:
        low, high = map(float, between.groups())
        return low > published + allowed or high < published - allowed
    return abs(value - published) > allowed + float(row[f"{column}_error"] or 0)


def told(row, column):
    """A cell of the table."""
    if not row[column]:
        return "no case yet" if any(word in row["quantity"] for word in WITHOUT_CASE) else "not solved yet"
    text = row[column]
    error = as_number(row[f"{column}_error"])
    if row["quantity"] == REGIME:
        text += f", {100 * (1 - error):.0f} %" if error else ""
    elif error and error > 1e-4 * abs(float(row[column])):
        text += f" +- {error:.2g}"
    ratio = ratio_of(row, column)
    if ratio is not None:
        text += f" ({100 * (ratio - 1) + 0.0:+.1f} %)".replace("-0.0 %", "+0.0 %")
    return f"**{text}**" if misses(row, column) else text


def title(name):
    if name in DERIVED:
        return DERIVED[name][1]
    case = next(case for case in CASES if case.name == name)
    scene = os.path.relpath(case.scene, NATURE)
    return f"[{case.text}]({scene})"


def group_table(rows, group):
    def lines():
        before = None
        for row in rows:
            if row["group"] != group:
                continue
            published = row["published"] + (f" +- {row['uncertainty']}" if as_number(row["uncertainty"]) else "")
            unit = row["unit"] if row["unit"] not in ("", "-") else ""
            yield [title(row["case"]) if row["case"] != before else "", row["quantity"] + (f", {unit}" if unit else ""), published,
                   row["verified"], *(told(row, column) for column in MODELS.values())]
            before = row["case"]

    return table(["case", "figure", "published", "verified", *HEADS], lines())


def tally_table(rows):
    """How many figures hold, of those that can be judged."""
    def lines():
        for group in (*GROUPS, None):
            cells = ["all" if group is None else group, str(sum(group in (None, row["group"]) for row in rows))]
            for column in MODELS.values():
                verdicts = [misses(row, column) for row in rows if group in (None, row["group"])]
                judged = [verdict for verdict in verdicts if verdict is not None]
                cells.append(f"{judged.count(False)} of {len(judged)}")
            yield cells

    return table(["group", "figures", *(f"{head} within" for head in HEADS)], lines())


def cost_table(rows, costs):
    """What is left, and what it is estimated to cost."""
    done = {(row["case"], model) for row in rows for model in MODELS if row[MODELS[model]]}

    def cell(cost, name, model):
        return "done" if (name, model) in done else f"{float(cost):,.0f}" if cost else "no estimate"

    def lines():
        for cost in costs:
            case = next((case for case in CASES if case.name == cost["case"]), None)
            if case is None or all((case.name, model) in done for model in (TABLES, FULL_CFD)):
                continue
            yield [case.name, cell(cost["bake"], case.name, TABLES), cell(cost["fall"], case.name, FULL_CFD)]

    return table(["case", "bake, CPU s", "full CFD, CPU s"], lines())


def source_table(published):
    """Every source once, with what is said of the first figure that it is for."""
    first = {}
    for row in published:
        if row["source"] != "the same":
            first.setdefault(row["source"], row)
    return table(["source", "for", "verified", "where it was seen, and what is ours"],
                 ([source, row["case"], row["verified"], row["seen"] or "-"] for source, row in first.items()))


def picture(rows, file):
    """Measured over published, of every figure of which there is such a ratio; a bar spans the published one's uncertainty."""
    shown = [row for row in rows if any(row[f"{column}_ratio"] for column in MODELS.values())]

    figure, (axes,) = new_figure(2400, 950, margins=(0.11, 0.985, 0.32, 0.93))
    bands = [(as_number(row["uncertainty"]) or 0.0) / float(row["published"]) for row in shown]
    axes.bar(range(len(shown)), [2 * band for band in bands], 0.8, [1.0 - band for band in bands], color="#d0d0d0",
             label="published, with its uncertainty")
    axes.axhline(1.0, color="#1a1a1a", lw=1, zorder=1)
    styles = ((-0.2, "#3a9d5d", "^"), (0.0, "#2a6f97", "o"), (0.2, "#d98c1f", "s"))
    for column, (aside, colour, marker), head in zip(MODELS.values(), styles, HEADS):
        told = [(place + aside, float(row[f"{column}_ratio"]), float(row[f"{column}_error"] or 0) / abs(float(row["published"])))
                for place, row in enumerate(shown) if row[f"{column}_ratio"]]
        if told:
            axes.errorbar(*zip(*told), fmt=marker, color=colour, ms=7, capsize=3, elinewidth=1.2, label=head)
    axes.grid(False, axis="x")
    axes.set_ylabel("measured over published")
    axes.set_xlim(-0.6, len(shown) - 0.4)
    axes.set_ylim(bottom=0.0)
    axes.set_xticks(range(len(shown)), [f"{row['case']}: {row['quantity']}" for row in shown], rotation=40, ha="right", rotation_mode="anchor",
                    fontsize=11)
    axes.tick_params(axis="x", length=0)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4)
    save(figure, file)


def main(source, folder):
    published = rows_from(os.path.join(folder, "published.csv"))
    target = os.path.join(folder, "nature.csv")
    rows = merged(published, rows_from(source), rows_from(target), rows_from(STRIPS))
    write(target, COLUMNS, rows)
    costs = rows_from(os.path.join(os.path.dirname(source), "costs.csv"))
    families = {"plates": [strips_table()], "fruits": [fruits_table()]}
    groups = [text for group in GROUPS for text in [group_table(rows, group), *families.get(group, [])]]
    write_tables(os.path.join(folder, "README.md"), [tally_table(rows), *groups, cost_table(rows, costs), source_table(published)],
                 mark("nature"))
    picture(rows, os.path.join(folder, "nature.png"))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
