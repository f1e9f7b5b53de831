#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy over src/ with the checks of .clang-tidy; a few minutes on two cores.
# The class for PCL's points, src/pcl/, takes as long again and has nothing of its own.
#   test/checks/tidy.sh BUILD [FILE ...]      BUILD: a build tree that has been built
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:?name a build tree}
shift
files=("$@")
[ $# -gt 0 ] || mapfile -t files < <(find src -name "*.cpp" -not -path "src/pcl/*" | sort)
# clang's own default is older than that of the compiler that the commands are for
printf '%s\0' "${files[@]}" | xargs -0 -n 4 -P 2 \
  clang-tidy-14 -p "$build" --quiet --extra-arg=-std=c++17 2> >(
    grep -vE '^[0-9]+ warnings?( and [0-9]+ errors?)? generated|^Suppressed' >&2)
