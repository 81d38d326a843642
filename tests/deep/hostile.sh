#!/bin/sh
# Files that somebody else has written, HOSTILE_FILES of them (1,000 unless told), others each time
# unless HOSTILE_SEED is told: see tests/app/hostile_test.cpp.
set -u
log=$(mktemp)
trap 'rm -f "$log"' EXIT
seed=${HOSTILE_SEED:-$(date +%s)}
LANTERN_HOSTILE_FILES=${HOSTILE_FILES:-1000} LANTERN_HOSTILE_SEED=$seed \
  "$BUILD/tests/tests_app" --gtest_filter='Hostile.*' >"$log" 2>&1
code=$?
cat "$log"
sed -n "s/^\([0-9]* hostile files, .*\)/\1; seed $seed/p" "$log"
exit $code
