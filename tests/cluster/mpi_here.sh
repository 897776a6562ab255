# For the scripts beside it, which run btr under mpirun; they end here where that is not there.
. "$(dirname "$0")/../cli/common.sh"
. "$(dirname "$0")/trial.sh"
skip() { echo "skipped: $*"; exit 77; }
command -v mpirun > /dev/null || skip "mpirun is not installed (openmpi-bin)"
[ -f "$(dirname "$btr")/../lib/libbtr_mpi.so" ] || skip "this btr was built without MPI"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_pml=ob1 # one machine: no network is searched for at each start
export TMPDIR=$folder # Open MPI's own files
ranks() { local count=$1; shift; mpirun -n "$count" --oversubscribe --bind-to none "$@"; }

# small FILE GENERATIONS: a short kick with a stand-in reality, measured in the middle
small() {
  short_kick "$1" << PY
spec["learner"]["settings"]["population"] = 8
spec["adaptation"]["learner"]["settings"]["population"] = 4
spec["adaptation"]["settings"]["generations"] = 2
spec["stages"].update(first_generations=$2, next_generations=$2, total_generations=2 * $2, measured_individuals=2)
PY
}
# below PROCESS: all that descend from it
below() { for child in $(pgrep -P "$1"); do echo "$child"; below "$child"; done; }
# content DB OUT: what the run holds, but times
content() {
  for what in individuals gaps simulators; do "$btr" export --db "$1" --run 1 --what $what; done 2>&1 |
    sed -E "s/[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]+Z//g" > "$2"
}
same() { cmp -s "$folder/one" "$folder/other" || { fail "$1: other content than of one process"; diff "$folder/one" "$folder/other" | head -6; }; }
# kill_a_piece PROCESS N: the Nth (modulo) of the processes below it that make pieces of an analysis, a foreman or a worker
# of it, as soon as there is one; false if the process ends without
kill_a_piece() {
  local victims process
  while kill -0 "$1" 2> /dev/null; do
    victims=()
    for process in $(below "$1"); do grep -qzx pieces "/proc/$process/cmdline" 2> /dev/null && victims+=("$process"); done
    [ ${#victims[@]} -gt 0 ] && kill -9 "${victims[$2 % ${#victims[@]}]}" 2> /dev/null && return
    sleep 0.02
  done
  return 1
}
# other_build: a whole copy of the program, in $folder/copy, of which one plugin was changed
other_build() {
  mkdir -p "$folder/copy/bin"
  cp -r "$(dirname "$btr")/../lib" "$folder/copy/lib"
  cp "$btr" "$folder/copy/bin/btr"
  printf x >> "$folder/copy/lib/plugins/fitness/$(ls "$folder/copy/lib/plugins/fitness" | head -1)"
}
# refuses_other_build "what" words...: rank 1 has that build, and is refused by name in one sentence
refuses_other_build() {
  local what=$1
  shift
  LD_LIBRARY_PATH=$folder/copy/lib expect 1 "$what" mpirun --oversubscribe --bind-to none \
    -n 1 "$btr" "$@" : -n 1 env LD_LIBRARY_PATH="$folder/copy/lib" "$folder/copy/bin/btr" "$@"
  says err "btr: rank 1 (host $(hostname)): its "
  says err "is another one; install the same build on every machine"
  [ "$(grep -c '^btr: ' "$folder/err")" = 1 ] || fail "$what: more than one sentence"
}
