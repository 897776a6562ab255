#!/usr/bin/env bash
# Adoption, reverting and kept recordings through the real program.
. "$(dirname "$0")/common.sh"

kick_of_a_person "$folder/kick.json" < /dev/null
db=$folder/a.db
expect 10 "a run that waits" "$btr" run "$folder/kick.json" --db "$db"

cat > "$folder/simulator.json" <<'JSON'
{"format": "uchilsim-simulator-1", "values": {"friction": 0.9},
 "effects": [{"effect": "coulomb_friction", "at": "ers7.LF_J1", "parameters": {"torque_nm": 0.05}}]}
JSON
expect 0 "adopt" "$btr" gap adopt --db "$db" --run 1 --simulator "$folder/simulator.json"
says out "simulator version 1 by gap analysis"
expect 1 "adopt it twice" "$btr" gap adopt --db "$db" --run 1 --simulator "$folder/simulator.json"
one_line
says err "is this simulator already"
expect 1 "a report that is not there" "$btr" gap adopt --db "$db" --run 1 --simulator "$folder/simulator.json" --report "$folder/none"
one_line
echo '{"format": "uchilsim-simulator-1", "values": {"robots.arm.servos.elbow.p": 1}, "effects": []}' > "$folder/other.json"
expect 1 "a simulator of another robot" "$btr" gap adopt --db "$db" --run 1 --simulator "$folder/other.json"
one_line
says err "a robot of this scene, which has ers7"
expect 0 "revert" "$btr" --json gap revert --db "$db" --run 1
says out '"simulator": 2'
expect 0 "lineage" "$btr" export --db "$db" --run 1 --what simulators
says out "coulomb_friction@ers7.LF_J1"
[ "$(wc -l < "$folder/out")" = 4 ] || fail "three versions should be there"

printf 't_ms,q\n0,10\n10,20\n' > "$folder/swing.csv"
echo '{"time_s": {"column": "t_ms", "scale": 0.001}, "leg.knee.position_rad": {"column": "q"}}' > "$folder/map.json"
expect 0 "import" "$btr" gap recordings import --db "$db" --run 1 --mapping "$folder/map.json" "$folder/swing.csv"
says out "stored as recording 1, 2 rows"
expect 0 "list" "$btr" gap recordings list --db "$db"
says out "$(sha256sum "$folder/swing.csv" | cut -c1-12)"
expect 0 "export" "$btr" --json gap recordings export --db "$db" --recording 1 --out "$folder/kept"
python3 -c 'import json,sys; assert json.load(open(sys.argv[1]))[0]["recording"] == 1' "$folder/out" || fail "one JSON document"
cmp -s "$folder/swing.csv" "$folder/kept/swing.csv" || fail "the exported recording differs"
cmp -s "$folder/map.json" "$folder/kept/swing.mapping.json" || fail "the exported mapping differs"
mkdir "$folder/scenes"
cp "$folder/map.json" "$folder/scenes/rig.mapping.json"
printf 't_ms,q\n0,10\n10,30\n' > "$folder/other.csv"
expect 1 "without a mapping" "$btr" gap recordings import --db "$db" "$folder/other.csv"
one_line
says err "there is no column time_s"
expect 0 "the scene's mapping" "$btr" gap recordings import --db "$db" --scene "$folder/scenes/rig.json" "$folder/other.csv"
says out "stored as recording 2, 2 rows"
printf 't_ms,q\n10,10\n10,20\n' > "$folder/bad.csv"
expect 1 "a damaged recording" "$btr" gap recordings import --db "$db" --mapping "$folder/map.json" "$folder/bad.csv"
one_line
says err "line 3, column 1"
finish
