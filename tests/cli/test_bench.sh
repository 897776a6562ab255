# btr bench: one table of all parts, or of those that are asked for.
. "$(dirname "$0")/common.sh"
mkdir "$folder/tmp"
export TMPDIR=$folder/tmp

expect 0 "chosen parts" "$btr" bench --parts setup --parts database --repeats 1 --individuals 5000
says out 'CPU of a trial of one step'
says out 'bytes an individual, all but traces'
says out 'open for reading'
says out 'all individuals of a run'
grep -q "live scene" "$folder/out" && fail "a part that was not asked for"
[ -z "$(ls "$folder/tmp")" ] || fail "files were left: $(ls "$folder/tmp")"

expect 0 "the same for programs" "$btr" --json bench --parts setup --repeats 1
says out '"format": "uchilsim-bench-1"'
says out '"part": "set-up"'
says out '"unit": "ms"'

expect 2 "a part that is not there" "$btr" bench --parts sleep
says err 'sleep'
expect 2 "too few individuals" "$btr" bench --individuals 10

finish
