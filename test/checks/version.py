#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the version that CMakeLists.txt gives the project is the one of CITATION.cff
and of the newest section of CHANGELOG.md, and that no code has one of its own.

    test/checks/version.py [FOLDER]      of the project; otherwise the one this file is in
"""
import re

from report import report

CODE = ["benchmarks", "cmake", "evaluation", "examples", "include", "python", "src", "tools"]


def found(pattern, path):
    """What a pattern captures in a file, the first time."""
    match = re.search(pattern, path.read_text(), re.MULTILINE)
    return match.group(1) if match else "none"


def problems_of(root):
    version = found(r"^project\(pcl_kss_icp VERSION ([\d.]+)", root / "CMakeLists.txt")
    if not re.fullmatch(r"\d+\.\d+\.\d+", version):
        yield f"CMakeLists.txt: {version} is no MAJOR.MINOR.PATCH"
    others = {"CITATION.cff": found(r"^version: *(\S+)$", root / "CITATION.cff"),
              "CHANGELOG.md": found(r"^## (?:Unreleased: )?(\d\S*)", root / "CHANGELOG.md")}
    for name, other in others.items():
        if other != version:
            yield f"{name} has the version {other}, CMakeLists.txt {version}"
    number = re.compile(rf"(?<![\d.]){re.escape(version)}(?![\d.])")
    for folder in CODE:
        for file in sorted((root / folder).rglob("*")):
            if file.suffix in {".cpp", ".h", ".hpp", ".txt", ".cmake", ".in", ".py", ".sh"}:
                if number.search(file.read_text()):
                    yield (f"{file.relative_to(root)} has the version {version} in it: "
                           "CMake's PROJECT_VERSION is the one place for it")


if __name__ == "__main__":
    report(problems_of)
