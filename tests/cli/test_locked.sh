#!/usr/bin/env bash
# Another process holds the database: writing ends with one sentence, reading goes on or ends too, nothing hangs; a typed
# value is in the file itself; backup and check.
. "$(dirname "$0")/common.sh"
kick_of_a_person "$folder/kick.json" <<'PY'
spec["learner"]["settings"]["population"] = 4
PY
db=$folder/kick.db
expect 10 "a run that waits" "$btr" run "$folder/kick.json" --db "$db"
ids=($("$btr" --json fitness list --db "$db" --run 1 | python3 -c 'import json,sys; print(*[t["individual"] for t in json.load(sys.stdin)])'))

# locks DB "STATEMENTS" HELD GO: runs them, opens one pipe and waits for the other
locks() {
  python3 -c '
import sqlite3, sys
c = sqlite3.connect(sys.argv[1], isolation_level=None)
for statement in sys.argv[2].split(";"): c.execute(statement).fetchall()
open(sys.argv[3], "w").close()
open(sys.argv[4]).read()' "$@"
}
# holds "STATEMENTS": another process runs them and then waits; its number is $holder
holds() {
  mkfifo "$folder/held" "$folder/go"
  locks "$db" "$1" "$folder/held" "$folder/go" &
  holder=$!
  cat "$folder/held"
}
lets_go() { : > "$folder/go"; wait $holder; rm "$folder/held" "$folder/go"; }

holds "SELECT count(*) FROM run"
expect 0 "a value beside a program that keeps the database open" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value 0.5
[ ! -s "$folder/err" ] || fail "nothing is in the way of the value: $(cat "$folder/err")"
mkdir "$folder/alone"
cp "$db" "$folder/alone/kick.db"
lets_go
expect 0 "the file that was copied alone" "$btr" export --db "$folder/alone/kick.db" --run 1 --what measurements
says out "0.5"

holds "BEGIN;SELECT count(*) FROM run"
expect 0 "a value beside a reader of an older state" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value 0.6
one_line
says err "copy with btr backup"
expect 0 "backup beside it" "$btr" backup --db "$db" "$folder/copy.db"
lets_go
expect 0 "the copy has the value" "$btr" export --db "$folder/copy.db" --run 1 --what measurements
says out "0.6"

# Each of these waits some seconds for the lock, so that a copy is locked as well and they wait together.
cp "$db" "$folder/locked.db"
mkfifo "$folder/locked-held" "$folder/locked-go"
locks "$folder/locked.db" "PRAGMA locking_mode=EXCLUSIVE;BEGIN EXCLUSIVE;COMMIT" "$folder/locked-held" "$folder/locked-go" &
locker=$!
cat "$folder/locked-held"
commands=("status" "fitness list --run 1" "export --run 1 --what generations")
for i in "${!commands[@]}"; do
  timeout 30 "$btr" ${commands[i]} --db "$folder/locked.db" > "$folder/out-$i" 2> "$folder/err-$i" &
  waiting[i]=$!
done

holds "BEGIN IMMEDIATE"
expect 1 "writing beside a writer" timeout 30 "$btr" fitness enter --db "$db" --run 1 --individual "${ids[1]}" --value 0.5
one_line
says err "another process keeps the database locked"
expect 0 "reading beside a writer" timeout 30 "$btr" status --db "$db"
lets_go

for i in "${!commands[@]}"; do
  wait "${waiting[i]}"
  got=$?
  cp "$folder/err-$i" "$folder/err"
  [ $got = 1 ] || fail "${commands[i]} beside one that lets nobody in: exit code $got instead of 1"
  one_line
  says err "another process keeps the database locked"
done
: > "$folder/locked-go"
wait $locker

expect 0 "check" "$btr" --json check --db "$db" --replays 2
says out '"identical": 2'
expect 1 "a backup over a file that is there" "$btr" backup --db "$db" "$folder/copy.db"
one_line
says err "copy.db: is there already"
expect 0 "a backup that replaces it" "$btr" backup --db "$db" "$folder/copy.db" --force
for command in "status" "check" "fitness list --run 1" "replay --run 1 --individual 1" "export --run 1 --what gaps" \
    "stop --run 1" "run --run 1" "backup $folder/none.db"; do
  expect 1 "$command of a name that is mistyped" "$btr" $command --db "$folder/kik.db"
  one_line
  says err "kik.db: there is no such file"
  [ ! -e "$folder/kik.db" ] || fail "$command has made an empty database"
done
sqlite3 "$folder/copy.db" "PRAGMA foreign_keys = OFF; INSERT INTO trace VALUES (999, x'00')"
expect 1 "a damaged file" "$btr" check --db "$folder/copy.db" --replays 0
says out "row 999 of trace refers to a row of individual that is missing"
finish
