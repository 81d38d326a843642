#!/bin/sh
# A fault at each call: the n-th open, write, rename, link, unlink, mkdir, sync or allocation of a
# run fails. The run must end with an exit code that Lantern has, without a signal, and with one
# line of complaint; the same run without faults must then leave the bytes of a clean one.
#   faults.sh LANTERN LIBRARY ROOT EVERY JOB...     every EVERY-th call; jobs: svg png atlas resumed
#                                                   check measure
set -u
lantern=$1 library=$2 root=$3 every=$4
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
runs=0 failures=0

# The scenarios stay the same; only what is written counts.
ghosts=$root/scenarios/ghost_quadtree.toml
textures=$root/scenarios/kdtree_atlas.toml

fail() {
  failures=$((failures + 1))
  echo "FAILED: $1"
  sed 's/^/    /' "$work/err"
}

# One run of a job, its files in the folder $work/out; "$@" stands before the program.
run() {
  job=$1
  shift
  case $job in
    svg) "$@" "$lantern" render "$ghosts" --frames 0-3 --format svg --size 160x90 -o "$work/out" ;;
    png) "$@" "$lantern" render "$ghosts" --frames 0-3 --size 160x90 -j 2 -o "$work/out" ;;
    atlas) "$@" "$lantern" render "$textures" --format svg --size 160x90 -o "$work/out" ;;
    resumed) "$@" "$lantern" render "$ghosts" --format svg --size 160x90 -o "$work/out" ;;
    check) "$@" "$lantern" check --json "$ghosts" ;;
    measure) "$@" "$lantern" measure oscillator --quick --no-peers --method velocity_verlet \
      --method runge_kutta_4 --step 0.2 --step 0.1 -o "$work/out" ;;
  esac >"$work/said" 2>"$work/err"
}

# What a job finds when it begins.
set_up() {
  rm -rf "$work/out"
  mkdir "$work/out"
  if [ "$1" = resumed ]; then cp -R "$work/begun/." "$work/out"; fi
}

# Are the files those of a clean run? Of a measurement, which takes times, the rows' names.
is_clean() {
  if [ "$1" = measure ]; then
    cut -d, -f1-6 "$work/out/measure.csv" | cmp -s - "$work/clean.csv"
  else
    diff -r "$work/clean" "$work/out" >"$work/err" 2>&1
  fi
}

try() { # JOB KIND NUMBER
  set_up "$1"
  runs=$((runs + 1))
  error=$(($3 % 2 * 23 + 5)) # EIO or ENOSPC
  run "$1" env FAULT_KIND="$2" FAULT_AT="$3" FAULT_ERRNO="$error" FAULT_DIR="$work/out" \
    LD_PRELOAD="$library"
  code=$?
  at="$1, $2 number $3: exit code $code"
  case $code in
    0) ;;
    1 | 2 | 3 | 4 | 130)
      [ "$(grep -c 'lantern: error' "$work/err")" = 1 ] || fail "$at, not one line of complaint" ;;
    *) fail "$at" ;;
  esac
  [ "$1" = check ] && return
  run "$1" || fail "$at; then it does not go on"
  is_clean "$1" || fail "$at; then other bytes than a clean run's"
}

calls_of() { # JOB KIND
  set_up "$1"
  run "$1" env FAULT_KIND="$2" FAULT_AT=0 FAULT_LOG="$work/calls" FAULT_DIR="$work/out" \
    LD_PRELOAD="$library" || fail "$1 without faults"
  cat "$work/calls"
}

for job in "$@"; do
  if [ "$job" = resumed ]; then
    rm -rf "$work/out"
    "$lantern" render "$ghosts" --frames 2-4 --format svg --size 160x90 -o "$work/out" 2>"$work/err"
    rm -rf "$work/begun"
    mv "$work/out" "$work/begun"
  fi
  rm -rf "$work/out" "$work/clean"
  mkdir "$work/out"
  run "$job" || fail "$job without faults"
  cp -R "$work/out" "$work/clean"
  [ "$job" = measure ] && cut -d, -f1-6 "$work/out/measure.csv" >"$work/clean.csv"
  kinds="open write rename link unlink mkdir sync"
  # Mesa's own allocations are not ours: only jobs that load no driver.
  case $job in check | svg) [ "${FAULTS_NEW:-1}" = 1 ] && kinds="$kinds new" ;; esac
  [ "$job" = check ] && kinds=new
  for kind in $kinds; do
    calls=$(calls_of "$job" "$kind")
    step=$every
    [ "$kind" = new ] && step=$((every * (1 + calls / 400)))
    n=1
    while [ "$n" -le "$calls" ]; do
      try "$job" "$kind" "$n"
      n=$((n + step))
    done
  done
done
echo "$runs runs with a fault, $failures failures"
[ "$failures" = 0 ]
