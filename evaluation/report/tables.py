# SPDX-License-Identifier: BSD-3-Clause
"""Tables as Markdown and as CSV, and how numbers are written in them."""
import csv
import math
import os
from dataclasses import dataclass, field
from urllib.parse import quote

NOTHING = "–"


@dataclass
class Sheet:
    """A CSV file of the report: its name without extension, and raw values."""
    name: str
    head: list
    rows: list = field(default_factory=list)

    def link(self) -> str:
        return f"[All figures as CSV]({quote(f'tables/{self.name}.csv')})"

    def write(self, folder: str):
        with open(os.path.join(folder, self.name + ".csv"), "w", encoding="utf-8",
                  newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self.head)
            writer.writerows(self.rows)


def markdown(head: list, rows: list, texts: int = 1) -> str:
    """A table whose first columns are texts, the others numbers."""
    if not rows:
        return "Not measured.\n"
    rule = ["---"] * texts + ["---:"] * (len(head) - texts)
    return "".join("| " + " | ".join(_cell(cell) for cell in line) + " |\n"
                   for line in [head, rule] + rows)


def _cell(cell) -> str:
    return str(cell).replace("|", "\\|").replace("\n", " ")


def scientific(value) -> str:
    """As in the paper: 1.01E-2."""
    if value is None:
        return NOTHING
    if value == 0 or not math.isfinite(value):
        return f"{value:g}"
    digits, exponent = f"{value:.2E}".split("E")
    return f"{digits}E{int(exponent)}"


def number(value, digits: int = 3) -> str:
    if value is None:
        return NOTHING
    if not math.isfinite(value):
        return f"{value:g}"
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:#.{digits}g}".rstrip(".")


def measured(value) -> str:
    """A time or an amount of memory; infinite where most runs were stopped."""
    return "timeout" if value == math.inf else number(value)


def measured_seconds(value) -> str:
    return "timeout" if value == math.inf else number(value) + " s"


def measured_raw(value):
    """The same for a CSV file, in full."""
    return "timeout" if value == math.inf else value


def thousands(points: float) -> str:
    """A number of points as in the paper: 10k."""
    return f"{points / 1000:,g}k" if points >= 1000 else f"{points:g}"


def percent(part: int, whole: int) -> str:
    return f"{100 * part / whole:.0f} %"


def share(part: int, whole: int) -> str:
    return f"{part}/{whole}" if whole else NOTHING


def bold(text: str) -> str:
    return f"**{text}**"


def bold_best(values: list, text, best=min) -> list:
    """The values as text, the best in bold, and whatever reads the same."""
    finite = [value for value in values if value is not None and math.isfinite(value)]
    if not finite:
        return [text(value) for value in values]
    winner = text(best(finite))
    return [bold(text(value)) if text(value) == winner else text(value)
            for value in values]
