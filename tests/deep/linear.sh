#!/bin/sh
# That n bodies cost n instructions: what no counter counts (a loop through all bodies or links for
# each of them) shows here only. Some ten minutes.
set -eu
exec python3 "$(dirname "$0")/linear.py" "${LANTERN:-build/lantern}"
