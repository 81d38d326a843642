#!/bin/sh
# What is installed works without the folder that it was built in: the program, the libraries for
# another project, each header by itself, Debian's packages, the page of the API.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${BUILD:-$root/build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
left_out=""
fail() { echo "package: $*" >&2; exit 1; }
leave_out() { left_out="$left_out; left out: $1 ($2)"; }
have() { command -v "$1" >/dev/null || { leave_out "$2" "$1 is not there"; return 1; }; }

# The program, and a project that uses every target.
sh "$root/tests/package/installed.sh" "$build" "$root" "$work/installed" \
  example_spatial example_physics example_render program

prefix=$work/prefix
cmake --install "$build" --prefix "$prefix" >/dev/null

# spatial and physics need fmt and glm, nothing else; other versions are refused.
use() {
  cmake -S "$root/tests/package/libraries" -B "$work/$1" -G "Unix Makefiles" \
    -DCMAKE_PREFIX_PATH="$prefix" -DEXAMPLES="$root/tests/example_api" -DVERSION="$2" \
    >"$work/$1.log" 2>&1
}
use libraries 0.3 || fail "find_package: $(cat "$work/libraries.log")"
cmake --build "$work/libraries" >>"$work/libraries.log" 2>&1 || fail "$(cat "$work/libraries.log")"
"$work/libraries/libraries" >/dev/null || fail "libraries"
grep -q liblantern_spatial "$work/libraries/CMakeFiles/libraries.dir/link.txt" || fail "no link.txt"
! grep -qE "hwy|deflate|toml|CLI" "$work/libraries/CMakeFiles/libraries.dir/link.txt" || fail "too much"
for version in 0.2 0.4 1.0; do
  ! use "version$version" $version || fail "version $version is taken for this one"
done

# Each header by itself, with nothing but fmt and glm.
cd "$prefix/include/lantern"
find . -name "*.hpp" | sed 's|^\./||' | sort >"$work/headers"
xargs -P "$(nproc)" -I{} sh -c '
  echo "#include <lantern/{}>" | '"${CXX:-g++}"' -std=c++20 -fsyntax-only -Wall -Wextra -x c++ \
    -I "'"$prefix/include"'" -I "'"$prefix/include/lantern"'" - || { echo "package: {}" >&2; exit 1; }
' <"$work/headers" || fail "a header does not stand alone"
echo "$(wc -l <"$work/headers") headers, each by itself"

# Manual pages, as man sees them.
if have man "manual pages"; then
  for page in "$prefix"/share/man/man1/*; do
    warnings=$(LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z "$page" 2>&1 >/dev/null)
    [ -z "$warnings" ] || fail "$page: $warnings"
  done
fi

# Debian's packages: the same bytes twice, right fields, what they hold draws.
if have dpkg-shlibdeps "packages"; then
  for run in once again; do
    mkdir "$work/$run"
    (cd "$work/$run" && SOURCE_DATE_EPOCH=1700000000 cpack -G DEB --config "$build/CPackConfig.cmake" \
      -B "$work/$run" >cpack.log 2>&1) || fail "cpack: $(cat "$work/$run/cpack.log")"
    sleep 1
  done
  for deb in "$work"/once/*.deb; do
    cmp "$deb" "$work/again/$(basename "$deb")" || fail "$(basename "$deb") differs between two runs"
  done
  deb=$(echo "$work"/once/lantern_*.deb)
  for field in "Package: lantern" "Section: graphics" "Depends:.*libosmesa6" "Depends:.*libfmt" \
    "Recommends:.*ffmpeg"; do
    dpkg-deb -I "$deb" | grep -qE "^ $field" || fail "no $field: $(dpkg-deb -I "$deb")"
  done
  dpkg-deb -I "$work"/once/lantern-doc_*.deb | grep -q "Architecture: all" || fail "lantern-doc"
  dpkg-deb -I "$work"/once/lantern-dev_*.deb | grep -q "Depends: .*libglm-dev" || fail "lantern-dev"
  dpkg-deb -x "$deb" "$work/root"
  (mkdir "$work/home" && cd "$work/home" && "$work/root/usr/bin/lantern" render ghost_quadtree \
    --at four -o - >first.png 2>said && [ -s first.png ] &&
    grep -qF "$work/root/usr/share/lantern/scenarios/" said) || fail "the packed program: $(cat "$work/home/said")"
  if have apt-get "the packages' dependencies"; then
    apt-get install --simulate -qq "$deb" "$work"/once/lantern-dev_*.deb >"$work/apt" 2>&1 ||
      fail "apt-get would not install it: $(cat "$work/apt")"
  fi
  # Two commands from nothing to a picture, on a machine that is this one and is thrown away.
  if [ "$(id -u)" = 0 ] && unshare -m true 2>/dev/null; then
    cp "$deb" "$work/lantern.deb"
    unshare -m sh "$root/tests/package/two_commands.sh" "$work/lantern.deb" >"$work/apt" 2>&1 ||
      fail "two commands: $(cat "$work/apt")"
    tail -n 1 "$work/apt"
  else
    leave_out "two commands from nothing to a picture" "needs root and unshare"
  fi
  # The changelog is one for people, not Debian's.
  if have lintian "its opinion of the package"; then
    lintian --allow-root --fail-on error,warning \
      --suppress-tags syntax-error-in-debian-changelog "$deb" || fail lintian
  fi
  du -h "$work"/once/*.deb | sed "s|$work/once/||"
fi

# The page of the API, without a warning.
if have doxygen "the page of the API"; then
  cmake --build "$build" --target api >"$work/api.log" 2>&1 ||
    fail "api: $(cat "$work/api.log")"
  grep -q "all_pairs" "$build/api/html/index.html" || fail "the API's first page lacks its examples"
fi

# A Lantern without lab and tests is installed as well, when nothing but the program was built.
cmake -S "$root" -B "$work/no_lab" -DLANTERN_LAB=OFF -DBUILD_TESTING=OFF -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_CXX_FLAGS_RELEASE=-O0 >"$work/no_lab.log" 2>&1 &&
  cmake --build "$work/no_lab" -j "$(nproc)" --target lantern >>"$work/no_lab.log" 2>&1 &&
  sh "$root/tests/package/installed.sh" "$work/no_lab" "$root" "$work/no_lab_installed" program \
    >>"$work/no_lab.log" 2>&1 || fail "without the lab: $(tail -n 30 "$work/no_lab.log")"
echo "$(wc -l <"$work/headers") headers, each by itself, $(ls "$work"/once/*.deb 2>/dev/null | wc -l) Debian" \
  "packages, manual pages, API and a build without the lab are right$left_out"
