#!/usr/bin/env bash
# The workbench as a real window on a virtual screen: it appears, shows a stored run, writes a picture and ends by its keys.
#   real_window.sh UCHILSIM DATABASE
set -u
program=$1
database=$2
command -v xvfb-run > /dev/null && command -v xdotool > /dev/null || { echo "xvfb-run and xdotool are needed"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$database" "$folder/window.db"
export XDG_RUNTIME_DIR=$folder XDG_CONFIG_HOME=$folder HOME=$folder QT_QPA_PLATFORM=xcb

cat > "$folder/session.sh" <<'S'
program=$1 folder=$2
"$program" "$folder/window.db" --select-run 1 --width 1920 --screenshot "$folder/window.png" || { echo "no picture: exit code $?"; exit 1; }
[ "$(stat -c %s "$folder/window.png")" -gt 30000 ] || { echo "the picture is empty"; exit 1; }
file "$folder/window.png" | grep -q "1920 x 1000" || { echo "the picture is no larger than the screen"; exit 1; }
"$program" "$folder/window.db" --select-run 1 &
window=$(timeout 60 xdotool search --sync --onlyvisible --name UCHILSIM | tail -n 1)
[ -n "$window" ] || { echo "no window appeared"; kill %1; exit 1; }
xdotool windowfocus --sync "$window"
xdotool key --window "$window" ctrl+q
wait %1
S
timeout 150 xvfb-run -a -s "-screen 0 1600x1000x24" bash "$folder/session.sh" "$program" "$folder" || { echo "FAILED"; exit 1; }
echo passed
