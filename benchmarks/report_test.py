# SPDX-License-Identifier: MIT
"""Tests of report.py: python3 report_test.py; the target `report` runs them first."""
import contextlib
import io
import json
import pathlib
import tempfile
import unittest
from unittest import mock

import report


def entry(name, error, seconds):
    return {"name": name, "run_type": "iteration", "cpu_time": seconds, "real_time": 7.0, "time_unit": "s",
            "iterations": 1, "per_item": 1e-9, **({} if error is None else {"error": error})}


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_report(self, entries, *options):
        """Returns exit status and what was printed."""
        file = self.folder / "run.json"
        file.write_text(json.dumps({"benchmarks": entries}))
        arguments = ["report.py", "--bands", str(self.folder / "bands.csv"), "--output", str(self.folder), *options]
        with mock.patch("sys.argv", [*arguments, str(file)]), io.StringIO() as out, contextlib.redirect_stdout(out), \
                contextlib.redirect_stderr(out):
            return report.main(), out.getvalue()

    def test_an_error_without_a_band_fails_and_is_accepted_on_demand(self):
        run = [entry("family/ours/steps:1", 0.1, 1.0)]
        self.assertEqual(self.run_report(run)[0], 1)
        self.assertEqual(self.run_report(run, "--accept")[0], 0)
        self.assertEqual(self.run_report(run)[0], 0)

    def test_an_error_outside_its_band_fails_on_either_side(self):
        self.run_report([entry("family/ours/steps:1", 0.1, 1.0)], "--accept")
        for error, status in ((0.13, 1), (0.07, 1), (0.12, 0), (0.09, 0)):
            self.assertEqual(self.run_report([entry("family/ours/steps:1", error, 1.0)])[0], status)

    def test_round_off_is_exact(self):
        self.run_report([entry("family/ours/steps:1", 1e-16, 1.0)], "--accept")
        self.assertEqual(self.run_report([entry("family/ours/steps:1", 0.0, 1.0)])[0], 0)
        self.assertEqual(self.run_report([entry("family/ours/steps:1", 1e-10, 1.0)])[0], 1)

    def test_a_slower_run_only_warns(self):
        self.run_report([entry("family/ours/steps:1", 0.1, 1.0)], "--accept")
        status, text = self.run_report([entry("family/ours/steps:1", 0.1, 3.0)])
        self.assertEqual(status, 0)
        self.assertIn("warning: family/ours/steps:1 took 3 s, recorded 1 s", text)

    def test_a_benchmark_that_fell_out_of_its_family_fails(self):
        self.run_report([entry("family/ours/steps:1", 0.1, 1.0), entry("other/ours/steps:1", 0.1, 1.0)], "--accept")
        status, text = self.run_report([entry("family/ours/steps:2", 0.1, 1.0)])
        self.assertEqual(status, 1)
        self.assertIn("family/ours/steps:1: has a band, but was not run", text)
        self.assertNotIn("other/", text)

    def test_names_lose_what_the_timer_added_and_choose_its_time(self):
        run = [entry("family/VFS/threshold 0.74/d_dx:2/iterations:3/real_time", 0.1, 1.0)]
        self.run_report(run, "--accept")
        self.assertIn("| VFS threshold 0.74 | 2 | 7 s | 0.1 | 1 ns |", (self.folder / "report.md").read_text())
        self.assertIn("family/VFS/threshold 0.74/d_dx:2,", (self.folder / "bands.csv").read_text())

    def test_a_benchmark_that_failed_fails_and_the_others_are_reported(self):
        broken = {**entry("family/broken/steps:1", None, 1.0), "error_occurred": True, "error_message": "no memory"}
        status, text = self.run_report([broken, entry("family/ours/steps:1", None, 1.0)])
        self.assertEqual(status, 1)
        self.assertIn("family/broken/steps:1 failed: no memory", text)
        self.assertIn("| ours | 1 |", (self.folder / "report.md").read_text())

    def test_a_rival_that_is_not_installed_is_skipped_with_its_band(self):
        run = [entry("family/ours/steps:1", 0.1, 1.0), entry("family/rival/steps:1", 0.1, 1.0)]
        self.run_report(run, "--accept")
        run[1] = {**run[1], "error_occurred": True, "error_message": "absent: rival is not installed"}
        status, text = self.run_report(run)
        self.assertEqual(status, 0)
        self.assertIn("skipped: family/rival/steps:1: rival is not installed", text)

    def test_a_benchmark_without_error_has_a_row_and_no_band(self):
        self.assertEqual(self.run_report([entry("family/ours/steps:1", None, 1.0)])[0], 0)
        self.assertIn("| ours | 1 | 1 s |  | 1 ns |", (self.folder / "report.md").read_text())


if __name__ == "__main__":
    unittest.main()
