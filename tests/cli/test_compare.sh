#!/usr/bin/env bash
# btr compare: what it refuses, and that a stopped or repeated comparison finds its runs again.
. "$(dirname "$0")/common.sh"
expect 1 "no such file" "$btr" compare "$folder/none.json" --db "$folder/a.db"
echo '{"format": "uchilsim-comparison-1", "name": "c", "arms": [], "seeds": [1]}' > "$folder/empty.json"
expect 1 "no arm" "$btr" compare "$folder/empty.json" --db "$folder/a.db"
says err "at least one arm"
expect 2 "no database" "$btr" compare "$folder/empty.json"
# The example can be read and begun; a small copy of it runs to its end.
for arm in parameters recordings; do
  sed -e 's/"first_generations": [0-9]*, "next_generations": [0-9]*, "total_generations": [0-9]*, "measured_individuals": [0-9]*/"first_generations": 1, "next_generations": 1, "total_generations": 1, "measured_individuals": 2/' \
    -e 's/"population": [0-9]*/"population": 4/; s/"generations": [0-9]*, "norm"/"generations": 1, "norm"/' \
    -e 's/"after_stage": 1/"after_stage": 0/' -e "s#\.\./scenes#$root/resources/scenes#" \
    "$root/resources/experiments/worn-knee-$arm.json" > "$folder/worn-knee-$arm.json"
done
sed -e 's#\.\./experiments/##' -e 's/\[1, [0-9, ]*\]/[1]/' "$root/resources/comparisons/worn-knee.json" > "$folder/c.json"
expect 0 "a small comparison" "$btr" compare "$folder/c.json" --db "$folder/a.db" --quiet --csv "$folder/c.csv"
says out "parameters alone"
[ "$(wc -l < "$folder/c.csv")" = 3 ] || fail "a header and two rows were expected"
expect 0 "again" "$btr" --json compare "$folder/c.json" --db "$folder/a.db" --quiet
says out '"finished": true'
expect 0 "status" "$btr" --json status --db "$folder/a.db"
[ "$(grep -c '"run":' "$folder/out")" = 2 ] || fail "the runs were not found again"
finish
