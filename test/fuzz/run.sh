#!/usr/bin/env bash
# Fuzzes for some minutes: builds the preset fuzz, and goes on from the inputs that
# earlier runs found.
#   test/fuzz/run.sh MINUTES [TARGET ...]    readers, align; default: both, one by one
#
# A finding ends the run; its input is left in build-fuzz/found/<target>. The file goes
# to test/fuzz/findings/<target> with the commit that mends it.
set -euo pipefail
cd "$(dirname "$0")/../.."
minutes=${1:?say for how many minutes}
shift
[ $# -gt 0 ] || set -- readers align

cmake --preset fuzz >/dev/null
for target in "$@"; do
  cmake --build build-fuzz --target "fuzz_$target"
done
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
export LSAN_OPTIONS=suppressions=$PWD/test/sanitizers/leaks.txt
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1:suppressions=$PWD/test/sanitizers/undefined.txt
status=0
for target in "$@"; do
  found=build-fuzz/found/$target inputs=build-fuzz/inputs/$target
  mkdir -p "$found" "$inputs"
  known=(build-fuzz/test/fuzz/corpus/"$target")
  [ ! -d test/fuzz/findings/"$target" ] || known+=(test/fuzz/findings/"$target")
  echo "$target: $minutes minutes"
  build-fuzz/test/fuzz/fuzz_"$target" -max_total_time=$((60 * minutes)) \
    -timeout=10 -rss_limit_mb=2048 -max_len=4096 -print_final_stats=1 \
    -artifact_prefix="$found/" \
    "$inputs" "${known[@]}" 2>"$found/log" || status=1
  grep -E "stat::number_of_executed_units|stat::average_exec_per_sec|stat::peak_rss" \
    "$found/log" || true
  [ $status -eq 0 ] || { tail -n 60 "$found/log"; break; }
done
exit $status
