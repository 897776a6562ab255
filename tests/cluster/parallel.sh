#!/usr/bin/env bash
# Array jobs over ssh: an sshd of our own on this machine plays two of them, a third is not there.
. "$(dirname "$0")/../cli/common.sh"
. "$(dirname "$0")/trial.sh"
for program in parallel rsync ssh sshd ssh-keygen; do
  PATH=$PATH:/usr/sbin command -v $program > /dev/null || { echo "skipped: $program is not installed (parallel, rsync, openssh-server)"; exit 77; }
done
at=$folder/ssh
mkdir -m 700 "$at" "$folder/scratch" "$folder/home"
ssh-keygen -q -t ed25519 -N "" -f "$at/host"
ssh-keygen -q -t ed25519 -N "" -f "$at/key"
cp "$at/key.pub" "$at/authorized"
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
cat > "$at/sshd_config" <<CONF
ListenAddress 127.0.0.1
Port $port
HostKey $at/host
AuthorizedKeysFile $at/authorized
PidFile none
UsePAM no
PasswordAuthentication no
StrictModes no
PermitRootLogin yes
SetEnv TMPDIR=$folder/scratch HOME=$folder/home
CONF
[ "$(id -u)" = 0 ] && mkdir -p /run/sshd
$(PATH=$PATH:/usr/sbin command -v sshd) -D -e -f "$at/sshd_config" 2> "$at/log" &
server=$!
trap 'kill $server $shared 2> /dev/null; rm -rf "$folder"' EXIT
shared=
until grep -qs "Server listening" "$at/log"; do
  kill -0 $server 2> /dev/null || { echo "skipped: sshd does not start here: $(tail -1 "$at/log")"; exit 77; }
  sleep 0.05
done
# Machines are named as a user would; what ssh needs to reach them stands in its configuration. The first keeps one
# connection for all calls, the second makes a new one for each, with a quick exchange of keys.
cat > "$at/config" <<CONF
Host lab1 lab2
  HostName 127.0.0.1
Host lab3
  HostName 127.0.0.1
  Port 1
Host lab1 lab2 lab3
  Port $port
  IdentityFile $at/key
  UserKnownHostsFile $at/known
  StrictHostKeyChecking no
  LogLevel ERROR
  KexAlgorithms curve25519-sha256
Host lab1
  ControlPath $at/shared
CONF
export PARALLEL_SSH="ssh -F $at/config" PARALLEL_HOME=$folder/parallel
mkdir "$PARALLEL_HOME"
ssh -F "$at/config" -M -N lab1 &
shared=$!
until [ -S "$at/shared" ]; do
  kill -0 $shared 2> /dev/null || { fail "no connection to lab1"; finish; }
  sleep 0.05
done

short_kick "$folder/kick.json" << 'PY'
spec["learner"]["settings"]["population"] = 6
spec["adaptation"]["learner"]["settings"]["population"] = 4
spec["adaptation"]["settings"]["generations"] = 1
spec["stages"].update(first_generations=2, next_generations=1, total_generations=2, measured_individuals=2)
PY
cat > "$folder/c.json" << 'JSON'
{"format": "uchilsim-comparison-1", "name": "c", "seeds": [1, 2, 3], "arms": [{"name": "a", "experiment": "kick.json"}]}
JSON
sed 's/"seeds": .*"arms"/"seeds": [1], "arms"/' "$folder/c.json" > "$folder/one-seed.json"
expect 0 "one process" "$btr" compare "$folder/c.json" --db "$folder/one.db" --jobs 1 --quiet --csv "$folder/one.csv"
printf 'lab1\n# the next one is switched off\nlab3\nlab2\n' > "$folder/hosts"
expect 0 "three machines, one of them not there" "$btr" compare "$folder/c.json" --db "$folder/all.db" --ssh "$folder/job" --hosts "$folder/hosts"
says err "btr: host lab3 is left out: "
one_line
[ "$(grep -c " done *100.0 %" "$folder/out")" = 3 ] || { fail "not all elements are done"; cat "$folder/out"; cat "$folder/job/parallel.log"; }
expect 0 "collecting" "$btr" array collect "$folder/job"
says out "3 elements collected"
expect 0 "the collected comparison" "$btr" compare "$folder/c.json" --db "$folder/all.db" --quiet --csv "$folder/all.csv"
cmp -s "$folder/one.csv" "$folder/all.csv" || fail "other results than of one process"

echo lab3 > "$folder/none"
expect 1 "no machine at all" "$btr" compare "$folder/one-seed.json" --db "$folder/x.db" --ssh "$folder/none-job" --hosts "$folder/none"
says err "no host that can be used"
expect 3 "it is written, and machines may come" "$btr" array collect "$folder/none-job"
expect 0 "with another machine" "$btr" array resume "$folder/none-job" --hosts "$folder/hosts"
[ "$(grep -c " done *100.0 %" "$folder/out")" = 1 ] || { fail "its element is not done"; cat "$folder/out"; }

