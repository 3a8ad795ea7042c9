#!/usr/bin/env bash
# tidy.sh BUILD_FOLDER [REGEX]: clang-tidy over the program's sources (src/ and platform/), all cores.
set -euo pipefail
log=$1/tidy.log
status=0
run-clang-tidy-14 -quiet -p "$1" -j "$(nproc)" "${2:-/(src|platform)/}" >"$log" 2>&1 || status=$?
grep -vE '^clang-tidy-14 |warnings? generated|^Suppressed |^Use -header-filter|^$' "$log" || true
exit $status
