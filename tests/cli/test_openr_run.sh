#!/usr/bin/env bash
# OPEN-R programs on robots of games: the same bits, with a log that plays again without them; two robots with two
# sticks; crashes, shutdowns, the console; a game that has a stick in it; an experiment.
. "$(dirname "$0")/common.sh"

robot=$root/resources/robots/ers7.wrl
stick=$folder/MS
cp -r "$root/resources/openr/PanPath" "$folder/PanPath"
expect 0 "build" "$btr" openr build "$folder/PanPath" --out "$stick"
cp "$folder/PanPath/MS/parameters.json" "$stick" 2> /dev/null

expect 0 "run" "$btr" openr run --game "$robot" --robot robot --stick "$stick" --seconds 2 --log "$folder/log" --csv "$folder/pan.csv"
says out "robot PanPath: pan gains 8 2 4, 0 ms ahead"
says out "2 s simulated"
sha=$(sed -n 's/^trace //p' "$folder/out")
[ ${#sha} = 64 ] || fail "no trace: $sha"
python3 - "$folder/pan.csv" <<'P' || failures=1
import csv, math, sys
rows = list(csv.DictReader(open(sys.argv[1])))
assert len(rows) == 251, len(rows)
# The command is the program's sine, a few frames late; the joint follows it.
told = [float(row["robot.HEAD_PAN.command_rad"]) for row in rows]
late = min(range(20), key=lambda n: sum(abs(told[i] - 0.5 * math.sin(2 * math.pi * 0.008 * (i - n))) for i in range(40, 240)))
assert all(abs(told[i] - 0.5 * math.sin(2 * math.pi * 0.008 * (i - late))) < 2e-6 for i in range(40, 240)), late
assert max(abs(float(row["robot.HEAD_PAN.position_rad"])) for row in rows) > 0.4
# Legs that nobody enabled are limp: it lies.
assert float(rows[-1]["robot.base.z_m"]) < float(rows[0]["robot.base.z_m"]) - 0.02
P

expect 0 "again" "$btr" --json openr run --game "$robot" --robot robot --stick "$stick" --seconds 2
says out "\"trace_sha256\": \"$sha\""
says out '"real_time_factor"'
says out '"simulated_s": 2.0'
says out '"running": true'
says err "robot PanPath: pan gains 8 2 4, 0 ms ahead"
mv "$stick" "$folder/away"
expect 0 "without the program" "$btr" live "$robot" --replay "$folder/log"
says out "identical to the log's"
says out "$sha"
mv "$folder/away" "$stick"

# Two robots with two sticks; one has other gains on it.
cp -r "$stick" "$folder/MS2"
printf 'pan_p 20\npan_d 6\nahead_ms 40\n' > "$folder/MS2/PARAMS.TXT"
python3 - "$folder/two.json" "$root" <<'P'
import json, sys
robots = [{"name": name, "model": sys.argv[2] + "/resources/robots/ers7.wrl", "position_m": [x, 0, 0]} for name, x in (("red1", -0.4), ("blue1", 0.4))]
scene = {"format": "uchilsim-scene-1", "step_s": 0.004, "control_period_s": 0.008, "floor": {"friction": 1}, "robots": robots}
game = {"format": "uchilsim-game-1", "scene": scene}
json.dump(game, open(sys.argv[1], "w"))
game["robots"] = {"red1": {"controller": {"openr": {"stick": "MS"}}}, "blue1": {"controller": {"openr": {"stick": "MS2"}}}}
json.dump(game, open(sys.argv[1].replace("two", "sticks"), "w"))
scene["control_period_s"] = 0.016
json.dump(game, open(sys.argv[1].replace("two", "slow"), "w"))
P
expect 0 "two" "$btr" openr run --game "$folder/two.json" --robot red1 --stick "$stick" --robot blue1 --stick "$folder/MS2" --seconds 1
says out "red1 PanPath: pan gains 8 2 4, 0 ms ahead"
says out "blue1 PanPath: pan gains 20 2 6, 40 ms ahead"
sha=$(sed -n 's/^trace //p' "$folder/out")
expect 0 "sticks in the game" "$btr" live "$folder/sticks.json" --seconds 1
says out "blue1 PanPath: pan gains 20 2 6, 40 ms ahead"
says out "trace $sha"
expect 0 "saved" "$btr" live "$folder/sticks.json" --seconds 1 --save "$folder/later.json"
expect 0 "what was saved" "$btr" live "$folder/later.json" --seconds 0.1

# A head that follows the ball that its camera sees: the same images every time; without OpenGL none, and that is said.
if [ -x "$(dirname "$btr")/btr-camera" ]; then
  mkdir "$folder/openr" "$folder/games"
  cp -r "$root/resources/openr/BallHead" "$folder/openr"
  ln -s "$root/resources/robots" "$folder/robots"
  cp "$root/resources/games/ball-follower.json" "$folder/games"
  expect 0 "build" "$btr" openr build "$folder/openr/BallHead" --out "$folder/openr/BallHead/MS"
  expect 0 "a ball" "$btr" live "$folder/games/ball-follower.json" --seconds 1.2 --csv "$folder/ball.csv"
  says out "red1 BallHead: there is the ball"
  sha=$(sed -n 's/^trace //p' "$folder/out")
  python3 - "$folder/ball.csv" <<'P' || failures=1
import csv, math, sys
last = list(csv.DictReader(open(sys.argv[1])))[-1]
number = lambda name: float(last[name])
neck = 0.0675  # ahead of the body's origin
bearing = math.atan2(number("ball.y_m") - number("red1.base.y_m"), number("ball.x_m") - number("red1.base.x_m") - neck)
assert abs(number("red1.HEAD_PAN.position_rad") - bearing) < 0.03, (number("red1.HEAD_PAN.position_rad"), bearing)
P
  expect 0 "the same ball" "$btr" live "$folder/games/ball-follower.json" --seconds 1.2
  says out "$sha"
  # A dog that walks to the ball, stops before it and does not touch it; its log plays again without program and camera.
  cp -r "$root/resources/openr/BallWalker" "$folder/openr"
  sed "s/\[1.0, 0.5, 0.0425\]/[0.7, 0.35, 0.0425]/" "$root/resources/games/ball-walker.json" > "$folder/games/ball-walker.json" # a shorter way
  expect 0 "build" "$btr" openr build "$folder/openr/BallWalker" --out "$folder/openr/BallWalker/MS"
  expect 0 "walk" "$btr" live "$folder/games/ball-walker.json" --seconds 9 --csv "$folder/walk.csv" --log "$folder/walk.log"
  says out "red1 BallWalker: here I am"
  python3 - "$folder/walk.csv" <<'P' || failures=1
import csv, math, sys
rows = list(csv.DictReader(open(sys.argv[1])))
place = lambda row, thing: [float(row[thing + axis]) for axis in (".x_m", ".y_m")]
assert math.dist(place(rows[0], "red1.base"), place(rows[0], "ball")) > 0.7
assert math.dist(place(rows[-1], "red1.base"), place(rows[-1], "ball")) < 0.3
assert math.dist(place(rows[0], "ball"), place(rows[-1], "ball")) < 0.001
P
  rm -r "$folder/openr/BallWalker"
  expect 0 "without program and camera" "$btr" live "$folder/games/ball-walker.json" --replay "$folder/walk.log"
  says out "identical to the log's"
  __EGL_VENDOR_LIBRARY_FILENAMES=/nowhere expect 0 "blind" "$btr" live "$folder/games/ball-follower.json" --seconds 0.2
  says out "red1: its camera gives no images"
  says out "on 0 of 0 images"
  says err "OpenGL"
fi

# What is wrong is said in one sentence.
expect 1 "another period" "$btr" live "$folder/slow.json" --seconds 1
says err "0.008"
one_line
expect 1 "no such robot" "$btr" openr run --game "$folder/two.json" --robot green1 --stick "$stick"
says err "green1"
expect 1 "no stick" "$btr" openr run --game "$folder/two.json" --robot red1 --stick "$root/tests"
says err "OBJECT.CFG"
expect 1 "one stick for two" "$btr" openr run --game "$folder/two.json" --robot red1 --robot blue1 --stick "$stick"
says err "one for each"
expect 1 "two sticks for one" "$btr" openr run --game "$folder/two.json" --robot red1 --stick "$stick" --robot red1 --stick "$folder/MS2"
says err "red1 twice"
expect 1 "the same stick twice" "$btr" openr run --game "$folder/two.json" --robot red1 --stick "$stick" --robot blue1 --stick "$stick/."
says err "a folder of its own for each robot"
expect 1 "not Sony's" "$btr" openr run --game "$root/resources/robots/emps.urdf" --robot robot --stick "$stick"
says err "ERS-7"

# A program that crashes, one that does not come back, one that reads its console and shuts the robot down.
made() {  # name, what DoStart does
  mkdir -p "$folder/$1/$1" "$folder/$1/MS/OPEN-R/MW/CONF"
  printf 'ObjectName : %s\nNumOfOSubject : 1\nNumOfOObserver : 1\nService : "%s.A.char.S", null, null\nService : "%s.B.char.O", null, null\n' "$1" "$1" "$1" > "$folder/$1/$1/stub.cfg"
  printf 'object %s 3072 16384 128 cache tlb user\n' "$1" > "$folder/$1/$1/$1.ocf"
  cat > "$folder/$1/$1/$1.h" <<H
#include <OPENR/OObject.h>
#include <OPENR/OSubject.h>
#include <OPENR/OObserver.h>
#include "def.h"
class $1 : public OObject {
 public:
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
};
H
  cat > "$folder/$1/$1/$1.cc" <<C
#include "$1.h"
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <stdio.h>
#include <string.h>
OStatus $1::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}
OStatus $1::DoStart(const OSystemEvent&) {
  OPENR::SetMotorPower(opowerON);
  $2
  return oSUCCESS;
}
C
  expect 0 "build $1" "$btr" openr build "$folder/$1" --out "$folder/$1/MS"
  [ -f "$folder/$1/MS/OPEN-R/MW/CONF/OBJECT.CFG" ] ||
    (cd "$folder/$1/MS/OPEN-R/MW/OBJS" && printf '/MS/OPEN-R/MW/OBJS/%s\n' *.BIN > ../CONF/OBJECT.CFG)
}
made Crashes '*(volatile int*)0 = 1;'
expect 1 "a crash" "$btr" openr run --game "$robot" --robot robot --stick "$folder/Crashes/MS" --seconds 1
says out "1 s simulated"
says err "robot's program ended: Crashes crashed in"
one_line
made Talks 'char line[80]; OSYSPRINT(("who?\n")); if (fgets(line, sizeof line, stdin)) OSYSPRINT(("hello %s", line)); OPENR::Shutdown(OBootCondition(0));'
cat > "$folder/lines" <<'LINES'
{"do": "step", "periods": 5}
{"do": "type", "robot": "robot", "text": "Ana\n"}
{"do": "step", "periods": 10}
{"do": "type", "robot": "robot", "text": "late\n"}
{"do": "end"}
LINES
python3 - "$folder/talks.json" "$root" "$folder" <<'P'
import json, sys
scene = {"format": "uchilsim-scene-1", "control_period_s": 0.008, "floor": {"friction": 1},
         "robots": [{"name": "robot", "model": sys.argv[2] + "/resources/robots/ers7.wrl"}]}
game = {"format": "uchilsim-game-1", "scene": scene, "robots": {"robot": {"controller": {"openr": {"stick": "Talks/MS"}}}}}
json.dump(game, open(sys.argv[1], "w"))
P
expect 0 "typed" bash -c '"$0" live "$1" --steered < "$2"' "$btr" "$folder/talks.json" "$folder/lines"
python3 - "$folder/out" <<'P' || failures=1
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
said = [text for line in lines for robot, thing, text in line.get("console", []) if thing == "Talks"]
assert said == ["who?", "hello Ana"], said
programs = [line["programs"]["robot"] for line in lines if "programs" in line]
assert programs[0] == {"running": True}, programs
assert programs[-1]["running"] is False and programs[-1]["why"] == "shutdown", programs
power = [line["orders"]["robot"]["motor_power"] for line in lines if "orders" in line]
assert power[0] is False and True in power and power[-1] is False, power
refused = [line["refused"] for line in lines if "refused" in line]
assert len(refused) == 1 and "robot" in refused[0], refused
P

# In an experiment: what evolves comes from the stick; a program that crashes is a failed trial.
python3 - "$folder/pan.json" "$root" <<'P'
import json, sys
spec = json.load(open(sys.argv[2] + "/resources/experiments/pan-gains.json"))
spec["scene"] = sys.argv[2] + "/resources/scenes/head.json"
spec["controller"]["settings"].update(stick="MS", duration_s=1.5)
spec["stages"].update(first_generations=1, next_generations=1, total_generations=2)
spec["adaptation"]["settings"]["generations"] = 1
json.dump(spec, open(sys.argv[1], "w"))
spec["controller"]["settings"]["stick"] = "Crashes/MS"
json.dump(spec, open(sys.argv[1].replace("pan", "crashes"), "w"))
P
expect 0 "experiment" "$btr" run "$folder/pan.json" --db "$folder/pan.db" --jobs 2
expect 0 "exported" "$btr" export --db "$folder/pan.db" --run 1 --what individuals
python3 - "$folder/out" <<'P' || failures=1
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
assert {"pan_p", "pan_d", "ahead_ms"} <= set(rows[0]), rows[0]
fitness = [float(row["fitness"]) for row in rows]
assert max(fitness) > -5 and len(set(fitness)) > 10, fitness
P
expect 0 "the same bits" "$btr" replay --db "$folder/pan.db" --run 1 --individual 7
says out "identical"
cp "$stick/parameters.json" "$folder/Crashes/MS"
expect 1 "all crash" "$btr" run "$folder/crashes.json" --db "$folder/crashes.db"
says err "Crashes crashed in"

finish
