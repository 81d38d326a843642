#!/bin/sh
# The engine of live pages under 10,000 hostile texts and hands, and how long its answers take; the page
# in Firefox, where that is installed. The engine is built first, by ./run web.
set -eu
cd "$(dirname "$0")/../.."
./run web >/dev/null
count=${COUNT:-10000}
hostile=$(node tests/live/hostile.cjs build/lantern.wasm scenarios "$count" "${SEED:-1}")
echo "$hostile"
node tests/live/speed.cjs build/lantern.wasm scenarios
in_firefox=$(python3 tests/publish/live_page.py build/lantern . build/deep/firefox --firefox) || [ $? -eq 77 ] || { echo "$in_firefox"; exit 1; }
echo "$(echo "$hostile" | tail -n 1). ${in_firefox:-No Firefox}"
