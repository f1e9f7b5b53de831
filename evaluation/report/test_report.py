#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of report.py on small made-up results. usage: test_report.py"""
import contextlib
import io
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True

import errors
import losses
import paper
import report
import runs
import tables

ABOUT = {
    "version": "0", "command": "pcl_kss_icp_evaluate models --out out", "seed": 0,
    "machine": {"cpu": "a CPU"}, "settings": {"points": 10000},
    "models": [{"name": "cow", "file": "cow.off", "kind": "mesh"},
               {"name": "ant", "file": "ant.off", "kind": "mesh"}],
    "skipped": [{"file": "x.off", "reason": "no faces"}],
    "methods": [
        {"name": "KSS-ICP", "estimates_scale": True, "group": "kss", "ablates": ""},
        {"name": "SAC-IA", "estimates_scale": False, "group": "peer", "ablates": ""},
        {"name": "Open3D RANSAC", "estimates_scale": True, "group": "peer", "ablates": ""},
        {"name": "k = 500", "estimates_scale": True, "group": "ablation",
         "ablates": "number of points k"}],
    "conditions": [
        {"name": "similarity", "table": "similarity", "title": "Random similarity",
         "parameter": 0},
        {"name": "gauss-0.33", "table": "gauss", "parameter": 0.33},
        {"name": "gauss-2", "table": "gauss", "parameter": 2},
        {"name": "size-5000", "table": "size", "parameter": 5000}]}


def run(condition="similarity", model="cow", method="KSS-ICP", mse=1e-3, solved=True,
        **others) -> dict:
    """One result."""
    result = {
        "condition": condition, "model": model, "repetition": 0, "method": method,
        "scale_given": False, "status": "ok", "message": "", "claimed": solved,
        "solved": solved, "mse": mse, "rmse": mse ** 0.5, "mae": 0.8 * mse ** 0.5,
        "mse_r": 0.1, "rmse_r": 0.3, "mae_r": 0.2, "rotation_deg": 1.0,
        "translation": 0.01, "scale": 0.01, "tre": 0.01, "cpu_s": 2.0, "wall_s": 1.0,
        "peak_mb": 100.0, "pose": [0.0] * 16}
    result.update(others)
    return result


def results_of(*entries) -> runs.Results:
    return runs.Results(ABOUT, list(entries))


def everything() -> list:
    """All methods in all conditions."""
    return [run(condition["name"], model["name"], method["name"],
                1e-3 * (1 + 0.37 * i + 0.11 * j + 0.07 * k), scale_given=given)
            for i, condition in enumerate(ABOUT["conditions"])
            for j, model in enumerate(ABOUT["models"])
            for k, method in enumerate(ABOUT["methods"]) for given in (False, True)]


def write(folder: str, entries: list, end: str = ""):
    with open(os.path.join(folder, "run.json"), "w", encoding="utf-8") as file:
        json.dump(ABOUT, file)
    with open(os.path.join(folder, "runs.jsonl"), "w", encoding="utf-8") as file:
        file.write("".join(json.dumps(entry) + "\n" for entry in entries) + end)


def report_without_pictures(entries: list, end: str = "") -> dict:
    """What report.py writes, by file, where there is no matplotlib."""
    with tempfile.TemporaryDirectory() as folder:
        write(folder, entries, end)
        with mock.patch.dict(sys.modules, {"matplotlib": None, "plots": None,
                                           "pictures": None}), \
                contextlib.redirect_stderr(io.StringIO()):
            report.main(folder)
        files = {}
        for path, _, names in os.walk(folder):
            for name in names:
                if name.endswith((".md", ".csv")):
                    with open(os.path.join(path, name), encoding="utf-8") as file:
                        files[name] = file.read()
        return files


class Reading(unittest.TestCase):
    def read(self, entries, end=""):
        with tempfile.TemporaryDirectory() as folder:
            write(folder, entries, end)
            return runs.read(folder)

    def test_truncated_last_line_is_ignored(self):
        results = self.read([run()], '{"condition": "simi')
        self.assertEqual(results.number_of_runs(), 1)
        self.assertTrue(results.ignored_line)

    def test_broken_line_elsewhere_is_an_error(self):
        with self.assertRaisesRegex(runs.InputError, "runs.jsonl:2: not JSON"):
            self.read([run()], '{"condi\n' + json.dumps(run(model="ant")) + "\n")

    def test_second_result_of_a_key_replaces_the_first(self):
        results = self.read([run(), run(mse=2)])
        self.assertEqual(results.number_of_runs(), 1)
        self.assertEqual(runs.mean(results.over(results.conditions, results.methods[0],
                                                runs.UNKNOWN), "mse"), 2)

    def test_no_results(self):
        with self.assertRaisesRegex(runs.InputError, "no results"):
            self.read([])

    def test_missing_file_is_one_line_and_exit_code_1(self):
        with tempfile.TemporaryDirectory() as folder:
            program = subprocess.run([sys.executable, report.__file__, folder],
                                     capture_output=True, text=True, check=False)
        self.assertEqual(program.returncode, 1)
        self.assertEqual(len(program.stderr.splitlines()), 1)


