#!/bin/sh
# rooms.sh: the tests of the rooms that ./run test runs under sanitizers only, in the release build.
set -u
cd "$(dirname "$0")/../.."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
ctest --test-dir "${BUILD:-build}" --output-on-failure -j "$(nproc)" -O "$log" \
  -E '^(app|physics|render|faults)\.'
code=$?
grep 'tests passed' "$log"
exit $code
