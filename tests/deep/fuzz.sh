#!/bin/sh
# A long search with another seed each time: FUZZ_MINUTES of it, 20 unless told.
set -eu
cmake --build "$BUILD" --target tests_fuzz >/dev/null
"$BUILD/tests/tests_fuzz" --minutes "${FUZZ_MINUTES:-20}" --seed "$(date +%s)" \
  --findings "$BUILD/fuzz-findings"
