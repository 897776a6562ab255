#!/usr/bin/env bash
# The version stands once, in CMakeLists.txt; both programs and the newest entry of the changelog show it.
. "$(dirname "$0")/common.sh"

version=$(sed -n 's/^project(uchilsim VERSION \([0-9]*\.[0-9]*\.[0-9]*\) .*/\1/p' "$root/CMakeLists.txt")
[ -n "$version" ] || fail "CMakeLists.txt has no semantic version"
expect 0 "version of btr" "$btr" --version
[ "$(cat "$folder/out")" = "btr $version" ] || fail "btr --version says $(cat "$folder/out") instead of btr $version"
if [ -x "$(dirname "$btr")/uchilsim" ]; then
  QT_QPA_PLATFORM=offscreen expect 0 "version of uchilsim" "$(dirname "$btr")/uchilsim" --version
  [ "$(cat "$folder/out")" = "uchilsim $version" ] || fail "uchilsim --version says $(cat "$folder/out")"
fi

# Each version has a date, and each of its entries stands under one of the three kinds.
newest=$(sed -n 's/^## \(.*\)/\1/p' "$root/CHANGELOG.md" | head -n 1)
[[ $newest =~ ^"$version – "20[0-9]{2}-[0-9]{2}-[0-9]{2}$ ]] || fail "the changelog begins with \"$newest\", not with $version and a date"
stray=$(awk '/^## / {kind = ""} /^### / {kind = $2} kind !~ /^(Added|Changed|Fixed)$/ && /^- / {print NR ": " $0}' "$root/CHANGELOG.md")
[ -z "$stray" ] || fail "changelog entries outside Added, Changed and Fixed: $stray"
torn=$(grep -nE '^ +[^ -]' "$root/CHANGELOG.md")
[ -z "$torn" ] || fail "changelog lines that continue another entry: $torn"
finish
