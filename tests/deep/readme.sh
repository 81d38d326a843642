#!/bin/sh
# readme.sh: every command of the README and of the pages that it leads to, the measurement of everything among them, which
# ./run test leaves out.
set -eu
cd "$(dirname "$0")/../.."
LANTERN_ALL=1 "${BUILD:-build}/tests/tests_app" --gtest_filter='Readme.*'
echo "$(sed -n '/^```sh$/,/^```$/p' README.md scenarios/PICTURES.md scenarios/PIPELINES.md \
  scenarios/bench/README.md tests/example/README.md tests/README.md | grep -vc '^```\|^$\|^./run test$') commands, each ended with 0"
