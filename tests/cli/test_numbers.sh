#!/usr/bin/env bash
# Numbers on the command line are decimal, whole texts and within their bounds, or wrong usage with one line.
. "$(dirname "$0")/common.sh"
wrong() {  # wrong "value" command…
  local value=$1
  shift
  expect 2 "$*" "$btr" "$@"
  one_line
  says err "\"$value\" is not allowed"
}
for value in "" 0x10 1e-400 1e400 nan inf "1 " fast; do
  wrong "$value" fitness enter --db x.db --run 1 --individual 1 --value "$value"
  wrong "$value" grid map --db x.db --grid 1 --distance-m "$value"
  wrong "$value" gap residual scene.json --recording r.csv --inverse --lowpass "$value"
done
for value in "" -1 18446744073709551616 0x10 1.5 1e3; do
  wrong "$value" run x.json --db x.db --seed "$value"
  wrong "$value" gap clues --db x.db --run 1 --seed "$value"
done
for value in 0 -1 "" 99999999999999999999 0x1 1.0; do
  wrong "$value" export --db x.db --run "$value" --what gaps
  says err "whole numbers from 1"
done
wrong 1025 run x.json --db x.db --jobs 1025
says err "whole numbers 0 to 1024"
# Ten is ten, with a leading zero, too: the file is looked for.
expect 1 "a leading zero" "$btr" run "$folder/none.json" --db "$folder/x.db" --seed 010
expect 1 "the largest seed" "$btr" run "$folder/none.json" --db "$folder/x.db" --seed 18446744073709551615

expect 2 "neither a file nor a run" "$btr" run --db "$folder/x.db"
one_line
expect 2 "no value" "$btr" fitness enter --db "$folder/x.db" --run 1 --individual 1
one_line
expect 2 "cells of no grid" "$btr" grid table --db "$folder/x.db" --cells "$folder/cells.csv"
one_line
expect 2 "an export is CSV" "$btr" --json export --db "$folder/x.db" --run 1 --what gaps
one_line
finish
