#!/usr/bin/env bash
# btr camera: pictures of the stages, a fit to photographs of a board, errors.
. "$(dirname "$0")/common.sh"
[ -x "$(dirname "$btr")/btr-camera" ] || { echo "btr-camera is built with the window only: nothing to test"; finish; }
camera="$root/resources/cameras/ers7.json"

expect 0 "help" "$btr" camera --help
for command in apply fit fit-colour; do says out "$command"; done
expect 2 "unknown command" "$btr" camera dance
says err "btr-camera"

expect 0 "apply" "$btr" camera apply "$root/resources/window.png" --camera "$camera" --out "$folder/stages"
for name in 1-lens 2-vignetting 3-shutter 4-colour 5-noise 6-gamma 7-ycbcr picture; do
  says out "$folder/stages/$name.png"
  [ -s "$folder/stages/$name.png" ] || fail "$name.png was not written"
done
[ ! -e "$folder/stages/9-jpeg.png" ] || fail "a stage that is off has a picture"
[ "$(wc -c < "$folder/stages/picture.yuyv")" = $((2 * 208 * 160)) ] || fail "the bytes are not two a pixel"

expect 0 "the same again" "$btr" --json camera apply "$root/resources/window.png" --camera "$camera" --out "$folder/again"
says out '"picture.yuyv"'
cmp -s "$folder/stages/picture.png" "$folder/again/picture.png" || fail "the same frame has other bytes"
expect 0 "another frame" "$btr" camera apply "$root/resources/window.png" --camera "$camera" --frame 1 --out "$folder/other"
cmp -s "$folder/stages/picture.png" "$folder/other/picture.png" && fail "another frame has the same noise"

expect 0 "two stages" "$btr" camera apply "$root/resources/window.png" --camera "$camera" --only lens classes --out "$folder/only"
[ "$(ls "$folder/only")" = "$(printf '%s\n' 1-lens.png 8-classes.png classes.bytes picture.png)" ] || fail "not only two stages: $(ls "$folder/only")"
expect 0 "without two" "$btr" camera apply "$root/resources/window.png" --camera "$camera" --without noise ycbcr --out "$folder/without"
[ ! -e "$folder/without/5-noise.png" ] || fail "--without noise has noise"

expect 1 "unknown stage" "$btr" camera apply "$root/resources/window.png" --camera "$camera" --only fog --out "$folder/bad"
one_line
says err 'stage: "fog" is not allowed; one of lens, vignetting'
expect 1 "no picture" "$btr" camera apply "$camera" --camera "$camera" --out "$folder/bad"
one_line
says err "is no picture"
expect 1 "no camera" "$btr" camera apply "$root/resources/window.png" --camera "$folder/none.json" --out "$folder/bad"
one_line
expect 1 "board" "$btr" camera fit --board 9by6 --photos "$folder/stages" --camera "$camera" --out "$folder/found.json"
one_line
says err "9x6"
mkdir "$folder/empty"
expect 1 "no photographs" "$btr" camera fit --board 9x6 --photos "$folder/empty" --camera "$camera" --out "$folder/found.json"
one_line
says err "has no picture"
[ ! -e "$folder/found.json" ] || fail "a fit that failed wrote a camera"
cp "$camera" "$folder/same.json"
expect 1 "over its input" "$btr" camera fit --board 9x6 --photos "$folder/stages" --camera "$folder/same.json" --out "$folder/same.json"
one_line

public=/usr/share/doc/opencv-doc/examples/data
if [ -e "$public/left01.jpg" ]; then
  mkdir "$folder/photos"
  cp "$public"/left0[1-9].jpg "$public"/left1[1-4].jpg "$folder/photos"
  echo '{"format": "uchilsim-camera-1", "name": "thought", "width_px": 640, "height_px": 480, "focal_px": 500}' > "$folder/thought.json"
  expect 0 "fit" "$btr" camera fit --board 9x6 --photos "$folder/photos" --camera "$folder/thought.json" --out "$folder/found.json"
  says out "Held out:"
  expect 0 "fit as JSON" "$btr" --json camera fit --board 9x6 --photos "$folder/photos" --camera "$folder/thought.json" --out "$folder/found.json"
  python3 - "$folder/out" "$folder/found.json" <<'P' || failures=1
import json, sys
fit, found = (json.load(open(path)) for path in sys.argv[1:])
assert fit["held_out"]["after"] < 0.5 < fit["held_out"]["before"], fit["held_out"]
assert abs(found["focal_px"] - 536) < 10, found["focal_px"]
assert sum(photo["held_out"] for photo in fit["photos"]) == 3
P
else
  echo "not tested: a fit to photographs needs Debian's package opencv-doc"
fi
finish