class Means(unittest.TestCase):
    def test_mean_is_over_cases(self):
        entries = [run(mse=1.0), run(model="ant", mse=4.0)]
        self.assertEqual(runs.mean(entries, "mse"), 2.5)
        self.assertEqual(runs.mean(entries, "rmse"), 1.5)  # not the root of the mean MSE

    def test_what_is_not_a_number_is_left_out(self):
        entries = [run(mse=1.0), run(mse=3.0, rmse=None)]
        entries.append(run(rmse=float("nan")) | {"mse": float("nan")})
        self.assertEqual(runs.mean(entries, "mse"), 2.0)
        self.assertEqual(runs.mean(entries, "rmse"), 1.0)
        self.assertIsNone(runs.mean([run(mse=1.0, rmse=None)], "rmse"))

    def test_timeouts_count_as_infinite_times(self):
        slow = run(status="timeout", cpu_s=None)
        self.assertEqual(runs.time_median([run(), run(), slow], "cpu_s"), 2.0)
        self.assertEqual(tables.measured(runs.time_median([run(), slow, slow], "cpu_s")),
                         "timeout")

    def test_sizes_are_run_as_each_method_is_able_to(self):
        """Both in one block: SAC-IA is given the scale, KSS-ICP finds it."""
        results = results_of(run("size-5000"),
                             run("size-5000", method="SAC-IA", scale_given=True))
        for name in ("KSS-ICP", "SAC-IA"):
            method = next(m for m in results.methods if m.name == name)
            self.assertEqual(len(results.of(results.table("size")[0], method, runs.MIXED)),
                             1)

    def test_crashes_have_no_time(self):
        self.assertIsNone(runs.time_median([run(status="crashed", cpu_s=1.0)], "cpu_s"))

    def test_claims(self):
        entries = [run(), run(solved=False, claimed=True), run(claimed=False),
                   run(claimed=False)]
        self.assertEqual(len(runs.wrong_claims(entries)), 1)
        self.assertEqual(len(runs.missed(entries)), 2)


class Tables(unittest.TestCase):
    def test_format_of_the_paper(self):
        self.assertEqual(tables.scientific(0.0101), "1.01E-2")
        self.assertEqual(tables.scientific(3.894e-4), "3.89E-4")
        self.assertEqual(tables.scientific(None), tables.NOTHING)

    def test_ties_are_all_best(self):
        self.assertEqual(tables.bold_best([1.001, 1.0012, 2, None], tables.scientific),
                         ["**1.00E0**", "**1.00E0**", "2.00E0", tables.NOTHING])

    def test_counts_are_shown_where_they_differ(self):
        complete = [run(), run(model="ant"), run(method="SAC-IA"),
                    run(method="SAC-IA", model="ant")]
        text, _ = errors.section(results_of(*complete), paper.read())
        self.assertNotIn("| n |", text)
        text, _ = errors.section(results_of(*complete[:3]), paper.read())
        self.assertIn("| n |", text)

    def test_figures_of_the_paper_stand_beside_ours(self):
        text, _ = errors.section(results_of(run(), run(method="SAC-IA")), paper.read())
        self.assertRegex(text, r"\| KSS-ICP \|.*\| \*3\.89E-4\* \|")
        self.assertRegex(text, r"\| SAC-IA † \|.*\| \*2\.26E-3\* \|")

    def test_noise_beyond_the_paper_is_marked(self):
        text, _ = errors.section(results_of(run("gauss-0.33"), run("gauss-2")),
                                 paper.read())
        self.assertRegex(text, r"\| 0\.33 \| KSS-ICP \|")
        self.assertRegex(text, r"\| 2 \(beyond the paper\) \| KSS-ICP \|")


