#!/bin/sh
# The peak of memory of every file of tests/cases, and whether it is within the budget; what is
# refused names what to change.
set -eu
exec python3 "$(dirname "$0")/memory.py" "${LANTERN:-build/lantern}"
