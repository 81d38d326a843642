#!/bin/sh
# With any limit of address space or data a run is good, or ends with one line that says why and exit
# code 1, 2 or 4: never by a signal. Needs LANTERN, the program; some minutes. STEP: kilobytes from one
# limit to the next.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0 runs=0

# try LIMIT WORDS...: LIMIT as -v 300000 (kB)
try() {
  limit=$1
  shift
  runs=$((runs + 1))
  rm -rf "$folder/out"
  (ulimit -c 0; ulimit $limit; exec "$LANTERN" "$@") >/dev/null 2>"$folder/err"
  code=$?
  lines=$(grep -c '^lantern: error: ' "$folder/err")
  case $code in
    0) return ;;
    1 | 4) [ "$1" = doctor ] || [ "$lines" -eq 1 ] && return ;;
    # The command line asks for larger pictures than the budget, which is half the limit, holds.
    2) [ "$lines" -eq 1 ] && grep -q '^lantern: error: .*, the budget is .*--size.*--memory' "$folder/err" &&
      return ;;
  esac
  failures=$((failures + 1))
  echo "ulimit $limit: $*: exit code $code"
  head -5 "$folder/err"
}

ghosts=$root/scenarios/ghost_quadtree.toml
for which in -v -d; do
  for kilobytes in $(seq 50000 "${STEP:-60000}" 700000) $(seq 800000 400000 2000000); do
    limit="$which $kilobytes"
    try "$limit" check "$ghosts"
    try "$limit" doctor
    for backend in osmesa egl; do
      try "$limit" render --backend $backend --frames 0-3 -j 8 -o "$folder/out" "$ghosts"
      try "$limit" render --backend $backend --frames 0-1 -j 2 --size 8192x8192 -o "$folder/out" \
        "$ghosts"
    done
    try "$limit" measure kepler --quick --method velocity_verlet --longest 1 -o "$folder/out"
  done
done
echo "$runs runs, $failures that ended by a signal or without one line that says why"
[ $failures -eq 0 ]
