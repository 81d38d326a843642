#!/bin/sh
# readme.sh: every command of the README and of the pages that it leads to, the measurement of
# everything among them, which ./run test leaves out.
set -eu
cd "$(dirname "$0")/../.."
LANTERN_ALL=1 "${BUILD:-build}/tests/tests_app" --gtest_filter='Readme.*'
pages="README.md $(grep -o '](\([A-Za-z0-9_./]*\.md\))' README.md | tr -d ']()' | sort -u)"
echo "$(sed -n '/^```sh$/,/^```$/p' $pages | grep -vc '^```\|^$\|^./run test$') commands, each ended with 0"
