#!/usr/bin/env bash
# btr live --steered: every control period of the channels that were asked for, and of no others.
. "$(dirname "$0")/common.sh"
cat > "$folder/session.py" <<'PY'
import json, subprocess, sys

btr, game = sys.argv[1:]
lines = [
    {"do": "step", "periods": 7},
    {"do": "signals", "channels": ["time_s", "nobody.x_m"]},
    {"do": "step", "periods": 100},
    {"act": "add", "ball": {"name": "later", "position_m": [1, 1, 0.0425]}},
    {"do": "step", "periods": 3},
    {"do": "signals", "channels": ["later.x_m"]},
    {"do": "step", "periods": 2},
    {"do": "signals", "channels": []},
    {"do": "step", "periods": 2},
    {"do": "signals", "channels": ["time_s"] * 101},
]
told = subprocess.run([btr, "live", game, "--steered"], input="\n".join(map(json.dumps, lines)) + "\n",
                      capture_output=True, text=True, check=True).stdout
wanted, samples, refused = None, {}, []
for line in map(json.loads, told.splitlines()):
    if "signals" in line:
        wanted = tuple(line["signals"])
    if "refused" in line:
        refused.append(line["refused"])
    for sample in line.get("samples", []):
        assert len(sample) == len(wanted) + 1, line
        samples.setdefault(wanted, []).append(sample)
first = samples[("time_s", "nobody.x_m")]
assert [s[0] for s in first] == list(range(8, 111)), [s[0] for s in first]
assert all(abs(s[1] - 0.008 * s[0]) < 1e-9 and s[2] is None for s in first)
later = samples[("later.x_m",)]
assert [s[0] for s in later] == [111, 112] and all(abs(s[1] - 1) < 1e-6 for s in later), later
assert len(samples) == 2 and len(refused) == 1 and "100" in refused[0], (samples.keys(), refused)
PY
cat > "$folder/game.json" <<EOF
{"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1", "step_s": 0.008, "control_period_s": 0.008,
 "floor": {"friction": 1}, "balls": [{"name": "ball", "position_m": [0, 0, 0.0425]}]}}
EOF
python3 "$folder/session.py" "$btr" "$folder/game.json" || fail "the samples are not those of every control period"
finish
