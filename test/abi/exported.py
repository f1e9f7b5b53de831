#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a library exports what its list here names, and nothing else, and that it
finds all that it needs itself.

    test/abi/exported.py LIBRARY              checks
    test/abi/exported.py LIBRARY --update     writes the list anew

libpcl_kss_icp has exported.txt, libpcl_kss_icp_multiview has exported_multiview.txt.

The members of KSSICP are listed once: each is there for all of its instantiations.
"""
import pathlib
import re
import subprocess
import sys

INSTANTIATION = re.compile(r"pcl::KSSICP<(pcl::\w+), \1, (float|double)>")
# Names that stand for what they abbreviate.
SHORT = [
    (re.compile(r"\[abi:cxx11\]"), ""),
    (re.compile(r"std::__cxx11::basic_string<char, std::char_traits<char>, "
                r"std::allocator<char> >"), "std::string"),
    (re.compile(r"Eigen::Matrix<double, 4, 4, 0, 4, 4>"), "Eigen::Matrix4d"),
    (re.compile(r"Eigen::Matrix<float, 4, 4, 0, 4, 4>"), "Eigen::Matrix4f"),
    (re.compile(r"Eigen::Matrix<double, 3, 1, 0, 3, 1>"), "Eigen::Vector3d"),
    (re.compile(r" >"), ">"),
    (re.compile(r"std::vector<([^<>]*), std::allocator<\1>>"), r"std::vector<\1>"),
]


def exported(library):
    """What the library exports, in short: instantiations of KSSICP, and symbols."""
    names = subprocess.run(
        f"nm --dynamic --defined-only --format=posix '{library}' | cut -d ' ' -f 1 | c++filt",
        shell=True, check=True, capture_output=True, text=True).stdout.splitlines()
    others, members = set(), {}
    for name in names:
        for pattern, short in SHORT:
            name = pattern.sub(short, name)
        instantiation = INSTANTIATION.search(name)
        if not instantiation:
            others.add(name)
            continue
        point, scalar = instantiation.groups()
        name = name.replace(instantiation.group(), "pcl::KSSICP").replace(point, "PointT")
        name = name.replace("Contender, std::allocator<pcl::KSSICP::Contender>", "Contender")
        # matrices of the class' Scalar cannot be told from those that are double always
        name = re.sub(r"Eigen::Matrix4[df]", "Matrix4", name)
        members.setdefault(instantiation.group(), set()).add(name)
    for instantiation, its in members.items():
        for name in set().union(*members.values()) - its:
            others.add(f"all of KSSICP but {instantiation}: {name}")
    return others.union(members, *members.values())


def undefined(library):
    """What the library needs and does not find."""
    lines = subprocess.run(["ldd", "-r", library], capture_output=True, text=True)
    return [line.strip() for line in (lines.stdout + lines.stderr).splitlines()
            if "undefined" in line or "not found" in line]


def main():
    library = sys.argv[1]
    kind = "_multiview" if "_multiview" in pathlib.Path(library).name else ""
    listing = pathlib.Path(__file__).with_name(f"exported{kind}.txt")
    now = exported(library)
    if sys.argv[2:] == ["--update"]:
        listing.write_text("".join(f"{name}\n" for name in sorted(now)))
        return 0
    listed = set(listing.read_text().splitlines())
    changes = ([f"new: {name}" for name in sorted(now - listed)] +
               [f"gone: {name}" for name in sorted(listed - now)])
    problems = changes + undefined(library)
    for problem in problems:
        print(problem)
    if changes:
        print(f"\nThe symbols of {library} are not those that {listing} lists.\n"
              "What need not be exported is marked with PCL_KSS_ICP_EXPORT, or named in\n"
              "exports.map, without need. If the change is meant, it is one of the\n"
              "ABI: a new minor version in CMakeLists.txt, a line in CHANGELOG.md, and\n"
              f"    test/abi/exported.py {library} --update")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
