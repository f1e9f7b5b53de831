# SPDX-License-Identifier: BSD-3-Clause
"""The plots of the report (needs Debian's python3-matplotlib)."""
import math
import os
from dataclasses import dataclass
from typing import Callable

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import (FixedFormatter, FixedLocator, FuncFormatter, LogLocator,
                               NullLocator)

import runs
import tables
from plot_style import (DPI, GREY, NEUTRAL, in_background, in_one_panel, in_own_panel,
                        style_of, tidy)
from runs import BLOCKS, REFERENCE, UNKNOWN, Condition, Results

NOTES = """\
Noise 0 is the condition with a random similarity alone; the steps of the noise are drawn
at equal distances. No time is drawn where at least half of the runs reached the time limit.
† The method cannot estimate scale.
"""
COLUMNS = 4


@dataclass(frozen=True)
class Plot:
    """A picture of the report."""
    name: str
    title: str


@dataclass(frozen=True)
class Chart:
    """A value of each method against the parameter of conditions."""
    plot: Plot
    conditions: list
    value: Callable
    x_label: str
    y_label: str
    by_size: bool = False

    def lines(self, results: Results, methods: list, block: str) -> dict:
        """Points by name of the method, KSS-ICP last, upon the others."""
        found = {}
        for method in sorted(methods, key=lambda method: method.name == REFERENCE):
            values = [self.value(results.of(condition, method, block))
                      for condition in self.conditions]
            points = [(x, y) for x, y in zip(self.places(), values)
                      if y is not None and math.isfinite(y)]
            if points:
                found[method.name] = points
        return found

    def places(self) -> list:
        """Where the conditions are on the x axis: sizes to scale, noises side by side."""
        if self.by_size:
            return [condition.parameter for condition in self.conditions]
        return list(range(len(self.conditions)))

    def x_ticks(self, panel):
        texts = [tables.thousands(condition.parameter) if self.by_size
                 else f"{_noise(condition):g}" for condition in self.conditions]
        places = self.places()
        if self.by_size:
            panel.set_xscale("log")
        else:
            panel.set_xlim(-0.2, places[-1] + 0.2)
        panel.xaxis.set_major_locator(FixedLocator(places))
        panel.xaxis.set_major_formatter(FixedFormatter(texts))
        panel.xaxis.set_minor_locator(NullLocator())
        panel.tick_params(labelsize=8.5)


def draw_all(results: Results, folder: str) -> list:
    """Draws what there is to draw; returns the plots."""
    drawn = []
    for table, noise in (("gauss", "Gaussian"), ("uniform", "one-sided uniform")):
        conditions = _noises(results, table)
        label = f"{noise} noise, mean neighbour distances"
        errors = Chart(Plot(f"mse_{table}", f"MSE against {noise} noise"), conditions,
                       lambda cases: runs.mean(cases, "mse"), label, "mean MSE")
        rates = Chart(Plot(f"success_{table}", f"Success rate against {noise} noise"),
                      conditions, _success, label, "solved cases, %")
        drawn += _together(errors, results, results.compared(), folder)
        drawn += _apart(rates, results, folder)
    sizes = results.table("size")
    times = Chart(Plot("cpu_size", "CPU time against the number of points"), sizes,
                  lambda cases: runs.time_median(cases, "cpu_s"), "points",
                  "median CPU time, s", True)
    memory = Chart(Plot("memory_size", "Peak memory against the number of points"), sizes,
                   lambda cases: runs.median(cases, "peak_mb"), "points",
                   "median peak memory, MB", True)
    for chart in (times, memory):
        drawn += _together(chart, results, results.registering(), folder)
    return drawn


def _noises(results: Results, table: str) -> list:
    """The conditions of a table of noise, after the one without noise."""
    conditions = results.table(table)
    return results.table("similarity")[:1] + conditions if conditions else []


def _noise(condition: Condition) -> float:
    return 0 if condition.table == "similarity" else condition.parameter


def _success(cases: list):
    return 100 * len(runs.solved(cases)) / len(cases) if cases else None


def _save(figure, chart: Chart, folder: str) -> list:
    figure.suptitle(chart.plot.title, x=0.01, ha="left", fontsize=13, fontweight="bold")
    figure.tight_layout()
    figure.savefig(os.path.join(folder, chart.plot.name + ".png"), bbox_inches="tight",
                   facecolor="white")
    plt.close(figure)
    return [chart.plot]


