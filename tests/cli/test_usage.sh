#!/usr/bin/env bash
# Exit codes and errors: 1 wrong input with one line, 2 wrong usage.
. "$(dirname "$0")/common.sh"

expect 2 "no command" "$btr"
expect 2 "unknown command" "$btr" dance
expect 2 "missing option" "$btr" status
expect 0 "help" "$btr" --help
for command in run status fitness replay export model list gap bench; do says out "$command"; done

expect 1 "absent database" "$btr" status --db "$folder/none.db"
one_line
says err "none.db"
[ ! -e "$folder/none.db" ] || fail "status made a database"

echo "this is not a database, it is a letter to a friend" > "$folder/letter.db"
cp "$folder/letter.db" "$folder/letter.copy"
expect 1 "a text file as database" "$btr" run "$root/resources/experiments/kick-short.json" --db "$folder/letter.db"
one_line
cmp -s "$folder/letter.db" "$folder/letter.copy" || fail "a foreign file was changed"

expect 1 "absent experiment" "$btr" run "$folder/none.json" --db "$folder/a.db"
one_line
printf '{"format": "uchilsim-experiment-1",\n "name": "x",,}' > "$folder/bad.json"
expect 1 "JSON with a typing error" "$btr" run "$folder/bad.json" --db "$folder/a.db"
one_line
says err "bad.json:2:14"

mkdir "$folder/experiments"
cp -r "$root/resources/scenes" "$root/resources/robots" "$folder"
sed 's/"population": *[0-9]*/"population": 1/' "$root/resources/experiments/kick-short.json" > "$folder/experiments/one.json"
expect 1 "population 1" "$btr" run "$folder/experiments/one.json" --db "$folder/a.db"
one_line
says err "population"

expect 1 "absent model" "$btr" model check "$folder/none.wrl"
one_line
expect 0 "the ERS-7" "$btr" model check "$root/resources/robots/ers7.wrl"
for word in LF_J1 RR_J3 HEAD_TILT kg; do says out "$word"; done

for kind in effects learners controllers fitness realities plugins; do expect 0 "list $kind" "$btr" list $kind; done
expect 2 "list of something else" "$btr" list cats
expect 0 "learners as JSON" "$btr" --json list learners
says out '"crossover'
finish
