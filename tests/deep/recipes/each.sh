#!/bin/sh
# Measures problems, or tries hard cases, a job each, which GNU parallel starts here or on other
# machines (as in parallel.sh).
#   each.sh OUT measure PROBLEM...      `lantern measure --list` names them
#   each.sh OUT stress CASE...          `lantern stress --list` names them
# Each job has the folder OUT/NAME; OPTIONS are further words for all of them. Run it again after a
# crash, with the names that are to be done again. One page of all that was measured:
#   lantern measure --from OUT/* -o PAGE
# Times are worth something only of jobs that are alone: JOBS=1 on each machine.
set -eu
lantern=${LANTERN:-lantern}
out=$1 command=$2
shift 2
exec parallel --jobs "${JOBS:-100%}" "$lantern" "$command" {} ${OPTIONS:-} -o "$out/{}" ::: "$@"
