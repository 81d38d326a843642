#!/bin/sh
# Renders a course in parts that GNU parallel starts, here or on other machines, and merges them.
#   parallel.sh OUT SHARDS FILE.toml...
# Run it again after a crash or a change: frames that are still right are kept. A shard that fails
# is named by the merge, with the command that does it again.
# On other machines: add --sshloginfile HOSTS --workdir . to parallel. OUT must then be on a disk
# that all of them share; otherwise bring the folders OUT/shard-I-of-N together before the merge.
set -eu
lantern=${LANTERN:-lantern}
out=$1 shards=$2
shift 2
seq "$shards" |
  parallel --quote --jobs "${JOBS:-100%}" \
    "$lantern" render "$@" -o "$out" --shard "{}/$shards" -j 1 || true
exec "$lantern" merge "$out"
