# btr run and btr gap analyse under mpirun: the bits of one process whatever the number of ranks, killed ranks and workers, other builds.
. "$(dirname "$0")/../cli/common.sh"
. "$(dirname "$0")/trial.sh"
skip() { echo "skipped: $*"; exit 77; }
command -v mpirun > /dev/null || skip "mpirun is not installed (openmpi-bin)"
[ -f "$(dirname "$btr")/../lib/libbtr_mpi.so" ] || skip "this btr was built without MPI"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export TMPDIR=$folder # Open MPI's own files
ranks() { local count=$1; shift; mpirun -n "$count" --oversubscribe --bind-to none "$@"; }

# small FILE GENERATIONS: a short kick with a stand-in reality, measured in the middle
small() {
  python3 -c '
import json, os, sys
root, out, generations = sys.argv[1], sys.argv[2], int(sys.argv[3])
source = os.path.join(root, "resources/experiments/kick-short.json")
spec = json.load(open(source))
spec["scene"] = os.path.abspath(os.path.join(os.path.dirname(source), spec["scene"]))
spec["learner"]["settings"]["population"] = 8
spec["adaptation"]["learner"]["settings"]["population"] = 4
spec["adaptation"]["settings"]["generations"] = 2
spec["stages"].update(first_generations=generations, next_generations=generations,
                      total_generations=2 * generations, measured_individuals=2)
json.dump(spec, open(out, "w"))' "$root" "$1" "$2"
}
# below PROCESS: all that descend from it
below() { for child in $(pgrep -P "$1"); do echo "$child"; below "$child"; done; }
# content DB OUT: what the run holds, but times
content() {
  for what in individuals gaps simulators; do "$btr" export --db "$1" --run 1 --what $what; done 2>&1 |
    sed -E "s/[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]+Z//g" > "$2"
}
same() { cmp -s "$folder/one" "$folder/other" || { fail "$1: other content than of one process"; diff "$folder/one" "$folder/other" | head -6; }; }

small "$folder/kick.json" 2
expect 0 "one process" "$btr" run "$folder/kick.json" --db "$folder/one.db" --jobs 1 --quiet
content "$folder/one.db" "$folder/one"
[ "$(wc -l < "$folder/one")" -gt 30 ] || fail "the run of one process is too short to compare"
for n in 2 3; do
  expect 0 "$n ranks" ranks $n "$btr" run "$folder/kick.json" --db "$folder/ranks-$n.db"
  says err "trials in"
  content "$folder/ranks-$n.db" "$folder/other"
  same "$n ranks"
done

# Cells of a grid, and a comparison.
small_grid
python3 -c '
import json, sys
json.dump({"format": "uchilsim-comparison-1", "name": "c", "seeds": [1], "arms": [{"name": "a", "experiment": "kick.json"}]},
          open(sys.argv[1] + "/compare.json", "w"))' "$folder"
expect 0 "a grid in one process" "$btr" grid "$folder/grid.json" --db "$folder/grid-one.db" --workers 1 --quiet --csv "$folder/one"
expect 0 "a grid on 2 ranks" ranks 2 "$btr" grid "$folder/grid.json" --db "$folder/grid-two.db" --quiet --csv "$folder/other"
same "a grid on 2 ranks"
expect 0 "a comparison in one process" "$btr" compare "$folder/compare.json" --db "$folder/c-one.db" --jobs 1 --quiet --csv "$folder/one"
expect 0 "a comparison on 2 ranks" ranks 2 "$btr" compare "$folder/compare.json" --db "$folder/c-two.db" --quiet --csv "$folder/other"
same "a comparison on 2 ranks"

# Blind cases: the same files, with a place that is killed as well, and those of a trial that went on.
if has_generator; then
  expect 0 "a blind trial in one process" trial 6 --out "$folder/trial-one"
  for n in 2 3; do
    expect 0 "a blind trial on $n ranks" ranks $n "$btr" gap prove --cases 6 --scene pendulum --kind nothing --seed 5 \
      --out "$folder/trial-$n" --places "$folder/places.json"
    says err "cases in"
    same_trial "$folder/trial-one" "$folder/trial-$n" "a blind trial on $n ranks"
    python3 -c '
