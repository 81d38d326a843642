#!/bin/sh
# By GNU parallel, as the recipes start it: a course in shards has the same bytes as one run, when all
# goes well, and after shards were killed in their midst and done again; problems and cases, a job
# each, have the rows of one run.
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
until ls killed/shard-2-of-4/*/*.png >/dev/null 2>&1; do
  kill -0 "$program" 2>/dev/null || fail "shard 2 draws nothing: $(tail -n 3 killed.log)"
  sleep 0.02
done
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

# --- a job each ---
each=$root/tests/deep/recipes/each.sh
problems="projectile oscillator" cases="root_too_small overflow zeno"
OPTIONS="--quick --no-peers" sh "$each" measured measure $problems >each.log 2>&1 ||
  fail "measure: $(tail -n 3 each.log)"
"$lantern" measure $problems --quick --no-peers -o measured_in_one >each.log 2>&1 || fail "$(cat each.log)"
sh "$each" tried stress $cases >each.log 2>&1 || fail "stress: $(tail -n 3 each.log)"
"$lantern" stress $cases -o tried_in_one >each.log 2>&1 || fail "$(cat each.log)"
# Of rows that hold times their names.
rows() { for table; do tail -n +2 "$table" | cut -d, -f"$columns"; done | sort; }
columns=1-6
rows measured/*/measure.csv >all
rows measured_in_one/measure.csv | cmp - all || fail "measured a job each, other rows"
columns=1-
rows tried/*/stress.csv >all
rows tried_in_one/stress.csv | cmp - all || fail "cases a job each, other rows"
"$lantern" measure --from measured/* -o page >each.log 2>&1 || fail "$(cat each.log)"
for title in Projectile Oscillator; do
  grep -q "<h2>$title" page/report.html || fail "no $title on the page"
done
echo "$(ls one | wc -l) scenarios in 1, 3 and 8 shards, and in 4 of which one was killed: the same bytes;" \
  "2 problems and 3 cases, a job each: the same rows"
