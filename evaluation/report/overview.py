# SPDX-License-Identifier: BSD-3-Clause
"""The head of the report: what was run, on which models, and what was left out."""
import json

import tables
from runs import Results


def _text(value) -> str:
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def section(results: Results) -> str:
    about = results.about
    facts = [["command", f"`{about['command']}`"]] if about.get("command") else []
    facts += [["version", about["version"]]] if about.get("version") else []
    facts += [["seed", _text(about["seed"])]] if "seed" in about else []
    facts += [[name, _text(value)] for name, value in about.get("settings", {}).items()
              if name != "seed"]
    facts += [[f"machine: {name}", _text(value)]
              for name, value in about.get("machine", {}).items()]
    facts.append(["results", f"{results.number_of_runs():,}"])
    parts = ["# KSS-ICP: the paper's experiments\n", "## What was run\n",
             tables.markdown(["what", "value"], facts, texts=2)]
    if results.ignored_line:
        parts.append("The last line of runs.jsonl was incomplete and is left out.\n")
    parts += ["### Models\n", _models(about), _skipped(about)]
    return "\n".join(parts)


def _models(about: dict) -> str:
    entries, of_sizes = about.get("models", []), about.get("size_models", [])
    lines = [f"{len(entries)} models, of {about.get('readable_models', len(entries))} that "
             "can be read.\n"]
    if of_sizes:
        lines.append(f"Table VI is measured with: {', '.join(of_sizes)}.\n")
    columns = [name for name in ("name", "file", "kind")
               if any(name in entry for entry in entries)]
    rows = [[entry.get(name, "") for name in columns] for entry in entries]
    return "\n".join(lines + [tables.markdown(columns, rows, len(columns))])


def _skipped(about: dict) -> str:
    rows = [[entry.get("file", ""), entry.get("reason", "")]
            for entry in about.get("skipped", [])]
    if not rows:
        return "No file was skipped.\n"
    return "Skipped files:\n\n" + tables.markdown(["file", "reason"], rows, 2)
