#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compiles a program that uses all of KSSICP, without running it, against the headers of
# several versions of PCL, by g++ and clang++.
#   test/package/compile_against.sh BUILD DIR...
#     BUILD   a build tree, for the header that it has generated
#     DIR     a folder that has a folder pcl/, such as /usr/include/pcl-1.13, or that of a
#             package that is not installed:
#               apt-get download libpcl-dev && dpkg-deb -x libpcl-dev_*.deb root
#             with root/usr/include/pcl-1.15. Eigen is taken from beside it, if it is there
# Each is tried as it is and with getFitnessScore(double, bool), which PCL has after 1.15.
# CXX: compilers instead of "g++ clang++". CXX_FLAGS: more flags.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=${1:?name a build tree}
shift
[ $# -gt 0 ] || { echo "name folders with headers of PCL" >&2; exit 2; }
read -ra compilers <<< "${CXX:-g++ clang++}"
read -ra more <<< "${CXX_FLAGS:-}"

after_1_15=$(mktemp -d)
trap 'rm -rf "$after_1_15"' EXIT

# with_use_indices DIR: a copy of what declares and defines getFitnessScore(), changed
with_use_indices() {
  mkdir -p "$after_1_15/pcl/registration/impl"
  local file
  for file in registration.h impl/registration.hpp; do
    sed -E -e 's/(getFitnessScore ?\(double max_range = .*)\);/\1, bool = false);/' \
      -e 's/(getFitnessScore ?\(double max_range)\)$/\1, bool)/' \
      "$1/pcl/registration/$file" > "$after_1_15/pcl/registration/$file"
    grep -q 'max_range.*, bool' "$after_1_15/pcl/registration/$file" || {
      echo "$1: no getFitnessScore(double) to change" >&2; exit 2; }
  done
}

# compiles COMPILER INCLUDES...: says so
compiles() {
  local compiler=$1 output
  shift
  local flags=(-std=c++17 -fsyntax-only -Wall -Wextra -Werror
    "-I$here/../../include" "-I$build/generated/include"
    -DPCL_KSS_ICP_COMPILED_ALIGNMENT=16)
  if output=$("$compiler" "${flags[@]}" "$@" "${more[@]}" "$here/compile_against.cpp" 2>&1)
  then
    echo compiles
  else
    echo FAILS
    echo "$output" | grep -E -m 5 'error' >&2
    result=1
  fi
}

result=0
for dir in "$@"; do
  eigen=$dir/../eigen3
  [ -d "$eigen" ] || eigen=/usr/include/eigen3
  system=(-isystem "$dir" -isystem "$eigen")
  with_use_indices "$dir"
  for compiler in "${compilers[@]}"; do
    printf '%s, %s: ' "$dir" "$compiler"
    compiles "$compiler" "${system[@]}"
    printf '%s, %s, getFitnessScore(double, bool): ' "$dir" "$compiler"
    compiles "$compiler" -isystem "$after_1_15" "${system[@]}"
  done
done
exit $result
