#!/bin/sh
# two_commands.sh DEB: in a mount namespace of its own, installs the package over a copy of this
# machine that lives in memory, and draws a first picture. What the package depends on must be here.
set -eu
deb=$1
over=$(mktemp -d)
mount -t tmpfs tmpfs "$over"
mkdir "$over/changed" "$over/work" "$over/machine"
mount -t overlay overlay -o "lowerdir=/,upperdir=$over/changed,workdir=$over/work" "$over/machine"
machine=$over/machine
mount --bind /proc "$machine/proc"
mount --bind /dev "$machine/dev"
mkdir -p "$machine/first"
cp "$deb" "$machine/first/lantern.deb"
chroot "$machine" sh -euc '
  cd /first
  export DEBIAN_FRONTEND=noninteractive
  apt-get install -y -q --no-install-recommends ./lantern.deb
  lantern render ghost_quadtree --at four -o - >first.png
  head -c 8 first.png | od -An -tx1 | grep -q "89 50 4e 47"
  lantern doctor | head -n 1
  man -w lantern-render 2>/dev/null || true
  apt-get remove -y -q lantern
  [ ! -e /usr/bin/lantern ]
'
echo "installed by apt-get, drawn, removed"
