#!/bin/sh
# From SIGINT or SIGTERM to the end of the process: at most 0.2 s at the 99th percentile, exit code
# 130, whatever the program is doing. MOMENTS sets how many a command, SEED which, LONGEST how late at
# most. Words choose commands.
set -eu
exec python3 "$(dirname "$0")/interrupts.py" "${LANTERN:-build/lantern}" "$@"
