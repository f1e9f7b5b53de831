#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that whatever the documentation links to is there, and so is every file of the
project that a text or a comment names, such as src/alignment.cpp or kernels/*.cl.

    test/checks/links.py [FOLDER]      of the project; otherwise the one this file is in
"""
import re

from report import report

FOLDERS = ["benchmarks", "cmake", "docs", "evaluation", "examples", "include", "kernels",
           "python", "src", "test", "tools"]
TEXTS = {".md", ".cff", ".txt", ".h", ".hpp", ".cpp", ".cl", ".cmake", ".py", ".json"}

LINK = re.compile(r"!?\[[^\]]*\]\(\s*([^()\s]+)\s*\)")
CODE_BLOCK = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+ +(.*?)\s*$", re.MULTILINE)
# not a part of a longer path, such as build/tools/pcl_kss_icp or <pcl/test/x.h>
MENTION = re.compile(r"(?<![\w./${}<-])(?:%s)/[\w./*{},-]*[\w*}]" % "|".join(FOLDERS))


def anchors_of(markdown):
    """The anchors of a text's headings, as GitHub makes them."""
    headings = HEADING.findall(CODE_BLOCK.sub("", markdown))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(file):
    text = file.read_text()
    for link in LINK.findall(CODE_BLOCK.sub("", text)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = file.parent / path if path else file
        if not target.exists():
            yield link
        elif anchor and target.suffix == ".md" and anchor not in anchors_of(target.read_text()):
            yield link


def alternatives(mention):
    """a/{b,c}.h as a/b.h and a/c.h"""
    braces = re.search(r"\{([^{}]*)\}", mention)
    if not braces:
        return [mention]
    return [path for choice in braces.group(1).split(",")
            for path in alternatives(mention[:braces.start()] + choice + mention[braces.end():])]


def broken_mentions(root, file):
    for mention in sorted(set(MENTION.findall(file.read_text()))):
        for path in alternatives(mention):
            # as seen from the project, from the folder of the text, or a target's
            if not any(any(folder.glob(path)) for folder in (root, file.parent)):
                yield mention


def problems_of(root):
    files = [file for file in root.iterdir() if file.is_file()]
    for folder in FOLDERS:
        files += (file for file in (root / folder).rglob("*") if file.is_file())
    for file in sorted(files):
        name = file.relative_to(root)
        if file.suffix == ".md":
            for link in broken_links(file):
                yield f"{name} links to {link}, which there is not"
        if file.suffix in TEXTS:
            for mention in broken_mentions(root, file):
                yield f"{name} names {mention}, which there is not"


if __name__ == "__main__":
    report(problems_of)