# Cancelled from elsewhere while two elements are worked on: what they did came back, and they go on from there.
python3 -c '
import json, sys
folder = sys.argv[1]
spec = json.load(open(folder + "/kick.json"))
spec["name"] = "long"
spec["stages"].update(first_generations=300, next_generations=1, total_generations=300)
json.dump(spec, open(folder + "/long.json", "w"))
json.dump({"format": "uchilsim-comparison-1", "name": "long", "seeds": [1, 2, 3],
           "arms": [{"name": "a", "experiment": "long.json"}]}, open(folder + "/long-c.json", "w"))' "$folder"
# of FOLDER EXPRESSION: of the job's status in JSON, j
of() { "$btr" --json array status "$1" | python3 -c "import json, sys; j = json.load(sys.stdin); print($2)"; }
printf '2/lab1\n' > "$folder/two" # one machine, two elements at a time
"$btr" compare "$folder/long-c.json" --db "$folder/long.db" --ssh "$folder/long" --hosts "$folder/two" > "$folder/long.out" 2> "$folder/long.err" &
working=$!
until [ "$(of "$folder/long" 'sum(e["state"] == "running" and e["share"] > 0 for e in j["elements"])' 2> /dev/null)" = 2 ]; do
  kill -0 $working || { fail "the long job ended"; cat "$folder/long.err"; break; }
  sleep 0.2
done
[ "$(of "$folder/long" 'j["is_worked_on_over_ssh"], j["elements"][2]["state"], j["seconds_left"] > 0, j["trials_per_second"] > 0')" = "True queued True True" ] ||
  { fail "the status of a job that is worked on:"; "$btr" --json array status "$folder/long"; }
expect 0 "by two at once" "$btr" array resume "$folder/long" --hosts "$folder/two"
says out "nothing is left that could go on"
expect 0 "cancelling" "$btr" array cancel "$folder/long"
wait $working
[ $? = 3 ] || fail "the cancelled command did not say that it was stopped"
[ "$(of "$folder/long" '[e["state"] for e in j["elements"]], j["is_worked_on_over_ssh"]')" = "['stopped', 'stopped', 'not begun'] False" ] ||
  { fail "the states after it was cancelled:"; "$btr" array status "$folder/long"; }
for number in 1 2; do
  generations=$("$btr" --json status --db "$folder/long/$number.db" | python3 -c 'import json, sys; print(json.load(sys.stdin)[0]["generation"])')
  [ "$generations" -gt 0 ] || fail "element $number brought back $generations generations"
done
expect 1 "cancelling what nobody works on" "$btr" array cancel "$folder/long"
one_line
says err "nobody works on it"

# A blind trial, with a machine that is not there; cancelled from elsewhere it goes on with what is missing.
if has_generator; then
  expect 0 "a blind trial in one process" trial 3 --out "$folder/trial-one"
  expect 0 "a blind trial over ssh" trial 3 --out "$folder/trial" --ssh "$folder/trial-job" --hosts "$folder/hosts"
  says err "btr: host lab3 is left out: "
  expect 0 "collecting its cases" "$btr" array collect "$folder/trial-job"
  says out "3 elements collected"
  same_trial "$folder/trial-one" "$folder/trial" "a blind trial over ssh"
  expect 0 "more cases in one process" trial 17 --out "$folder/trial-one"
  trial 17 --out "$folder/trial" --ssh "$folder/trial-more" --hosts "$folder/two" --per-element 8 > "$folder/long.out" 2> "$folder/long.err" &
  working=$!
  until ls "$folder"/scratch/uchilsim-element-*/out/case_004/verdict.json > /dev/null 2>&1; do
    kill -0 $working 2> /dev/null || { fail "the longer trial ended"; cat "$folder/long.err"; break; }
    sleep 0.05
  done
  expect 0 "cancelling the trial" "$btr" array cancel "$folder/trial-more"
  wait $working
  [ $? = 3 ] || fail "the cancelled trial did not say that it was stopped"
  [ "$(of "$folder/trial-more" 'any(0 < e["share"] < 1 and e["trials_per_second"] > 0 for e in j["elements"])')" = True ] ||
    { fail "the states of the cancelled trial:"; "$btr" array status "$folder/trial-more"; }
  expect 0 "the trial goes on" "$btr" array resume "$folder/trial-more" --hosts "$folder/hosts"
  expect 0 "collecting the longer trial" "$btr" array collect "$folder/trial-more"
  same_trial "$folder/trial-one" "$folder/trial" "a cancelled blind trial over ssh"
fi

echo "# nobody" > "$folder/nobody"
expect 1 "no hosts" "$btr" compare "$folder/c.json" --db "$folder/x.db" --ssh "$folder/y" --hosts "$folder/nobody"
says err "machines that ssh reaches"
expect 2 "hosts are needed" "$btr" compare "$folder/c.json" --db "$folder/x.db" --ssh "$folder/y"
finish
