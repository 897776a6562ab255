#!/usr/bin/env bash
# Array jobs in a real Slurm, started here: the results of one process, elements that fail, cancelled, killed, refused.
. "$(dirname "$0")/../cli/common.sh"
. "$(dirname "$0")/slurm_here.sh"
. "$(dirname "$0")/trial.sh"
slurm_begin || exit $?
trap 'slurm_end; umount "$folder/tiny" 2> /dev/null; rm -rf "$folder"' EXIT

# comparison FILE GENERATIONS SEEDS: two arms of short kicks
comparison() {
  local name
  for name in little much; do
    short_kick "$folder/$name-$2.json" << PY
spec["name"] = "$name $2"
spec["learner"]["settings"].update(population=6, mutation={"little": 0.015, "much": 0.2}["$name"])
spec["adaptation"]["learner"]["settings"]["population"] = 4
spec["adaptation"]["settings"]["generations"] = 1
spec["stages"].update(first_generations=$2, next_generations=1, total_generations=$2, measured_individuals=2)
PY
  done
  cat > "$1" << JSON
{"format": "uchilsim-comparison-1", "name": "c", "seeds": $3, "arms": [
  {"name": "little", "experiment": "$folder/little-$2.json"}, {"name": "much", "experiment": "$folder/much-$2.json"}]}
JSON
}
# states FOLDER: "done done failed …"
states() { "$btr" --json array status "$1" | python3 -c 'import json, sys; print(*(e["state"].replace(" ", "_") for e in json.load(sys.stdin)["elements"]))'; }
# until_over FOLDER: nothing is queued or running any more
until_over() { while states "$1" | grep -qE "queued|running|not_begun"; do sleep 0.2; done; }
# release FOLDER: its newest job may begin
release() { scontrol release "$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["queue_ids"][-1])' "$1/job.json")"; }
has_srun() { [ -f "$(dirname "$btr")/../lib/libbtr_mpi.so" ] && srun --mpi=list 2>&1 | grep -q pmix; }
same() { cmp -s "$1" "$2" || { fail "$3: other results than of one process"; diff "$1" "$2" | head -4; }; }

# The results of one process, which works while Slurm does.
comparison "$folder/c.json" 2 "[1, 2]"
expect 0 "submitting" "$btr" compare "$folder/c.json" --db "$folder/all.db" --slurm "$folder/job"
says out "4 elements in"
expect 0 "one process" "$btr" compare "$folder/c.json" --db "$folder/one.db" --jobs 1 --quiet --csv "$folder/one.csv"
until_over "$folder/job"
[ "$(states "$folder/job")" = "done done done done" ] || { fail "the elements are $(states "$folder/job")"; "$btr" array status "$folder/job"; }
expect 0 "collecting" "$btr" array collect "$folder/job"
says out "4 elements collected"
expect 0 "collecting again" "$btr" array collect "$folder/job"
says out "0 elements collected, 4 had been before"
expect 0 "the collected comparison" "$btr" compare "$folder/c.json" --db "$folder/all.db" --quiet --csv "$folder/all.csv"
same "$folder/one.csv" "$folder/all.csv" "the array"
expect 1 "a folder that is in use" "$btr" compare "$folder/c.json" --db "$folder/all.db" --slurm "$folder/job"
says err "btr array status"
one_line

# What Slurm refuses is one sentence, and can be given to it again.
expect 1 "a partition that is not there" "$btr" compare "$folder/c.json" --db "$folder/x.db" --slurm "$folder/refused" \
  --slurm-option=--partition=nowhere
says err "sbatch: "
says err "btr array resume"
one_line

# One element whose file was spoiled fails, is named and runs again alone.
comparison "$folder/held.json" 1 "[1]"
expect 0 "submitting, held" "$btr" compare "$folder/held.json" --db "$folder/mended.db" --slurm "$folder/mended" \
  --slurm-option=--hold
