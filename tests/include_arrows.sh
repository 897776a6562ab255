#!/usr/bin/env bash
# Arrows point one way: ui, app → remote, cluster → live, run → gap, store, plugin, camera → learn, sim → model → spec; inside gap: proof → report → search →
# fit → replay → recordings; inside run: loop → reality → setup.
# Reads every #include "..." and names each that points the wrong way.
set -u
cd "${1:-$(dirname "$0")/..}" || exit 2
declare -A may=(
  [core/spec]="core/spec"
  [core/model]="core/spec core/model"
  [core/sim]="core/spec core/model core/sim"
  [core/learn]="core/spec core/learn"
  [core/plugin]="core/spec core/model core/sim core/learn core/plugin"
  [core/gap/recordings]="core/spec core/model core/sim core/learn core/plugin core/gap/recordings"
  [core/gap/replay]="core/spec core/model core/sim core/learn core/plugin core/gap/recordings core/gap/replay"
  [core/gap/fit]="core/spec core/model core/sim core/learn core/plugin core/gap/recordings core/gap/replay core/gap/fit"
  [core/gap/search]="core/spec core/model core/sim core/learn core/plugin core/gap/recordings core/gap/replay core/gap/fit core/gap/search"
  [core/gap/report]="core/spec core/model core/sim core/learn core/plugin core/gap/recordings core/gap/replay core/gap/fit core/gap/search core/gap/report"
  [core/gap/proof]="core/spec core/model core/sim core/learn core/plugin core/gap"
  [core/store]="core/spec core/model core/sim core/learn core/store"
  [core/run]="core/spec core/model core/sim core/learn core/plugin core/gap core/store core/run"
  [core/run/setup]="core/spec core/model core/sim core/learn core/plugin core/gap core/store core/run/setup"
  [core/run/reality]="core/spec core/model core/sim core/learn core/plugin core/gap core/store core/run/setup core/run/reality"
  [core/run/loop]="core/spec core/model core/sim core/learn core/plugin core/gap core/store core/run/setup core/run/reality core/run/loop"
  [core/cluster]="core/spec core/model core/sim core/learn core/plugin core/gap core/store core/run core/cluster"
  [core/camera]="core/spec core/camera"
  [core/live]="core/spec core/model core/sim core/plugin core/live"
  [core/remote]="core/spec core/model core/sim core/learn core/plugin core/robot core/store core/run core/live core/remote"
  [core/openr]="core/spec core/model core/sim core/plugin core/live core/openr"
  [core/robot]="core/spec core/model core/sim core/learn core/plugin core/robot"
  [plugins]="core/plugin core/robot"
  [ui]="core ui"
  [app]="core ui app"
)
bad=0
check() {  # file, layer
  local file=$1 layer=$2 target ok prefix
  while read -r target; do
    ok=0
    for prefix in ${may[$layer]}; do [[ $target == "$prefix"/* ]] && ok=1; done
    [ $ok = 1 ] || { echo "$file includes \"$target\": not allowed from $layer"; bad=1; }
  done < <(sed -nE 's/^[[:space:]]*#include "((core|ui|app|plugins|tests)\/[^"]+)".*/\1/p' "$file")
}
for layer in "${!may[@]}"; do
  while IFS= read -r file; do check "$file" "$layer"; done < <(find "$layer" -name '*.cpp' -o -name '*.h' 2>/dev/null)
done
# Of core the window sees what the user asked for (spec), the public headers of runs, store and plugins, and what it
# draws: models, trials, recordings and reports. A header that is not here is an inner part: add it only if it is not.
declare -A public=(
  [store]="database network_file records"
  [plugin]="plugin_host reality"
  [run]="comparison replay"
  [run/loop]="back_to_reality"
  [run/setup]="prepared_experiment spec_changes"
  [run/reality]="adoption fitness_clues measured_import plausibility reality_gap reality_report resting_simulator rig
    spread stored_recordings"
  [run/grid]="grid grid_cells grid_kicks grid_losses grid_table"
  [model]="kinematics robot_model"
  [sim]="model_losses scene trace trial"
  [sim/contact]="obstacle_shape"
  [live]="act game number_groups session_log session_players"
  [camera]="camera_pipeline camera_spec picture_file pinhole point_files truth_file twin video_file"
  [gap/recordings]="channel_name mapping recording"
  [gap/recordings/doctor]="doctor objection recording_health"
  [gap/recordings/table]="table_preview"
  [gap/replay]="number_table residual trial_scenes"
  [gap/search]="gap_report report_words"
  [gap/report]="report_figures report_files report_html report_json report_lead report_text"
  [gap/proof]="proof_marks"
)
seen=" "
for folder in "${!public[@]}"; do
  for header in ${public[$folder]}; do
    seen+="core/$folder/$header.h "
    [ -f "core/$folder/$header.h" ] || { echo "core/$folder/$header.h is listed for the window and is not there"; bad=1; }
  done
done
while IFS=: read -r file target; do
  [[ $target == core/spec/* || $seen == *" $target "* ]] ||
    { echo "$file includes \"$target\": no public header of core for the window"; bad=1; }
done < <(grep -rE '^[[:space:]]*#include "core/' ui --include=*.cpp --include=*.h |
           sed -nE 's/^([^:]+):[[:space:]]*#include "([^"]+)".*/\1:\2/p')
# core never names a widget toolkit, and a plugin sees only plugin.h or robot.h; a fitness of balls alone ball_fitness.h,
# a reality that reads tables measured_table.h.
grep -rnE '#include <(Q|osg)' core app/btr*.cpp app/{bench,cluster,gap,live,openr,serve} plugins --include=*.cpp --include=*.h &&
  { echo "Qt or OSG outside ui/"; bad=1; }
grep -rnP '#include "core/(plugin/(?!plugin\.h|(ball_fitness|measured_table)\.h)|robot/(?!robot\.h))' plugins --include=*.cpp &&
  { echo "a plugin may include only core/plugin/plugin.h (and ball_fitness.h, measured_table.h) or core/robot/robot.h"; bad=1; }
exit $bad
