#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a Markdown file as Doxygen gets it: links to files that are no pages, such as the
code, become their words, since the documentation has no copy of them; links to a page's
part become links to the page; and words of links and pictures stand in one line, since
Doxygen takes the rest of the page for them otherwise.

usage: doxygen_filter.py FILE.md"""
import re
import sys

LINK = re.compile(r"(?<!!)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")
PICTURE = re.compile(r"!\[[^\]]*\]")
CODE_BLOCK = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)


def in_one_line(text):
    return " ".join(text.split())


def text_for_doxygen(text):
    return LINK.sub(shown, PICTURE.sub(lambda words: in_one_line(words.group()), text))


def shown(link):
    words, target = link.groups()
    page = target.partition("#")[0]
    if re.match(r"[a-z]+:", target):
        return link.group()
    return f"[{in_one_line(words)}]({page})" if page.endswith(".md") else words


if len(sys.argv) != 2:
    sys.exit(__doc__)
with open(sys.argv[1], encoding="utf-8") as text:
    for part in CODE_BLOCK.split(text.read()):
        sys.stdout.write(part if part.startswith("```") else text_for_doxygen(part))
