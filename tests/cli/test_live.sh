#!/usr/bin/env bash
# A match with a referee, steered by lines: what it tells, what is taken back, and the same bits from its log.
. "$(dirname "$0")/common.sh"

match=$root/resources/games/match-2004.json
cat > "$folder/lines" <<'LINES'
{"do": "step", "periods": 20}
{"act": "place", "object": "ball", "position_m": [1.9, 0.1, 0.0425], "gesture": 1}
{"act": "throw", "object": "ball", "velocity_m_s": [2, 0, 0], "gesture": 1}
{"do": "step", "periods": 60}
{"act": "remove", "object": "blue1"}
{"do": "step", "periods": 20}
{"do": "undo"}
{"do": "step", "periods": 20}
{"do": "redo"}
{"do": "redo"}
{"act": "score", "red": 3, "blue": 2}
{"act": "kick_off", "team": "blue"}
{"do": "step", "periods": 30}
{"do": "end"}
LINES
expect 0 "steered" bash -c '"$0" live "$1" --steered --log "$2" < "$3"' "$btr" "$match" "$folder/log" "$folder/lines"
python3 - "$folder/out" <<'P' || failures=1
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
undos = [(line["undo"], line["redo"]) for line in lines if "undo" in line]
wanted = [("move ball", ""), ("remove blue1", ""), ("move ball", "remove blue1"), ("remove blue1", ""), ("score", ""), ("kick-off", "")]
assert undos == wanted, undos
assert [line["refused"] for line in lines if "refused" in line] == ["redo: nothing is not allowed; an act that was taken back"]
rows = [line for line in lines if "row" in line]
assert rows[-1]["score"] == [3, 2] and rows[-1]["half"] == 1 and not rows[-1]["over"], rows[-1]["score"]
assert abs(rows[-1]["clock_s"] - 150 * 0.008) < 1e-9, rows[-1]["clock_s"]
events = [event for row in rows for event in row.get("events", [])]
assert [event["what"] for event in events] == ["goal", "kick_off", "score", "kick_off"], events
assert events[0]["team"] == "red" and abs(events[0]["x_m"] - 2.1425) < 1e-9
robots = [len(line["game"]["scene"]["robots"]) for line in lines if "game" in line]
assert robots == [2, 1, 2, 1], robots
P
expect 0 "replayed" "$btr" --json live "$match" --replay "$folder/log"
says out '"identical": true'
says out '"score"'
expect 0 "in words" "$btr" live "$match" --seconds 0.1
says out "red 0, blue 0, half 1 at 0.1"
# What stands in something else is told when it comes there and when it no longer does.
cat > "$folder/lines" <<'LINES'
{"act": "place", "object": "ball", "position_m": [1.5, 0.5, 0.0225]}
{"act": "place", "object": "ball", "position_m": [1.5, 0.6, 0.0225]}
{"do": "undo"}
{"do": "undo"}
{"do": "end"}
LINES
expect 0 "in the floor" bash -c '"$0" live "$1" --steered < "$2"' "$btr" "$match" "$folder/lines"
python3 - "$folder/out" <<'P' || failures=1
import json, sys
told = [line["overlaps"] for line in map(json.loads, open(sys.argv[1])) if "overlaps" in line]
assert told == [["ball stands 20 mm in the floor: it will be pushed out"], []], told
P
python3 - "$match" "$folder/in-one-place.json" "$root" <<'P'
import json, sys
game = json.load(open(sys.argv[1]))
game["field"] = sys.argv[3] + "/resources/fields/four-legged-2004.json"
for robot in game["scene"]["robots"]:
    robot["model"] = sys.argv[3] + "/resources/robots/ers7.wrl"
    robot["position_m"] = [0.5, 0.5, 0]
json.dump(game, open(sys.argv[2], "w"))
P
expect 0 "in one place" "$btr" live "$folder/in-one-place.json" --seconds 0.1
says err "mm inside one another: they will be pushed apart"
expect 2 "no patience" "$btr" live "$match" --patience 0

# What robots sense stands in the recording.
python3 - "$match" "$folder/senses.json" "$root" <<'P'
import json, sys
game = json.load(open(sys.argv[1]))
game["field"] = sys.argv[3] + "/resources/fields/four-legged-2004.json"
for robot in game["scene"]["robots"]:
    robot["model"] = sys.argv[3] + "/resources/robots/ers7.wrl"