cp "$folder/mended/2.db" "$folder/kept.db"
head -c 5000 "$folder/kept.db" > "$folder/mended/2.db"
release "$folder/mended"
until_over "$folder/mended"
[ "$(states "$folder/mended")" = "done failed" ] || fail "with a spoiled file the elements are $(states "$folder/mended")"
expect 3 "collecting what is there" "$btr" array collect "$folder/mended"
says out "1 of 2 are missing (2)"
cp "$folder/kept.db" "$folder/mended/2.db"
expect 0 "again" "$btr" array resume "$folder/mended"
says out "elements 2 of"
release "$folder/mended"
until_over "$folder/mended"
expect 0 "collecting the rest" "$btr" array collect "$folder/mended"
says out "1 elements collected, 1 had been before"

# A full disk where an element works: one sentence, and again with room.
mkdir "$folder/tiny"
if mount -t tmpfs -o size=400k none "$folder/tiny" 2> /dev/null; then
  comparison "$folder/full.json" 30 "[1]"
  TMPDIR=$folder/tiny expect 0 "submitting to a full disk" "$btr" compare "$folder/full.json" --db "$folder/full.db" --slurm "$folder/full"
  until_over "$folder/full"
  [ "$(states "$folder/full")" = "failed failed" ] || fail "on a full disk the elements are $(states "$folder/full")"
  "$btr" array status "$folder/full" > "$folder/out"
  # Where it is the copy that does not fit, the system's words are others.
  grep -qE "full|No space left" "$folder/out" || { fail "a full disk is not named:"; cat "$folder/out"; }
else
  echo "not tested: a full disk (no tmpfs may be mounted here)"
fi

# Cancelled while it works, its btr killed, and the whole element killed: it goes on with the same bits.
comparison "$folder/long.json" 60 "[3]"
python3 -c '
import json, sys
path = sys.argv[1]
spec = json.load(open(path))
spec["stages"].update(first_generations=2, total_generations=2)  # the other arm is the one to cancel and to kill
json.dump(spec, open(path, "w"))' "$folder/much-60.json"
expect 0 "submitting the longer one" "$btr" compare "$folder/long.json" --db "$folder/long.db" --slurm "$folder/long"
until states "$folder/long" | grep -q "^running"; do sleep 0.05; done
expect 0 "cancelling" "$btr" array cancel "$folder/long"
until_over "$folder/long"
states "$folder/long" | grep -qE "^(stopped|failed)" || fail "cancelled, the elements are $(states "$folder/long")"
"$btr" check --db "$folder/long/1.db" --replays 0 > /dev/null || fail "what a cancelled element brought back is not whole"
expect 0 "going on" "$btr" array resume "$folder/long"
until states "$folder/long" | grep -q "^running"; do sleep 0.05; done
pkill -9 -f "element $folder/long 1"
until_over "$folder/long"
"$btr" array status "$folder/long" > "$folder/out"
says out "it ended without a word"
expect 0 "going on once more" "$btr" array resume "$folder/long"
expect 0 "one process, longer" "$btr" compare "$folder/long.json" --db "$folder/long-one.db" --jobs 1 --quiet --csv "$folder/long-one.csv"
until_over "$folder/long"
expect 0 "collecting the longer one" "$btr" array collect "$folder/long"
expect 0 "its comparison" "$btr" compare "$folder/long.json" --db "$folder/long.db" --quiet --csv "$folder/long.csv"
same "$folder/long-one.csv" "$folder/long.csv" "cancelled and killed"

# A grid's element says how fast it is.
small_grid
expect 0 "a grid" "$btr" grid "$folder/grid.json" --db "$folder/grid.db" --workers 1 --slurm "$folder/grid"
until_over "$folder/grid"
speeds() { "$btr" --json array status "$1" | python3 -c 'import json, sys; print(all(e["trials_per_second"] > 0 for e in json.load(sys.stdin)["elements"]))'; }
[ "$(states "$folder/grid") $(speeds "$folder/grid")" = "done True" ] || { fail "the grid's element"; "$btr" --json array status "$folder/grid"; }