import json, sys
places = json.load(open(sys.argv[1]))
assert places["share"] == 1 and places["trials_per_second"] > 0 and sum(h["trials"] for h in places["hosts"]) == 6, places' \
      "$folder/places.json" || fail "what --places says of $n ranks"
  done
  for where in workers job; do
    ranks 2 "$btr" gap prove --cases 6 --scene pendulum --kind nothing --seed 5 --out "$folder/trial-killed-$where" > "$folder/out" 2> "$folder/err" &
    job=$!
    until [ -d "$folder/trial-killed-$where/case_001" ] || ! kill -0 $job 2> /dev/null; do sleep 0.05; done
    if [ $where = job ]; then
      kill -9 $job $(below $job) 2> /dev/null
      wait $job
      expect 0 "a blind trial goes on" ranks 2 "$btr" gap prove --cases 6 --scene pendulum --kind nothing --seed 5 --out "$folder/trial-killed-job"
    else
      victims=($(below $job))
      kill -9 "${victims[-1]}" 2> /dev/null # a worker of a rank, or the generator that it asked
      wait $job
    fi
    same_trial "$folder/trial-one" "$folder/trial-killed-$where" "a blind trial of which the $where was killed"
  done
  UCHILSIM_CONCEAL=/nowhere expect 1 "no generator on any rank" ranks 2 "$btr" gap prove --cases 1 --out "$folder/none"
  says err "/nowhere: the generator of blind cases is not there"
  [ "$(grep -c '^btr: ' "$folder/err")" = 1 ] || fail "no generator: more than one sentence"
fi

# A gap analysis: the report of one process, with a worker that is killed as well; nothing where it is stopped.
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
  expect 0 "an analysis on $n ranks" on_ranks $n --jobs $jobs --out "$folder/analysis-$n-$jobs"
  cp "$folder/out" "$folder/analysis-$n-$jobs/printed"
  same_report "analysis-$n-$jobs" "an analysis on $n ranks with $jobs workers each"
