#!/bin/sh
# same_facts.sh NODE LANTERN ENGINE ROOT FOLDER: see same_facts.cjs. Skipped where there is no engine.
set -eu
[ -f "$3" ] || exit 77
rm -rf "$5"
"$2" render "$4"/scenarios/*.toml --format svg -o "$5" >/dev/null
exec "$1" "$(dirname "$0")/same_facts.cjs" "$3" "$4/scenarios" "$5"
