#!/usr/bin/env -S python3 -IB
"""Records that a free fall was solved, from the files that OpenFOAM wrote.

    check_fall.py FOLDER   writes FOLDER/provenance.json where the fall reached its end

Otherwise exits with 1 and one line with the error and the log's name; where the fall diverged in all attempts (not where the
solver was only stopped) FOLDER/failed.json with that reason is written too. provenance.json is written last and whole, so that
its existence means success. The momentum balance is checked where the fall is read (converter/falls/fall_record).
"""

import os
import re
import sys

sys.path.append(os.path.dirname(os.path.realpath(__file__)))  # which python3 -I leaves out
from farm_script import input_hash, mesh_record, run_on_folder, stopping_error  # noqa: E402
from case_files import Failure, CaseError, parameter, read, read_record, word, write_json  # noqa: E402


def check_fall(folder):
    done = read_record(os.path.join(folder, "attempts.json"))
    if not done:
        raise CaseError(stopping_error(folder, os.path.join(folder, "log.Allrun")))
    last = done["attempts"][-1]
    log = os.path.join(folder, "log.pimpleFoam")
    if done["verdict"] == "failed":
        tried = ", ".join(one["what"] for one in done["attempts"])
        raise Failure(f"diverged in all attempts ({tried}); the last: {last['end']}; try a smaller --step")
    if done["verdict"] is None:
        raise CaseError(stopping_error(folder, log))
    text = read(log)
    parameters = read(os.path.join(folder, "parameters"))
    build = re.search(r"^Build\s*:\s*(.*)$", text, re.MULTILINE)
    courant = [float(value) for value in re.findall(r"^Courant Number mean: \S+ max: (\S+)", text, re.MULTILINE)]
    write_json(os.path.join(folder, "provenance.json"), {
        "case": os.path.basename(os.path.abspath(folder)),
        "openfoam": build.group(1).strip() if build else "",
        "closure": word(parameters, "closure") if word(parameters, "simulationType") != "laminar" else "laminar",
        "convection": word(parameters, "convection"),
        "gradient": word(parameters, "gradient"),
        "rate_of_change": word(parameters, "rateOfChange"),
        "reynolds_number": parameter(parameters, "reynoldsNumber"),
        "time_step": float(last.get("timeStep", parameter(parameters, "timeStep"))),
        "largest_courant_number": max(courant, default=0.0),
        "attempts": done["attempts"],
        "mesh": mesh_record(folder),
        "cpu_seconds": done["cpu_seconds"],
        "inputs_hash": input_hash(folder),
    })


if __name__ == "__main__":
    sys.exit(run_on_folder(sys.argv, __doc__, check_fall))
