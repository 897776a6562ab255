# btr run, grid and compare under mpirun: the bits of one process whatever the number of ranks, killed ranks and workers, other builds.
. "$(dirname "$0")/mpi_here.sh"

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

# A rank with another build.
other_build
refuses_other_build "another build" run "$folder/kick.json" --db "$folder/other.db"

# Killed at moments drawn at random, ranks and workers and all: the database is whole, and what goes on has the same bits.
RANDOM=${SEED:-7}
content "$folder/one.db" "$folder/one"
killed=0
end=stopped
for ((try = 0; try < 200; try++)); do
  ranks 2 "$btr" run "$folder/kick.json" --db "$folder/killed.db" --quiet > "$folder/out" 2> "$folder/err" &
  job=$!
  if [ $killed -lt ${KILLS:-8} ]; then
    sleep "$((RANDOM % 10))e-1" # when, not how long it may take
    victims=($(below $job))
    [ ${#victims[@]} -gt 0 ] && kill -9 "${victims[killed % ${#victims[@]}]}" 2> /dev/null && killed=$((killed + 1))
  fi
  wait $job
  end=$?
  "$btr" check --db "$folder/killed.db" --replays 0 > "$folder/check" 2>&1 || { grep -q "no such" "$folder/check" || { fail "after kill $killed the database is not whole"; head -3 "$folder/check"; }; }
  [ $end = 0 ] && [ $killed -ge ${KILLS:-8} ] && break
  [ $end = 0 ] && { content "$folder/killed.db" "$folder/other"; same "after $killed kills"; rm -f "$folder/killed.db"*; }
done
[ $end = 0 ] || fail "the killed run never ended: exit code $end"
content "$folder/killed.db" "$folder/other"
same "after $killed kills"

finish
