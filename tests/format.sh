#!/usr/bin/env bash
# Every C++ file is as clang-format 14 (Debian 12) leaves it. To mend: clang-format -i FILE
set -euo pipefail
cd "$(dirname "$0")/.."
if [ -d .git ] || git rev-parse --git-dir > /dev/null 2>&1; then
  files=$(git ls-files '*.cpp' '*.h')
else
  files=$(find app core plugins resources tests ui -name '*.cpp' -o -name '*.h')
fi
echo "$files" | xargs -d '\n' clang-format --dry-run -Werror
