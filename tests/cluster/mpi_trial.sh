# btr gap prove under mpirun: the files of one process, with a place that is killed as well, and those of a trial that went on.
. "$(dirname "$0")/mpi_here.sh"
has_generator || exit 77

expect 0 "a blind trial in one process" trial 4 --out "$folder/trial-one"
for n in 2 3; do
  expect 0 "a blind trial on $n ranks" ranks $n "$btr" gap prove --cases 4 --scene pendulum --kind nothing --seed 5 \
    --out "$folder/trial-$n" --places "$folder/places.json"
  says err "cases in"
  same_trial "$folder/trial-one" "$folder/trial-$n" "a blind trial on $n ranks"
  python3 -c '
import json, sys
places = json.load(open(sys.argv[1]))
assert places["share"] == 1 and places["trials_per_second"] > 0 and sum(h["trials"] for h in places["hosts"]) == 4, places' \
    "$folder/places.json" || fail "what --places says of $n ranks"
done
for where in workers job; do
  ranks 2 "$btr" gap prove --cases 4 --scene pendulum --kind nothing --seed 5 --out "$folder/trial-killed-$where" > "$folder/out" 2> "$folder/err" &
  job=$!
  until [ -d "$folder/trial-killed-$where/case_001" ] || ! kill -0 $job 2> /dev/null; do sleep 0.05; done
  if [ $where = job ]; then
    kill -9 $job $(below $job) 2> /dev/null
    wait $job
    expect 0 "a blind trial goes on" ranks 2 "$btr" gap prove --cases 4 --scene pendulum --kind nothing --seed 5 --out "$folder/trial-killed-job"
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

finish
