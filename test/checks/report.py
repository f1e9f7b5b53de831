# SPDX-License-Identifier: BSD-3-Clause
"""What the checks of texts and of the code have in common: how they are called."""
import pathlib
import sys


def report(problems_of):
    """Print the problems of the project, the one in the folder that the command line names
    or otherwise the one this file is in, and exit with 1 if there are any."""
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else
                        pathlib.Path(__file__).parents[2]).resolve()
    problems = list(problems_of(root))
    for problem in problems:
        print(problem)
    sys.exit(1 if problems else 0)
