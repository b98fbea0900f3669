"""Reading and writing of a case's files, and its errors, for the scripts in a case and the farm's scripts. A copy is put into
each case, so that it can be run by itself."""

import glob
import hashlib
import json
import math
import os
import re

NUMBER = re.compile(r"[-+]?(?:\d[\d.]*(?:[eE][-+]?\d+)?|nan|inf)")
TIME = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TESTED_VERSION = "1912"  # of OpenFOAM
MESH_FILES = ("points", "faces", "owner", "neighbour", "boundary")


class CaseError(Exception):
    """An error, as one line for the user."""


class Failure(CaseError):
    """An error by the case itself, which would recur with the same inputs, so that the case is left out. Other errors (a killed
    program, a full disk) are not by the case."""


def read(path):
    try:
        with open(path, errors="replace") as file:
            return file.read()
    except OSError as error:
        raise CaseError(f"{path}: {error.strerror}") from error


def say(line, file=None):
    """Prints a line, which may contain names of folders that are no valid UTF-8."""
    print(str(line).encode(errors="surrogateescape").decode(errors="replace"), file=file)


def write_json(path, content):
    """Writes the file completely, or not at all."""
    temporary = path + ".part"
    with open(temporary, "w", encoding="utf-8", errors="replace") as file:
        json.dump(content, file, indent=2, allow_nan=False, ensure_ascii=False)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(temporary, path)


def read_record(path):
    """Reads the output of write_json; returns {} where the file is missing or damaged."""
    try:
        with open(path) as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def are_attempts(record, known, required, optional=()):
    """Whether the record holds a valid list of attempts: each of a known name, with the `required` numbers and perhaps the
    `optional` ones."""
    try:
        return bool(record["attempts"]) and all(
            attempt["what"] in known and all(math.isfinite(float(attempt[name])) for name in required)
            and all(math.isfinite(float(attempt[name])) for name in optional if name in attempt)
            for attempt in record["attempts"])
    except (LookupError, TypeError, ValueError):
        return False


def write_entries(path, remark, entries):
    """Writes entries of an OpenFOAM dictionary, which replace earlier ones where the file is included."""
    with open(path, "w") as file:
        file.write(f"// {remark}\n")
        file.writelines(f"{name} {value};\n" for name, value in entries.items())


def numbers(text):
    """Returns all numbers in the text, including `nan` and `inf`."""
    return [float(word) for word in NUMBER.findall(text)]


def word(text, name):
    """Returns the text of an entry of a case's file `parameters`."""
    match = re.search(rf"^{name}\s+([^;]+);", text, re.MULTILINE)
    if not match:
        raise CaseError(f"parameters: has no entry {name}; restore it")
    return match.group(1).strip()


def parameter(text, name):
    """Returns the number, or the list of numbers in brackets, of an entry."""
    value = word(text, name)
    return numbers(value) if value.startswith("(") else numbers(value)[0]


def time_folders(folder):
    """Returns the paths of the subfolders that are named by a time, by ascending time."""
    names = os.listdir(folder) if os.path.isdir(folder) else []
    paths = {float(name): os.path.join(folder, name) for name in names if TIME.fullmatch(name)}
    return {time: paths[time] for time in sorted(paths) if os.path.isdir(paths[time])}


def rows_of(path):
    """Returns the rows of numbers in a file of a history, without an incomplete last line."""
    lines = read(path).split("\n")[:-1]
    try:
        rows = [numbers(line) for line in lines if line and not line.startswith("#")]
    except ValueError as error:
        raise CaseError(f"{path}: is damaged ({error}); ./Allclean starts over") from error
    if any(len(row) != len(rows[0]) for row in rows):
        raise CaseError(f"{path}: is damaged: its rows differ in length; ./Allclean starts over")
    return rows


def history(folder, name, file):
    """Returns the rows [time, values...] of a function object over all runs; where two overlap, the later run is used."""
    rows = []
    for start, path in time_folders(os.path.join(folder, "postProcessing", name)).items():
        rows = [row for row in rows if row[0] <= start] + rows_of(os.path.join(path, file))
    return rows


def hash_of_inputs(more=()):
    """Returns the hash of all inputs of the case in this folder: its own files, its mesh, and the files `more`."""
    own = ["parameters"] + [path for pattern in ("0.orig/*", "system/*", "constant/*") for path in glob.glob(pattern)]
    mesh = [os.path.join("constant/polyMesh", name) for name in MESH_FILES]
    total = hashlib.sha256()
    for path in sorted(own) + mesh + list(more):
        if os.path.isfile(path):
            with open(path, "rb") as file:
                total.update(os.fsencode(path) + b"\0" + file.read() + b"\0")
    return total.hexdigest()


def last_run(log):
    """Returns the part of the log by the last run of a program."""
    return re.split(r"^Build\s*:", read(log), flags=re.MULTILINE)[-1]


def other_version(log):
    """Returns a remark for an error where the log's last run was by an OpenFOAM with which the cases are not tested."""
    builds = re.findall(r"^Build\s*:\s*(.*?)\s*$", read(log), re.MULTILINE)
    if not builds or TESTED_VERSION in builds[-1]:
        return ""
    return f" (this OpenFOAM is '{builds[-1]}'; the cases are tested with v{TESTED_VERSION})"


def could_not_read_state(log):
    """Whether the solver's last run could not read the state from which it was to continue, as after a full disk."""
    run = last_run(log)
    return "FOAM FATAL IO ERROR" in run and not re.search(r"^Time = ", run, re.MULTILINE)


def breakdown(log, program, unit=None):
    """Returns the exception for a program whose last run in the log did not reach its end: Failure where the case is the cause,
    CaseError where the program was stopped or could not read a file. `unit`: the word for a solver's steps ("iteration"); before
    the first step an error is not attributed to the case."""
    text = last_run(log)
    times = re.findall(r"^Time = (\S+)", text, re.MULTILINE)
    where = f" at {unit} {times[-1]}" if unit and times else ""
    see = f"; see {log}"
    fatal = re.search(r"FOAM FATAL ([A-Z ]*ERROR)[^\n]*\n(?:\s*\n)*([^\n]*)", text)
    if fatal:
        of_case = "IO" not in fatal.group(1) and (times or not unit)
        # Allrun passes this path in place of a folder whose name OpenFOAM does not accept.
        said = fatal.group(2).strip().rstrip(".").replace("/proc/self/cwd", os.path.dirname(log) or ".")
        return (Failure if of_case else CaseError)(f"{program} failed{where}: {said}{other_version(log)}{see}")
    # The signal's handler in the stack trace; OpenFOAM's banner mentions floating point exceptions too.
    if "sigFpe::sigHandler" in text:
        return Failure(f"{program} diverged (floating point exception){where}{see}")
    return CaseError(f"{program} was stopped{where}, before its end{see}")


def cpu_seconds(log_text):
    times = re.findall(r"ExecutionTime = ([\d.]+) s", log_text)
    return float(times[-1]) if times else 0.0
