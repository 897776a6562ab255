#!/usr/bin/env bash
# clang-tidy on the sources that changed since a commit, by default the one at which this branch left its upstream, or
# the last one. Run by hand; needs clang-tidy. Nothing to compare with (no history): nothing is checked, and that is said.
#   bash tests/tidy.sh [COMMIT]
set -euo pipefail
cd "$(dirname "$0")/.."
base=${1:-$(git merge-base HEAD '@{upstream}' 2> /dev/null || true)}
[ -n "$base" ] && [ "$base" != "$(git rev-parse HEAD)" ] || base=$(git rev-parse --verify --quiet 'HEAD~1' || true)
if [ -z "$base" ]; then
  echo "clang-tidy: no earlier commit to compare with; nothing was checked"
  exit 0
fi
mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- 'app/*.cpp' 'core/*.cpp' 'plugins/*.cpp' 'ui/*.cpp')
echo "clang-tidy: ${#files[@]} sources changed since ${base:0:12}"
[ ${#files[@]} -gt 0 ] || exit 0
# Each file by itself, with the flags of the preset that compiles so.
cmake --preset dev -DBUILD_TESTING=OFF > /dev/null
printf '%s\n' "${files[@]}" | xargs -d '\n' -P "$(nproc)" -n 1 clang-tidy -p build/dev --quiet \
  --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option
