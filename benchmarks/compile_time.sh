#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# How long a file takes to compile that includes kss_icp.h and nothing else, beside one
# that includes PCL's icp.h: seconds of processor time, medians, which load changes little.
#   benchmarks/compile_time.sh BUILD [TIMES]      BUILD: a build tree; TIMES: 5 unless given
# CXX and LEVELS in the environment: compilers, instead of "g++ clang++", and levels of
# optimization, instead of "-O0 -O2 -O3".
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "${1:?name a build tree}")
times=${2:-5}
read -ra compilers <<< "${CXX:-g++ clang++}"
read -ra levels <<< "${LEVELS:--O0 -O2 -O3}"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo '#include <pcl/registration/icp.h>' > "$scratch/icp.cpp"
echo '#include <pcl/registration/kss_icp.h>' > "$scratch/kss_icp.cpp"
alignment=$(grep -o 'COMPILED_ALIGNMENT=[0-9]*' "$build/pcl_kss_icp.pc")
read -ra pcl <<< "$(pkg-config --cflags pcl_registration)"
flags=(-std=c++17 "-I$here/../include" "-I$build/generated/include"
  "-DPCL_KSS_ICP_$alignment" "${pcl[@]/#-I/-isystem}")

# seconds COMPILER LEVEL FILE: one compilation
seconds() {
  (TIMEFORMAT=%U && time "$1" "${flags[@]}" "$2" -c "$scratch/$3.cpp" \
    -o "$scratch/$3.o" > /dev/null) 2>&1 | tail -n 1
}

printf '%-10s %-5s %8s %9s %6s\n' compiler level icp.h kss_icp.h ratio
for compiler in "${compilers[@]}"; do
  for level in "${levels[@]}"; do
    rm -f "$scratch"/*.times
    for ((i = 0; i < times; ++i)); do # in turns
      for file in icp kss_icp; do
        seconds "$compiler" "$level" $file >> "$scratch/$file.times"
      done
    done
    for file in icp kss_icp; do
      sort -n "$scratch/$file.times" | sed -n "$(((times + 1) / 2))p"
    done | paste -s | awk -v compiler="$compiler" -v level="$level" \
      '{ printf "%-10s %-5s %8.2f %9.2f %6.2f\n", compiler, level, $1, $2, $2 / $1 }'
  done
done
