# SPDX-License-Identifier: BSD-3-Clause
"""What the paper's tables lack: how often a method succeeds, how close it comes, and
whether it knows."""
import runs
import tables
from runs import BLOCKS, STATUSES, Results

ERRORS = {"rotation_deg": "rotation, °", "translation": "translation",
          "scale": "scale", "tre": "TRE"}

INTRODUCTION = """\
A case is solved where the pose is less than 5 degrees, 5 % of the diagonal and 5 % of the
scale off, or where the model's symmetry makes it as good as such a pose. Errors are medians
over the solved cases, those solved by symmetry aside: of the rotation, of the translation (the target's diagonal is 1), of
the scale (relative), and of the points' places (TRE, root mean square; the diagonal is 1).
“Claimed wrongly”: the method says that it has succeeded, and has not. “Missed”: it has
succeeded and does not say so. The last columns count the cases without an answer.
"""


def section(results: Results):
    """The Markdown, and its sheets."""
    sheet = _sheet(results)
    parts = [INTRODUCTION]
    for block in BLOCKS:
        overview = _overview(results, block)
        if overview:
            parts += [f"### Solved cases, {block}\n", overview]
    parts.append(sheet.link() + "\n")
    for condition in results.conditions:
        title = f" ({condition.title})" if condition.title else ""
        parts.append(f"### {condition.name}{title}\n")
        for block in BLOCKS:
            rows = _rows(results, condition, block)
            if rows:
                parts += [f"{tables.bold(block.capitalize())}\n", rows]
    return "\n".join(parts), [sheet]


def _found(results: Results, condition: runs.Condition, block: str) -> list:
    found = [(method, results.of(condition, method, block))
             for method in results.registering()]
    return [(method, cases) for method, cases in found if cases]


def _rate(cases: list):
    return len(runs.solved(cases)) / len(cases) if cases else None


def _overview(results: Results, block: str) -> str:
    """Methods by conditions, the best of each condition in bold."""
    methods = [method for method in results.registering()
               if results.over(results.conditions, method, block)]
    if not methods:
        return ""
    conditions = [condition for condition in results.conditions
                  if _found(results, condition, block)]
    rows = [[method.title] for method in methods]
    for condition in [None] + conditions:
        chosen = conditions if condition is None else [condition]
        columns = [results.over(chosen, method, block) for method in methods]
        rates = [_rate(cases) for cases in columns]
        best = max(rate for rate in rates if rate is not None)
        for row, cases, rate in zip(rows, columns, rates):
            cell = tables.share(len(runs.solved(cases)), len(cases))
            row.append(tables.bold(cell) if rate == best else cell)
    return tables.markdown(["Method", "all"] + [c.name for c in conditions], rows)


def _rows(results: Results, condition: runs.Condition, block: str) -> str:
    rows = []
    for method, cases in _found(results, condition, block):
        good, near = runs.solved(cases), runs.placed(cases)
        rows.append([method.title, tables.share(len(good), len(cases)),
                     tables.percent(len(good), len(cases))]
                    + [tables.number(runs.median(near, field)) for field in ERRORS]
                    + [len(runs.wrong_claims(cases)), len(runs.missed(cases))]
                    + [len(runs.with_status(cases, status)) for status in STATUSES])
    if not rows:
        return ""
    return tables.markdown(["Method", "solved", "success"] + list(ERRORS.values())
                           + ["claimed wrongly", "missed"] + list(STATUSES), rows)


def _sheet(results: Results) -> tables.Sheet:
    rows = []
    for block in BLOCKS:
        for condition in results.conditions:
            for method, cases in _found(results, condition, block):
                good, near = runs.solved(cases), runs.placed(cases)
                rows.append([block, condition.name, method.name,
                             int(method.estimates_scale), len(cases), len(good)]
                            + [runs.median(near, field) for field in ERRORS]
                            + [len(runs.wrong_claims(cases)), len(runs.missed(cases))]
                            + [len(runs.with_status(cases, status))
                               for status in STATUSES])
    head = ["block", "condition", "method", "estimates_scale", "n", "solved"]
    head += [f"{field}_median_of_solved" for field in ERRORS]
    return tables.Sheet("poses", head + ["claimed_wrongly", "missed", *STATUSES], rows)
