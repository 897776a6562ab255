# A Slurm of one node on this machine, in $folder/slurm, for the scripts beside it; started and stopped by them.
# slurm_begin: returns 77 after a sentence where it cannot be.
slurm_begin() {
  local program
  for program in munged slurmctld slurmd sbatch squeue; do
    command -v "$program" > /dev/null || { echo "skipped: $program is not installed (slurm-wlm, munge)"; return 77; }
  done
  [ "$(id -u)" = 0 ] || { echo "skipped: only root may start a slurmd here"; return 77; }
  local at=$folder/slurm host
  host=$(hostname -s)
  mkdir -p "$at/state" "$at/spool"
  chmod 755 "$folder" "$at"
  dd if=/dev/urandom of="$at/munge.key" bs=128 count=1 2> /dev/null
  chmod 400 "$at/munge.key"
  munged --force --foreground --key-file="$at/munge.key" --socket="$at/munge.socket" --pid-file="$at/munged.pid" \
    --log-file="$at/munged.log" --seed-file="$at/munge.seed" 2> "$at/munged.err" &
  slurm_processes=($!)
  local ports
  ports=($(python3 -c '
import socket
free = [socket.socket() for _ in range(2)]
for s in free: s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in free))'))
  cat > "$at/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$at/munge.socket
CredType=cred/munge
StateSaveLocation=$at/state
SlurmdSpoolDir=$at/spool
SlurmctldPidFile=$at/slurmctld.pid
SlurmdPidFile=$at/slurmd.pid
SlurmctldLogFile=$at/slurmctld.log
SlurmdLogFile=$at/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
KillWait=10
MessageTimeout=5
InactiveLimit=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$at/slurm.conf
  until [ -S "$at/munge.socket" ]; do
    kill -0 "${slurm_processes[0]}" 2> /dev/null || { echo "skipped: munged does not start here: $(tail -1 "$at/munged.err")"; return 77; }
    sleep 0.05
  done
  slurmctld -D -f "$SLURM_CONF" > "$at/slurmctld.out" 2>&1 &
  slurm_processes+=($!)
  slurmd -D -f "$SLURM_CONF" > "$at/slurmd.out" 2>&1 &
  slurm_processes+=($!)
  until sinfo --noheader --format=%T 2> /dev/null | grep -q idle; do
    for program in "${slurm_processes[@]}"; do
      kill -0 "$program" 2> /dev/null || { echo "skipped: Slurm does not start here: $(tail -1 "$at/slurmctld.log" "$at/slurmd.log" 2> /dev/null | tr '\n' ' ')"; slurm_end; return 77; }
    done
    sleep 0.1
  done
}
slurm_end() {
  local i
  for ((i = ${#slurm_processes[@]} - 1; i >= 0; i--)); do kill "${slurm_processes[i]}" 2> /dev/null; wait "${slurm_processes[i]}" 2> /dev/null; done
  slurm_processes=()
}