done
says err "parts of the analysis in"
expect 0 "an analysis that tells its places" on_ranks 2 --jobs 1 --places "$folder/places.json" --out "$folder/analysis-places"
cp "$folder/out" "$folder/analysis-places/printed"
same_report "analysis-places" "an analysis that tells its places"
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
  victims=()
  for process in $(below $job); do grep -qzx pieces "/proc/$process/cmdline" 2> /dev/null && victims+=("$process"); done
  [ ${#victims[@]} -gt 0 ] && kill -9 "${victims[kill % ${#victims[@]}]}" 2> /dev/null # a foreman or a worker of it
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

# A run's own gap analysis: the version of one process, with a foreman or worker that is killed during it as well.
repaired() {
  python3 -c '
import json, sys
spec = json.load(open(sys.argv[1]))
spec["controller"]["settings"].update(accumulate_s=0.1, hold_s=0, return_s=0.1)
spec["concealed"] = {"effects": ["coulomb_friction"], "at": ["ers7.LF_J3"]}
spec["stand_in"].update(hidden_effects=1, effect_size=5)
spec["recordings"] = {"settings": {"after_stage": 1, "individuals": 2, "maximum_effects": 1},
                      "effects": ["viscous_friction", "backlash", "coulomb_friction"], "joints": ["ers7.LF_J3"]}
json.dump(spec, open(sys.argv[2], "w"))' "$folder/kick.json" "$folder/repaired.json"
}
repaired
expect 0 "a run with recordings in one process" "$btr" run "$folder/repaired.json" --db "$folder/repaired-one.db" --jobs 1 --quiet
content "$folder/repaired-one.db" "$folder/one"
grep -q "gap analysis" "$folder/one" || fail "the run made no version from its recordings"
for words in "1 2" "2 1" "3 1" "2 2"; do
  n=${words% *} jobs=${words#* }
  expect 0 "a run with recordings on $n ranks" ranks $n "$btr" run "$folder/repaired.json" --db "$folder/repaired-$n-$jobs.db" --jobs $jobs --places "$folder/places.json"
  content "$folder/repaired-$n-$jobs.db" "$folder/other"
  same "a run with recordings on $n ranks with $jobs workers each"
  [ $n = 1 ] && continue
  says err "parts of gap analyses in"
  python3 -c '
import json, sys
hosts = json.load(open(sys.argv[1]))["hosts"]
assert sum(h["analyses"]["parts"] for h in hosts) > 0 and sum(h["trials"] for h in hosts) > 0, hosts' \
    "$folder/places.json" || fail "what --places says of a run with an analysis"
done
for ((kill = 0; kill < 3; kill++)); do
  ranks 2 "$btr" run "$folder/repaired.json" --db "$folder/repaired-killed-$kill.db" --jobs 1 > "$folder/out" 2> "$folder/err" &
  job=$!
  until "$btr" gap recordings list --db "$folder/repaired-killed-$kill.db" 2> /dev/null | grep -q individual-.*individual- || ! kill -0 $job 2> /dev/null; do sleep 0.02; done
  victims=()
  for process in $(below $job); do grep -qzx pieces "/proc/$process/cmdline" 2> /dev/null && victims+=("$process"); done
  [ ${#victims[@]} -gt 0 ] && kill -9 "${victims[kill % ${#victims[@]}]}" 2> /dev/null
  wait $job || fail "a run of whose analysis a process was killed: exit code $?"
  content "$folder/repaired-killed-$kill.db" "$folder/other"
  same "a run of whose analysis a process was killed"
done

# A rank with another build is refused by name. It is a whole copy of which one plugin was changed.
mkdir -p "$folder/copy"
cp -r "$(dirname "$btr")/../lib" "$folder/copy/lib"
mkdir "$folder/copy/bin"
cp "$btr" "$folder/copy/bin/btr"
printf x >> "$folder/copy/lib/plugins/fitness/$(ls "$folder/copy/lib/plugins/fitness" | head -1)"
LD_LIBRARY_PATH=$folder/copy/lib expect 1 "another build" mpirun --oversubscribe --bind-to none \
  -n 1 "$btr" run "$folder/kick.json" --db "$folder/other.db" : \
  -n 1 env LD_LIBRARY_PATH="$folder/copy/lib" "$folder/copy/bin/btr" run "$folder/kick.json" --db "$folder/other.db"
says err "btr: rank 1 (host $(hostname)): its "
says err "is another one; install the same build on every machine"
[ "$(grep -c '^btr: ' "$folder/err")" = 1 ] || fail "another build: more than one sentence"
analysis_words="gap analyse $root/resources/scenes/xl330.json --recording $folder/recording/made_kp200_sines.csv --out $folder/analysis-none"
LD_LIBRARY_PATH=$folder/copy/lib expect 1 "an analysis with another build" mpirun --oversubscribe --bind-to none \
  -n 1 "$btr" $analysis_words : -n 1 env LD_LIBRARY_PATH="$folder/copy/lib" "$folder/copy/bin/btr" $analysis_words
says err "btr: rank 1 (host $(hostname)): its "
[ "$(grep -c '^btr: ' "$folder/err")" = 1 ] || fail "an analysis with another build: more than one sentence"
[ -e "$folder/analysis-none/report.json" ] && fail "an analysis with another build wrote something"

# Killed at moments drawn at random, ranks and workers and all: the database is whole, and what goes on has the same bits.
RANDOM=${SEED:-7}
small "$folder/longer.json" 4
expect 0 "one process, longer" "$btr" run "$folder/longer.json" --db "$folder/longer-one.db" --jobs 1 --quiet
content "$folder/longer-one.db" "$folder/one"
killed=0
end=stopped
for ((try = 0; try < 200; try++)); do
  ranks 2 "$btr" run "$folder/longer.json" --db "$folder/killed.db" --quiet > "$folder/out" 2> "$folder/err" &
  job=$!
  if [ $killed -lt ${KILLS:-12} ]; then
    sleep "$((RANDOM % 3)).$((RANDOM % 10))" # when, not how long it may take
    victims=($job $(below $job))
    kill -9 "${victims[RANDOM % ${#victims[@]}]}" 2> /dev/null && killed=$((killed + 1))
  fi
  wait $job
  end=$?
  "$btr" check --db "$folder/killed.db" --replays 0 > "$folder/check" 2>&1 || { grep -q "no such" "$folder/check" || { fail "after kill $killed the database is not whole"; head -3 "$folder/check"; }; }
  [ $end = 0 ] && [ $killed -ge ${KILLS:-12} ] && break
  [ $end = 0 ] && { content "$folder/killed.db" "$folder/other"; same "after $killed kills"; rm -f "$folder/killed.db"*; }
done
[ $end = 0 ] || fail "the killed run never ended: exit code $end"
content "$folder/killed.db" "$folder/other"
same "after $killed kills"

finish
