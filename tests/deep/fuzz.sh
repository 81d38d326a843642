#!/bin/sh
# A long search with another seed each time: FUZZ_FILES files (1,000,000 unless told), by as many
# processes as there are processors, each with a seed of its own from FUZZ_SEED on.
set -u
files=${FUZZ_FILES:-1000000} seed=${FUZZ_SEED:-$(date +%s)} processes=${FUZZ_PROCESSES:-$(nproc)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
each=$(((files + processes - 1) / processes))
i=0 running=""
while [ "$i" -lt "$processes" ]; do
  "$BUILD/tests/tests_fuzz" --rounds "$each" --seed $((seed + i)) --findings "$BUILD/fuzz-findings" \
    >"$work/$i" &
  running="$running $!"
  i=$((i + 1))
done
failed=0
for process in $running; do wait "$process" || failed=1; done
cat "$work"/*
awk -v first="$seed" -v last=$((seed + processes - 1)) '
  / files in / { files += $1; if ($4 > seconds) seconds = $4; for (i = 2; i < NF; i++) {
    if ($(i + 1) ~ /^drawn/) drawn += $i; if ($(i + 1) ~ /^measured/) measured += $i } }
  / crashes, / { crashes += $1; hangs += $3; broken += $5 }
  END { printf "%d files, %d of them drawn and %d measured: %d crashes, %d hangs, %d broken promises; seeds %d to %d\n",
        files, drawn, measured, crashes, hangs, broken, first, last }' "$work"/*
[ "$failed" = 0 ]
