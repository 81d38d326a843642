#!/bin/sh
# same_facts.sh NODE LANTERN ENGINE ROOT FOLDER: see same_facts.cjs. Skipped where there is no engine.
set -eu
node=$1 lantern=$2 engine=$3 folder=$5 here=$(dirname "$0")
[ -f "$engine" ] || exit 77
set -- "$4"/scenarios/*.toml "$here"/letters.toml
rm -rf "$folder"
"$lantern" render "$@" --format svg -o "$folder" >/dev/null
exec "$node" "$here"/same_facts.cjs "$engine" "$folder" "$@"
