#!/usr/bin/env python3
"""Prints how many instructions a step of one body executes, by its parts, and one of as many bodies side by side as a
vector of single precision holds, by their kinds, as valgrind counts them (which has no AVX-512: of the steps for AVX2).
Usage: step_instructions.py BENCHMARKS, the program samara-benchmarks."""
import re
import subprocess
import sys
import tempfile
from collections import Counter
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


KINDS = [  # of instructions by their names; the first that fits
    ("divisions and roots", r"v(div|sqrt)"),
    ("values to all lanes", r"vp?broadcast"),
    ("moves between registers and memory", r"vp?mov(?!msk)"),
    ("sums, products and other arithmetic", r"v"),
    ("addresses, loops and branches", r""),
]

CROWDS = [("batch_on_one_core/4096", "2 ms, one solve"), ("million_leaves", "1/60 s, both solves")]


def executed(counts: str) -> Counter[int]:
    """How often each address of the kernel was executed, of what callgrind wrote by instructions."""
    result: Counter[int] = Counter()
    in_kernel = is_call = False
    for line in counts.splitlines():
        if line.startswith("fn="):
            in_kernel = "samara::N_AVX2::" in line
        elif line.startswith("calls="):
            is_call = True
        elif line.startswith("0x"):
            if in_kernel and not is_call:
                address, _, count = line.split()[:3]
                result[int(address, 16)] += int(count)
            is_call = False
    return result


def crowd(program: str, benchmark: str) -> dict[str, float]:
    """Instructions by their kinds, of a step of one vector of bodies."""
    with tempfile.TemporaryDirectory() as folder:
        counts = Path(folder) / "counts"
        subprocess.run(
            ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--compress-strings=no", "--compress-pos=no",
             f"--callgrind-out-file={counts}", program, f"--benchmark_filter=^{benchmark}/real_time$",
             "--benchmark_min_time=0.01"],
            capture_output=True, check=True)
        often = executed(counts.read_text(encoding="utf-8"))
    code = subprocess.run(
        ["objdump", "-d", "--no-show-raw-insn", f"--start-address={min(often)}", f"--stop-address={max(often) + 16}",
         program], capture_output=True, text=True, check=True).stdout
    names = {int(line[1], 16): line[2] for line in re.finditer(r"^\s*([0-9a-f]+):\s+(\S+)", code, re.MULTILINE)}
    # Most of a step is passed once.
    steps = Counter({count: 0 for count in often.values()})
    for count in often.values():
        steps[count] += count
    result: Counter[str] = Counter()
    for address, count in often.items():
        result[next(kind for kind, pattern in KINDS if re.match(pattern, names[address]))] += count
    return {kind: result[kind] / steps.most_common(1)[0][0] for kind, _ in KINDS}


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 1
    print("| benchmark | what it does | instructions a step | of them in the kernel | in Philox |")
    print("|---|---|---|---|---|")
    for benchmark, title in PARTS:
        count = counted(sys.argv[1], benchmark)
        print(f"| {benchmark} | {title} | {count['whole']:.0f} | {count['kernel']:.0f} | {count['random']:.0f} |")
    crowds = [crowd(sys.argv[1], benchmark) for benchmark, _ in CROWDS]
    print("\n| instructions of a step of a vector of bodies | " + " | ".join(title for _, title in CROWDS) + " |")
    print("|---" * (1 + len(CROWDS)) + "|")
    for kind, _ in KINDS:
        print(f"| {kind} | " + " | ".join(f"{counts[kind]:.0f}" for counts in crowds) + " |")
    print("| all | " + " | ".join(f"{sum(counts.values()):.0f}" for counts in crowds) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
