#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns the results of pcl_kss_icp_evaluate into tables, plots and pictures.

usage: report.py DIR
Reads DIR/run.json, DIR/runs.jsonl and DIR/worst; writes DIR/report.md and what it shows:
DIR/tables/*.csv, DIR/plots/*.png and DIR/pictures/*.png. The plots and pictures need
Debian's python3-matplotlib; without it only the tables are written."""
import os
import sys
from urllib.parse import quote

sys.dont_write_bytecode = True  # the source tree stays as it is

import ablations
import costs
import errors
import losses
import overview
import paper
import poses
import runs

NO_PLOTS = "not drawn: matplotlib is missing (Debian: python3-matplotlib)"


def main(folder: str):
    results = runs.read(folder)
    paper_tables = paper.read()
    error_text, error_sheets = errors.section(results, paper_tables)
    size_text, size_sheets = costs.by_size(results, paper_tables["size"])
    pose_text, pose_sheets = poses.section(results)
    cost_text, cost_sheets = costs.section(results)
    loss_text, loss_sheets = losses.section(results)
    ablation_text, ablation_sheets = ablations.section(results)
    plot_text, picture_text = draw(results, folder)

    sections = {"The paper's tables": error_text + "\n" + size_text,
                "What the paper's tables lack": pose_text + "\n" + cost_text,
                "Where KSS-ICP loses": loss_text,
                "Plots": plot_text,
                "Ablations": ablation_text,
                "Worst cases": picture_text}
    write_sheets(folder, error_sheets + size_sheets + pose_sheets + cost_sheets
                 + loss_sheets + ablation_sheets)
    write_report(folder, overview.section(results), sections)


def draw(results: runs.Results, folder: str):
    """Draws plots and pictures; returns the Markdown that shows them."""
    try:
        import pictures
        import plots
    except ImportError as error:
        print(f"report.py: no plots and pictures: {error}; Debian's package "
              "python3-matplotlib makes them", file=sys.stderr)
        return f"Plots were {NO_PLOTS}.\n", f"Pictures were {NO_PLOTS}.\n"
    plot_list = plots.draw_all(results, made(folder, "plots"))
    picture_list = pictures.draw_all(os.path.join(folder, "worst"),
                                     made(folder, "pictures"))
    notes = plots.NOTES if plot_list else "Nothing to plot.\n"
    return notes + "\n" + shown("plots", plot_list), shown("pictures", picture_list)


def made(folder: str, name: str) -> str:
    path = os.path.join(folder, name)
    os.makedirs(path, exist_ok=True)
    return path


def shown(folder: str, images: list) -> str:
    return "\n".join(f"![{image.title}]({quote(f'{folder}/{image.name}.png')})\n"
                     for image in images)


def write_sheets(folder: str, sheets: list):
    for sheet in sheets:
        sheet.write(made(folder, "tables"))


def write_report(folder: str, head: str, sections: dict):
    """Sections without text are left out."""
    parts = [head] + [f"## {title}\n\n{text}" for title, text in sections.items()
                      if text.strip()]
    with open(os.path.join(folder, "report.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(parts))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        main(sys.argv[1])
    except runs.InputError as error:
        sys.exit(f"report.py: {error}")
