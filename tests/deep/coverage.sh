#!/bin/sh
# Which lines of src/language and src/run the fuzzer's files run, out of a build with counters.
#   coverage.sh [ROUNDS]      5,000 files unless told
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${BUILD:-$root/build}/coverage
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_UNITY_BUILD=ON -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS="--coverage -fprofile-update=atomic" -DCMAKE_CXX_FLAGS_RELEASE=-O0 \
  -DCMAKE_EXE_LINKER_FLAGS=-Wl,-u,__gcov_dump >/dev/null
cmake --build "$build" --target tests_fuzz >"$build/build.log" || { tail -n 20 "$build/build.log"; exit 1; }
find "$build" -name '*.gcda' -exec rm {} +
"$build/tests/tests_fuzz" --rounds "${1:-5000}" --findings "$build/findings" >"$build/report.txt" || {
  cat "$build/report.txt"
  echo "it found something: see $build/findings"
  exit 1
}
head -n 2 "$build/report.txt"
# Plain gcov: for each object a list of its sources' lines. A line counts once, however many
# objects hold it.
gcov=$(command -v gcov || ls /usr/bin/gcov-* | head -n 1)
find "$build/CMakeFiles/lantern_language.dir" "$build/CMakeFiles/lantern_run.dir" -name '*.gcda' -exec "$gcov" -t {} + 2>/dev/null |
  awk -F: '
    $3 == "Source" { inside = $0 ~ "/src/(language|run)/"; file = $4; sub(/.*\/src\//, "", file) }
    inside && NF > 2 && $2 + 0 > 0 {
      line = file ":" ($2 + 0)
      gsub(/ /, "", $1)
      if ($1 == "-") next
      if (!(line in known)) { known[line] = 1; all[file]++; total++ }
      if ($1 !~ /#|=/ && !(line in hit)) { hit[line] = 1; run[file]++; ran++ }
    }
    END {
      for (file in all)
        printf "%6.1f %% of %4d lines  %s\n", 100 * run[file] / all[file], all[file], file | "sort -n"
      close("sort -n")
      if (total == 0) { print "no line of src/language and src/run was counted"; exit 1 }
      printf "%.1f %% of %d lines of src/language and src/run\n", 100 * ran / total, total
    }'
