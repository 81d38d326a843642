#!/bin/sh
# Every call of a small run fails once: see tests/faults/faults.sh.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${CXX:-g++}" -std=c++20 -O1 -fPIC -shared "$root/tests/faults/faults.cpp" -o "$folder/faults.so" -ldl
sh "$root/tests/faults/faults.sh" "$LANTERN" "$folder/faults.so" "$root" 1 \
  svg png atlas resumed check measure
