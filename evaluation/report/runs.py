# SPDX-License-Identifier: BSD-3-Clause
"""What pcl_kss_icp_evaluate wrote: reading it, grouping it, means and medians."""
import json
import math
import os
import statistics
from dataclasses import dataclass

REFERENCE = "KSS-ICP"
NOTHING_DONE = "none"
STATUSES = ("failed", "timeout", "crashed")
UNKNOWN = "scale unknown"
GIVEN = "true scale given"
MIXED = "scale unknown, but given to †"  # sizes: each method runs only as it is able to
BLOCKS = (UNKNOWN, GIVEN, MIXED)
KEY = ("condition", "model", "repetition", "method", "scale_given")


class InputError(Exception):
    """What is wrong with the input, in one line."""


@dataclass(frozen=True)
class Method:
    name: str
    estimates_scale: bool = True
    group: str = "peer"
    ablates: str = ""

    @property
    def is_own(self) -> bool:
        """Whether it is a variant of KSS-ICP."""
        return self.group in ("kss", "ablation")

    @property
    def title(self) -> str:
        if self.name == NOTHING_DONE:
            return "none (the clouds as they were)"
        return self.name if self.estimates_scale else self.name + " †"


@dataclass(frozen=True)
class Condition:
    name: str
    table: str
    title: str = ""
    parameter: float = 0


class Results:
    """All runs of a program, in an order that does not depend on the file's."""

    def __init__(self, about: dict, runs: list, ignored_line: bool = False):
        self.about = about
        self.ignored_line = ignored_line
        self.methods = self._known_methods(runs)
        self.conditions = self._known_conditions(runs)
        self._runs = self._grouped(runs)

    def _known_methods(self, runs: list) -> list:
        """In the order of run.json, then those that it does not list."""
        methods = [Method(entry["name"], bool(entry.get("estimates_scale", True)),
                          entry.get("group", "peer"), entry.get("ablates") or "")
                   for entry in self.about.get("methods", [])]
        names = {method.name for method in methods}
        others = {run["method"] for run in runs} - names
        return methods + [Method(name) for name in sorted(others)]

    def _known_conditions(self, runs: list) -> list:
        """Those with runs: in the order of run.json, then those that it does not list."""
        conditions = [Condition(entry["name"], entry.get("table", entry["name"]),
                                entry.get("title", ""), entry.get("parameter") or 0)
                      for entry in self.about.get("conditions", [])]
        found = {run["condition"] for run in runs}
        others = found - {condition.name for condition in conditions}
        return ([condition for condition in conditions if condition.name in found]
                + [Condition(name, name) for name in sorted(others)])

    def _grouped(self, runs: list) -> dict:
        """The runs by condition, method and block."""
        methods = {method.name: method for method in self.methods}
        sizes = {condition.name for condition in self.table("size")}
        groups = {}
        for run in sorted(runs, key=lambda run: tuple(run[field] for field in KEY)):
            block = GIVEN if run["scale_given"] else UNKNOWN
            able = run["scale_given"] != methods[run["method"]].estimates_scale
            if run["condition"] in sizes and able:
                block = MIXED
            group = run["condition"], run["method"], block
            groups.setdefault(group, []).append(run)
        return groups

    def of(self, condition: Condition, method: Method, block: str) -> list:
        """The runs of a method in a condition."""
        return self._runs.get((condition.name, method.name, block), [])

    def over(self, conditions: list, method: Method, block: str) -> list:
        """The runs of a method in several conditions."""
        return [run for condition in conditions
                for run in self.of(condition, method, block)]

    def table(self, name: str) -> list:
        """The conditions of a table, by parameter."""
        return sorted((condition for condition in self.conditions
                       if condition.table == name), key=lambda c: (c.parameter, c.name))

    def compared(self) -> list:
        """The methods of the main tables: all but the ablations."""
        return [method for method in self.methods if method.group != "ablation"]

    def registering(self) -> list:
        """Those of them that do something."""
        return [method for method in self.compared() if method.name != NOTHING_DONE]

    def reference(self):
        """The method that the others are compared with; None if it was not run."""
        return next((method for method in self.methods if method.name == REFERENCE), None)

    def number_of_runs(self) -> int:
        return sum(len(runs) for runs in self._runs.values())

    def cases(self, condition: Condition) -> int:
        """How many pairs of clouds there were in a condition."""
        return len({(run["model"], run["repetition"])
                    for (name, _, _), runs in self._runs.items() if name == condition.name
                    for run in runs})


