#!/bin/sh
# The same facts and drawings from GCC and from Clang, for the least processor and for this one:
# every sequence as JSON and SVG, byte for byte.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
lantern=${LANTERN:-$root/build/lantern}  # by GCC
build=$root/build
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# render NAME PROGRAM: all sequences to $folder/NAME, but for what names the program.
render() {
  "$2" render "$root"/scenarios/*.toml --format svg -o "$folder/$1" >"$folder/$1.log"
  find "$folder/$1" -name manifest.json -delete
  find "$folder/$1" -name '*.svg' -exec sed -i '/^<!-- Lantern made this from/d' {} +
  find "$folder/$1" -name '*.json' -exec sed -i '/^"made_from"/d' {} +
}
# built NAME COMPILER FLAGS...: another program.
built() {
  name=$1 compiler=$2
  shift 2
  cmake -S "$root" -B "$build/compilers/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=40 -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_CXX_FLAGS="$*" >"$folder/$name.log" 2>&1 &&
    cmake --build "$build/compilers/$name" --target lantern >>"$folder/$name.log" 2>&1 || {
    tail -n 30 "$folder/$name.log"
    exit 1
  }
  render "$name" "$build/compilers/$name/lantern"
}

render gcc "$lantern"
files=$(find "$folder/gcc" -type f | wc -l)
[ "$files" -gt 1000 ] || { echo "only $files files were written"; exit 1; }
clang=$(ls /usr/bin/clang++-* | sort -V | tail -n 1)  # the newest
built clang "$clang"
built gcc_native g++ -march=native
built clang_native "$clang" -march=native
for name in clang gcc_native clang_native; do
  diff -qr "$folder/gcc" "$folder/$name" >"$folder/differences" || {
    head -n 20 "$folder/differences"
    echo "$name: $(wc -l <"$folder/differences") of $files files differ"
    exit 1
  }
done
echo "$files files of GCC, of Clang and of both with all vectors of this processor: 0 differ"
