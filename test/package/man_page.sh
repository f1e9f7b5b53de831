#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Checks that the manual page has all options that --help shows, and
# that man has nothing to complain of.
#   test/package/man_page.sh TOOL PAGE
set -euo pipefail
tool=${1:?name the tool}
page=${2:?name the manual page}
options=$("$tool" --help | grep -oE '^  (-. \[ )?--[a-z-]+' | grep -oE -- '--[a-z-]+')
[ "$(wc -l <<< "$options")" -ge 20 ] || { echo "--help shows too few options"; exit 1; }

text=$(sed -e 's/\\-/-/g' -e 's/\\f.//g' "$page")
result=0
for option in $options; do
  grep -qE -- "^(-. \[ )?$option( |$)" <<< "$text" || { echo "no $option"; result=1; }
done
for section in NAME SYNOPSIS DESCRIPTION ENVIRONMENT; do
  grep -q "^\.SH \"\?$section" "$page" || { echo "no section $section"; result=1; }
done
if command -v man > /dev/null; then
  complaints=$(LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings --local-file "$page" 2>&1 > /dev/null)
  [ -z "$complaints" ] || { echo "$complaints"; result=1; }
fi
exit $result
