# btr gap analyse under mpirun: the report of one process, with a worker that is killed as well; nothing where it is stopped.
. "$(dirname "$0")/mpi_here.sh"

mkdir "$folder/recording"
head -n 400 "$root/resources/recordings/xl330-made/made_kp200_sines.csv" > "$folder/recording/made_kp200_sines.csv"
cp "$root/resources/recordings/xl330-made/made_kp200_sines.mapping.json" "$folder/recording"
analysis() { "$btr" gap analyse "$root/resources/scenes/xl330.json" --recording "$folder/recording/made_kp200_sines.csv" --effects viscous_friction backlash coulomb_friction "$@"; }
on_ranks() { local count=$1; shift; ranks "$count" "$btr" gap analyse "$root/resources/scenes/xl330.json" --recording "$folder/recording/made_kp200_sines.csv" --effects viscous_friction backlash coulomb_friction "$@"; }
# report_content FOLDER: all its files and what was printed, but times
report_content() {
  (cd "$1" && find . -type f | sort | while read -r file; do echo "== $file"; cat "$file"; done) |
    sed -E 's/"wall_time_s": [0-9.e-]*//; s/, seed [0-9]+, [0-9.e-]+ s//; s/^[0-9.e-]+ s$//'
}
same_report() {
  report_content "$folder/$1" > "$folder/other"
  cmp -s "$folder/report" "$folder/other" || { fail "$2: another report than of one process"; diff "$folder/report" "$folder/other" | cut -c1-200 | head -6; }
}
expect 0 "an analysis in one process" analysis --jobs 1 --out "$folder/analysis-one"
cp "$folder/out" "$folder/analysis-one/printed"
report_content "$folder/analysis-one" > "$folder/report"
grep -q coulomb_friction "$folder/report" || fail "the analysis found nothing to compare"
for words in "1 1" "2 1" "3 1" "2 2"; do
  n=${words% *} jobs=${words#* }
  places=()
  [ "$words" = "2 1" ] && places=(--places "$folder/places.json")
  expect 0 "an analysis on $n ranks" on_ranks $n --jobs $jobs "${places[@]}" --out "$folder/analysis-$n-$jobs"
  cp "$folder/out" "$folder/analysis-$n-$jobs/printed"
  same_report "analysis-$n-$jobs" "an analysis on $n ranks with $jobs workers each"
done
says err "parts of the analysis in"
python3 -c '
import json, sys
places = json.load(open(sys.argv[1]))
assert places["share"] == 1 and places["trials_per_second"] > 0 and sum(h["workers"] for h in places["hosts"]) == 2, places
assert sum(h["trials"] for h in places["hosts"]) > 0, places' "$folder/places.json" || fail "what --places says of an analysis"
expect 1 "places that cannot be written" analysis --places "$folder/nowhere/places.json" --out "$folder/analysis-none"
for ((kill = 0; kill < 3; kill++)); do
  : > "$folder/err" # what was said before is no sign of it
  on_ranks 2 --jobs 1 --progress --out "$folder/analysis-killed-$kill" > "$folder/out" 2> "$folder/err" &
  job=$!
  until grep -q "0\\.[0-9]*[1-9]" "$folder/err" || ! kill -0 $job 2> /dev/null; do sleep 0.02; done
  kill_a_piece $job $kill || fail "nothing was there to be killed in the analysis"
  wait $job || fail "an analysis of which a process was killed: exit code $?"
  cp "$folder/out" "$folder/analysis-killed-$kill/printed"
  same_report "analysis-killed-$kill" "an analysis of which a process was killed"
done
: > "$folder/err"
whole=$root/resources/recordings/xl330-made
ranks 2 "$btr" gap analyse "$root/resources/scenes/xl330.json" --recording "$whole/made_kp200_sines.csv" --recording "$whole/made_kp400_slow.csv" \
  --jobs 1 --progress --out "$folder/analysis-stopped" > "$folder/out" 2> "$folder/err" &
job=$!
until grep -q "0\\.[0-9]*[1-9]" "$folder/err" || ! kill -0 $job 2> /dev/null; do sleep 0.02; done
for process in $(below $job); do
  grep -qzx OMPI_COMM_WORLD_RANK=0 "/proc/$process/environ" 2> /dev/null && kill -INT "$process" # as Ctrl-C
done
wait $job
end=$?
[ $end = 3 ] || fail "a stopped analysis: exit code $end instead of 3"
says err "stopped; nothing was written"
[ -e "$folder/analysis-stopped/report.json" ] && fail "a stopped analysis wrote a report"
expect 1 "an analysis without its recording" ranks 2 "$btr" gap analyse "$root/resources/scenes/xl330.json" --recording "$folder/none.csv" --out "$folder/analysis-none"
says err "btr: $folder/none.csv: there is no such file"
[ "$(grep -c '^btr: ' "$folder/err")" = 1 ] || fail "an analysis without its recording: more than one sentence"

# A rank with another build.
other_build
refuses_other_build "an analysis with another build" gap analyse "$root/resources/scenes/xl330.json" \
  --recording "$folder/recording/made_kp200_sines.csv" --out "$folder/analysis-none"
[ -e "$folder/analysis-none/report.json" ] && fail "an analysis with another build wrote something"

finish
