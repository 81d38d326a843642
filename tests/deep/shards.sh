#!/bin/sh
# A course in shards, by GNU parallel as recipes/parallel.sh starts it: the same bytes as one run,
# when all goes well, and after shards were killed in their midst and done again.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
lantern=${LANTERN:-$root/build/lantern}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
command -v parallel >/dev/null || { echo "there is no parallel: apt-get install parallel"; exit 1; }
fail() { echo "FAILED: $*"; exit 1; }
export LANTERN="$lantern" JOBS=2
mkdir scenarios
for s in pong_bsp ghost_maze kdtree_atlas n_squared octree_split; do
  cp "$root/scenarios/$s.toml" scenarios/
done
course="$(echo scenarios/*.toml) --size 640x360"
recipe=$root/tests/deep/recipes/parallel.sh
say_time() { echo "$1: $(awk -v a="$2" -v b="$(date +%s%N)" 'BEGIN { printf "%.1f", (b - a) / 1e9 }') s"; }

begun=$(date +%s%N)
"$lantern" render $course -o one >one.log 2>&1 || fail "one run: $(tail -n 3 one.log)"
say_time "one run" "$begun"

# The whole beside the shards, and nothing else, is what one run makes.
same_as_one() {
  rm -rf compared
  mkdir compared
  for s in one/*; do cp -r "$1/$(basename "$s")" compared/; done
  diff -r one compared
}

for shards in 1 3 8; do
  begun=$(date +%s%N)
  sh "$recipe" "out$shards" "$shards" $course >parallel.log 2>&1 ||
    fail "$shards shards: $(tail -n 3 parallel.log)"
  say_time "$shards shards by GNU parallel, two at a time, and the merge" "$begun"
  same_as_one "out$shards" || fail "$shards shards differ from one run"
done

# --- killed ---
"$lantern" render $course -o killed --shard 2/4 >killed.log 2>&1 &
program=$!
until ls killed/shard-2-of-4/*/*.png >/dev/null 2>&1; do sleep 0.02; done
kill -KILL "$program" 2>/dev/null || true
wait "$program" 2>/dev/null || true
for i in 1 4; do
  "$lantern" render $course -o killed --shard "$i/4" >>killed.log 2>&1
done
if "$lantern" merge killed >merge.log 2>&1; then fail "a merge without shards 2 and 3"; fi
grep -q "shard 2/4 of .* is not finished: run lantern render" merge.log || fail "$(cat merge.log)"
grep -q "shard 3/4 of .* is missing: run lantern render" merge.log || fail "$(cat merge.log)"
# What it says is what helps.
sed -n 's/.*: run lantern render /render /p' merge.log >again
[ "$(wc -l <again)" = 2 ] || fail "two shards are to be done again: $(cat again)"
while read -r words; do eval "$lantern $words" >>killed.log 2>&1 || fail "$words"; done <again
"$lantern" merge killed >merge.log 2>&1 || fail "$(cat merge.log)"
same_as_one killed || fail "a shard that was killed and done again differs"
echo "killed, named, done again as the merge says: the same bytes"
