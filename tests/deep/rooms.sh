#!/bin/sh
# rooms.sh: the tests of the rooms that ./run test runs under sanitizers only, in the release build.
set -eu
cd "$(dirname "$0")/../.."
exec ctest --test-dir "${BUILD:-build}" --output-on-failure -j "$(nproc)" \
  -E '^(app|physics|render|faults)\.'
