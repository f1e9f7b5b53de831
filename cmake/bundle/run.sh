#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What the kernels do on this machine: their tests, poses by the device beside poses by the
# host, and times.
#   ./run.sh [FOLDER]     FOLDER: for all output; default: results
# Exit status: 1 where a test fails or a pose differs.

bundle=$(cd "$(dirname "$0")" && pwd)
. "$bundle/setup.sh"
results=${1:-results}
mkdir -p "$results" && results=$(cd "$results" && pwd) || exit 2
clouds=$(mktemp -d) || exit 2
trap 'rm -rf "$clouds"' EXIT
status=0

echo "== OpenCL devices"
"$bundle/bin/pcl_kss_icp" --list-devices | tee "$results/devices.txt"

# check NAME COMMAND...: a test, whose output goes to NAME.txt
check() {
  log=$results/$1.txt
  shift
  if timeout 300 "$@" > "$log" 2>&1; then
    verdict=passed
  else
    verdict=FAILED
    status=1
  fi
  echo "$(basename "$log" .txt): $verdict, $(grep -c '^\[       OK \]' "$log") tests," \
    "$(grep -c '^\[  SKIPPED \] .* ms)' "$log") skipped"
  grep '^\[  FAILED  \].* ms)' "$log"
}

echo "== Kernel tests"
check test_evaluators "$bundle/bin/test_evaluators"
check test_search "$bundle/bin/test_search"
check test_opencl "$bundle/bin/test_opencl"
# what has to come before anything in a process has called OpenCL
check test_opencl_fork "$bundle/bin/test_opencl" --gtest_filter='ForkBefore.*'
check test_opencl_process "$bundle/bin/test_opencl" --gtest_filter='ProcessBefore.*'
# PoCL, where it is the driver, then has two
check test_several_devices env POCL_DEVICES='pthread basic' \
  "$bundle/bin/test_several_devices"
check test_no_device env OCL_ICD_VENDORS="$bundle/lib/fallback" \
  "$bundle/bin/test_evaluators" --gtest_filter='NoDevice.*'

echo "== Poses"
"$bundle/bin/pcl_kss_icp_benchmark" --write-clouds="$clouds" || exit 2
for pair in surface_5000 surface_10000 surface_100000 surface_1000000 street_1 street_2 \
    room_1 room_2; do
  case $pair in surface*) scale= ;; *) scale=--rigid ;; esac
  for device in auto host; do
    "$bundle/bin/pcl_kss_icp" "$clouds/${pair}_source.pcd" "$clouds/${pair}_target.pcd" \
      $scale --device $device --transform "$results/${pair}_$device.txt" \
      --report "$results/${pair}_$device.json" > "$results/${pair}_$device.log" 2>&1
    echo "$pair: exit status $?, $(grep '^Time:' "$results/${pair}_$device.log")"
  done
  # columns 1 to 3 turn, column 4 moves
  cat "$results/${pair}_auto.txt" "$results/${pair}_host.txt" | awk '
    NR <= 4 { for (i = 1; i <= 4; ++i) a[NR, i] = $i }
    NR > 4 { for (i = 1; i <= 4; ++i) {
      difference = $i - a[NR - 4, i]; if (difference < 0) difference = -difference
      if (i < 4 && difference > turn) turn = difference
      if (i == 4) { size += $i * $i; if (difference > move) move = difference } } }
    END { printf "  turns differ by %.1e, moves by %.1e", turn, move
      same = NR == 8 && turn < 1e-3 && move < 1e-3 * (1 + sqrt(size))
      print same ? "" : ": TOO MUCH"; exit !same }' || status=1
done

echo "== Times"
"$bundle/bin/pcl_kss_icp_benchmark" --benchmark_out="$results/times.json" \
  --benchmark_filter='^(Automatic|AutomaticHost|Stages.*Rigid)/' 2>&1 |
  tee "$results/times.txt" | grep -E 'median|repeats:1/' | cut -c -110
exit $status
