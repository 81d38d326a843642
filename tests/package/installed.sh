#!/bin/sh
# installed.sh BUILD ROOT WORK [TARGET...]: installs the build folder BUILD of the repository ROOT to a
# prefix in WORK, uses the program as whoever has nothing else would, and builds these targets of a
# project that knows of Lantern what is installed (tests/package/consumer).
set -eu
build=$1 root=$2 work=$3
shift 3
prefix=$work/prefix
fail() { echo "installed.sh: $*" >&2; exit 1; }

rm -rf "$work"
mkdir -p "$work/empty"
cmake --install "$build" --prefix "$prefix" >"$work/install.log" || fail "cmake --install failed"

for file in bin/lantern share/man/man1/lantern.1.gz share/man/man1/lantern-bench-step.1.gz \
  share/bash-completion/completions/lantern share/zsh/site-functions/_lantern \
  share/fish/vendor_completions.d/lantern.fish share/doc/lantern/copyright \
  share/doc/lantern/THIRD_PARTY.md share/lantern/scenarios/ghost_quadtree.toml \
  share/lantern/scenarios/problems/kepler.toml share/lantern/scenarios/REFERENCE.md \
  share/lantern/scenarios/FRAME.md share/lantern/scenarios/scenario.schema.json \
  include/lantern/version.hpp include/lantern/spatial/structure.hpp \
  include/lantern/app/program.hpp; do
  [ -s "$prefix/$file" ] || fail "$file is not installed"
done
[ ! -e "$build/lantern_lab.so" ] || "$prefix/bin/lantern" stress --list >"$work/cases" ||
  fail "the lab is built, but not installed"
[ ! -e "$build/lantern.wasm" ] || [ -s "$prefix/share/lantern/lantern.wasm" ] ||
  fail "the engine of live pages is built, but not installed"
grep -q "SIL OPEN FONT LICENSE" "$prefix/share/doc/lantern/copyright" || fail "the font's licence"
where=$(grep -rlF -e "$root" -e "$build" "$prefix") && fail "names where it was built: $where"

# What pages lead to is there, and they begin with what is installed.
dead=$(find "$prefix/share" -name '*.md' | while read -r page; do
  grep -o ']([^)# ]*' "$page" | cut -c 3- | grep -v -e '^[a-z]*:' -e '^$' | while read -r target; do
    [ -e "$(dirname "$page")/$target" ] || echo "$page: $target"
  done
done)
[ -z "$dead" ] || fail "pages lead nowhere: $dead"
doc=$prefix/share/doc/lantern-doc
where=$(grep -rlE -e '(^|[^a-z])build/lantern ' -e '^\./run ' "$doc" "$prefix/share/lantern" \
  --include='*.md') && fail "for those who have the sources: $where"
sed 15q "$doc/README.md" | grep -qx 'lantern list' || fail "the README does not begin with it"
[ -L "$doc/scenarios" ] || fail "the README leads to no scenarios"

# From anywhere, with nothing but a name.
cd "$work/empty"
"$prefix/bin/lantern" render ghost_quadtree --at four -o - >first.png 2>said
grep -qF "'ghost_quadtree' is $prefix/share/lantern/scenarios/ghost_quadtree.toml" said ||
  fail "it does not say which scenario it draws: $(cat said)"
head -c 8 first.png | od -An -tx1 | grep -q "89 50 4e 47 0d 0a 1a 0a" || fail "no picture"
[ "$("$prefix/bin/lantern" list 2>/dev/null | wc -l)" -ge 20 ] || fail "list"
if command -v man >/dev/null; then
  man -M "$prefix/share/man" lantern-render </dev/null 2>/dev/null | grep -q -e --theme || fail "man"
fi

cmake -S "$root/tests/package/consumer" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$prefix" \
  -DEXAMPLES="$root/tests/example_api" -DCMAKE_CXX_FLAGS=-O0 >"$work/consumer.log" 2>&1 ||
  fail "find_package(Lantern) failed: $(cat "$work/consumer.log")"
for target; do
  cmake --build "$work/consumer" --target "$target" >>"$work/consumer.log" 2>&1 ||
    fail "$target cannot be built: $(cat "$work/consumer.log")"
done
cd "$work"
for target; do
  "consumer/$target" --version >"$target.out" || fail "$target failed: $(cat "$target.out")"
done
echo "installed and used: $(du -sh "$prefix" | cut -f1)"
rm -rf "$work"
