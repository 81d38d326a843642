#!/bin/sh
# The tasks of five kinds of users (tests/package/user_tasks.sh), from Debian's packages alone, over a copy
# of this machine that lives in memory. Needs root, unshare and what packages are made with.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${BUILD:-$root/build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "users: $*" >&2; exit 1; }
if [ "$(id -u)" != 0 ] || ! unshare -m true 2>/dev/null || ! command -v dpkg-shlibdeps >/dev/null; then
  echo "left out: needs root, unshare and dpkg-dev"
  exit 0
fi
cmake --build "$build" --target lab >"$work/lab.log" 2>&1 || fail "$(tail -n 5 "$work/lab.log")"
mkdir "$work/packages"
(cd "$work/packages" && cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work/packages" \
  >cpack.log 2>&1) || fail "cpack: $(cat "$work/packages/cpack.log")"
for name in lantern lantern-lab lantern-dev lantern-doc; do
  ls "$work"/packages/"${name}"_*.deb >/dev/null || fail "there is no package $name"
done
cp "$root/tests/package/user_tasks.sh" "$work/packages"
cat >"$work/inside.sh" <<'INSIDE'
set -eu
packages=$1
over=$(mktemp -d)
mount -t tmpfs tmpfs "$over"
mkdir "$over/changed" "$over/work" "$over/machine"
mount -t overlay overlay -o "lowerdir=/,upperdir=$over/changed,workdir=$over/work" "$over/machine"
machine=$over/machine
mount --bind /proc "$machine/proc"
mount --bind /dev "$machine/dev"
mkdir -p "$machine/user"
cp "$packages"/*.deb "$packages/user_tasks.sh" "$machine/user"
chroot "$machine" sh -euc '
  cd /user
  export DEBIAN_FRONTEND=noninteractive
  apt-get install -y -q --no-install-recommends ./*.deb >apt.log 2>&1 || { tail -n 5 apt.log >&2; exit 1; }
  mkdir tasks && cd tasks && sh ../user_tasks.sh
'
INSIDE
unshare -m sh "$work/inside.sh" "$work/packages"
