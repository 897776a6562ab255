#!/usr/bin/env bash
# btr live --camera: frames, video and truth of a running world; the same again from its log; errors.
. "$(dirname "$0")/common.sh"
[ -x "$(dirname "$btr")/btr-camera" ] || { echo "btr-camera is built with the window only: nothing to test"; finish; }
game="$root/resources/games/two-dogs-and-a-ball.json"
robot=red1  # an ERS-7

expect 0 "a second" "$btr" live "$game" --seconds 1 --log "$folder/log" --camera "$robot" \
  --frames "$folder/frames" --video "$folder/look.mp4" --truth "$folder/truth.csv"
# A frame ends 0.02 s after its middle: of the 31 frames that begin in this second the last is not complete.
frames=$(ls "$folder/frames"/*.png | wc -l)
[ "$frames" = 30 ] || fail "$frames frames in a second at 30 a second"
[ "$(wc -l < "$folder/truth.csv")" = $((frames + 1)) ] || fail "truth has other frames than the folder"
[ -s "$folder/look.mp4" ] || fail "no video"
python3 - "$folder/truth.csv" "$robot" << 'S' || fail "truth"
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
for number, row in enumerate(rows):
    assert int(row["frame"]) == number and abs(float(row["time_s"]) - number / 30) < 1e-9, row
    assert int(row["floor.pixels"]) > 0
    total = sum(int(value) for name, value in row.items() if name.endswith(".pixels"))
    assert total <= 208 * 160, total
assert any(name.startswith(sys.argv[2]) and name.endswith("position_rad") for name in rows[0])
assert not any(name.startswith(".") for name in rows[0]), "an object without a name"
S

expect 0 "its log" "$btr" live "$game" --replay "$folder/log" --camera "$robot" --frames "$folder/again"
says out "identical"
diff -rq "$folder/frames" "$folder/again" > "$folder/differs" || fail "frames of the log differ: $(head -3 "$folder/differs")"

expect 1 "a robot that is not there" "$btr" live "$game" --seconds 0.1 --camera nobody --frames "$folder/none"
says err "nobody"
says err "$robot"
one_line
expect 2 "frames without a camera" "$btr" live "$game" --seconds 0.1 --frames "$folder/none"
expect 1 "a folder that cannot be" "$btr" live "$game" --seconds 0.1 --camera "$robot" --video "$folder/no/where.mp4"
echo '{"format": "uchilsim-camera-1", "width_px": 1}' > "$folder/bad.json"
expect 1 "a bad camera" "$btr" live "$game" --seconds 0.1 --camera "$robot" --camera-file "$folder/bad.json" --frames "$folder/none"
says err "bad.json"
one_line
finish
