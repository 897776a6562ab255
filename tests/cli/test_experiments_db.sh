#!/usr/bin/env bash
# The database that a newcomer's first window shows: it opens, holds a finished run with three updates, and says that its
# reality is a stand-in.
. "$(dirname "$0")/common.sh"
cp "$root/experiments.db" "$folder/experiments.db"
expect 0 "status" "$btr" --json status --db "$folder/experiments.db"
says out '"state": "finished"'
says out '"reality": "stand_in"'
says out '"generation": 150'
expect 0 "gaps" "$btr" export --db "$folder/experiments.db" --run 1 --what gaps
[ "$(wc -l < "$folder/out")" = 4 ] || fail "three gaps and a header were expected"
says out stand_in
expect 0 "replay" "$btr" replay --db "$folder/experiments.db" --run 1 --individual 1
[ ! -e "$root/experiments.db-wal" ] || fail "a log lies beside the shipped database"
finish
