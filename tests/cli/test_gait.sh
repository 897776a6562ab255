#!/usr/bin/env bash
# Published gaits as a check on reality: the table, the same as JSON, the simulator that was adapted, and what is refused.
. "$(dirname "$0")/common.sh"

# The files that come with the program, with trials of two seconds instead of twelve.
python3 - "$root" "$folder" <<'PY'
import json, os, sys
root, out = sys.argv[1:]
for name in ("kohl_stone_start", "cmpack_turning", "upenn_2004"):
    path = os.path.join(root, "resources/gaits", name + ".json")
    gait = json.load(open(path))
    gait["scene"] = os.path.abspath(os.path.join(os.path.dirname(path), gait["scene"]))
    gait["controller"]["settings"].update(duration_s=2, lead_in_s=0.4)
    gait["fitness"]["settings"]["skip_s"] = 0.5
    json.dump(gait, open(os.path.join(out, name + ".json"), "w"))
PY
check() { "$btr" "$@" gait check "$folder/kohl_stone_start.json" "$folder/upenn_2004.json" --held-out "$folder/cmpack_turning.json" \
            --generations 2 --population 4 --adapt friction --adapt servo_p_nm_rad --seed 3 --jobs "$jobs" --out "$folder/adapted.json"; }

jobs=1
expect 0 "the table" check
for word in fitted "held out" commanded "24.5" "2.03" "cm/s" "rad/s" "adapted:"; do says out "$word"; done
[ "$(grep -c '%' "$folder/out")" = 3 ] || fail "three gaits, each in a line with its error, were expected"
cp "$folder/adapted.json" "$folder/first.json"

jobs=2
expect 0 "as JSON" check --json
cmp -s "$folder/first.json" "$folder/adapted.json" || fail "two workers found another simulator than one"
python3 - "$folder/out" "$folder/adapted.json" <<'PY' || fail "the figures do not fit each other"
import json, sys
d, adapted = (json.load(open(f)) for f in sys.argv[1:])
by = {g["gait"]: g for g in d["gaits"]}
assert len(by) == 3
fitted = [g for g in d["gaits"] if g["kind"] == "measured" and not g["held_out"]]
held = [g for g in d["gaits"] if g["held_out"]]
assert len(fitted) == 1 and len(held) == 1 and sum(g["kind"] == "commanded" for g in d["gaits"]) == 1
for group, key in ((fitted, "error"), (held, "held_out")):
    for when in ("before", "after"):
        share = abs(group[0][when] / group[0]["real"] - 1)  # of one gait the root mean square is this
        assert abs(share - d[key + "_" + when]) < 1e-9, (key, when)
assert d["error_after"] <= d["error_before"]
assert set(d["simulator"]["values"]) <= {"friction", "servo_p_nm_rad"}
assert d["simulator"]["values"] == adapted["values"]
PY

expect 1 "nothing is left to fit" "$btr" gait check "$folder/upenn_2004.json"
one_line
says err "none is left to fit"
expect 1 "a parameter that is none" "$btr" gait check "$folder/kohl_stone_start.json" --adapt grip
one_line
says err "grip"
sed 's/"ground_speed/"ground_sped/; s/"cycle_s"/"cycle"/' "$folder/kohl_stone_start.json" > "$folder/wrong.json"
expect 1 "a parameter that the controller does not have" "$btr" gait check "$folder/wrong.json"
one_line
expect 2 "no gait" "$btr" gait check
finish
