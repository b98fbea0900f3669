"""The files of a case, and how a fault is said: what the scripts in a case and the farm's scripts share. The writer of
cases puts a copy into each, so that a case can be run by itself."""

import glob
import hashlib
import json
import os
import re

NUMBER = re.compile(r"[-+]?(?:\d[\d.]*(?:[eE][-+]?\d+)?|nan|inf)")
MESH_FILES = ("points", "faces", "owner", "neighbour", "boundary")


class Fault(Exception):
    """What is wrong, in one line for the user."""


class Failure(Fault):
    """A fault of the case itself, which would come again on the same inputs: the case is to be left out. Any
    other fault (a program that was killed, a full disk) says nothing against the case."""


def read(path):
    try:
        with open(path, errors="replace") as file:
            return file.read()
    except OSError as error:
        raise Fault(f"{path}: {error.strerror}") from error


def write_json(path, content):
    """Writes the file whole, or not at all."""
    temporary = path + ".part"
    with open(temporary, "w") as file:
        json.dump(content, file, indent=2, allow_nan=False)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(temporary, path)


def read_record(path):
    """What write_json wrote; empty where there is no such file, or it is damaged."""
    try:
        with open(path) as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def write_entries(path, remark, entries):
    """Writes entries of OpenFOAM's dictionaries, which count in place of earlier ones where the file is included."""
    with open(path, "w") as file:
        file.write(f"// {remark}\n")
        file.writelines(f"{name} {value};\n" for name, value in entries.items())


def numbers(text):
    """All the numbers in the text, `nan` and `inf` among them."""
    return [float(word) for word in NUMBER.findall(text)]


def word(text, name):
    """The text of an entry of a case's file `parameters`."""
    match = re.search(rf"^{name}\s+([^;]+);", text, re.MULTILINE)
    if not match:
        raise Fault(f"parameters: has no entry {name}; restore it")
    return match.group(1).strip()


def parameter(text, name):
    """The number, or the numbers in brackets, of an entry."""
    value = word(text, name)
    return numbers(value) if value.startswith("(") else numbers(value)[0]


def history(folder, name, file):
    """The rows [time, values...] of a function object over all runs; a later run counts where two overlap."""
    rows = []
    starts = {float(os.path.basename(path)): path
              for path in glob.glob(os.path.join(folder, "postProcessing", name, "*"))}
    for start, path in sorted(starts.items()):
        rows = [row for row in rows if row[0] <= start]
        with open(os.path.join(path, file), errors="replace") as lines:
            rows += [numbers(line) for line in lines if not line.startswith("#")]
    return [row for row in rows if row]


def hash_of_inputs(more=()):
    """Of all that the solution of the case in this folder depends on: its own files, its mesh, and the files `more`.
    What a script writes into system/ for a round is none of them."""
    own = ["parameters"] + [path for pattern in ("0.orig/*", "system/*", "constant/*") for path in glob.glob(pattern)]
    mesh = [os.path.join("constant/polyMesh", name) for name in MESH_FILES]
    total = hashlib.sha256()
    for path in sorted(own) + mesh + list(more):
        if os.path.isfile(path) and path != "system/round":
            with open(path, "rb") as file:
                total.update(path.encode() + b"\0" + file.read() + b"\0")
    return total.hexdigest()


def breakdown(log, program, unit=None):
    """The exception for a program whose last run in the log did not reach its end: Failure where the case is at
    fault, Fault where the program was stopped or could not read a file. `unit`: of a solver's steps ("iteration"),
    before the first of which nothing says that its case is at fault."""
    text = re.split(r"^Build\s*:", read(log), flags=re.MULTILINE)[-1]
    times = re.findall(r"^Time = (\S+)", text, re.MULTILINE)
    where = f" at {unit} {times[-1]}" if unit and times else ""
    see = f"; see {log}"
    fatal = re.search(r"FOAM FATAL ([A-Z ]*ERROR)[^\n]*\n(?:\s*\n)*([^\n]*)", text)
    if fatal:
        of_case = "IO" not in fatal.group(1) and (times or not unit)
        return (Failure if of_case else Fault)(f"{program} failed{where}: {fatal.group(2).strip().rstrip('.')}{see}")
    # The signal's handler, in the stack that OpenFOAM prints; its banner speaks of floating point exceptions too.
    if "sigFpe::sigHandler" in text:
        return Failure(f"{program} diverged (floating point exception){where}{see}")
    return Fault(f"{program} was stopped{where}, before its end{see}")


def cpu_seconds(log_text):
    times = re.findall(r"ExecutionTime = ([\d.]+) s", log_text)
    return float(times[-1]) if times else 0.0
