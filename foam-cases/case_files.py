"""What the scripts beside it share: the files of a case, and how a fault is said."""

import json
import os
import re
import sys


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


def numbers(text):
    """All the numbers in the text, `nan` and `inf` among them."""
    return [float(word) for word in re.findall(r"[-+]?(?:\d[\d.]*(?:[eE][-+]?\d+)?|nan|inf)", text)]


def word(text, name):
    """The text of an entry of a case's file `parameters`."""
    match = re.search(rf"^{name}\s+([^;]+);", text, re.MULTILINE)
    if not match:
        raise Fault(f"parameters: has no entry {name}")
    return match.group(1).strip()


def parameter(text, name):
    """The number, or the numbers in brackets, of an entry."""
    value = word(text, name)
    return numbers(value) if value.startswith("(") else numbers(value)[0]


def check_ended(log, program):
    """Faults of a program that did not reach its end, with the iteration where it stopped."""
    text = read(log)
    if re.search(r"^End$", text, re.MULTILINE):
        return text
    times = re.findall(r"^Time = (\d+)", text, re.MULTILINE)
    where = f" at iteration {times[-1]}" if times else ""
    fatal = re.search(r"FOAM FATAL ([A-Z ]*ERROR)[^\n]*\n(?:\s*\n)*([^\n]*)", text)
    if fatal:
        # Files that are missing or cannot be read say nothing against the case.
        kind = Fault if "IO" in fatal.group(1) else Failure
        raise kind(f"{program} failed{where}: {fatal.group(2).strip().rstrip('.')}; see {log}")
    # The signal's handler, in the stack that OpenFOAM prints; its banner speaks of floating point exceptions too.
    if "sigFpe::sigHandler" in text:
        raise Failure(f"{program} diverged (floating point exception){where}; see {log}")
    raise Fault(f"{program} was stopped{where}, before its end; see {log}")


def cpu_seconds(log_text):
    times = re.findall(r"ExecutionTime = ([\d.]+) s", log_text)
    return float(times[-1]) if times else 0.0


def input_hash(folder):
    """The hash that plan.json, one folder up, gives the inputs of this mesh or case; empty where the folder
    stands alone."""
    path = os.path.join(folder, "..", "plan.json")
    if not os.path.exists(path):
        return ""
    plan = json.loads(read(path))
    name = os.path.basename(os.path.abspath(folder))
    for entry in plan.get("meshes", []) + plan["cases"] + plan.get("falls", []):
        if entry["name"] == name:
            return entry.get("inputs_hash", "")
    return ""


def run_on_folder(words, documentation, work):
    """Runs work(FOLDER) for a script whose one argument is a folder; returns its exit status. A fault is printed
    in one line. A failure is also noted in FOLDER/failed.json, so that the farm leaves the case out."""
    if len(words) != 2:
        sys.stderr.write(documentation)
        return 2
    folder = os.path.normpath(words[1])
    try:
        work(folder)
    except Failure as failure:
        print(f"{folder}: {failure}")
        write_json(os.path.join(folder, "failed.json"), {"reason": str(failure), "inputs_hash": input_hash(folder)})
        return 1
    except Fault as fault:
        print(f"{folder}: {fault}")
        return 1
    return 0
