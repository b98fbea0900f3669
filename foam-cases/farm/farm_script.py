"""Functions of the farm's scripts, each of which judges the folder of a mesh or a case and records the result."""

import os
import sys

TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "templates")
sys.path += [TEMPLATES, os.path.join(TEMPLATES, "body-flow")]  # modules of the scripts in a case
from case_files import Failure, CaseError, read, read_record, say, write_json  # noqa: E402


def input_hash(folder):
    """Returns the hash of the inputs of this mesh or case in plan.json, one folder up; empty where there is no plan."""
    plan = read_record(os.path.join(folder, "..", "plan.json"))
    name = os.path.basename(os.path.abspath(folder))
    for entry in plan.get("meshes", []) + plan.get("cases", []) + plan.get("falls", []):
        if entry["name"] == name:
            return entry.get("inputs_hash", "")
    return ""


def mesh_record(folder):
    """Returns the record by make_mesh.py of the mesh that a case is linked to; None where there is none."""
    poly_mesh = os.path.realpath(os.path.join(folder, "constant", "polyMesh"))
    return read_record(os.path.join(poly_mesh, "..", "..", "mesh.json")) or None


def stopping_error(folder, log):
    """Returns why a case stopped without a verdict: the last line of its script."""
    said = [line for line in read(os.path.join(folder, "log.Allrun")).splitlines() if line.strip()]
    return said[-1] if said and not said[-1].startswith("Running") else f"was stopped before its end; see {log}"


def run_on_folder(words, documentation, work):
    """Runs work(FOLDER) for a script whose one argument is a folder; returns its exit status. An error is printed in
    one line. A failure is also recorded in FOLDER/failed.json, so that the farm leaves the case out."""
    if len(words) != 2:
        sys.stderr.write(documentation)
        return 2
    folder = os.path.normpath(words[1])
    try:
        work(folder)
    except Failure as failure:
        say(f"{folder}: {failure}")
        write_json(os.path.join(folder, "failed.json"), {"reason": str(failure), "inputs_hash": input_hash(folder)})
        return 1
    except (CaseError, OSError) as error:
        say(f"{folder}: {error}")
        return 1
    return 0
