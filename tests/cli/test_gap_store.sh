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

# The same for a scene that no run belongs to.
cat > "$folder/leg.urdf" <<'XML'
<robot name="leg">
  <link name="stand"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="knee" type="continuous"><parent link="stand"/><child link="shin"/><axis xyz="0 1 0"/></joint>
  <link name="shin"><inertial><origin xyz="0 0 -0.1"/><mass value="0.2"/>
    <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>
XML
cat > "$folder/bench.json" <<'JSON'
{"format": "uchilsim-scene-1", "robots": [{"name": "leg", "model": "leg.urdf", "base": "fixed",
 "servos": {"knee": {"p": 4, "i": 0, "d": 0.03, "max_torque_nm": 1}}}]}
JSON
echo '{"format": "uchilsim-simulator-1", "values": {"robots.leg.servos.knee.p": 3.5}, "effects": []}' > "$folder/found.json"
expect 1 "a rig that is not there" "$btr" gap versions --db "$db" --rig "$folder/bench.json"
one_line
says err "has nothing of this rig"
expect 2 "neither run nor rig" "$btr" gap adopt --db "$db" --simulator "$folder/found.json"
expect 2 "run and rig" "$btr" gap revert --db "$db" --run 1 --rig "$folder/bench.json"
expect 0 "adopt for a rig" "$btr" gap adopt --db "$db" --rig "$folder/bench.json" --simulator "$folder/found.json"
says out "rig bench: simulator version 1 by gap analysis"
expect 0 "go back" "$btr" --json gap revert --db "$db" --rig "$folder/bench.json"
says out '"simulator": 2'
expect 0 "versions" "$btr" --json gap versions --db "$db" --rig "$folder/bench.json"
python3 -c 'import json,sys; v=json.load(open(sys.argv[1])); assert [x["parent"] for x in v] == [None, 0, 1], v' "$folder/out" || fail "three versions of the rig"
expect 0 "a version as a file" "$btr" gap versions --db "$db" --rig "$folder/bench.json" --version 1 --out "$folder/again.json"
python3 -c 'import json,sys; a,b=(json.load(open(f)) for f in sys.argv[1:]); assert a["values"] == b["values"]' "$folder/again.json" "$folder/found.json" || fail "the version differs"
expect 1 "a version that is not there" "$btr" gap versions --db "$db" --rig "$folder/bench.json" --version 9 --out "$folder/none.json"
one_line
says err "a version from 0 to 2"
expect 0 "a run's version as a file" "$btr" gap versions --db "$db" --run 1 --version 1 --out "$folder/of_run.json"
grep -q coulomb_friction "$folder/of_run.json" || fail "the run's version has its effect"

printf 't_ms,q\n0,10\n10,20\n' > "$folder/swing.csv"
echo '{"time_s": {"column": "t_ms", "scale": 0.001}, "leg.knee.position_rad": {"column": "q"}}' > "$folder/map.json"
expect 0 "import" "$btr" gap recordings import --db "$db" --run 1 --mapping "$folder/map.json" "$folder/swing.csv"
says out "stored as recording 1, 2 rows"
expect 1 "whose" "$btr" gap recordings list --db "$db"
one_line
says err "give --run, --experiment or --rig"
expect 0 "list" "$btr" gap recordings list --db "$db" --run 1
says out "$(sha256sum "$folder/swing.csv" | cut -c1-12)"
expect 0 "export" "$btr" --json gap recordings export --db "$db" --recording 1 --out "$folder/kept"
python3 -c 'import json,sys; assert json.load(open(sys.argv[1]))[0]["recording"] == 1' "$folder/out" || fail "one JSON document"
cmp -s "$folder/swing.csv" "$folder/kept/swing.csv" || fail "the exported recording differs"
cmp -s "$folder/map.json" "$folder/kept/swing.mapping.json" || fail "the exported mapping differs"
mkdir "$folder/scenes"
cp "$folder/map.json" "$folder/scenes/rig.mapping.json"
printf 't_ms,q\n0,10\n10,30\n' > "$folder/other.csv"
expect 1 "without a mapping" "$btr" gap recordings import --db "$db" --run 1 "$folder/other.csv"
one_line
says err "there is no column time_s"
expect 0 "the scene's mapping" "$btr" gap recordings import --db "$db" --run 1 --scene "$folder/scenes/rig.json" "$folder/other.csv"
says out "stored as recording 2, 2 rows"
expect 0 "keep it with the rig" "$btr" gap recordings import --db "$db" --rig "$folder/bench.json" --mapping "$folder/map.json" "$folder/swing.csv"
expect 0 "the rig's" "$btr" --json gap recordings list --db "$db" --rig "$folder/bench.json"
python3 -c 'import json,sys; assert [r["recording"] for r in json.load(open(sys.argv[1]))] == [3]' "$folder/out" || fail "one recording of the rig"
printf 't_ms,q\n10,10\n10,20\n' > "$folder/bad.csv"
expect 1 "a damaged recording" "$btr" gap recordings import --db "$db" --run 1 --mapping "$folder/map.json" "$folder/bad.csv"
one_line
says err "line 3, column 2"
expect 1 "a damaged one makes no database" "$btr" gap recordings import --db "$folder/fresh.db" --rig "$folder/bench.json" --mapping "$folder/map.json" "$folder/bad.csv"
[ -e "$folder/fresh.db" ] && fail "an empty database was left"
expect 0 "a rig needs no database of runs" "$btr" gap recordings import --db "$folder/fresh.db" --rig "$folder/bench.json" --mapping "$folder/map.json" "$folder/swing.csv"
sed 's/"p": 4/"p": 5/' "$folder/bench.json" > "$folder/other.json"
expect 1 "a damaged one of a new rig" "$btr" gap recordings import --db "$folder/fresh.db" --rig "$folder/other.json" --mapping "$folder/map.json" "$folder/bad.csv"
expect 1 "leaves no empty rig behind" "$btr" gap recordings list --db "$folder/fresh.db" --rig "$folder/other.json"
one_line
says err "has nothing of this rig"
finish
