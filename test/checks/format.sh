#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Checks that the code is laid out as .clang-format says, by the version of clang-format
# that makes the same of it everywhere, and that no line is longer than 88 columns:
# comments are left alone, and only their writers can shorten them.
#   test/checks/format.sh          checks
#   test/checks/format.sh --fix    lays the code out, then checks
set -euo pipefail
cd "$(dirname "$0")/../.."
folders=(benchmarks evaluation examples include kernels python src test tools)

format=(clang-format-14 --style=file --dry-run -Werror)
[ "${1:-}" = --fix ] && format=(clang-format-14 --style=file -i)

mapfile -d '' files < <(find "${folders[@]}" -type f \
  '(' -name '*.cpp' -o -name '*.h' -o -name '*.hpp' -o -name '*.cl' ')' -print0 | sort -z)
result=0
printf '%s\0' "${files[@]}" | xargs -0 -n 32 -P 2 "${format[@]}" || result=1
LC_ALL=C.UTF-8 awk 'length($0) > 88 {
  print FILENAME ":" FNR ": " length($0) " columns"; found = 1
} END { exit found }' "${files[@]}" || result=1
[ $result -eq 0 ] || echo "test/checks/format.sh --fix lays out all but long comments"
exit $result
