#!/usr/bin/env python3
"""Holds a run of the benchmarks against an earlier one.

    compare_benchmarks.py OLD.json NEW.json

Both are what `./dev bench --save FILE.json` writes: each benchmark several times. Prints the ratio of the medians of CPU
time, new over old, with the 95 % interval that the repetitions tell (bootstrap), and what was slower for certain: where
that interval lies above 1.05. Exit status 1 where there is any; 2 where a file cannot be compared.
"""

import json
import random
import statistics
import sys

SLOWER, FASTER = 1.05, 0.95
RESAMPLES = 2000
NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
SAME_MACHINE = ("num_cpus", "mhz_per_cpu", "host_name")


class ReportError(Exception):
    """What is said in one line."""


def read(path):
    """The context, and the CPU times (ns) of each benchmark's repetitions."""
    try:
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
        times = {}
        for one in found["benchmarks"]:
            if one.get("run_type", "iteration") == "iteration" and not one.get("error_occurred"):
                times.setdefault(one.get("run_name", one["name"]), []).append(one["cpu_time"] * NANOSECONDS[one["time_unit"]])
        return found.get("context", {}), times
    except OSError as error:
        raise ReportError(f"{path}: {error.strerror}; write one by ./dev bench --save {path}") from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ReportError(f"{path}: is no result of the benchmarks; write one by ./dev bench --save {path}") from error


def ratio_of(old, new):
    """The ratio of the medians, new over old, and its 95 % interval by the bootstrap; no interval of fewer than three
    repetitions."""
    ratio = statistics.median(new) / statistics.median(old)
    if min(len(old), len(new)) < 3:
        return ratio, None
    draws = random.Random(1)
    ratios = sorted(statistics.median(draws.choices(new, k=len(new))) / statistics.median(draws.choices(old, k=len(old)))
                    for _ in range(RESAMPLES))
    return ratio, (ratios[RESAMPLES // 40], ratios[-1 - RESAMPLES // 40])


def verdict(interval):
    if interval is None:
        return "too few repetitions"
    if interval[0] > SLOWER:
        return "SLOWER"
    return "faster" if interval[1] < FASTER else ""


def in_words(nanoseconds):
    for unit, size in (("s", 1e9), ("ms", 1e6), ("us", 1e3)):
        if nanoseconds >= size:
            return f"{nanoseconds / size:.3g} {unit}"
    return f"{nanoseconds:.3g} ns"


def compared(old, new):
    """The lines of the table, and the names of what is slower for certain."""
    names = [name for name in new if name in old]
    if not names:
        raise ReportError("the two files have no benchmark in common")
    width = max(map(len, names))
    lines, slower = [f"{'benchmark':<{width}}  {'old':>8}  {'new':>8}  ratio"], []
    for name in names:
        ratio, interval = ratio_of(old[name], new[name])
        spread = f" ({interval[0]:.3f} to {interval[1]:.3f})" if interval else ""
        said = verdict(interval)
        lines.append(f"{name:<{width}}  {in_words(statistics.median(old[name])):>8}  {in_words(statistics.median(new[name])):>8}  "
                     f"{ratio:.3f}{spread}  {said}".rstrip())
        slower += [name] if said == "SLOWER" else []
    return lines, slower


def main(words):
    if len(words) != 3:
        sys.stderr.write(__doc__)
        return 2
    try:
        (old_context, old), (new_context, new) = read(words[1]), read(words[2])
        lines, slower = compared(old, new)
    except ReportError as error:
        sys.stderr.write(f"compare_benchmarks: {error}\n")
        return 2
    print("\n".join(lines))
    for name in sorted(set(old) - set(new)):
        print(f"only in {words[1]}: {name}")
    for name in sorted(set(new) - set(old)):
        print(f"only in {words[2]}: {name}")
    if any(old_context.get(key) != new_context.get(key) for key in SAME_MACHINE):
        print("note: the two are from machines that differ")
    if slower:
        print(f"{len(slower)} of {len(lines) - 1} slower than before by more than {100 * (SLOWER - 1):.0f} %, for certain")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
