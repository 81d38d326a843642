#!/bin/sh
# mutants.sh [SEED [SIZE]]: small faults put into four rooms, SIZE into each (60), and what their
# tests say of them; 1 if fewer than 90 % of the faults that matter are found. Every seed takes
# other places. Needs Debian's python3-clang-14 and libclang-14-dev.
set -eu
cd "$(dirname "$0")/../.."
exec /usr/bin/python3 tests/mutate/mutate.py --seed "${1:-1}" --size "${2:-${MUTANTS:-60}}" \
  --folder "${BUILD:-build}/mutants"
