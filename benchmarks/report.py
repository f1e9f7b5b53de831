#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns the results of pcl_kss_icp_benchmark into Markdown tables.

usage: pcl_kss_icp_benchmark --benchmark_format=json > results.json
       report.py results.json... > results.md

Times are CPU seconds of the whole process over all threads, medians of the repetitions.
What did not solve its pair in every repetition has no time: "failed"."""
import json
import statistics
import sys

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
FAILED = "failed"


class Results:
    """The medians of what was measured, by name of the benchmark and number of points."""

    def __init__(self, runs):
        self.runs = {}
        for run in runs:
            if run["run_type"] == "iteration":
                name, size = run["run_name"].split("/")[:2]
                self.runs.setdefault((name, int(size)), []).append(run)

    def sizes(self):
        return sorted({size for _, size in self.runs})

    def median(self, name, size, field):
        """A median; None where nothing was measured, or FAILED."""
        runs = self.runs.get((name, size))
        if not runs:
            return None
        if any(run.get("error_occurred") for run in runs):
            return FAILED
        values = [run[field] for run in runs if field in run]
        if not values:
            return None
        unit = SECONDS[runs[0]["time_unit"]] if field in ("cpu_time", "real_time") else 1.0
        return unit * statistics.median(values)

    def seconds(self, name, size):
        return self.median(name, size, "cpu_time")


def ratio(a, b):
    """a / b, where both are numbers."""
    return a / b if isinstance(a, float) and isinstance(b, float) else None


def text(value, digits=3):
    if value is None or isinstance(value, str):
        return value or ""
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.{digits}g}"


def times(value):
    return "" if value is None else text(value) + "x"


def table(head, rows):
    rows = [row for row in rows if any(row[1:])]
    if not rows:
        return "Not measured.\n"
    lines = [head, ["---"] + ["---:"] * (len(head) - 1)] + rows
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def registrations(results):
    """Both modes of KSS-ICP beside SAC-IA + ICP."""
    rows = []
    for size in results.sizes():
        automatic = results.seconds("Automatic", size)
        complete = results.seconds("GlobalGlobal", size)
        sac_ia = results.seconds("SacIaIcp", size)
        grid = results.seconds("VoxelGridAndKdTree", size)
        rows.append([
            f"{size:,}", text(automatic), text(complete), text(sac_ia),
            times(ratio(sac_ia, automatic)), times(ratio(sac_ia, complete)),
            text(grid), times(ratio(automatic, grid)),
            text(results.median("MemoryAutomatic", size, "peak_MB"))])
    return table(
        ["points", "automatic", "GlobalGlobal", "SAC-IA + ICP", "SAC-IA / automatic",
         "SAC-IA / GlobalGlobal", "VoxelGrid + KdTree", "automatic / VoxelGrid + KdTree",
         "peak memory, MB"], rows)


VARIANTS = [("Automatic", "automatic"), ("AutomaticRigid", "automatic, scale known"),
            ("GlobalGlobal", "GlobalGlobal"),
            ("GlobalGlobalRigid", "GlobalGlobal, scale known"),
            ("SacIaIcp", "SAC-IA + ICP"), ("SacIaShortIcp", "SAC-IA + 10 iterations of ICP"),
            ("SacIaOfTutorialIcp", "SAC-IA as in PCL's tutorial + ICP")]


def variants(results):
    """Time and error of everything that registers."""
    rows = []
    for size in results.sizes():
        cells = []
        for name, _ in VARIANTS:
            seconds = results.seconds(name, size)
            error = results.median(name, size, "error_degrees")
            cells.append(f"{text(seconds)} ({text(error, 2)}°)"
                         if isinstance(error, float) else text(seconds))
        rows.append([f"{size:,}"] + cells)
    return table(["points"] + [title for _, title in VARIANTS], rows)


def steps(results, name, titles):
    """The counters of one benchmark: how its time is spent."""
    rows = [[f"{size:,}"] + [text(results.median(name, size, field)) for field in titles]
            for size in results.sizes()]
    return table(["points"] + list(titles.values()), rows)


def stages(results):
    """Whatever stages there are, with their names."""
    fields = sorted({field for (name, _), runs in results.runs.items() if name == "Stages"
                     for run in runs for field in run if field.endswith("_s")})
    return steps(results, "Stages", {field: field[:-2] for field in fields})


def targets(results):
    """What was asked for: (what, value, limit, whether it is to be at least the limit)."""
    million = 1000000

    def speed_up(name, size):
        return ratio(results.seconds("SacIaIcp", size), results.seconds(name, size))

    yield "SAC-IA + ICP / automatic, 10,000 points", speed_up("Automatic", 10000), 6, True
    yield "SAC-IA + ICP / GlobalGlobal, 10,000 points", speed_up("GlobalGlobal", 10000), \
        15, True
    yield "SAC-IA + ICP / automatic, 1,000,000 points", speed_up("Automatic", million), \
        60, True
    yield "automatic / (VoxelGrid + KdTree), 1,000,000 points", ratio(
        results.seconds("Automatic", million),
        results.seconds("VoxelGridAndKdTree", million)), 2, False
    yield "peak memory of automatic, 1,000,000 points, MB", results.median(
        "MemoryAutomatic", million, "peak_MB"), 400, False
    for size in (10000, 100000, million):
        yield f"second source / fresh object, {size:,} points", ratio(
            results.seconds("SecondSource", size),
            results.seconds("SecondSourceFreshObject", size)), 0.6, False
    yield "first call, nothing compiled, 10,000 points, wall s", results.median(
        "FirstCallColdCache", 10000, "wall_s"), 3, False


def asked(results):
    rows = []
    for what, value, limit, at_least in targets(results):
        met = ""
        if isinstance(value, float):
            met = "yes" if (value >= limit if at_least else value <= limit) else "no"
        sign = "≥" if at_least else "≤"
        rows.append([what, text(value) or "not measured", f"{sign} {limit:g}", met])
    return table(["what", "value", "asked", "met"], rows)


def main(paths):
    runs = []
    for path in paths:
        with open(path, encoding="utf-8") as file:
            runs += json.load(file)["benchmarks"]
    results = Results(runs)
    sections = [
        ("Registration, CPU seconds", registrations(results)),
        ("What was asked for", asked(results)),
        ("All settings: CPU seconds and rotation error", variants(results)),
        ("Steps of SAC-IA + ICP, CPU seconds", steps(results, "SacIaIcp", {
            "voxel_grid_s": "VoxelGrid", "normals_s": "normals", "features_s": "FPFH",
            "sac_ia_s": "SAC-IA", "icp_s": "ICP", "icp_iterations": "ICP iterations"})),
        ("VoxelGrid + KdTree, CPU seconds", steps(results, "VoxelGridAndKdTree", {
            "voxel_grid_s": "VoxelGrid, both clouds", "kd_tree_s": "KdTreeFLANN, target"})),
        ("Stages of automatic, wall seconds", stages(results)),
    ]
    print("\n".join(f"## {title}\n\n{content}" for title, content in sections), end="")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
