# SPDX-License-Identifier: BSD-3-Clause
"""Time and memory: the paper's table of times by size, and all conditions."""
import runs
import tables
from paper import PaperTable
from runs import BLOCKS, MIXED, Results

FIELDS = {"cpu_s": "CPU time, s", "wall_s": "wall time, s", "peak_mb": "peak memory, MB"}


def typical(cases: list, field: str):
    """The median of a time or of memory."""
    return (runs.median if field == "peak_mb" else runs.time_median)(cases, field)


def by_size(results: Results, paper: PaperTable):
    """The paper's Table VI: the Markdown, and its sheets."""
    conditions = results.table("size")
    if not conditions:
        return "", []
    sheet = _sheet(results, "size", conditions)
    parts = [f"### Table {paper.number}: {paper.title}\n",
             "Medians in seconds; “timeout” where at least half of the runs reached the "
             "time limit. A time says nothing about success: see the solved cases below. "
             "The rows in italics are the paper's own times, on its machine.\n"]
    for block in BLOCKS:
        for field in ("wall_s", "cpu_s"):
            quoted = paper if field == "wall_s" and block == MIXED else None
            rows = _rows(results, conditions, block, field, quoted)
            if rows:
                head = ["Method"] + [tables.thousands(c.parameter) for c in conditions]
                parts += [f"{tables.bold(f'{block.capitalize()}: {FIELDS[field]}')}\n",
                          tables.markdown(head, rows)]
    parts += [sheet.link() + "\n", paper.quoted()]
    return "\n".join(parts), [sheet]


def section(results: Results):
    """Time and memory in all conditions: the Markdown, and its sheets."""
    sheet = _sheet(results, "costs", results.conditions)
    parts = ["### Time and memory\n",
             "Medians over all cases, solved or not; “timeout” where at least half of the "
             "runs reached the time limit. So the least is not always worth having: "
             "compare the solved cases above.\n"]
    for block in BLOCKS:
        for field, title in FIELDS.items():
            conditions = [condition for condition in results.conditions
                          if any(results.of(condition, method, block)
                                 for method in results.registering())]
            rows = _rows(results, conditions, block, field)
            if rows:
                head = ["Method"] + [condition.name for condition in conditions]
                parts += [f"{tables.bold(f'{block.capitalize()}: {title}')}\n",
                          tables.markdown(head, rows)]
    parts.append(sheet.link() + "\n")
    return "\n".join(parts), [sheet]


def _rows(results: Results, conditions: list, block: str, field: str,
          paper: PaperTable = None) -> list:
    methods = [method for method in results.registering()
               if results.over(conditions, method, block)]
    columns = [tables.bold_best(
        [typical(results.of(condition, method, block), field)
         for method in methods], tables.measured) for condition in conditions]
    rows = []
    for index, method in enumerate(methods):
        rows.append([method.title] + [column[index] for column in columns])
        if paper and paper.method(method.name):
            rows.append(_quoted_row(paper, method.name, conditions))
    return rows


def _quoted_row(paper: PaperTable, name: str, conditions: list) -> list:
    """The paper's times at our sizes."""
    times = dict(zip(paper.sizes, paper.figures(name, None).values()))
    cells = [times.get(condition.parameter) for condition in conditions]
    return [f"*paper: {paper.method(name)}, {paper.data_set}*"] + [
        f"*{cell}*" if cell else tables.NOTHING for cell in cells]


def _sheet(results: Results, name: str, conditions: list) -> tables.Sheet:
    rows = []
    for block in BLOCKS:
        for condition in conditions:
            for method in results.registering():
                cases = results.of(condition, method, block)
                if cases:
                    rows.append([block, condition.name, condition.parameter, method.name,
                                 len(cases), len(runs.solved(cases)),
                                 len(runs.with_status(cases, "timeout"))]
                                + [tables.measured_raw(typical(cases, field))
                                   for field in FIELDS])
    head = ["block", "condition", "parameter", "method", "n", "solved", "timeout"]
    return tables.Sheet(name, head + [f"{field}_median" for field in FIELDS], rows)