def read(folder: str) -> Results:
    """Reads run.json and runs.jsonl."""
    about = _read_about(os.path.join(folder, "run.json"))
    runs, ignored_line = _read_runs(os.path.join(folder, "runs.jsonl"))
    return Results(about, _asked_for(about, runs), ignored_line)


def _asked_for(about: dict, runs: list) -> list:
    """The runs of the last command: a folder may hold those of others, too, with other
    models or methods."""
    models = {entry["name"] for entry in about.get("models", [])}
    models |= set(about.get("size_models", []))
    asked = [("method", {entry["name"] for entry in about.get("methods", [])}),
             ("condition", {entry["name"] for entry in about.get("conditions", [])}),
             ("model", models)]
    chosen = [run for run in runs
              if all(run[field] in names for field, names in asked if names)]
    if not chosen:
        raise InputError("runs.jsonl: no results of what run.json lists")
    return chosen


def _text(path: str) -> str:
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error


def _read_about(path: str) -> dict:
    try:
        about = json.loads(_text(path))
    except ValueError as error:
        raise InputError(f"{path}: not JSON: {error}") from error
    if not isinstance(about, dict):
        raise InputError(f"{path}: not a JSON object")
    return about


def _read_runs(path: str):
    """The runs, and whether the last line was incomplete and therefore ignored."""
    lines = [(number, line) for number, line in enumerate(_text(path).split("\n"), 1)
             if line.strip()]
    by_key, ignored_line = {}, False
    for number, line in lines:
        try:
            run = json.loads(line)
        except ValueError as error:
            if number == lines[-1][0]:
                ignored_line = True
                break
            raise InputError(f"{path}:{number}: not JSON: {error}") from error
        if not isinstance(run, dict) or any(field not in run for field in KEY):
            raise InputError(f"{path}:{number}: one of {', '.join(KEY)} is missing")
        by_key[tuple(run[field] for field in KEY)] = run  # done anew: the last one counts
    if not by_key:
        raise InputError(f"{path}: no results in it")
    return list(by_key.values()), ignored_line


def values(runs: list, field: str) -> list:
    """The values of a field, where there are any that are finite."""
    found = [run.get(field) for run in runs]
    return [float(value) for value in found
            if isinstance(value, (int, float)) and math.isfinite(value)]


def mean(runs: list, field: str):
    """The mean over the runs that have the field; None if none has."""
    found = values(runs, field)
    return math.fsum(found) / len(found) if found else None


def median(runs: list, field: str):
    """The median over the runs that have the field; None if none has."""
    found = values(runs, field)
    return statistics.median(found) if found else None


def time_median(runs: list, field: str):
    """The median of a time, a run that was stopped at the time limit counting as infinite,
    one that crashed not at all; None if nothing was measured."""
    found = []
    for run in runs:
        if run.get("status") == "timeout":
            found.append(math.inf)
        elif run.get("status") != "crashed":
            found += values([run], field)
    return statistics.median(found) if found else None


def solved(runs: list) -> list:
    return [run for run in runs if run.get("solved")]


def placed(runs: list) -> list:
    """Those whose pose is near the true one, not only as good by the model's symmetry."""
    return [run for run in solved(runs) if not run.get("by_symmetry")]


def in_common(some: list, others: list):
    """Both, on the cases that both have."""
    def cases(these):
        return {(run["model"], run["repetition"]) for run in these}

    common = cases(some) & cases(others)
    return tuple([run for run in these if (run["model"], run["repetition"]) in common]
                 for these in (some, others))


def wrong_claims(runs: list) -> list:
    """Those that claim success without it."""
    return [run for run in runs if run.get("claimed") and not run.get("solved")]


def missed(runs: list) -> list:
    """Those that succeeded and do not say so."""
    return [run for run in runs if run.get("solved") and not run.get("claimed")]


def with_status(runs: list, status: str) -> list:
    return [run for run in runs if run.get("status") == status]
