#!/bin/sh
# readme.sh: every command of the README, the measurement of everything among them, which
# ./run test leaves out.
set -eu
cd "$(dirname "$0")/../.."
LANTERN_ALL=1 "${BUILD:-build}/tests/tests_app" --gtest_filter='Readme.*'
echo "$(sed -n '/^```sh$/,/^```$/p' README.md | grep -vc '^```\|^$\|^./run test$') commands, each ended with 0"
