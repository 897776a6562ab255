# For the scripts beside it: a small grid, and blind trials where their generator was built: pendulums without anything hidden, quick ones.
has_generator() { [ -x "$(dirname "$btr")/conceal" ] || { echo "not tested: blind trials (conceal was not built)"; return 1; }; }
# trial CASES [words...]: the words of a trial
trial() { local cases=$1; shift; "$btr" gap prove --cases "$cases" --scene pendulum --kind nothing --seed 5 "$@"; }
# trial_content FOLDER: all its files, but how long analyses took and where the folder is
trial_content() {
  local each="s#$1##g; s/\"(wall_time_s|(median_)?seconds)\": [^,]*//; s/, seed [0-9]+, [0-9.e-]+ s//; s/time of an analysis, median.*//"
  (
    cd "$1" || exit
    find . -type f | sort
    find . -type f ! -name proof.txt ! -name proof.html -print0 | sort -z | xargs -0r sed -s -E "1F; $each"
    find . -type f \( -name proof.txt -o -name proof.html \) -print0 | sort -z |
      xargs -0r sed -s -E "1F; $each; s#(<td>| +)[0-9.]+(</td></tr>|\$)#\2#"
  )
}
# same_trial ONE OTHER "what": the same cases and the same count
same_trial() {
  trial_content "$1" > "$folder/trial-a"
  trial_content "$2" > "$folder/trial-b"
  cmp -s "$folder/trial-a" "$folder/trial-b" || { fail "$3: other files than of one process"; diff "$folder/trial-a" "$folder/trial-b" | cut -c1-200 | head -8; }
}
# small_grid: three quick cells of a kick, in grid.json and cell.json of $folder
small_grid() {
  python3 -c '
import json, os, sys
root, folder = sys.argv[1:]
source = os.path.join(root, "resources/grids/kick-grid-short.json")
grid = json.load(open(source))
spec_path = os.path.join(os.path.dirname(source), grid["experiment"])
spec = json.load(open(spec_path))
spec["scene"] = os.path.abspath(os.path.join(os.path.dirname(spec_path), spec["scene"]))
spec["learner"]["settings"]["population"] = 4
json.dump(spec, open(folder + "/cell.json", "w"))
grid.update(experiment="cell.json", distances_m=[0.14], bearings_rad=[-0.3, 0, 0.3], directions_rad=[0],
            methods=["similarity"], seeds=[1])
grid["settings"] = dict(grid.get("settings", {}), generations=2, points=3)
json.dump(grid, open(folder + "/grid.json", "w"))' "$root" "$folder"
}
