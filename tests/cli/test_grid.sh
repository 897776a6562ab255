#!/usr/bin/env bash
# btr grid: what it refuses; a small copy of the example runs to its end, is found again, and is shown.
. "$(dirname "$0")/common.sh"
expect 1 "no such file" "$btr" grid "$folder/none.json" --db "$folder/a.db"
one_line
expect 2 "no database" "$btr" grid "$folder/none.json"
expect 2 "neither file nor command" "$btr" grid --db "$folder/a.db"
sed -e 's/"population": [0-9]*/"population": 4/' -e "s#\.\./scenes#$root/resources/scenes#" \
  "$root/resources/experiments/kick-short.json" > "$folder/kick.json"
sed -e 's#\.\./experiments/kick-short.json#kick.json#' -e 's/"generations": 15/"generations": 1/' -e 's/"points": 200/"points": 2/' \
  -e 's/\[-0.5236, 0, 0.5236\]/[0]/' "$root/resources/grids/kick-grid-short.json" > "$folder/grid.json"
sed -e 's/0.18/0.8/' "$folder/grid.json" > "$folder/far.json"
expect 1 "a distance that the kick does not know" "$btr" grid "$folder/far.json" --db "$folder/b.db"
one_line
says err "/distances_m: 0.8 is not allowed"
expect 1 "a method that is none" "$btr" grid "$folder/grid.json" --db "$folder/b.db" --method similar
says err "independent, contamination or similarity"
expect 0 "a small grid" "$btr" grid "$folder/grid.json" --db "$folder/a.db" --workers 2 --csv "$folder/m.csv"
says out "mirror image of cell"
says out "contamination"
[ "$(wc -l < "$folder/m.csv")" = 4 ] || fail "a header and three methods were expected"
cp "$folder/m.csv" "$folder/first.csv"
expect 0 "again" "$btr" --json grid "$folder/grid.json" --db "$folder/a.db" --csv "$folder/m.csv"
says out '"format": "uchilsim-grids-1"'
cmp -s "$folder/m.csv" "$folder/first.csv" || fail "the table changed"
expect 2 "a file and a stored grid" "$btr" grid "$folder/grid.json" --db "$folder/a.db" --grid 1
expect 2 "a stored grid has its method" "$btr" grid --db "$folder/a.db" --grid 1 --method similarity
expect 0 "a stored grid without its file" "$btr" grid --db "$folder/a.db" --grid 1 --csv "$folder/m.csv"
cmp -s "$folder/m.csv" "$folder/first.csv" || fail "the table of a stored grid is another one"
expect 1 "a stored grid that is none" "$btr" grid --db "$folder/a.db" --grid 99
one_line
expect 1 "no database" "$btr" grid --db "$folder/none.db" --grid 1
[ ! -e "$folder/none.db" ] || fail "a database was made for a grid that cannot be there"
expect 0 "status" "$btr" --json status --db "$folder/a.db"
[ "$(grep -c '"run":' "$folder/out")" = 18 ] || fail "18 runs were expected, one for each cell and method"
expect 0 "table" "$btr" grid table --db "$folder/a.db" --grid 1 --cells "$folder/cells.csv" --points "$folder/points.csv"
[ "$(wc -l < "$folder/cells.csv")" = 7 ] || fail "a header and six cells were expected"
[ "$(wc -l < "$folder/points.csv")" = 3 ] || fail "a header and two points were expected"
individual=$(tail -1 "$folder/cells.csv" | cut -d, -f13)
run=$(tail -1 "$folder/cells.csv" | cut -d, -f12)
expect 0 "a cell's solution is replayed" "$btr" replay --db "$folder/a.db" --run "$run" --individual "$individual"
expect 0 "one kick" "$btr" grid kick --db "$folder/a.db" --grid 1 --distance-m 0.15 --bearing-rad 0.1 --direction-rad 0
says out "fitness"
expect 1 "a kick outside" "$btr" grid kick --db "$folder/a.db" --grid 1 --distance-m 0.15 --bearing-rad 0.6 --direction-rad 0
says err "bearing_rad: 0.6 is not allowed; -0.35 to 0.35"
expect 0 "a map" "$btr" --json grid map --db "$folder/a.db" --grid 1 --distance-m 0.14 --columns 3 --rows 1
says out '"format": "uchilsim-grid-map-1"'
expect 1 "an unknown grid" "$btr" grid map --db "$folder/a.db" --grid 99 --distance-m 0.14
says err "grid 99"
finish
