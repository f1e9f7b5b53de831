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
    """The medians of what was measured, by name of the benchmark and its argument: the
    number of points, or the seed of a street or room as "seed:1"."""

    def __init__(self, runs):
        self.runs = {}
        for run in runs:
            if run["run_type"] == "iteration":
                name, size = run["run_name"].split("/")[:2]
                size = int(size) if size.isdigit() else size
                self.runs.setdefault((name, size), []).append(run)

    def sizes(self):
        return sorted({size for _, size in self.runs if isinstance(size, int)})

    def seeds(self):
        return sorted({size for _, size in self.runs if not isinstance(size, int)})

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

    def seconds_and_error(self, name, size):
        seconds = self.seconds(name, size)
        error = self.median(name, size, "error_degrees")
        return (f"{text(seconds)} ({text(error, 2)}°)" if isinstance(error, float)
                else text(seconds))


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
            ("KissMatcher", "KISS-Matcher"),
            ("SacIaIcp", "SAC-IA + ICP"), ("SacIaShortIcp", "SAC-IA + 10 iterations of ICP"),
            ("SacIaOfTutorialIcp", "SAC-IA as in PCL's tutorial + ICP")]


def variants(results):
    """Time and error of everything that registers."""
    rows = []
    for size in results.sizes():
        rows.append([f"{size:,}"] + [results.seconds_and_error(name, size)
                                     for name, _ in VARIANTS])
    return table(["points"] + [title for _, title in VARIANTS], rows)


def scan_title(scene, seed):
    """Street, seed:1: street 1."""
    return f"{scene.lower()} {seed.split(':')[-1]}"


def scans(results):
    """Streets and rooms: KSS-ICP beside KISS-Matcher (kiss_matcher.py)."""
    rows = []
    for scene in ("Street", "Room"):
        for seed in results.seeds():
            names = [f"{scene}{method}" for method in ("Rigid", "KissMatcher")]
            points = results.median(names[0], seed, "source_points")
            rows.append([scan_title(scene, seed)] +
                        [results.seconds_and_error(name, seed) for name in names] +
                        [text(points)])
    return table(["scans", "automatic, scale known", "KISS-Matcher", "points"], rows)


def host(results):
    """OpenCL beside none, at the sizes at which both were measured."""
    rows = []
    for size in results.sizes():
        device, no_device = (results.seconds(name, size)
                             for name in ("Automatic", "AutomaticHost"))
        if no_device is not None:
            rows.append([f"{size:,}", text(device), text(no_device),
                         times(ratio(no_device, device))])
    return table(["points", "automatic", "without OpenCL", "without / automatic"], rows)


def threads(results):
    """Wall time by one and by two threads."""
    rows = []
    for size in results.sizes():
        one, two = (results.median(name, size, "real_time")
                    for name in ("AutomaticOneThread", "AutomaticTwoThreads"))
        rows.append([f"{size:,}", text(one), text(two), times(ratio(one, two))])
    return table(["points", "one thread", "two threads", "one / two"], rows)


def steps(results, name, titles):
    """The counters of one benchmark: how its time is spent."""
    rows = [[f"{size:,}"] + [text(results.median(name, size, field)) for field in titles]
            for size in results.sizes()]
    return table(["points"] + list(titles.values()), rows)


def stages(results):
    """Whatever stages there are, with their names, of the surface and of scans."""
    fields = sorted({field for (name, _), runs in results.runs.items()
                     if name.startswith("Stages")
                     for run in runs for field in run if field.endswith("_s")})
    whats = [("Stages", size, f"{size:,}") for size in results.sizes()]
    whats += [(f"Stages{scene}Rigid", seed, scan_title(scene, seed))
              for scene in ("Street", "Room") for seed in results.seeds()]
    rows = [[title] + [text(results.median(name, size, field)) for field in fields]
            for name, size, title in whats]
    return table(["points or scans"] + [field[:-2] for field in fields], rows)


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
        ("Scans: CPU seconds and rotation error", scans(results)),
        ("Without OpenCL, CPU seconds", host(results)),
        ("Threads, wall seconds", threads(results)),
        ("Stages of automatic, wall seconds", stages(results)),
    ]
    print("\n".join(f"## {title}\n\n{content}" for title, content in sections), end="")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
