#!/usr/bin/env bash
# The same source as a plugin in the game and as a program over the open interface: the same bits. And what a program says
# when something is wrong.   programs.sh BTR ROOT PLUGINS PROGRAMS PYTHON
plugins=$3 programs=$4 python=$5
. "$(dirname "$0")/../cli/common.sh" "$1" "$2"
export UCHILSIM_PLUGINS=$plugins
games=$folder/games
mkdir -p "$games/ex" "$games/robots"
cp "$root"/resources/robots/ers7.wrl "$games/robots/"
cp "$root"/resources/robot-examples/*.json "$games/ex/"
servers=()
trap '[ ${#servers[@]} = 0 ] || kill "${servers[@]}" 2> /dev/null; wait; rm -rf "$folder"' EXIT

# waits until a file holds a text; the process $3 must live on
await() {
  while ! grep -q -- "$2" "$1" 2> /dev/null; do
    kill -0 "$3" 2> /dev/null || { echo "FAILED: it ended before it said $2"; cat "$1" "$folder"/*.err; exit 1; }
    read -rt 0.05 < <(:) || true
  done
}
# serve OPTIONS…: sets $server and $port
serve() {
  : > "$folder/serve.out"
  "$btr" --json serve --port 0 --games "$games" "$@" > "$folder/serve.out" 2> "$folder/serve.err" &
  server=$!
  servers+=("$server")
  await "$folder/serve.out" '"port"' "$server"
  port=$(grep -o '"port": *[0-9]*' "$folder/serve.out" | grep -o '[0-9]*$')
}
field() { grep -o "\"$1\": *\"[^\"]*\"" "$folder/out" | sed 's/.*"\([^"]*\)"$/\1/'; }

# Two dogs: one walks or kicks, the other walks too.
for plugin in walk kick; do
  cat > "$games/ex/$plugin.json" <<J
{"format": "uchilsim-game-1", "seed": 3,
 "scene": {"format": "uchilsim-scene-1", "step_s": 0.004, "control_period_s": 0.008, "floor": {"friction": 1},
  "robots_collide": true, "robots": [{"name": "red1", "model": "../robots/ers7.wrl", "position_m": [-0.3, 0.1, 0]},
   {"name": "blue1", "model": "../robots/ers7.wrl", "position_m": [0.5, 0, 0], "orientation_wxyz": [0.6, 0, 0, 0.8]}],
  "balls": [{"name": "ball", "position_m": [0, 0.1, 0.0425], "rolling_deceleration_m_s2": 0.4}]},
 "robots": {"red1": {"controller": {"plugin": "$plugin"}}, "blue1": {"controller": {"plugin": "half_ellipse"}}}}
J
done

serve
# same GAME ROBOT PROGRAM SECONDS
same() {
  expect 0 "$3 as a plugin" "$btr" --json live "$games/ex/$1.json" --seconds "$4"
  local plugin program
  plugin=$(field trace_sha256)
  expect 0 "$3 as a program" "$programs/$3" --server "127.0.0.1:$port" --game "ex/$1.json" --robot "$2" --seconds "$4" --json
  program=$(field trace_sha256)
  [ -n "$plugin" ] && [ "$plugin" = "$program" ] || fail "$3: the plugin's trace is $plugin, the program's $program"
  # Its log plays again without the program.
  local log=$games/$(field log)
  expect 0 "$3: the log without the program" "$btr" live "${log%.log}.json" --replay "$log"
  says out "identical to the log's"
}
same walk red1 walk 1.5
same walk blue1 half_ellipse 1.5
same kick red1 kick 3
same wall red1 stroll 12
same hand red1 petted 1
expect 0 "it stops before the wall" "$btr" live "$games/ex/wall.json" --seconds 12 --csv "$folder/wall.csv"
"$python" - "$folder/wall.csv" <<'P' || fail "stroll does not stop before the wall"
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
assert float(rows[-1]["red1.infrared.near_m"]) < 0.3, rows[-1]["red1.infrared.near_m"]
P

# Through the camera, where something can draw.
if "$btr" --json live "$games/ex/ball.json" --seconds 0.2 > "$folder/out" 2> "$folder/camera"; then
  same ball red1 ball_watcher 1
else
  grep -q "OpenGL\|drawn" "$folder/camera" || fail "no camera, and another reason than OpenGL: $(cat "$folder/camera")"
  echo "without a camera: nothing can be drawn here"
fi

# In a world that somebody else opened, with a hand at the robot's head; there it is a plugin, here a program.
"$python" - "$port" "$programs/petted" <<'P' || fail "petted by the same hand"
import subprocess, sys
import uchilsim
port, program = sys.argv[1:]
with uchilsim.Client("127.0.0.1:" + port) as client:
    hand = dict(link="HEAD", point_m=(0, 0, 0.03), target_m=(0.2, 0, 0.25))
    shas = []
    for plays in (True, False):
        with client.open("ex/hand.json") as asked:
            game = asked.game()
        # As the plugin has them: what a program senses its world must give.
        game["robots"]["red1"]["senses"] = [{"sense": name, "parameters": {}} for name in ("touch", "paws", "accelerometer")]
        if not plays:
            del game["robots"]["red1"]["controller"]
        world = client.open(game)
        world.pull("red1", **hand)
        if plays:
            state = world.step(150)
        else:
            subprocess.run([program, "--server", "127.0.0.1:" + port, "--world", world.name, "--robot", "red1",
                            "--seconds", "1.2"], check=True, stdout=subprocess.DEVNULL)
            state = world.state()
        assert state["red1.touch.head"] == 1
        assert abs(state["red1.TAIL_PAN.command_rad"]) > 0.01
        shas.append(world.close())
    assert shas[0] == shas[1], shas
P

# One sentence for each thing that is wrong.
refused() {  # "what" "the text" words…
  local what=$1 text=$2
  shift 2
  expect 1 "$what" "$@"
  says err "$text"
  one_line
}
stroll=("$programs/stroll" --server "127.0.0.1:$port")
refused "another robot" 'without_controller: "red9" is not allowed; a robot of this game' "${stroll[@]}" --game ex/wall.json --robot red9
refused "another game" 'ex/nowhere.json' "${stroll[@]}" --game ex/nowhere.json --robot red1
refused "another world" "no such world" "${stroll[@]}" --world abc --robot red1
refused "neither game nor world" "--game" "${stroll[@]}" --robot red1
refused "a parameter out of its bounds" "stop_m: 3 is not allowed" "${stroll[@]}" --game ex/wall.json --robot red1 --parameter stop_m=3
refused "a parameter that it does not have" '"stop" is not allowed' "${stroll[@]}" --game ex/wall.json --robot red1 --parameter stop=3
for number in "--seconds nan" "--seconds -1" "--seed -1" "--seed 0x10" "--seed 18446744073709551616"; do
  expect 2 "$number" "${stroll[@]}" --game ex/wall.json --robot red1 $number
  says err "\"${number#* }\" is not allowed"
done
refused "another machine without TLS" "--ca" "$programs/stroll" --server "192.0.2.1:$port" --game ex/wall.json --robot red1
refused "nobody there" "no UCHILSIM answers there" "$programs/stroll" --server 127.0.0.1:1 --game ex/wall.json --robot red1
"$python" - "$port" "${stroll[0]}" <<'P' || fail "worlds that a program cannot play in"
import subprocess, sys
import uchilsim
port, program = sys.argv[1:]
def stroll(world, robot, *more):
    return subprocess.run([program, "--server", "127.0.0.1:" + port, "--world", world.name, "--robot", robot, *more],
                          capture_output=True, text=True)
with uchilsim.Client("127.0.0.1:" + port) as client:
    with client.open("ex/walk.json") as world:
        ran = stroll(world, "red1")  # the game gives the robot no eye
        assert ran.returncode == 1 and ran.stderr.count("\n") == 1 and "infrared_near" in ran.stderr, ran.stderr
    with client.open("ex/wall.json") as world:
        game = world.game()
    game["robots"]["red1"]["senses"] = "ers7"
    with client.open(game) as world:
        ran = stroll(world, "red1")  # a plugin moves it
        assert ran.returncode == 1 and ran.stderr.count("\n") == 1 and "plugin" in ran.stderr, ran.stderr
    # A world that goes on by itself, a hundred times as fast as time: the program is late, and says so.
    del game["robots"]["red1"]["controller"]
    with client.open(game) as world:
        world.play(100)
        ran = stroll(world, "red1", "--seconds", "0.2")
        assert ran.returncode == 0, ran.stderr
        assert ran.stderr.startswith("too late in ") and ran.stderr.count("\n") == 1, ran.stderr
        assert world.state().fault == ""
P

# A program that vanishes: the server and its other worlds go on, and the log is whole as far as it came.
"$programs/stroll" --server "127.0.0.1:$port" --game ex/wall.json --robot red1 --seconds 100000 > /dev/null 2>&1 &
program=$!
"$python" - "$port" "$program" <<'P' || fail "a program that vanishes"
import os, signal, sys
import uchilsim
port, program = sys.argv[1], int(sys.argv[2])
def driven(client):
    """The program's world once it has gone on a while; worlds may close while we look."""
    while True:
        for name in client.worlds():
            try:
                world = client.world(name)
                if world.robots["red1"].controller == "" and world.state().period > 100:
                    return world
            except uchilsim.NotFound:
                pass
with uchilsim.Client("127.0.0.1:" + port) as client:
    world = driven(client)
    os.kill(program, signal.SIGKILL)
    first = world.state().period
    last = world.step(10).period
    assert last >= first + 10 and world.state().fault == ""
    log = world.log()
    assert any('"act":"orders"' in text for text in log.values())
    world.close()
P
wait "$program" 2> /dev/null
expect 0 "the server goes on" "$programs/stroll" --server "127.0.0.1:$port" --game ex/wall.json --robot red1 --seconds 0.1
# A server that vanishes.
"$programs/stroll" --server "127.0.0.1:$port" --game ex/wall.json --robot red1 --seconds 100000 > "$folder/out" 2> "$folder/err" &
program=$!
"$python" - "$port" <<'P' || fail "no world of the program"
import sys
import uchilsim
with uchilsim.Client("127.0.0.1:" + sys.argv[1]) as client:
    period = 0
    while period < 10:
        for name in client.worlds():
            try:
                period = max(period, client.world(name).state().period)
            except uchilsim.NotFound:
                pass
P
kill -KILL "$server"
wait "$server" 2> /dev/null
wait "$program"
[ $? = 1 ] || fail "the program ends well although its server is gone"
one_line
says err "no UCHILSIM answers there, or no longer"

# Who has no token, or another one, does not get in.
token=0123456789abcdef0123456789abcdef
(umask 077 && echo "drive $token lab" > "$folder/tokens")
echo "$token" > "$folder/right"
echo "${token%f}e" > "$folder/wrong"
serve --token-file "$folder/tokens"
stroll=("$programs/stroll" --server "127.0.0.1:$port" --game ex/wall.json --robot red1 --seconds 0.1)
refused "no token" "token" "${stroll[@]}"
refused "another token" "token" "${stroll[@]}" --token-file "$folder/wrong"
expect 0 "the token" "${stroll[@]}" --token-file "$folder/right"
finish
