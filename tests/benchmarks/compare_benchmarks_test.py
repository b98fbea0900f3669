#!/usr/bin/env python3
"""Two runs of the benchmarks held against each other. Run by ctest."""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
from compare_benchmarks import main, ratio_of, verdict  # noqa: E402

JITTER = (0.0, 0.01, -0.01, 0.02, -0.015, 0.005, -0.005)


def run_of(times, host="one", unit="us"):
    """As Google Benchmark writes it: each repetition, and aggregates that do not count."""
    benchmarks = []
    for name, time in times.items():
        benchmarks += [{"name": name, "run_name": name, "run_type": "iteration", "cpu_time": time * (1 + jitter), "time_unit": unit}
                       for jitter in JITTER]
        benchmarks.append({"name": name + "_mean", "run_name": name, "run_type": "aggregate", "cpu_time": 1e9, "time_unit": unit})
    return {"context": {"host_name": host, "num_cpus": 2, "mhz_per_cpu": 2000}, "benchmarks": benchmarks}


class CompareBenchmarks(unittest.TestCase):
    def compared(self, old, new):
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("old.json", "new.json")]
            for path, content in zip(paths, (old, new)):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(content if isinstance(content, str) else json.dumps(content))
            said, complaint = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(complaint):
                status = main(["compare", *paths])
            return status, said.getvalue(), complaint.getvalue()

    def test_a_loss_beyond_its_spread_is_caught_and_a_gain_is_told(self):
        status, said, _ = self.compared(run_of({"step": 1.0, "load": 2.0}), run_of({"step": 1.3, "load": 1.0}))
        self.assertEqual(status, 1)
        self.assertRegex(said, r"step +1 us +1.3 us +1.300 \(1\.\d+ to 1\.\d+\)  SLOWER")
        self.assertRegex(said, r"load .* 0.500 .*faster")
        self.assertIn("1 of 2 slower", said)

    def test_what_lies_within_the_spread_is_no_loss(self):
        status, said, _ = self.compared(run_of({"step": 1.0}), run_of({"step": 1.01}))
        self.assertEqual(status, 0)
        self.assertNotIn("SLOWER", said)

    def test_units_are_converted(self):
        status, said, _ = self.compared(run_of({"step": 1.0}), run_of({"step": 1000.0}, unit="ns"))
        self.assertEqual(status, 0)
        self.assertIn("1.000", said)

    def test_one_repetition_decides_nothing(self):
        self.assertEqual(ratio_of([1.0], [2.0]), (2.0, None))
        self.assertEqual(verdict(None), "too few repetitions")

    def test_what_is_in_one_file_alone_and_another_machine_are_said(self):
        _, said, _ = self.compared(run_of({"a": 1.0, "b": 1.0}), run_of({"a": 1.0, "c": 1.0}, host="two"))
        self.assertRegex(said, r"only in .*old.json: b")
        self.assertRegex(said, r"only in .*new.json: c")
        self.assertIn("machines that differ", said)

    def test_files_that_cannot_be_compared_are_told_in_one_line(self):
        for old in ("", "{}", "[]", '{"benchmarks": [{}]}', "not json"):
            status, said, complaint = self.compared(old, run_of({"a": 1.0}))
            self.assertEqual((status, said), (2, ""))
            self.assertEqual(complaint.count("\n"), 1)
            self.assertIn("old.json", complaint)
        status, _, complaint = self.compared(run_of({"a": 1.0}), run_of({"b": 1.0}))
        self.assertEqual(status, 2)
        self.assertIn("no benchmark in common", complaint)
        status = main(["compare", "missing.json", "missing.json"])
        self.assertEqual(status, 2)


if __name__ == "__main__":
    unittest.main()
