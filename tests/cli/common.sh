# For the scripts beside it: $1 = btr, $2 = the project's root.
set -u
btr=$1
root=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
# What is called python3 may be a script that looks for it each time.
python3_itself=$(python3 -c 'import sys; print(sys.executable)')
python3() { "$python3_itself" "$@"; }

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# expect CODE "what" command…: runs it; output and errors go to $folder/out and $folder/err
expect() {
  local code=$1 what=$2 got
  shift 2
  "$@" > "$folder/out" 2> "$folder/err"
  got=$?
  [ $got = "$code" ] || { fail "$what: exit code $got instead of $code"; sed 's/^/    /' "$folder/err" | head -5; }
}

# says FILE "text": the file (out or err) holds the text
says() { grep -qF -- "$2" "$folder/$1" || { fail "expected \"$2\" in $1:"; sed 's/^/    /' "$folder/$1" | head -5; }; }

# one_line: exactly one line of error
one_line() { [ "$(wc -l < "$folder/err")" = 1 ] || { fail "more than one line of error:"; sed 's/^/    /' "$folder/err"; }; }

# short_kick FILE: the shipped short kick, found from anywhere; lines of Python on standard input may change `spec`
short_kick() {
  python3 -c '
import json, os, sys
root, out = sys.argv[1:]
source = os.path.join(root, "resources/experiments/kick-short.json")
spec = json.load(open(source))
spec["scene"] = os.path.abspath(os.path.join(os.path.dirname(source), spec["scene"]))
exec(sys.stdin.read())
json.dump(spec, open(out, "w"))' "$root" "$1"
}
# kick_of_a_person FILE: two generations of four, which a person measures; lines of Python as above
kick_of_a_person() {
  { cat << 'PY'; cat; } | short_kick "$1"
spec["reality"] = "person"
spec["learner"]["settings"]["population"] = 4
spec["stages"].update(first_generations=1, next_generations=1, total_generations=2, measured_individuals=2)
PY
}

finish() {
  [ $failures = 0 ] && echo "passed"
  exit $((failures > 0))
}
