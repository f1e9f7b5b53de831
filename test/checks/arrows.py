#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the rooms of the code include one another one way only, as the table says,
and that OpenCL stays where it is used.

    test/checks/arrows.py [FOLDER]      of the project; otherwise the one this file is in
"""
import pathlib
import re

from report import report

# Each folder, and what its files may include beside their own folder. The headers that
# are installed, <pcl/registration/kss...>, are open to all.
PUBLIC = "include/pcl/registration"
ARROWS = {
    PUBLIC: [],
    "src/support": [],
    "src/geometry": ["src/support"],
    "src/preparation": ["src/geometry", "src/support"],
    "src/candidates": ["src/geometry", "src/support"],
    "src/opencl": ["src/support"],
    "src/evaluators": ["src/candidates", "src/geometry", "src/opencl", "src/support"],
    "src/search": ["src/evaluators", "src/candidates", "src/geometry", "src/support"],
    "src/surfaces": ["src/geometry", "src/support"],
    "src/refinement": ["src/surfaces", "src/preparation", "src/geometry",
                       "src/support"],
    "src/final": ["src/geometry", "src/support"],
    "src/scans": ["src/preparation", "src/geometry", "src/support", "src"],
    # a library of its own, on what is installed, and on what is whole in its header
    "src/multiview": ["src/support"],
    # where all of them meet
    "src": ["src/final", "src/refinement", "src/search", "src/candidates", "src/preparation",
            "src/geometry", "src/support"],
    # the class for PCL's points: what is installed, and nothing else
    "src/pcl": [],
    "tools/io": [],
    "tools/crew": [],
    "tools/picture": ["tools/io"],
    "tools/command_line": ["tools/picture", "tools/io"],
    "tools/batch": ["tools/crew", "tools/command_line", "tools/io"],
    "tools/multiview": ["tools/crew", "tools/command_line", "tools/picture", "tools/io"],
}
# What may reach the CL headers, be it by way of another header.
OPENCL = re.compile(r"src/(opencl/.*|evaluators/(.*_opencl\..*|.*_of_devices\.h|"
                    r"kernel_arguments\.h))")
# Made by the build from kernels/, and who it is for.
GENERATED = {"kernels.h": "src/opencl", "pcl/registration/kss/export.h": PUBLIC}
# Where includes are looked for, after the folder of the file itself.
INCLUDE_PATH = ["include", "src", "tools"]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]', re.MULTILINE)


def room_of(file):
    """The innermost folder of the table that a file is in."""
    folder = file.parent
    while folder.as_posix() not in ARROWS:
        if folder == folder.parent:
            return None
        folder = folder.parent
    return folder.as_posix()


def resolved(root, file, quoted, name):
    """The file of the project that an include means; None: it is not the project's."""
    folders = [file.parent] if quoted else []
    for folder in folders + [pathlib.Path(path) for path in INCLUDE_PATH]:
        if (root / folder / name).is_file():
            return folder / name
    return None


def problems_of(root):
    files = sorted(path.relative_to(root) for folder in {key.split("/")[0] for key in ARROWS}
                   for path in (root / folder).rglob("*")
                   if path.suffix in {".h", ".hpp", ".cpp"})
    includes = {}
    for file in files:
        room = room_of(file)
        if room is None or (room == "src" and len(file.parts) > 2):
            yield f"{file}: a room that the table of {pathlib.Path(__file__).name} lacks"
            continue
        includes[file] = []
        for mark, name in INCLUDE.findall((root / file).read_text()):
            other = resolved(root, file, mark == '"', name)
            if name in GENERATED:
                if GENERATED[name] not in (room, PUBLIC):
                    yield f"{file} includes {name}, which is for {GENERATED[name]}"
                continue
            if other is None:
                includes[file].append(name)
                if mark == '"':
                    yield f'{file} includes "{name}", which there is not'
                continue
            includes[file].append(other)
            if room_of(other) not in [room, PUBLIC, *ARROWS[room]]:
                yield (f"{file} includes {other}: {room} may include "
                       f"{', '.join(ARROWS[room]) or 'nothing'} beside the installed headers")

    for file in includes:
        if OPENCL.fullmatch(file.as_posix()):
            continue
        way = way_to_opencl(file, includes)
        # what includes this file has the same way, and is not to blame
        if way and (len(way) == 2 or OPENCL.fullmatch(way[1].as_posix())):
            yield f"{' includes '.join(map(str, way))}: out of OpenCL's room"


def way_to_opencl(file, includes):
    """The shortest chain of includes from a file to a CL header, if there is any."""
    chains, seen = [[file]], {file}
    for chain in chains:
        for other in includes.get(chain[-1], []):
            if str(other).startswith("CL/"):
                return chain + [other]
            if other in includes and other not in seen:
                seen.add(other)
                chains.append(chain + [other])
    return None


if __name__ == "__main__":
    report(problems_of)
