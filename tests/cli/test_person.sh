#!/usr/bin/env bash
# A run whose reality is a person: it waits (exit code 10), takes values by hand and by file, adapts, goes on, finishes.
. "$(dirname "$0")/common.sh"

kick_of_a_person "$folder/kick.json" <<'PY'
spec["seed"] = 2  # some of its first kicks touch the ball, which simulators may disagree about
spec["learner"]["settings"]["population"] = 6
spec["adaptation"]["learner"]["settings"]["population"] = 4
spec["adaptation"]["settings"].update(generations=2, held_out=1)
spec["stages"].update(first_generations=2, next_generations=2, total_generations=4, measured_individuals=3,
                      disagreeing_individuals=1, candidate_simulators=3)
PY
db=$folder/person.db

expect 10 "first stage" "$btr" run "$folder/kick.json" --db "$db"
says out "waiting"
expect 10 "waiting is not over by asking again" "$btr" run "$folder/kick.json" --db "$db"
expect 0 "list" "$btr" fitness list --db "$db" --run 1
says out "hidden"
expect 0 "list as JSON" "$btr" --json fitness list --db "$db" --run 1
grep -q simulated_fitness "$folder/out" && fail "the simulated fitness is not hidden"
says out '"reason": "best"'
says out '"reason": "candidate simulators disagree"'
grep -q -e "disagreement" -e "rank" "$folder/out" && fail "rank and spread are not hidden"
expect 0 "why, in numbers" "$btr" fitness list --db "$db" --run 1 --show-simulated
says out "best, rank 1"
says out "candidate simulators disagree: ±"
expect 0 "list as JSON" "$btr" --json fitness list --db "$db" --run 1
ids=($(python3 -c 'import json,sys; print(*[t["individual"] for t in json.load(open(sys.argv[1]))])' "$folder/out"))
[ ${#ids[@]} = 3 ] || fail "3 individuals should wait, not ${#ids[@]}"

expect 1 "an individual that nobody asked for" "$btr" fitness enter --db "$db" --run 1 --individual 9999 --value 1
one_line
expect 2 "a value that is none" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value fast
expect 2 "no value at all" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}"
one_line
for value in 1e308 -1e308 1000000001; do
  expect 1 "a value that no gap can be made of" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value $value
  one_line
  says err "-1e+09 to 1e+09"
done
expect 1 "a note that is not UTF-8" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value 1 --yes --note $'\xff\xfe'
one_line
says err "note: the byte 0xFF"
printf 'individual,value,note\n%s,1,d\351rap\303\251\n' "${ids[0]}" > "$folder/latin.csv"
expect 1 "a table in Latin-1" "$btr" fitness import --db "$db" --run 1 "$folder/latin.csv"
one_line
says err "latin.csv line 2, column 3: the byte 0xE9"
mkfifo "$folder/pipe"
expect 1 "a pipe" timeout 20 "$btr" fitness import --db "$db" --run 1 "$folder/pipe"
one_line
expect 1 "a run that is not there" "$btr" fitness import --db "$db" --run 3 "$folder/latin.csv"
one_line
says err "run 3 is not in the database"
expect 1 "a kick of less than nothing" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value -0.5 --yes
one_line
says err "-0.5 m is not possible"
expect 1 "a kick of a thousand kilometres" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value 0.5 --value 1000000
one_line
says err "1e+06 m is about"
says err "--yes"
printf 'individual,value_ft\n%s,1\n' "${ids[0]}" > "$folder/feet.csv"
expect 1 "a unit that is not known" "$btr" fitness import --db "$db" --run 1 "$folder/feet.csv"
one_line
says err 'feet.csv line 1, column 2: values in the unit "ft"'
printf 'individual,value\n%s,0.5\n%s,5000\n' "${ids[0]}" "${ids[1]}" > "$folder/slip.csv"
expect 1 "a table with a slip" "$btr" fitness import --db "$db" --run 1 "$folder/slip.csv"
one_line
says err "slip.csv line 3: 5000 m"
expect 0 "nothing of it was stored" "$btr" --json fitness list --db "$db" --run 1
grep -q '"measurement"' "$folder/out" && fail "a doubtful value was stored"
expect 0 "one by hand" "$btr" fitness enter --db "$db" --run 1 --individual "${ids[0]}" --value 0.5 --value 0.7 --note "new battery" --yes
printf 'individual,value,note,void\n%s,0.25,,\n%s,zero,,\n' "${ids[1]}" "${ids[2]}" > "$folder/wrong.csv"
expect 1 "a table with a word for a number" "$btr" fitness import --db "$db" --run 1 "$folder/wrong.csv"
one_line
says err "line 3"
expect 0 "what was stored" "$btr" --json fitness list --db "$db" --run 1
grep -q '0.25' "$folder/out" && fail "half a table was stored"
printf 'individual,value [cm],note,void\n%s,25,,\n%s,0,"fell, on its nose",1\n' "${ids[1]}" "${ids[2]}" > "$folder/right.csv"
expect 0 "the table mended" "$btr" fitness import --db "$db" --run 1 "$folder/right.csv"

expect 0 "what counts" "$btr" fitness list --db "$db" --run 1
says out "0/1"
says out "0 (void)"

# A stored value can be made void and valid again, and annotated; it is never deleted.
expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
measurement() { python3 -c 'import json,sys; print([v[sys.argv[3]] for t in json.load(open(sys.argv[1])) for v in t["values"] if v["measurement"] == int(sys.argv[2])][0])' "$folder/out" "$@"; }
[ "$(measurement 1 void)" = False ] || fail "the first value should count"
expect 0 "void" "$btr" fitness void --db "$db" --run 1 --measurement 1
expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
[ "$(measurement 1 void) $(measurement 1 note)" = "True new battery" ] || fail "it should be void, with its note"
expect 0 "undo, with a note" "$btr" --json fitness void --db "$db" --run 1 --measurement 1 --undo --note "as it was"
says out '"void": false'
expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
[ "$(measurement 1 void) $(measurement 1 note)" = "False as it was" ] || fail "it should count, with the new note"
expect 1 "a measurement that is not there" "$btr" fitness void --db "$db" --run 1 --measurement 99
one_line
expect 1 "a note that is not UTF-8" "$btr" fitness void --db "$db" --run 1 --measurement 1 --note $'\xff'
one_line
expect 0 "as it was before" "$btr" fitness void --db "$db" --run 1 --measurement 1 --undo --note "new battery"

expect 10 "second stage" "$btr" run "$folder/kick.json" --db "$db"
expect 0 "gaps" "$btr" export --db "$db" --run 1 --what gaps
says out "stage"
[ "$(wc -l < "$folder/out")" = 2 ] || fail "one gap was expected"
expect 0 "a value is void after L3 took it in" "$btr" fitness void --db "$db" --run 1 --measurement 1
says err "simulator version 1 was adapted to this value (stage 1)"
says err "--version 0"
expect 0 "it counts again" "$btr" fitness void --db "$db" --run 1 --measurement 1 --undo
expect 0 "status says the gap on the held-out individual, too" "$btr" status --db "$db"
says out "held-out gap"
expect 0 "status" "$btr" --json status --db "$db"
says out '"held_out_individuals": '
expect 0 "measurements" "$btr" export --db "$db" --run 1 --what measurements
says out "person"
says out "new battery"

expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
for id in $(python3 -c 'import json,sys; print(*[t["individual"] for t in json.load(open(sys.argv[1]))])' "$folder/out"); do
  expect 0 "enter" "$btr" fitness enter --db "$db" --run 1 --individual "$id" --value 0.4 --yes
done
expect 0 "the end" "$btr" run "$folder/kick.json" --db "$db"
expect 0 "status" "$btr" --json status --db "$db"
says out '"state": "finished"'
says out '"generation": 4'
says out '"held_out_individuals": 1'
for what in generations individuals gaps simulators; do
  expect 0 "export $what" "$btr" export --db "$db" --run 1 --what $what --csv "$folder/$what.csv"
done
[ "$(wc -l < "$folder/generations.csv")" = 5 ] || fail "four generations and a header were expected"
[ "$(wc -l < "$folder/individuals.csv")" = 25 ] || fail "24 individuals and a header were expected"
[ "$(wc -l < "$folder/simulators.csv")" = 4 ] || fail "three simulators and a header were expected"

for id in 1 "${ids[0]}" 24; do
  expect 0 "replay $id" "$btr" replay --db "$db" --run 1 --individual "$id"
  says out "identical to the stored run"
done
expect 1 "replay of nobody" "$btr" replay --db "$db" --run 1 --individual 12345
one_line

# The same with L2: policies wait like individuals do, and go in by hand and by file.
python3 - "$folder/kick.json" "$folder/l2.json" <<'PY'
import json, sys
spec = json.load(open(sys.argv[1]))
spec["name"] += " with L2"
spec["reality_learning"] = {"learner": {"name": "pgrl", "settings": {"policies": 3, "measure_centre": "yes"}},
                            "settings": {"iterations": 1, "repeats": 2}}
json.dump(spec, open(sys.argv[2], "w"))
PY
db=$folder/l2.db
measure_all() {  # by file: two values each
  expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
  python3 - "$folder/out" > "$folder/all.csv" <<'PY'
import json, sys
print("individual,value")
for t in json.load(open(sys.argv[1])):
    for repeat in range(t["wanted_repeats"]):
        print(f'{t["individual"]},{0.3 + 0.01 * t["position"] + 0.002 * repeat}')
PY
  expect 0 "import" "$btr" fitness import --db "$db" --run 1 --yes "$folder/all.csv"
}
expect 10 "L1" "$btr" run "$folder/l2.json" --db "$db"
measure_all
expect 10 "L2 waits" "$btr" run "$folder/l2.json" --db "$db"
says out "L2 in stage 1, iteration 1: 4 of 4 policies wait for real fitness"
expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
[ "$(grep -c '"iteration": 1' "$folder/out")" = 4 ] || fail "three policies and the centre should wait"
grep -q simulated_fitness "$folder/out" && fail "the simulated fitness of policies is not hidden"
policy=$(python3 -c 'import json,sys; print(json.load(open(sys.argv[1]))[0]["individual"])' "$folder/out")
expect 0 "a policy by hand" "$btr" fitness enter --db "$db" --run 1 --individual "$policy" --value 0.6 --value 0.62 --yes
measure_all
expect 0 "replay of a policy" "$btr" replay --db "$db" --run 1 --individual "$policy"
says out "identical to the stored run"
expect 10 "the next stage" "$btr" run "$folder/l2.json" --db "$db"
expect 0 "policies" "$btr" export --db "$db" --run 1 --what policies
[ "$(wc -l < "$folder/out")" = 5 ] || fail "four policies and a header were expected"
expect 0 "steps" "$btr" export --db "$db" --run 1 --what steps
[ "$(wc -l < "$folder/out")" = 26 ] || fail "25 parameters and a header were expected"
measure_all
expect 0 "the end" "$btr" run "$folder/l2.json" --db "$db"

# A person ends L2 after two of its four policies: they stay, nobody asks for the others, the run goes on.
db=$folder/ended.db
expect 10 "L1" "$btr" run "$folder/l2.json" --db "$db"
expect 1 "L2 has not begun" "$btr" end-l2 --db "$db" --run 1
one_line
measure_all
expect 10 "L2 waits" "$btr" run "$folder/l2.json" --db "$db"
expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
for id in $(python3 -c 'import json,sys; print(*[t["individual"] for t in json.load(open(sys.argv[1]))][:2])' "$folder/out"); do
  expect 0 "enter" "$btr" fitness enter --db "$db" --run 1 --individual "$id" --value 0.9 --value 0.91 --yes
done
expect 0 "it is enough" "$btr" --json end-l2 --db "$db" --run 1
expect 10 "the next stage waits" "$btr" run "$folder/l2.json" --db "$db"
expect 0 "policies" "$btr" export --db "$db" --run 1 --what policies
[ "$(grep -c ',2,person,' "$folder/out")" = 2 ] || fail "two policies were measured twice each"
expect 0 "list" "$btr" --json fitness list --db "$db" --run 1
grep -q '"iteration": 1' "$folder/out" && fail "policies of an L2 that was ended are asked for"
measure_all
expect 0 "the end" "$btr" run "$folder/l2.json" --db "$db"
finish
