# The gap analysis of a run under mpirun: the version of one process, with a foreman or worker that is killed during it as well.
. "$(dirname "$0")/mpi_here.sh"

small "$folder/kick.json" 1
repaired() {
  python3 -c '
import json, sys
spec = json.load(open(sys.argv[1]))
spec["learner"]["settings"]["population"] = 4
spec["adaptation"]["settings"]["generations"] = 1
spec["controller"]["settings"].update(accumulate_s=0.1, hold_s=0, return_s=0.1)
spec["concealed"] = {"effects": ["coulomb_friction"], "at": ["ers7.LF_J3"]}
spec["stand_in"].update(hidden_effects=1, effect_size=5)
spec["recordings"] = {"settings": {"after_stage": 1, "individuals": 2, "maximum_effects": 1},
                      "effects": ["viscous_friction", "coulomb_friction"], "joints": ["ers7.LF_J3"]}
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
  until [ "$("$btr" gap recordings list --db "$folder/repaired-killed-$kill.db" 2> /dev/null | grep -c individual-)" = 2 ] || ! kill -0 $job 2> /dev/null; do sleep 0.02; done
  kill_a_piece $job $kill || fail "nothing was there to be killed in the analysis"
  wait $job || fail "a run of whose analysis a process was killed: exit code $?"
  content "$folder/repaired-killed-$kill.db" "$folder/other"
  same "a run of whose analysis a process was killed"
done

finish
