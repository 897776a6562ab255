#!/usr/bin/env bash
# Makes the pictures of the manual and of README again, from the real window on a virtual screen.
#   resources/manual/pictures.sh [BIN] [NAME…]      BIN: folder of uchilsim and btr (build/release/bin); NAME: only these pictures
# Needs xvfb, xauth, xdotool and imagemagick. Takes about three minutes, most of it for the gap analysis.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
bin=$(cd "${1:-build/release/bin}" && pwd)
[ $# -gt 0 ] && shift
wanted=" $* "
for tool in xvfb-run xdotool import; do
  command -v $tool > /dev/null || { echo "$tool is needed"; exit 1; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/pictures" "$folder/report"
wants() { [ "$wanted" = "  " ] || [[ $wanted == *" $1 "* ]]; }

# What the pictures show: the shipped runs, a run that waits for a person, a small grid, a report.
cp experiments.db "$folder/shipped.db"
if wants sheet; then
  cp -r resources/scenes resources/robots "$folder"
  python3 - "$folder/person.json" "$root" <<'P'
import json, sys
out, root = sys.argv[1:]
spec = json.load(open(root + "/resources/experiments/kick-short.json"))
spec.update(scene="scenes/kick.json", reality="person", name="Kicks that a person measures")
spec["stages"].update(first_generations=12, total_generations=20, measured_individuals=5, repeats=3)
json.dump(spec, open(out, "w"))
P
  "$bin/btr" run "$folder/person.json" --db "$folder/person.db" --quiet > /dev/null || [ $? = 10 ]
  individual=$("$bin/btr" --json fitness list --db "$folder/person.db" --run 1 | grep -o '"individual": *[0-9]*' | head -n 1 | grep -o '[0-9]*$')
  "$bin/btr" fitness enter --db "$folder/person.db" --run 1 --individual "$individual" --value 0.41 --value 0.38 --value 0.44 > /dev/null
fi
if wants grid; then
  python3 - "$folder/grid.json" "$root" <<'P'
import json, sys
out, root = sys.argv[1:]
grid = json.load(open(root + "/resources/grids/kick-grid-short.json"))
grid.update(experiment=root + "/resources/experiments/kick-short.json", methods=["contamination"], seeds=[1])
grid["settings"].update(generations=8, points=20)
json.dump(grid, open(out, "w"))
P
  "$bin/btr" grid "$folder/grid.json" --db "$folder/grid.db" --quiet > /dev/null
fi
if wants report; then
  made=resources/recordings/xl330-made
  "$bin/btr" gap analyse resources/scenes/xl330.json --recording $made/made_kp200_sines.csv \
    --recording $made/made_kp400_slow.csv --held-out $made/made_kp200_chirp.csv --out "$folder/report" > /dev/null
fi

if wants openr; then
  "$bin/btr" openr build resources/openr/BallHead --out "$folder/MS" > /dev/null
  sed "s#\.\./openr/BallHead/MS#$folder/MS#; s#\.\./robots#$root/resources/robots#" resources/games/ball-follower.json > "$folder/follower.json"
fi

if wants replay; then
  "$bin/btr" live resources/games/match-2004.json --steered --log "$folder/session.log" > /dev/null <<'L'
{"do": "step", "periods": 150}
{"act": "throw", "object": "ball", "velocity_m_s": [0.7, 0.5, 0.6]}
{"do": "step", "periods": 120}
{"act": "parameter", "robot": "red1", "name": "length_m", "value": 0.03}
{"do": "step", "periods": 200}
{"act": "remove", "object": "blue1"}
{"do": "step", "periods": 200}
{"do": "end"}
L
fi

# picture NAME "KEYS" ARGUMENT…: the window as it looks after these keys
cat > "$folder/picture.sh" <<'S'
name=$1 keys=$2 folder=$3
shift 3
"$@" > "$folder/$name.log" 2>&1 &
program=$!
# A window without a picture yet is not the one that stays.
for _ in $(seq 60); do
  window=$(xdotool search --onlyvisible --name UCHILSIM | tail -n 1)
  [ -n "$window" ] && import -window root "$folder/$name.png" && [ "$(identify -format %k "$folder/$name.png")" -gt 50 ] && break
  xdotool sleep 0.5
done
[ -n "$window" ] || { cat "$folder/$name.log"; kill $program; exit 1; }
xdotool windowmove "$window" 0 0 windowsize --sync "$window" "$(xdotool getdisplaygeometry | tr ' ' '\n' | head -n 1)" \
  "$(xdotool getdisplaygeometry | tr ' ' '\n' | tail -n 1)" || true
xdotool windowfocus --sync "$window"
# The picture is taken when two in a row are the same: everything is loaded and drawn. An alarm that pulses never is.
settled() {
  local before="" now
  for _ in $(seq 20); do
    import -window root "$folder/$name.png"
    now=$(convert "$folder/$name.png" -crop 100%x97%+0+0 rgb:- | sha256sum)
    [ "$now" = "$before" ] && return 0
    before=$now
    xdotool sleep 0.7
  done
}
settled
for key in $keys; do
  # @X,Y: a click there.
  case $key in
    @*) xdotool mousemove --window "$window" ${key:1:3} ${key:5} click 1 mousemove --window "$window" 700 300 ;;
    *) xdotool key --window "$window" "$key" ;;
  esac
  settled
done
mv "$folder/$name.png" "$folder/pictures/$name.png"
xdotool key --window "$window" ctrl+q
wait $program || true
S
export QT_QPA_PLATFORM=xcb XDG_RUNTIME_DIR=$folder LC_ALL=C.UTF-8
picture() {
  local name=$1 keys=$2 size=$3
  shift 3
  wants "$name" || return 0
  mkdir -p "$folder/home-$name"
  XDG_CONFIG_HOME=$folder/home-$name HOME=$folder/home-$name timeout 150 xvfb-run -a -s "-screen 0 ${size}x24" \
    bash "$folder/picture.sh" "$name" "$keys" "$folder" "$bin/uchilsim" --look light "$@"
  echo "$name"
}
short_kick=$("$bin/btr" --json status --db "$folder/shipped.db" | python3 -c '
import json, sys
print(next(run["run"] for run in json.load(sys.stdin) if "kick, short" in run["experiment"]))')
picture window "F7" 1600x1000 "$folder/shipped.db" --select-run "$short_kick"
picture form "ctrl+n" 1440x900 "$folder/shipped.db"
picture sheet "" 1440x900 "$folder/person.db" --select-run 1
picture grid "" 1440x900 "$folder/grid.db" --grid 1
picture scene "" 1440x900 "$folder/shipped.db" --scene resources/games/match-2004.json
picture replay "Right Right Right" 1440x900 "$folder/shipped.db" --scene "$folder/session.log"
picture openr "@363,113" 1440x900 "$folder/shipped.db" --scene "$folder/follower.json"
picture gap-setup "F8" 1440x900 "$folder/shipped.db" --select-run "$short_kick"
picture report "" 1440x900 "$folder/shipped.db" --report "$folder/report"

# 256 colours: a tenth of the size, no difference to be seen.
for file in "$folder"/pictures/*.png; do
  convert "$file" -dither None -colors 256 PNG8:"resources/manual/pictures/$(basename "$file")"
done
if wants window; then cp resources/manual/pictures/window.png resources/window.png; fi