def _together(chart: Chart, results: Results, methods: list, folder: str) -> list:
    """All methods in one panel for each knowledge of the scale, with a log y axis."""
    panels = {}
    for block in BLOCKS:
        lines = {name: [(x, y) for x, y in points if y > 0]
                 for name, points in chart.lines(results, methods, block).items()}
        lines = {name: points for name, points in lines.items() if points}
        if lines:
            panels[block] = lines
    if not panels:
        return []
    figure, axes = plt.subplots(1, len(panels), sharey=True, squeeze=False, dpi=DPI,
                                figsize=(11.0 if len(panels) > 1 else 7.0, 4.6))
    for panel, (block, lines) in zip(axes[0], panels.items()):
        for name, points in lines.items():
            panel.plot(*zip(*points), label=name,
                       **in_one_panel(name, style_of(name, results)))
        panel.set_yscale("log")
        if chart.by_size:
            panel.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            panel.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:,g}"))
        chart.x_ticks(panel)
        panel.set_xlabel(chart.x_label)
        panel.set_title(block, fontsize=10, color=GREY)
        tidy(panel)
    axes[0][0].set_ylabel(chart.y_label)
    _legend(axes[0], results)
    return _save(figure, chart, folder)


def _legend(axes, results: Results):
    """One for all panels, KSS-ICP first, then in the order of run.json."""
    handles = {}
    for panel in axes:
        for handle, label in zip(*panel.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    shown = [method for method in results.methods if method.name in handles]
    shown.sort(key=lambda method: method.name != REFERENCE)
    legend = axes[-1].legend(
        [handles[method.name] for method in shown], [method.title for method in shown],
        loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False, fontsize=9,
        handlelength=2.6, labelspacing=0.65)
    for method, text in zip(shown, legend.get_texts()):
        if method.name == REFERENCE:
            text.set_fontweight("bold")


def _apart(chart: Chart, results: Results, folder: str) -> list:
    """A panel for each method: many have the same rates and would hide each other."""
    lines = {block: chart.lines(results, results.registering(), block) for block in BLOCKS}
    methods = [method for method in results.registering()
               if any(method.name in found for found in lines.values())]
    methods.sort(key=lambda method: method.name != REFERENCE)
    if not methods:
        return []
    columns = min(COLUMNS, len(methods))
    rows = math.ceil(len(methods) / columns)
    figure, axes = plt.subplots(rows, columns, squeeze=False, sharey=True, dpi=DPI,
                                figsize=(0.6 + 2.6 * columns, 0.9 + 1.95 * rows))
    for panel in axes.flat[len(methods):]:
        panel.axis("off")
    for index, (panel, method) in enumerate(zip(axes.flat, methods)):
        style = style_of(method.name, results)
        if method.name != REFERENCE and REFERENCE in lines[UNKNOWN]:
            panel.plot(*zip(*lines[UNKNOWN][REFERENCE]), **in_background())
        for block in BLOCKS:
            if method.name in lines[block]:
                panel.plot(*zip(*lines[block][method.name]), **in_own_panel(style, block))
        panel.set_title(method.title, fontsize=10, color=style.colour, fontweight="bold")
        chart.x_ticks(panel)
        panel.set_ylim(-4, 104)
        panel.set_yticks([0, 25, 50, 75, 100])
        if index + columns >= len(methods):
            panel.set_xlabel(chart.x_label.split(",")[0], fontsize=9)
        if index % columns == 0:
            panel.set_ylabel(chart.y_label, fontsize=9)
        tidy(panel)
    figure.legend(handles=_key(lines), loc="upper center", bbox_to_anchor=(0.5, 0.01),
                  ncol=3, frameon=False, fontsize=9, handlelength=2.6)
    return _save(figure, chart, folder)


def _key(lines: dict) -> list:
    """What the lines in such panels mean."""
    key = [Line2D([], [], label=block, **in_own_panel(NEUTRAL, block))
           for block in BLOCKS if lines[block]]
    if REFERENCE in lines[UNKNOWN]:
        key.append(Line2D([], [], label=f"{REFERENCE}, {UNKNOWN}, for comparison",
                          **in_background()))
    return key
