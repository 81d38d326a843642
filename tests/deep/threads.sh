#!/bin/sh
# The threads of -j under the thread sanitizer. Only what they run is built, without a graphics
# driver, whose own threads would be reported.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"${CXX:-g++}" -std=c++20 -g -O1 -fsanitize=thread -I"$root/src" \
  "$root/tests/deep/threads.cpp" "$root"/src/base/*.cpp "$root/src/render/pipeline.cpp" \
  "$root/src/render/png.cpp" "$root/src/render/deflate.cpp" \
  -lfmt -ldeflate -o "$folder/threads"
mkdir "$folder/files"
TSAN_OPTIONS="halt_on_error=0 exitcode=66" "$folder/threads" "$folder/files"
