#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the C++ that texts show is code that is compiled: before each block of it
stands the name of a file, <!-- FILE -->, and its lines follow one another in that file,
however far they are indented.

    test/checks/snippets.py [FOLDER]      of the project; otherwise the one this file is in
"""
import re
import textwrap

from report import report

BLOCK = re.compile(r"(?:^<!-- (\S+) -->\n)?^```cpp\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def lines_of(text):
    return [line.rstrip() for line in textwrap.dedent(text).strip("\n").split("\n")]


def is_in(snippet, code):
    """Whether lines are found one after another, all of them indented by as much."""
    return any(lines_of("\n".join(code[start:start + len(snippet)])) == snippet
               for start in range(len(code) - len(snippet) + 1))


def problems_of(root):
    for text in sorted([*root.glob("*.md"), *(root / "docs").rglob("*.md")]):
        for name, snippet in BLOCK.findall(text.read_text()):
            shown = lines_of(snippet)
            where = f"{text.relative_to(root)}: the code that begins with '{shown[0].strip()}'"
            if not name:
                yield f"{where} names no file that it is from"
            elif not (root / name).is_file():
                yield f"{where} is from {name}, which there is not"
            elif not is_in(shown, (root / name).read_text().split("\n")):
                yield f"{where} is not in {name}"


if __name__ == "__main__":
    report(problems_of)
