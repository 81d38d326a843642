#!/bin/sh
# How many times as quick as other libraries Lantern finds pairs of boxes, and what it is asked:
# each bound, and by how much it is kept or missed. On an idle machine; some minutes.
set -eu
exec python3 "$(dirname "$0")/pairs.py" "${LANTERN:-build/lantern}"
