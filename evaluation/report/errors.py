# SPDX-License-Identifier: BSD-3-Clause
"""The paper's tables of errors: mean errors of all methods, and the paper's figures."""
from typing import Optional

import runs
import tables
from paper import PaperTable
from runs import BLOCKS, UNKNOWN, Results

FIELDS = {"MSE": "mse", "RMSE": "rmse", "MAE": "mae",
          "MSE(R)": "mse_r", "RMSE(R)": "rmse_r", "MAE(R)": "mae_r"}
QUOTED = ("MSE", "RMSE", "MAE")
INTRODUCTION = """\
As in the paper: means over all cases of each case's MSE, RMSE and MAE of the distances from
the aligned source points to the nearest target points (the target's diagonal is 1), and
(R) of the angles between the normals there (radians). A method without an answer counts
with the clouds as they were. † The method cannot estimate scale: where that is unknown,
it can be right only if the true scale happens to be near 1. In bold: the best of a column.
In italics: figures quoted from the paper, for its counterpart of a method and on its own
data set, so not for the same models.
"""


def section(results: Results, paper_tables: dict):
    """The Markdown of all tables, and their sheets."""
    parts = [INTRODUCTION]
    names = [name for name in paper_tables if name != "size"]
    names += sorted({condition.table for condition in results.conditions}
                    - set(paper_tables))
    sheets = []
    for name in names:
        if results.table(name):
            sheet = _sheet(results, name)
            parts.append(_table(results, name, paper_tables.get(name), sheet))
            sheets.append(sheet)
    return "\n".join(parts), sheets


def _table(results: Results, name: str, paper: Optional[PaperTable],
           sheet: tables.Sheet) -> str:
    """One table: a block for each knowledge of the scale, then the paper's own."""
    conditions = results.table(name)
    columns = paper.columns if paper else list(FIELDS)
    parts = [_heading(conditions[0], paper), _cases(results, conditions)]
    for block in BLOCKS:
        rows = _block(results, conditions, block, columns, paper)
        if rows:
            parts += [f"{tables.bold(block.capitalize())}\n", rows]
    parts.append(sheet.link() + "\n")
    if paper:
        parts.append(paper.quoted())
    return "\n".join(parts)


def _heading(condition: runs.Condition, paper: Optional[PaperTable]) -> str:
    if paper:
        return f"### Table {paper.number}: {paper.title}\n"
    return f"### {condition.title or condition.table} (beyond the paper)\n"


def _cases(results: Results, conditions: list) -> str:
    counts = [results.cases(condition) for condition in conditions]
    text = f"{min(counts)}" + (f" to {max(counts)}" if max(counts) > min(counts) else "")
    return f"Means over n = {text} pairs of clouds, unless the table says otherwise.\n"


def _block(results: Results, conditions: list, block: str, columns: list,
           paper: Optional[PaperTable]) -> str:
    """The rows of all conditions, as in the paper one below the other."""
    several = len(conditions) > 1
    quote = paper is not None and block == UNKNOWN
    show_counts = _counts_differ(results, conditions, block)
    rows = []
    for condition in conditions:
        group = _rows(results, condition, block, columns, show_counts,
                      paper if quote else None)
        if several:
            group = [[_range(condition, paper)] + row for row in group]
        rows += group
    if not rows:
        return ""
    head = (["Noisy range" if paper else "Parameter"] if several else []) + ["Method"]
    head += columns + (["n"] if show_counts else [])
    if quote:
        head += [f"paper {column}, {paper.data_set}" for column in QUOTED]
    return tables.markdown(head, rows, texts=2 if several else 1)


def _range(condition: runs.Condition, paper: Optional[PaperTable]) -> str:
    beyond = paper is not None and not paper.has(condition.parameter)
    return f"{condition.parameter:g}" + (" (beyond the paper)" if beyond else "")


def _rows(results: Results, condition: runs.Condition, block: str, columns: list,
          show_counts: bool, paper: Optional[PaperTable]) -> list:
    found = [(method, results.of(condition, method, block))
             for method in results.compared()]
    found = [(method, cases) for method, cases in found if cases]
    cells = [tables.bold_best([runs.mean(cases, FIELDS[column]) for _, cases in found],
                              tables.scientific) for column in columns]
    rows = []
    for index, (method, cases) in enumerate(found):
        row = [method.title] + [column[index] for column in cells]
        if show_counts:
            row.append(_count(cases))
        if paper:
            figures = paper.figures(method.name, condition.parameter)
            row += [f"*{figures[column]}*" if figures else "" for column in QUOTED]
        rows.append(row)
    return rows


def _count(cases: list) -> int:
    return len(runs.values(cases, "mse"))


def _counts_differ(results: Results, conditions: list, block: str) -> bool:
    """Whether some method lacks a case that another one has."""
    for condition in conditions:
        for method in results.compared():
            cases = results.of(condition, method, block)
            if cases and _count(cases) != results.cases(condition):
                return True
    return False


def _sheet(results: Results, name: str) -> tables.Sheet:
    rows = []
    for block in BLOCKS:
        for condition in results.table(name):
            for method in results.compared():
                cases = results.of(condition, method, block)
                if cases:
                    rows.append([block, condition.name, condition.parameter, method.name,
                                 int(method.estimates_scale), _count(cases)]
                                + [runs.mean(cases, field) for field in FIELDS.values()])
    head = ["block", "condition", "parameter", "method", "estimates_scale", "n"]
    return tables.Sheet(name, head + list(FIELDS.values()), rows)