class Paper(unittest.TestCase):
    def test_figures_of_kss_icp(self):
        expected = {("similarity", 0): "3.89E-4", ("density", 0): "4.47E-4",
                    ("gauss", 0.33): "1.97E-03", ("gauss", 0.66): "1.63E-03",
                    ("uniform", 0.5): "7.33E-04", ("uniform", 1): "7.89E-04",
                    ("deleted", 0.3): "9.32E-4"}
        found = paper.read()
        for (table, parameter), figure in expected.items():
            self.assertEqual(found[table].figures("KSS-ICP", parameter)["MSE"], figure)

    def test_times(self):
        times = paper.read()["size"]
        self.assertEqual(times.figures("KSS-ICP", 0)["1,000k"], "124.3s")
        self.assertEqual(times.figures("KSS-ICP (host)", 0)["10k"], "85.7s")

    def test_all_rows_are_complete(self):
        for table in paper.read().values():
            head, _, *rows = [line for line in table.quoted().splitlines()
                              if line.startswith("|")]
            for row in rows:
                self.assertEqual(row.count("|"), head.count("|"))


class Losses(unittest.TestCase):
    def found(self, *entries):
        return [(loss.metric, loss.method.name)
                for loss in losses.find(results_of(*entries))]

    def test_none(self):
        self.assertEqual(self.found(run(), run(method="Open3D RANSAC")), [])
        text, _ = losses.section(results_of(run(), run(method="Open3D RANSAC")))
        self.assertEqual(text.count("None.\n"), 2)

    def test_margin(self):
        self.assertEqual(self.found(run(mse=1.0), run(method="SAC-IA", mse=0.96)), [])
        self.assertEqual(self.found(run(mse=1.0), run(method="SAC-IA", mse=0.94)),
                         [("MSE", "SAC-IA")])  # its root is only 3 % less

    def test_success(self):
        self.assertEqual(self.found(run(solved=False), run(method="SAC-IA")),
                         [("success", "SAC-IA")])

    def test_time_counts_for_methods_that_know_the_scale(self):
        fast = {"cpu_s": 1.0}
        self.assertEqual(self.found(run(), run(method="SAC-IA", **fast)), [])
        self.assertEqual(self.found(run(), run(method="Open3D RANSAC", **fast)),
                         [("CPU time", "Open3D RANSAC")])
        self.assertEqual(self.found(run(scale_given=True),
                                    run(method="SAC-IA", scale_given=True, **fast)),
                         [("CPU time", "SAC-IA")])

    def test_sizes(self):
        fast = {"cpu_s": 1.0, "scale_given": True}
        self.assertEqual(self.found(run("size-5000"),
                                    run("size-5000", method="SAC-IA", **fast)),
                         [("CPU time", "SAC-IA")])

    def test_ablations_are_apart(self):
        text, _ = losses.section(results_of(run(mse=1.0), run(method="k = 500", mse=0.5)))
        peers, own = text.split("### To its own variants")
        self.assertNotIn("k = 500", peers)
        self.assertIn("k = 500", own)


class Report(unittest.TestCase):
    def test_order_of_lines_does_not_matter(self):
        entries = everything()
        shuffled = entries[:]
        random.Random(0).shuffle(shuffled)
        self.assertEqual(report_without_pictures(entries),
                         report_without_pictures(shuffled))

    def test_times_are_apart(self):
        """Other times change nothing in the tables of results."""
        entries = everything()
        slower = [entry | {"cpu_s": 7.0, "wall_s": 5.0, "peak_mb": 9.0}
                  for entry in entries]
        before, after = report_without_pictures(entries), report_without_pictures(slower)
        with_times = {"report.md", "costs.csv", "size.csv", "ablation_costs.csv"}
        self.assertEqual({name for name in before if before[name] != after[name]},
                         with_times)

    def test_links_lead_to_files(self):
        files = report_without_pictures(everything())
        links = re.findall(r"\(tables/([^)]+)\)", files["report.md"])
        self.assertEqual(sorted(set(links)), sorted(set(files) - {"report.md"}))

    def test_sections(self):
        text = report_without_pictures(everything())["report.md"]
        for title in ("What was run", "The paper's tables", "What the paper's tables lack",
                      "Where KSS-ICP loses", "Plots", "Ablations"):
            self.assertIn(f"\n## {title}\n", text)

    def test_no_ablations_no_section(self):
        entries = [entry for entry in everything() if entry["method"] != "k = 500"]
        files = report_without_pictures(entries)
        self.assertNotIn("## Ablations", files["report.md"])
        self.assertNotIn("ablations.csv", files)

    def test_without_kss_icp(self):
        text = report_without_pictures([run(method="SAC-IA")])["report.md"]
        self.assertIn("SAC-IA", text)


if __name__ == "__main__":
    unittest.main()
