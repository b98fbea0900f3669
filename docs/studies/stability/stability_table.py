#!/usr/bin/env python3
"""Writes the table of README.md from the rows that the stability tests recorded.

    stability_tests --gtest_output=json:RESULTS && stability_table.py RESULTS docs/studies/stability/README.md
"""

import glob
import json
import os
import sys
from pathlib import Path

sys.path += glob.glob(f"{os.path.dirname(os.path.abspath(__file__))}/../*/")  # the modules of all studies
from report_tables import mark, write_tables  # noqa: E402

HEAD = "| case | step | what is checked | bound | figure |\n|---|---|---|---|---|\n"


def rows_of(test):
    """The rows that a test recorded, in their order."""
    names = sorted((key for key in test if key.startswith("row_")), key=lambda key: int(key[4:]))
    return [json.loads(test[name]) for name in names]


def table_line(row):
    columns = [row[key].replace("|", "\\|") for key in ("subject", "step", "checked", "bound", "figure")]
    return "| " + " | ".join(columns) + " |\n"


def main(results, document):
    suites = json.loads(results.read_text())["testsuites"]
    tests = [test for suite in suites for test in suite["testsuite"]]
    failed = [test["name"] for test in tests if test.get("failures")]
    if failed:
        sys.exit("stability_table.py: not written, since tests failed: " + ", ".join(failed))
    lines = [table_line(row) for test in tests for row in rows_of(test)]
    write_tables(document, [HEAD + "".join(lines)], mark("stability"))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), sys.argv[2])
