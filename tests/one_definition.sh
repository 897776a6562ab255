#!/usr/bin/env bash
# Each name of a type at namespace scope stands for one type in the whole program (C++ [basic.def.odr]): two of the same name
# make the linker keep one constructor for both, and it says so only when all is optimised at once (-flto -Wodr), as no
# build here is.
# Reads the definitions that begin a line; types in a class or in an unnamed namespace are free.
set -u
cd "${1:-$(dirname "$0")/..}" || exit 2
twice=$(find core plugins ui app tests -name '*.h' -o -name '*.cpp' | sort | xargs awk '
  FNR == 1 { unnamed = 0; scope = "" }
  /^namespace \{/ { unnamed = 1 }
  /^namespace [a-z_:]+ \{/ { scope = $2 }
  /^\}  \/\/ namespace$/ { unnamed = 0 }
  !unnamed && /^(struct|class|union|enum class|enum) [A-Z][A-Za-z0-9:]* ?(final )?(: .*)?\{/ {
    name = $1 == "enum" && $2 == "class" ? $3 : $2
    sub(/\{.*/, "", name)
    key = scope "::" name
    if (key in at) print key ": " at[key] " and " FILENAME ":" FNR
    at[key] = FILENAME ":" FNR
  }')
[ -z "$twice" ] && exit 0
echo "$twice"
exit 1