# Blind cases, by the handful: the same files as of one process; cancelled and killed they go on with what is missing.
if has_generator; then
  expect 0 "a blind trial as an array" trial 3 --out "$folder/trial" --slurm "$folder/trial-job" --per-element 2
  says out "2 elements in"
  expect 0 "a blind trial in one process" trial 3 --out "$folder/trial-one"
  until_over "$folder/trial-job"
  [ "$(states "$folder/trial-job") $(speeds "$folder/trial-job")" = "done done True" ] || { fail "the blind trial's elements"; "$btr" array status "$folder/trial-job"; }
  expect 0 "collecting its cases" "$btr" array collect "$folder/trial-job"
  says out "2 elements collected"
  same_trial "$folder/trial-one" "$folder/trial" "a blind trial as an array"
  if has_srun; then
    expect 0 "srun of blind cases" srun --mpi=pmix -n 2 "$btr" gap prove --cases 3 --scene pendulum --kind nothing --seed 5 --out "$folder/trial-srun"
    same_trial "$folder/trial-one" "$folder/trial-srun" "blind cases under srun"
  fi
  expect 1 "a trial that is finished" trial 3 --out "$folder/trial" --slurm "$folder/trial-again"
  says err "all its cases are finished"
  one_line
  expect 1 "another trial's folder" trial 3 --out "$folder/trial" --slurm "$folder/trial-again" --spoiled 1
  one_line
  # More cases of it, in one element.
  mkdir "$folder/scratch"
  TMPDIR=$folder/scratch expect 0 "more cases as an array" trial 9 --out "$folder/trial" --slurm "$folder/trial-more" --per-element 100
  says out "1 elements in"
  until ls "$folder"/scratch/uchilsim-element-*/out/case_004/verdict.json > /dev/null 2>&1; do
    [ "$(states "$folder/trial-more")" = failed ] && break
    sleep 0.05
  done
  expect 0 "cancelling the cases" "$btr" array cancel "$folder/trial-more"
  until_over "$folder/trial-more"
  tar -tf "$folder/trial-more/1.tar" | grep -q case_004/verdict.json || fail "a cancelled element did not bring back the cases that it had finished"
  expect 3 "collecting what a cancelled element has" "$btr" array collect "$folder/trial-more"
  [ -f "$folder/trial/case_004/verdict.json" ] || fail "finished cases of a cancelled element were not collected"
  expect 0 "its cases go on" "$btr" array resume "$folder/trial-more"
  expect 0 "more cases in one process" trial 9 --out "$folder/trial-one"
  until_over "$folder/trial-more"
  expect 0 "collecting the rest of its cases" "$btr" array collect "$folder/trial-more"
  same_trial "$folder/trial-one" "$folder/trial" "a cancelled blind trial"
fi

# Ranks under srun.
if has_srun; then
  expect 0 "srun" srun --mpi=pmix -n 2 "$btr" run "$folder/little-2.json" --db "$folder/srun.db" --seed 1
  says err "2 workers"
  expect 0 "the same alone" "$btr" run "$folder/little-2.json" --db "$folder/alone.db" --seed 1 --jobs 1
  for db in srun alone; do "$btr" export --db "$folder/$db.db" --run 1 --what individuals > "$folder/$db.csv"; done
  same "$folder/alone.csv" "$folder/srun.csv" "srun"
  mkdir "$folder/recording"
  head -n 400 "$root/resources/recordings/xl330-made/made_kp200_sines.csv" > "$folder/recording/made_kp200_sines.csv"
  cp "$root/resources/recordings/xl330-made/made_kp200_sines.mapping.json" "$folder/recording"
  analysis="$btr gap analyse $root/resources/scenes/xl330.json --recording $folder/recording/made_kp200_sines.csv --jobs 1 --effects viscous_friction backlash coulomb_friction"
  expect 0 "an analysis in one process" $analysis --out "$folder/analysis-one"
  expect 0 "an analysis under srun" srun --mpi=pmix -n 2 $analysis --out "$folder/analysis-srun"
  for report in one srun; do sed -E 's/"wall_time_s": [0-9.e-]*//' "$folder/analysis-$report/report.json" > "$folder/$report.json"; done
  same "$folder/one.json" "$folder/srun.json" "an analysis under srun"
  expect 1 "srun without MPI" srun --mpi=none -n 2 "$btr" run "$folder/little-2.json" --db "$folder/none.db" --seed 1
  says err "start it with srun --mpi=pmix"
fi

# A Slurm that does not answer; what asks does not try for long.
slurm_end
sed -i 's/^MessageTimeout=.*/MessageTimeout=1/' "$SLURM_CONF"
expect 1 "no controller" "$btr" array status "$folder/job"
says err "squeue: "
one_line
finish
