# SPDX-License-Identifier: BSD-3-Clause
"""Where KSS-ICP loses: every condition in which another method does better."""
from dataclasses import dataclass

import runs
import tables
from runs import BLOCKS, NOTHING_DONE, REFERENCE, UNKNOWN, Condition, Method, Results

ERRORS = {"MSE": "mse", "RMSE": "rmse", "MAE": "mae"}
MARGIN = 0.05


@dataclass(frozen=True)
class Loss:
    """A method that beats KSS-ICP in one figure."""
    block: str
    condition: Condition
    metric: str
    method: Method
    ours: float
    theirs: float
    our_cases: list
    their_cases: list

    @property
    def key(self):
        return self.block, self.condition.name, self.metric


def find(results: Results) -> list:
    """All losses in errors and success rates, then those in CPU time."""
    return _search(results, _result_losses) + _search(results, _time_losses)


def _search(results: Results, kind) -> list:
    reference = results.reference()
    found = []
    for block in BLOCKS:
        for condition in results.conditions:
            all_ours = results.of(condition, reference, block) if reference else []
            for method in results.methods:
                ours, theirs = runs.in_common(all_ours,
                                              results.of(condition, method, block))
                if ours and theirs and method.name != REFERENCE:
                    found += [Loss(block, condition, metric, method, a, b, ours,
                                   theirs)
                              for metric, a, b in kind(method, block, ours, theirs)]
    return found


def _result_losses(_method: Method, _block: str, ours: list, theirs: list):
    """Metric, our figure and theirs, where theirs is better."""
    for metric, field in ERRORS.items():
        a, b = runs.mean(ours, field), runs.mean(theirs, field)
        if a is not None and b is not None and b < (1 - MARGIN) * a:
            yield metric, a, b
    a, b = len(runs.solved(ours)) / len(ours), len(runs.solved(theirs)) / len(theirs)
    if b > a:
        yield "success", a, b


def _time_losses(method: Method, block: str, ours: list, theirs: list):
    """The same for CPU time. Where the scale is unknown, only methods that estimate it."""
    if method.name == NOTHING_DONE or block == UNKNOWN and not method.estimates_scale:
        return
    a, b = runs.time_median(ours, "cpu_s"), runs.time_median(theirs, "cpu_s")
    if a is not None and b is not None and b < a:
        yield "CPU time", a, b


def section(results: Results):
    """The Markdown, and its sheets."""
    if results.reference() is None:
        return f"{REFERENCE} was not run, so there is nothing to compare.\n", []
    found = find(results)
    results_sheet = _sheet("losses", [loss for loss in found if loss.metric != "CPU time"])
    time_sheet = _sheet("losses_time", [loss for loss in found
                                        if loss.metric == "CPU time"])
    parts = ["Computed from the tables above: wherever a method's mean MSE, RMSE or MAE is "
             f"lower than that of {REFERENCE} by more than {100 * MARGIN:.0f} %, its "
             "success rate is higher, or its median CPU time is lower. Where the scale is "
             "unknown, times are compared with methods that estimate it only. Each pair is "
             "compared on the cases that both have run; in brackets, how many of them are "
             "solved. What is not listed is no loss.\n"]
    parts += _missing(results)
    peers = [loss for loss in found if not loss.method.is_own]
    own = [loss for loss in found if loss.method.is_own]
    parts += ["### To other methods\n", _tables(peers),
              "### To its own variants and ablations\n", _tables(own)]
    parts.append(f"{results_sheet.link()}; times [apart](tables/{time_sheet.name}.csv)\n")
    return "\n".join(parts), [results_sheet, time_sheet]


def _missing(results: Results) -> list:
    """Says where KSS-ICP has no results to be compared."""
    lines = []
    for block in BLOCKS:
        names = [condition.name for condition in results.conditions
                 if not results.of(condition, results.reference(), block)
                 and any(results.of(condition, method, block)
                         for method in results.registering())]
        if names:
            lines.append(f"{REFERENCE} has no results with {block} in: "
                         f"{', '.join(names)}.\n")
    return lines


def _tables(losses: list) -> str:
    if not losses:
        return "None.\n"
    errors = [loss for loss in losses if loss.metric in ERRORS]
    rates = [loss for loss in losses if loss.metric == "success"]
    times = [loss for loss in losses if loss.metric == "CPU time"]
    parts = ["Errors:\n", _table(errors, tables.scientific, _less),
             "Success rates:\n", _table(rates, _percent, _rate),
             "CPU times:\n",
             _table(times, tables.measured_seconds, _time)]
    return "\n".join(parts)


def _table(losses: list, text, better) -> str:
    """A row for each figure that is lost, with all methods that are better in it."""
    if not losses:
        return "None.\n"
    groups = {}
    for loss in losses:
        groups.setdefault(loss.key, []).append(loss)
    rows = []
    for (block, condition, metric), group in groups.items():
        own_figure = text(group[0].ours) + _solved_text(group[0].metric,
                                                        group[0].our_cases)
        group.sort(key=lambda loss: loss.theirs, reverse=metric == "success")
        rows.append([block, condition, metric, own_figure,
                     "; ".join(better(loss) for loss in group)])
    head = ["Block", "Condition", "Figure", REFERENCE, "Better"]
    return tables.markdown(head, rows, texts=5)


def _solved_text(metric: str, cases: list) -> str:
    if metric == "success":
        return ""
    return f" ({tables.share(len(runs.solved(cases)), len(cases))})"


def _percent(value: float) -> str:
    return f"{100 * value:.1f} %"


def _less(loss: Loss) -> str:
    solved = _solved_text(loss.metric, loss.their_cases)
    return (f"{loss.method.title} {tables.scientific(loss.theirs)}{solved}, "
            f"−{100 * (1 - loss.theirs / loss.ours):.0f} %")


def _rate(loss: Loss) -> str:
    return f"{loss.method.title} {_percent(loss.theirs)}"


def _time(loss: Loss) -> str:
    solved = _solved_text("CPU time", loss.their_cases)
    return f"{loss.method.title} {tables.measured_seconds(loss.theirs)}{solved}"


def _sheet(name: str, losses: list) -> tables.Sheet:
    rows = [[*loss.key, loss.method.name, loss.method.group,
             tables.measured_raw(loss.ours), tables.measured_raw(loss.theirs),
             len(loss.our_cases), len(loss.their_cases),
             len(runs.solved(loss.our_cases)), len(runs.solved(loss.their_cases))]
            for loss in losses]
    return tables.Sheet(name, ["block", "condition", "figure", "method", "group", "kss_icp",
                               "method_figure", "kss_icp_n", "method_n", "kss_icp_solved",
                               "method_solved"], rows)
