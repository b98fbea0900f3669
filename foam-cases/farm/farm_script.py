"""What the farm's scripts share: each takes the folder of a mesh or a case, judges it, and notes what it found."""

import os
import sys

TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "templates")
sys.path += [TEMPLATES, os.path.join(TEMPLATES, "body-flow")]  # what the scripts in a case share with those of the farm
from case_files import Failure, CaseError, read, read_record, say, write_json  # noqa: E402


def input_hash(folder):
    """The hash that plan.json, one folder up, gives the inputs of this mesh or case; empty where the folder
    stands alone."""
    plan = read_record(os.path.join(folder, "..", "plan.json"))
    name = os.path.basename(os.path.abspath(folder))
    for entry in plan.get("meshes", []) + plan.get("cases", []) + plan.get("falls", []):
        if entry["name"] == name:
            return entry.get("inputs_hash", "")
    return ""


def mesh_record(folder):
    """What make_mesh.py noted of the mesh that a case is linked to; None where it made none."""
    poly_mesh = os.path.realpath(os.path.join(folder, "constant", "polyMesh"))
    return read_record(os.path.join(poly_mesh, "..", "..", "mesh.json")) or None


def stopping_fault(folder, log):
    """Why a case stopped without a verdict: what its script said last."""
    said = [line for line in read(os.path.join(folder, "log.Allrun")).splitlines() if line.strip()]
    return said[-1] if said and not said[-1].startswith("Running") else f"was stopped before its end; see {log}"


def run_on_folder(words, documentation, work):
    """Runs work(FOLDER) for a script whose one argument is a folder; returns its exit status. A error is printed
    in one line. A failure is also noted in FOLDER/failed.json, so that the farm leaves the case out."""
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
