#!/bin/sh
# stress_mutants.sh [SEED [SIZE]]: small faults put into the physics, SIZE of them (60), and which
# cases of `lantern stress` fail with each; 1 if fewer than 90 % of those that change motions are
# caught. Every seed takes other places. Needs Debian's python3-clang-14 and libclang-14-dev.
set -eu
cd "$(dirname "$0")/../.."
exec /usr/bin/python3 tests/mutate/stress.py --seed "${1:-1}" --size "${2:-${MUTANTS:-60}}" \
  --folder "${BUILD:-build}/mutants_of_stress" --page "${BUILD:-build}/CAUGHT.md"
