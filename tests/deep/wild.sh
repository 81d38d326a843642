#!/bin/sh
# wild.sh: 2,000 worlds drawn at random in 2D and as many in 3D, by every contact method.
set -u
log=$(mktemp)
trap 'rm -f "$log"' EXIT
LANTERN_WILD_WORLDS=2000 "${BUILD:-build}/tests/tests_physics" --gtest_brief=1 \
  --gtest_filter='*WildWorlds*' >"$log" 2>&1
code=$?
cat "$log"
printf '20,000 worlds; %s that did not hold\n' "$(grep -c '^seed\|: seed' "$log")"
exit $code
