#!/bin/sh
# Kills at seeded random moments over folders that are not empty. Whatever stood there before, and
# whenever the run was cut: once it is repeated, the folder holds the bytes of a clean run, and what
# Lantern did not make is untouched.
#   kills.sh [KILLS [SEED]]
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
LANTERN=${LANTERN:-$root/build/lantern}
kills=${1:-${KILLS:-200}} seed=${2:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
differing=0 cut_short=0 done_before=0 wrong_code=0

# The i-th random number of this row, from 0 to below $3.
dice() { awk -v s="$seed" -v i="$1" -v j="$2" -v n="$3" \
  'BEGIN { srand(s * 1000003 + i * 1009 + j * 7919); rand(); rand(); print int(rand() * n) }'; }

# --- the scenarios: as they are, and as an older lecture had them ---
scenarios="ghost_maze kdtree_atlas octree_split"
mkdir -p "$work/new" "$work/text" "$work/seed"
for s in $scenarios; do
  cp "$root/scenarios/$s.toml" "$work/new/"
  sed 's/^title = "/title = "Formerly: /; s/^caption = "/caption = "Once /' \
    "$root/scenarios/$s.toml" >"$work/text/$s.toml"
  { echo 'seed = 77'; grep -v '^seed' "$root/scenarios/$s.toml"; } >"$work/seed/$s.toml"
done

# --- the table: what the older run was like, and what the new one is ---
# NAME SCENARIOS-FOLDER OPTIONS, which come after those of the new run
older="none text:text theme:new:--theme_dark size:new:--size_128x72 format:new:--format_svg
pace:new:--pace_event range:new:--frames_1-2 seed:seed finished:new effort:new:--png_small
transparent:new:--transparent cut:new"
newer="png:--size_160x90 svg:--size_160x90_--format_svg dark:--size_160x90_--theme_dark
range:--size_160x90_--frames_2-4 threads:--size_160x90_-j_7"

words() { echo "$1" | tr _ ' '; }
field() { echo "$1" | cut -d: -f"$2"; }
now() { date +%s%N; }

render() { # FOLDER SCENARIO-FILE OPTIONS...
  out=$1 file=$2
  shift 2
  "$LANTERN" render "$file" -o "$out" "$@" >/dev/null 2>"$work/said"
}

# Once a pair of scenario and new run: the clean folder and how long it takes, in milliseconds.
clean_of() { # SCENARIO NEW
  clean=$work/clean/$1-$(field "$2" 1)
  if [ ! -d "$clean" ]; then
    begun=$(now)
    render "$clean" "$work/new/$1.toml" $(words "$(field "$2" 2)") || echo "no clean run of $1"
    echo $((($(now) - begun) / 1000000)) >"$clean.time"
  fi
  time=$(cat "$clean.time")
}

# The folder of an older run, with files that are somebody else's.
older_of() { # SCENARIO OLD NEW NUMBER
  rm -rf "$work/out"
  mkdir -p "$work/out/$1"
  name=$(field "$2" 1)
  text=$(field "$2" 2)
  options="$(words "$(field "$3" 2)") $(words "$(field "$2" 3)")"
  # The last of two options counts.
  for option in --size --format --theme --frames; do
    case "$options" in *"$option"*"$option"*)
      options=$(echo "$options" | sed "s/$option [^ ]*//") ;;
    esac
  done
  case $name in
    none) ;;
    cut)
      # The program itself, not a shell that waits for it.
      "$LANTERN" render "$work/new/$1.toml" -o "$work/out" $options >/dev/null 2>"$work/said" &
      sleep "$(awk -v t="$time" -v d="$(dice "$4" 5 100)" 'BEGIN { print t * d / 1e5 }')"
      kill -KILL $! 2>/dev/null
      wait $! 2>/dev/null ;;
    *) render "$work/out" "$work/$text/$1.toml" $options ;;
  esac
  echo "my notes" >"$work/out/$1/notes.txt"
  cp "$root/scenarios/ghost_quadtree.png" "$work/out/$1/mine.png"
  cp "$root/scenarios/ghost_quadtree.png" "$work/out/$1/$1_from_the_lecture.png"
}

is_clean() { # SCENARIO
  cmp -s "$root/scenarios/ghost_quadtree.png" "$work/out/$1/mine.png" &&
    cmp -s "$root/scenarios/ghost_quadtree.png" "$work/out/$1/$1_from_the_lecture.png" &&
    [ "$(cat "$work/out/$1/notes.txt")" = "my notes" ] || return 1
  rm "$work/out/$1/mine.png" "$work/out/$1/$1_from_the_lecture.png" "$work/out/$1/notes.txt"
  diff -r "$clean" "$work/out" >"$work/difference" 2>&1
}

nth() { shift "$1"; echo "$1"; }

i=1
while [ "$i" -le "$kills" ]; do
  scenario=$(nth $((1 + $(dice "$i" 1 3))) $scenarios)
  old=$(nth $((1 + i % 12)) $older)
  new=$(nth $((1 + $(dice "$i" 2 5))) $newer)
  signal=$(nth $((1 + $(dice "$i" 3 3))) KILL INT TERM)
  clean_of "$scenario" "$new"
  # Frames of the same pictures that an older range left belong to the whole: both ranges stand.
  case $(field "$old" 1):$(field "$new" 1) in
    range:range) clean_of "$scenario" "both:--size_160x90_--frames_1-4" ;;
    # So do those of the same frames in another format, where not all frames are asked for.
    format:range)
      clean=$work/clean/$scenario-formats
      for format in svg png; do
        [ -f "$clean.$format" ] || render "$clean" "$work/new/$scenario.toml" --size 160x90 --frames 2-4 \
          --format "$format"
        touch "$clean.$format"
      done ;;
  esac
  older_of "$scenario" "$old" "$new" "$i"
  moment=$(awk -v t="$time" -v d="$(dice "$i" 4 100)" 'BEGIN { print t * d / 1e5 }')
  options=$(words "$(field "$new" 2)")
  # A shell without job control has what it starts ignore INT.
  env --default-signal=INT "$LANTERN" render "$work/new/$scenario.toml" -o "$work/out" $options \
    >/dev/null 2>"$work/said" &
  program=$!
  sleep "$moment"
  kill -"$signal" "$program" 2>/dev/null
  wait "$program" 2>/dev/null
  code=$?
  case $signal:$code in
    *:0) done_before=$((done_before + 1)) ;;
    KILL:137 | INT:130 | TERM:130) cut_short=$((cut_short + 1)) ;;
    # Before it listens, a signal ends it as any program.
    TERM:143 | INT:2) cut_short=$((cut_short + 1)) ;;
    *)
      wrong_code=$((wrong_code + 1))
      echo "exit code $code: $scenario, over $old, $new, $signal after $moment s" ;;
  esac
  render "$work/out" "$work/new/$scenario.toml" $options
  if ! is_clean "$scenario"; then
    differing=$((differing + 1))
    echo "DIFFERS: $scenario, over $old, $new, $signal after $moment s"
    head -n 3 "$work/difference" 2>/dev/null | sed "s|$work/||g; s/^/    /"
  fi
  i=$((i + 1))
done
echo "$kills kills: $cut_short cut a run, $done_before came after its end," \
  "$differing folders differ, $wrong_code wrong exit codes"
[ "$differing" = 0 ] && [ "$wrong_code" = 0 ]
