#!/bin/sh
# sanitized.sh: all tests under the address and undefined-behaviour sanitizers, in a debug build that
# must draw the same; of these ./run test runs those of the engine.
set -eu
cd "$(dirname "$0")/../.."
build=${BUILD:-build}/debug
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake -S . -B "$build" -G Ninja -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=40 \
  -DCMAKE_BUILD_TYPE=Debug -DLANTERN_SANITIZE=ON -DLANTERN_WERROR=ON >"$log"
cmake --build "$build"
code=0
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -O "$log" || code=$?
grep 'tests passed' "$log"
exit $code
