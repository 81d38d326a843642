#!/bin/sh
# Something long says within a second what is coming, then every five seconds how far it is, though
# a single world step takes longer than that.
set -u
cases=$(dirname "$0")/../cases
said=$(mktemp)
failed=0

fail() {
  printf 'progress: %s\n' "$*" >&2
  cat "$said" >&2
  failed=1
}

# listen CASE BEGINNING: the run of CASE says the line that starts with BEGINNING.
listen() {
  "$LANTERN" check "$cases/$1.toml" >/dev/null 2>"$said" &
  run=$!
  sleep 1
  grep -q "^$1: $2" "$said" || fail "$1 has not said within 1 s: $2"
  sleep 10.5
  lines=$(grep -c "^$1: [0-9]* of $3 frames, [0-9 ]* of $4 world steps" "$said")
  [ "$lines" -eq 2 ] || fail "$1 has told $lines times in 11.5 s how far it is, not twice"
  kill -KILL "$run"
  wait "$run" 2>/dev/null
}

listen nostruct20k 'up to 601 frames of 600 000 world steps' 601 '600 000'
listen gravitation20k 'up to 61 frames of 60 000 world steps' 61 '60 000'
rm -f "$said"
[ "$failed" = 1 ] || echo "2 long runs said within 1 s what is to come, and twice in 11.5 s how far they were"
exit $failed
