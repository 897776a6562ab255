#!/usr/bin/env bash
# An edited experiment, scene or robot begins another run, and that is said: which keys, and how to go on with the old
# run. The status counts what was entered since the run last worked.
. "$(dirname "$0")/common.sh"
mkdir -p "$folder/scenes" "$folder/robots"
cp "$root/resources/scenes/kick.json" "$folder/scenes/"
cp "$root"/resources/robots/* "$folder/robots/"
edit() {  # FILE, lines of Python that change `it`
  python3 -c 'import json, sys
name = sys.argv[1]
it = json.load(open(name))
exec(sys.argv[2])
json.dump(it, open(name, "w"))' "$1" "$2"
}
kick_of_a_person "$folder/kick.json" <<PY
spec["scene"] = "$folder/scenes/kick.json"
PY
db=$folder/kick.db
expect 10 "a run that waits" "$btr" run "$folder/kick.json" --db "$db"
[ ! -s "$folder/err" ] || fail "nothing is to be said about the first run: $(cat "$folder/err")"
expect 0 "status" "$btr" --json status --db "$db"
says out "2 of 2 individuals wait for real fitness"
ids=($("$btr" --json fitness list --db "$db" --run 1 | python3 -c 'import json,sys; print(*[t["individual"] for t in json.load(sys.stdin)])'))
expect 0 "a value" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value 0.5
expect 0 "status after it" "$btr" --json status --db "$db"
says out "1 of 2 individuals wait for real fitness"
expect 0 "the other, void" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[1]}" --value 0.4
expect 0 "status after both" "$btr" --json status --db "$db"
says out "all values are entered; btr run goes on"
says out '"waiting_for_fitness": 0'
grep -q "wait for real" "$folder/out" && fail "nobody waits any more"

expect 10 "the same with another seed" "$btr" run "$folder/kick.json" --db "$db" --seed 5
[ ! -s "$folder/err" ] || fail "another seed is asked for, not edited: $(cat "$folder/err")"
edit "$folder/kick.json" 'it["learner"]["settings"]["population"] = 6; it["stages"]["repeats"] = 2'
expect 10 "an edited experiment" "$btr" run "$folder/kick.json" --db "$db"
one_line
says err "run 2 of the same name differs in learner.settings.population (4, now 6), stages.repeats (1, now 2); run 3 begins; to go on with run 2: --run 2"
expect 10 "it once more" "$btr" run "$folder/kick.json" --db "$db"
[ ! -s "$folder/err" ] || fail "run 3 goes on"
edit "$folder/scenes/kick.json" 'it["gravity_m_s2"] = [0, 0, -9.5]'
expect 10 "an edited scene" "$btr" run "$folder/kick.json" --db "$db"
one_line
says err "run 3 of the same name differs in scene gravity_m_s2 ("
says err "-9.5]); run 4 begins"
echo "# edited" >> "$folder/robots/ers7.wrl"
expect 10 "an edited robot" "$btr" run "$folder/kick.json" --db "$db"
one_line
says err "differs in file ../robots/ers7.wrl (sha256 "
expect 10 "the old run goes on as it was stored" "$btr" run --run 1 --db "$db"
expect 0 "its generations" "$btr" export --db "$db" --run 1 --what generations
[ "$(wc -l < "$folder/out")" = 3 ] || fail "run 1 should have learned its second generation"
finish