game["robots"]["red1"]["senses"] = "ers7"
json.dump(game, open(sys.argv[2], "w"))
P
expect 0 "senses" "$btr" live "$folder/senses.json" --seconds 0.5 --csv "$folder/senses.csv"
head -1 "$folder/senses.csv" | tr ',' '\n' > "$folder/out"
for column in red1.accelerometer.z_m_s2 red1.infrared.near_m red1.infrared.far_m red1.infrared.chest_m red1.paw.lf red1.touch.head red1.LF_J1.sensed_rad; do
  says out "$column"
done
expect 0 "speed" "$btr" --json bench --live --seconds 1
says out '"core_share_per_dog"'

# A moment of its log as a scene, from which something else begins.
expect 0 "a moment" "$btr" live "$match" --replay "$folder/log" --seconds 0.3 --save-scene "$folder/moment.json"
python3 - "$folder/moment.json" "$match" <<'P' || failures=1
import json, sys
moment = json.load(open(sys.argv[1]))
assert moment["format"] == "uchilsim-scene-1"
ball = moment["balls"][0]
assert ball["position_m"][0] > 2 and ball["velocity_m_s"][0] > 0.5, ball  # it was thrown at 0.16 s
assert len(moment["robots"]) == 2 and all(len(robot["joint_start"]) >= 15 for robot in moment["robots"])
P
expect 0 "from there" "$btr" live "$folder/moment.json" --seconds 0.1

# The log alone plays again: its game is in it, and marks say up to where the bits are the same.
expect 0 "the log alone" "$btr" --json live --replay "$folder/log"
says out '"identical": true'
says out '"identical_until": 150'
expect 2 "neither" "$btr" live
expect 2 "a table of what others steer" "$btr" live "$match" --steered --csv "$folder/steered.csv"
says err "--csv"
expect 1 "beyond its end" "$btr" live --replay "$folder/log" --until 9
says err "at most 1.2 s"
sed 's/"velocity_m_s":\[2.0,/"velocity_m_s":[2.1,/' "$folder/log" > "$folder/other.log"
expect 1 "another throw" "$btr" live --replay "$folder/other.log"
says out "the first difference is between the steps 0 and 50"
sed '1s/"directory":.*"game_sha256"/"game_sha256"/; 1s/^{/{"format":"uchilsim-log-1",/' "$folder/log" > "$folder/old.log"
expect 1 "without its game" "$btr" live --replay "$folder/old.log"
says err "btr live GAME --replay LOG"
expect 0 "with it" "$btr" live "$match" --replay "$folder/old.log"

# Any moment of it is the start of an experiment.
expect 0 "an experiment" "$btr" live --replay "$folder/log" --until 0.3 --save-experiment "$folder/from-here.json" --learner red1
expect 1 "nobody learns" "$btr" live --replay "$folder/log" --until 0.3 --save-experiment "$folder/none.json" --learner nobody
says err "nobody"

# Steered: hands are off until it goes on from where it is; its own log then has all of it.
cat > "$folder/lines" <<'LINES'
{"act": "remove", "object": "blue1"}
{"do": "step", "periods": 120}
{"do": "go_on"}
{"act": "score", "red": 9, "blue": 9}
{"do": "step", "periods": 30}
{"do": "end"}
LINES
expect 0 "steered replay" bash -c '"$0" live --replay "$1" --steered --log "$2" < "$3"' "$btr" "$folder/log" "$folder/on.log" "$folder/lines"
python3 - "$folder/out" <<'P' || failures=1
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
told = [line["log"] for line in lines if "log" in line][0]
assert told["until"] == 150 and [act[2] for act in told["acts"]].count("remove blue1") == 2, told
assert any("a log that is played again" in line.get("refused", "") for line in lines)
rows = [line for line in lines if "row" in line]
assert "replay" in rows[0] and "replay" not in rows[-1], rows[-1]
assert rows[-1]["score"] == [9, 9]
P
expect 0 "what went on" "$btr" --json live --replay "$folder/on.log"
says out '"identical": true'

# What is wrong with the parts of a game together names its file.
sed "s|\"walk\"|\"wlak\"|; s|\.\./|$root/resources/|" "$root/resources/games/two-dogs-and-a-ball.json" > "$folder/wrong.json"
expect 1 "an unknown controller" "$btr" live "$folder/wrong.json"
one_line
says err "$folder/wrong.json: robots red1/controller: \"wlak\" is not allowed; known: "

finish
