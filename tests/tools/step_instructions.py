#!/usr/bin/env python3
"""Prints how many instructions a step of one body executes, by its parts, as valgrind counts them (which has no
AVX-512: of the step for AVX2). Usage: step_instructions.py BENCHMARKS, the program samara-benchmarks."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PARTS = [
    ("step_without_loads", "rotation, inertia and two solves"),
    ("step_with_tables", "the loads of tables in both as well"),
    ("step_with_tables_and_noise", "turbulence of tables, its noise, and one solve"),
]


def counted(program: str, benchmark: str) -> dict[str, float]:
    """Instructions a step within samara::advance, and within the kernel and the random numbers alone."""
    with tempfile.TemporaryDirectory() as folder:
        counts = Path(folder) / "counts"
        subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}", program,
             f"--benchmark_filter=^{benchmark}$", "--benchmark_min_time=0.05"],
            capture_output=True, check=True)
        table = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(counts)],
                               capture_output=True, text=True, check=True).stdout
        return shares(table, calls_of("samara::advance(", counts.read_text(encoding="utf-8")))


def calls_of(function: str, counts: str) -> int:
    """How often a function was called, of what callgrind wrote: a name stands in full where it comes first."""
    names: dict[str, str] = {}
    called = ""
    calls = 0
    for line in counts.splitlines():
        name = re.match(r"c?fn=\((\d+)\)(?: (.*))?", line)
        if name:
            if name.group(2):
                names[name.group(1)] = name.group(2)
            if line.startswith("cfn="):
                called = names[name.group(1)]
        elif line.startswith("calls=") and called.startswith(function):
            calls += int(line[len("calls="):].split()[0])
    return calls


def shares(table: str, steps: int) -> dict[str, float]:
    """The rows of a table of callgrind_annotate that are told, over the steps."""
    told = {"whole": r"samara::advance\(", "kernel": r"::lone_steps\(", "random": r"samara::Noise::uniforms\("}
    result = dict.fromkeys(told, 0.0)
    for line in table.splitlines():
        for name, pattern in told.items():
            number = re.match(r"\s*([\d,]+)", line)
            if number and re.search(pattern, line):
                result[name] = max(result[name], int(number.group(1).replace(",", "")) / steps)
    return result


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 1
    print("| benchmark | what it does | instructions a step | of them in the kernel | in Philox |")
    print("|---|---|---|---|---|")
    for benchmark, title in PARTS:
        count = counted(sys.argv[1], benchmark)
        print(f"| {benchmark} | {title} | {count['whole']:.0f} | {count['kernel']:.0f} | {count['random']:.0f} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
