# SPDX-License-Identifier: BSD-3-Clause
"""Ablations: what each setting of KSS-ICP does to success, error and time."""
import runs
import tables
from costs import FIELDS as COSTS
from costs import typical
from runs import BLOCKS, Results


def section(results: Results):
    """The Markdown, and its sheets; empty without ablations."""
    subjects = _subjects(results)
    parts = []
    for subject, variants in subjects.items():
        parts.append(f"### {subject}\n")
        for block in BLOCKS:
            text = _block(results, variants, block)
            if text:
                parts.append(text)
    if not parts:
        return "", []
    sheets = _sheets(results, subjects)
    introduction = ("Each table varies one setting; its first row is the default. Cells: "
                    "solved cases, and their median rotation error, those solved by "
                    "symmetry aside.\n")
    return "\n".join([introduction] + parts + [sheets[0].link() + "; costs "
                     f"[apart](tables/{sheets[1].name}.csv)\n"]), sheets


def _subjects(results: Results) -> dict:
    """The variants by what they ablate, in the order of run.json."""
    found = {}
    for method in results.methods:
        if method.group == "ablation" and any(
                results.over(results.conditions, method, given) for given in BLOCKS):
            found.setdefault(method.ablates or "other settings", []).append(method)
    return found


def _compared(results: Results, variants: list, block: str):
    """The default and the variants that have runs, and the conditions that these have."""
    variants = [method for method in variants
                if results.over(results.conditions, method, block)]
    conditions = [condition for condition in results.conditions
                  if any(results.of(condition, method, block)
                         for method in variants)]
    reference = [results.reference()] if results.reference() else []
    return reference + variants if variants else [], conditions


def _block(results: Results, variants: list, block: str) -> str:
    methods, conditions = _compared(results, variants, block)
    if not methods:
        return ""
    names = [condition.name for condition in conditions]
    results_rows, cost_rows = [], []
    for method in methods:
        everything = results.over(conditions, method, block)
        by_condition = [results.of(condition, method, block)
                        for condition in conditions]
        results_rows.append([method.title, _success(everything)]
                            + [_cell(cases) for cases in by_condition])
        cost_rows.append([method.title]
                         + [tables.measured(typical(everything, field))
                            for field in COSTS]
                         + [tables.measured(runs.time_median(cases, "cpu_s"))
                            for cases in by_condition])
    return "\n".join([
        f"{tables.bold(block.capitalize())}\n",
        tables.markdown(["Variant", "success, all"] + names, results_rows),
        tables.markdown(["Variant"] + list(COSTS.values())
                        + [f"CPU s, {name}" for name in names], cost_rows)])


def _success(cases: list) -> str:
    if not cases:
        return tables.NOTHING
    good = len(runs.solved(cases))
    return f"{tables.percent(good, len(cases))} ({tables.share(good, len(cases))})"


def _cell(cases: list) -> str:
    if not cases:
        return tables.NOTHING
    good = runs.solved(cases)
    angle = runs.median(runs.placed(cases), "rotation_deg")
    error = "" if angle is None else f", {tables.number(angle, 2)}°"
    return tables.share(len(good), len(cases)) + error


def _sheets(results: Results, subjects: dict) -> list:
    figures, costs = [], []
    for subject, variants in subjects.items():
        for block in BLOCKS:
            methods, conditions = _compared(results, variants, block)
            for method in methods:
                for condition in conditions:
                    cases = results.of(condition, method, block)
                    if cases:
                        key = [subject, block, method.name, condition.name, len(cases)]
                        good = runs.solved(cases)
                        angle = runs.median(runs.placed(cases), "rotation_deg")
                        figures.append(key + [len(good), angle, runs.mean(cases, "mse")])
                        costs.append(key + [tables.measured_raw(typical(cases, field))
                                            for field in COSTS])
    key = ["ablates", "block", "method", "condition", "n"]
    return [tables.Sheet("ablations", key + ["solved", "rotation_deg_median_of_solved",
                                             "mse"], figures),
            tables.Sheet("ablation_costs", key + [f"{field}_median" for field in COSTS],
                         costs)]
