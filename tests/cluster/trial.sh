# Blind trials for the scripts beside it, where their generator was built: pendulums without anything hidden, quick ones.
has_generator() { [ -x "$(dirname "$btr")/conceal" ] || { echo "not tested: blind trials (conceal was not built)"; return 1; }; }
# trial CASES [words...]: the words of a trial
trial() { local cases=$1; shift; "$btr" gap prove --cases "$cases" --scene pendulum --kind nothing --seed 5 "$@"; }
# trial_content FOLDER: all its files, but how long analyses took and where the folder is
trial_content() {
  (cd "$1" && find . -type f | sort | while read -r file; do
    echo "== $file"
    sed -E "s#$1##g; s/\"(wall_time_s|(median_)?seconds)\": [^,]*//; s/, seed [0-9]+, [0-9.e-]+ s//; s/time of an analysis, median.*//" "$file" |
      case $file in */proof.txt | */proof.html) sed -E "s#(<td>| +)[0-9.]+(</td></tr>|\$)#\2#" ;; *) cat ;; esac
  done)
}
# same_trial ONE OTHER "what": the same cases and the same count
same_trial() {
  trial_content "$1" > "$folder/trial-a"
  trial_content "$2" > "$folder/trial-b"
  cmp -s "$folder/trial-a" "$folder/trial-b" || { fail "$3: other files than of one process"; diff "$folder/trial-a" "$folder/trial-b" | cut -c1-200 | head -8; }
}
