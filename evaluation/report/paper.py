# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the paper's tables, which paper_tables.json holds as printed."""
import json
import os

import tables

_PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "paper_tables.json")


class PaperTable:
    """One of the paper's tables."""

    def __init__(self, entry: dict, counterparts: dict):
        self.label = entry["label"]
        self.number = entry["number"]
        self.title = entry["title"]
        self.data_set = entry["data_set"]
        self.columns = entry["columns"]
        self.notes = entry["notes"]
        self.sizes = entry.get("sizes", [])
        self._parts = entry["parts"]
        self._counterparts = counterparts

    def has(self, parameter: float) -> bool:
        """Whether the paper has figures for a parameter, like a noisy range."""
        return self._part(parameter) is not None

    def method(self, name: str):
        """What the paper calls the counterpart of one of our methods; None without one."""
        return self._counterparts.get(name)

    def figures(self, name: str, parameter: float) -> dict:
        """The paper's figures for the counterpart of one of our methods, by column."""
        part = self._part(parameter)
        if part is None or self.method(name) is None:
            return {}
        return dict(zip(self.columns, part["rows"][self.method(name)]))

    def _part(self, parameter: float):
        return next((part for part in self._parts
                     if part["parameter"] in (None, parameter)), None)

    def quoted(self) -> str:
        """All of the table, as Markdown."""
        several = len(self._parts) > 1
        rows = []
        for part in self._parts:
            for method, figures in part["rows"].items():
                cells = [figure or tables.NOTHING for figure in figures]
                range_cell = [f"{part['parameter']}"] if several else []
                rows.append(range_cell + [method] + cells)
        head = (["Noisy range"] if several else []) + ["Method"] + self.columns
        lines = [f"Quoted from the paper: its Table {self.number} ({self.label}), "
                 f"{self.data_set}. Figures as printed there; its models differ from those "
                 "used here.", "",
                 tables.markdown(head, rows, texts=2 if several else 1)]
        lines += [f"> Note on the paper's table: {note}\n" for note in self.notes]
        return "\n".join(lines)


def read() -> dict:
    """The paper's tables, by the name that the program gives them."""
    with open(_PATH, encoding="utf-8") as file:
        everything = json.load(file)
    return {name: PaperTable(entry, everything["time_counterparts" if name == "size"
                                               else "counterparts"])
            for name, entry in everything["tables"].items()}
