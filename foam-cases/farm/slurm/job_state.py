#!/usr/bin/env -S python3 -IB
"""Reports the state of a Slurm job to Snakemake: prints running, success or failed.

    job_state.py ID

Uses scontrol, so that Slurm's accounting is not needed.
"""

import re
import subprocess
import sys

RUNNING = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "REQUEUE_HOLD", "RESIZING",
           "SIGNALING", "STAGE_OUT", "STOPPED", "SPECIAL_EXIT"}


def state(job):
    answer = subprocess.run(["scontrol", "--oneliner", "show", "job", job], capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        # Slurm forgets jobs minutes after their end: then the job's files show its success.
        # Where Slurm does not answer, it will later.
        return "success" if "Invalid job id" in answer.stderr else "running"
    word = re.search(r"JobState=(\w+)", answer.stdout).group(1)
    if word == "COMPLETED":
        return "success"
    return "running" if word in RUNNING else "failed"


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print(state(sys.argv[-1].split()[-1]))
