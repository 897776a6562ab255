#!/usr/bin/env bash
# What a command writes is never what it reads, is asked about before the work, and is complete or an error.
. "$(dirname "$0")/common.sh"

kick_of_a_person "$folder/kick.json" <<'PY'
spec["name"] = "kick \x1b[31m\n"
PY
db=$folder/a.db
expect 10 "a run that waits" "$btr" run "$folder/kick.json" --db "$db"
ln -s a.db "$folder/link.db"
ln "$db" "$folder/hard.db"

untouched() { sha256sum "$1" | cut -c1-64; }
refuses() {  # refuses FILE "says" command…: exit code 1, one line, the file as it was
  local file=$1 text=$2 before
  shift 2
  before=$(untouched "$file")
  expect 1 "over $file: $*" "$btr" "$@"
  one_line
  says err "$text"
  [ "$(untouched "$file")" = "$before" ] || fail "$file was changed by $*"
}

# A name is shown, and does not steer the terminal.
expect 0 "status" "$btr" status --db "$db"
says out 'kick \x1b[31m\n'

# The database, by any of its names, and what lies beside it.
refuses "$db" "belongs to the database" export --db "$db" --run 1 --what generations --csv "$db"
refuses "$db" "belongs to the database" export --db "$db" --run 1 --what generations --csv "$folder/link.db"
refuses "$db" "belongs to the database" export --db "$folder/link.db" --run 1 --what generations --csv "$folder/hard.db"
refuses "$db" "belongs to the database" replay --db "$db" --run 1 --individual 1 --csv "$db"
refuses "$db" "belongs to the database" grid table --db "$db" --csv "$db"
refuses "$db.run-1.lock" "belongs to the database" export --db "$db" --run 1 --what generations --csv "$db.run-1.lock"
for end in -wal -shm; do
  expect 1 "$end" "$btr" export --db "$db" --run 1 --what generations --csv "$db$end"
  one_line
done
cp "$db" "$folder/other.db"
refuses "$folder/other.db" "is a database" export --db "$db" --run 1 --what generations --csv "$folder/other.db"

# Inputs, and what they name.
scene=$root/resources/scenes/xl330.json
cp -r "$root/resources/scenes" "$root/resources/robots" "$folder"
scene=$folder/scenes/xl330.json
head -40 "$root/tests/data/bam_xl330/sin_sin_kp800_2026-01-15_10h29m47.csv" > "$folder/in.csv"
mapping=$folder/scenes/xl330.mapping.json
predict="gap predict $scene --recording $folder/in.csv --mapping $mapping --out"
for input in "$folder/in.csv" "$scene" "$mapping" "$folder/robots/xl330_pendulum.urdf"; do
  refuses "$input" "is read by this command" $predict "$input"
done
ln -s in.csv "$folder/link.csv"
refuses "$folder/in.csv" "is read by this command" $predict "$folder/link.csv"
mkdir "$folder/start"
cp "$folder/scenes/xl330_friction.simulator.json" "$folder/start/simulator.json"
refuses "$folder/start/simulator.json" "is read by this command" gap analyse "$scene" --recording "$folder/in.csv" \
  --simulator "$folder/start/simulator.json" --out "$folder/start"
expect 0 "another name" "$btr" $predict "$folder/predicted.csv"
expect 0 "and again over one's own result" "$btr" $predict "$folder/predicted.csv"
ln -s target.csv "$folder/dangling.csv"
expect 0 "a link to nothing yet" "$btr" $predict "$folder/dangling.csv"
[ -L "$folder/dangling.csv" ] && cmp -s "$folder/target.csv" "$folder/predicted.csv" || fail "the link was replaced"

# Before the work: folders that cannot be made, with the reason.
analyse="gap analyse $scene --recording $folder/in.csv --mapping $mapping --out"
expect 1 "a folder below a file" "$btr" $analyse "$folder/in.csv/report"
one_line
says err "Not a directory"
expect 1 "a folder in /proc" "$btr" $analyse /proc/report
one_line
expect 1 "compare" "$btr" compare "$root/resources/comparisons/worn-knee.json" --db "$folder/c.db" --csv "$folder/none/x.csv"
one_line
says err "there is no folder"
[ ! -e "$folder/c.db" ] || fail "a comparison that cannot be written made a database"
expect 1 "gait check" "$btr" gait check "$root/resources/gaits/kohl_stone_best.json" --out "$folder/none/x.json"
one_line

# Standard output that cannot be written, and none at all.
expect 1 "a full device" bash -c '"$0" list effects > /dev/full' "$btr"
one_line
says err "standard output: cannot be written"
expect 1 "JSON to a full device" bash -c '"$0" --json status --db "$1" > /dev/full' "$btr" "$db"
one_line
expect 1 "help to a full device" bash -c '"$0" --help > /dev/full' "$btr"
expect 1 "closed standard output" bash -c '"$0" list effects >&-' "$btr"
timeout 60 "$btr" gap analyse "$scene" --recording "$folder/in.csv" --mapping "$mapping" --out "$folder/closed" --jobs 2 \
  --maximum-effects 0 --effects coulomb_friction 0<&- 1>&- 2>&-
[ $? = 1 ] || fail "an analysis without standard files should end, and say that it could not print"
[ -s "$folder/closed/report.json" ] || fail "an analysis without standard files wrote no report"

# A working run that meets the largest size of a file goes on later: what it has is kept.
expect 3 "a full disk" bash -c 'ulimit -f 500; exec "$0" run "$1" --db "$2"' "$btr" \
  "$root/resources/experiments/kick-short.json" "$folder/full.db"
one_line
says err "disk full"
expect 0 "it is there" "$btr" status --db "$folder/full.db"

# What cannot be begun leaves no database behind.
expect 1 "merge of nothing" "$btr" merge "$folder/none.db" --db "$folder/new.db"
expect 1 "run of nothing" "$btr" run "$folder/none.json" --db "$folder/new.db"
cat > "$folder/arms.json" <<JSON
{"format": "uchilsim-comparison-1", "name": "x", "seeds": [1],
 "arms": [{"name": "a", "experiment": "kick.json"}, {"name": "b", "experiment": "none.json"}]}
JSON
expect 1 "a missing arm" "$btr" compare "$folder/arms.json" --db "$folder/new.db"
one_line
says err "arms.json /arms/1/experiment: "
[ ! -e "$folder/new.db" ] || fail "a failing command left an empty database"
touch "$folder/new.db.new-999999999" "$folder/new.db.new-$$"
expect 0 "a new database" "$btr" merge "$db" --db "$folder/new.db"
[ ! -e "$folder/new.db.new-999999999" ] || fail "what a dead process left is still there"
[ -e "$folder/new.db.new-$$" ] || fail "the draft of a living process was removed"

# The lock of a run is the same through a link.
mkfifo "$folder/hold"
python3 - "$db.run-1.lock" "$folder/hold" <<'PY' &
import fcntl, struct, sys
with open(sys.argv[1], "r+") as lock:
    # F_OFD_SETLK, a write lock of the whole file
    fcntl.fcntl(lock, 37, struct.pack("hhqqi4x", fcntl.F_WRLCK, 0, 0, 0, 0))
    open(sys.argv[2], "w").close()
    open(sys.argv[2]).read()
PY
cat "$folder/hold"
expect 1 "a run that another process works on" "$btr" run --db "$folder/link.db" --run 1
one_line
says err "another process works on it"
expect 0 "status through the link" "$btr" --json status --db "$folder/link.db"
says out '"active": true'
: > "$folder/hold"
wait
[ ! -e "$folder/link.db.run-1.lock" ] || fail "a second lock file was made"
finish
