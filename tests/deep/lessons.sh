#!/bin/sh
# Every scenario as a lesson page: at most 5 MB, open within a second, a step within 50 ms.
set -eu
cd "$(dirname "$0")/../.."
folder=${BUILD:-build}/test-output/lessons
mkdir -p "$folder"
${LANTERN:-build/lantern} render scenarios/*.toml -o "$folder/{scenario}.html"
python3 tests/publish/lesson_times.py "$folder"
