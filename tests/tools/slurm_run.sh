#!/usr/bin/env bash
# slurm_run.sh PROGRAM SCENE FOLDER: starts a private Slurm on this machine (controller and four
# hosts, each a slurmd), and runs on it the job that `luxodus deploy --for slurm` writes for SCENE:
# 4 million particles, a controller and four workers. It runs twice, undisturbed and with a killed
# worker; both times the flux must equal that of `luxodus run`. Logs are in FOLDER. Needs root and
# Debian's slurmctld, slurmd, slurm-client and munge; exits with 77 if these are missing. It stops
# everything that it starts.
set -euo pipefail

program=$(realpath "$1") scene=$(realpath "$2")
mkdir -p "$3"
folder=$(realpath "$3")
for tool in munged slurmctld slurmd sbatch squeue; do
  PATH=$PATH:/usr/sbin command -v "$tool" >/dev/null || { echo "there is no $tool" >&2; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "needs root" >&2; exit 77; }
export PATH=$PATH:/usr/sbin SLURM_CONF=$folder/slurm/slurm.conf
hosts=(lux1 lux2 lux3 lux4)
machine=$(hostname -s)

clean_up() {
  local id
  if scancel --quiet --user=root 2>/dev/null; then until_true none_runs || true; fi
  for id in "$folder"/slurm/*.pid; do kill "$(cat "$id")" 2>/dev/null || true; done
}
trap clean_up EXIT

# An unused port, followed by this many unused ones.
first_port() {
  local port=$1 i
  for i in $(seq 0 "$2"); do
    if (exec 3<>"/dev/tcp/127.0.0.1/$((port + i))") 2>/dev/null; then
      first_port $((port + 100)) "$2"
      return
    fi
  done
  echo "$port"
}

write_slurm_conf() {
  local base i
  base=$(first_port 28600 8)
  {
    cat <<END
ClusterName=luxodus
SlurmctldHost=$machine(127.0.0.1)
SlurmctldPort=$base
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/slurm/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$folder/slurm/state
SlurmctldPidFile=$folder/slurm/slurmctld.pid
SlurmctldLogFile=$folder/slurm/slurmctld.log
SlurmdPidFile=$folder/slurm/slurmd-%n.pid
SlurmdLogFile=$folder/slurm/slurmd-%n.log
SlurmdSpoolDir=$folder/slurm/spool-%n
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
ReturnToService=2
KillWait=5
SlurmdParameters=config_overrides
END
    for i in "${!hosts[@]}"; do
      echo "NodeName=${hosts[i]} NodeHostname=$machine NodeAddr=127.0.0.1" \
        "Port=$((base + 1 + i)) CPUs=2 RealMemory=2000 State=UNKNOWN"
    done
    echo "PartitionName=all Nodes=lux[1-4] Default=YES MaxTime=10 State=UP"
  } >"$SLURM_CONF"
}

start_slurm() {
  mkdir -p "$folder"/slurm/state
  (umask 077 && head -c 1024 /dev/urandom >"$folder/slurm/munge.key")
  munged --force --key-file="$folder/slurm/munge.key" --socket="$folder/slurm/munge.socket" \
    --pid-file="$folder/slurm/munged.pid" --log-file="$folder/slurm/munged.log" \
    --seed-file="$folder/slurm/munge.seed"
  write_slurm_conf
  slurmctld
  for host in "${hosts[@]}"; do
    mkdir -p "$folder/slurm/spool-$host"
    slurmd -N "$host"
  done
}

write_cluster() {
  local i port
  port=$(first_port 27600 40)
  printf '[run]\nname = "slurm"\nscene = "%s"\nparticles = 4_000_000\nout = "%s"\n' \
    "$scene" "$folder/out"
  printf '[keys]\nfolder = "keys"\n[timeouts]\nlost_s = 3\n'
  for i in "${!hosts[@]}"; do
    printf '[[host]]\nname = "%s"\naddress = "127.0.0.1"\nfirst_port = %s\n' \
      "${hosts[i]}" $((port + 10 * i))
    printf '[[node]]\nname = "n%s"\nhost = "%s"\n' "$i" "${hosts[i]}"
  done
  printf '[[node]]\nname = "controller"\nhost = "lux1"\nrole = "controller"\n'
}

# until_true COMMAND...: tries every 0.2 s, for at most two minutes.
until_true() {
  local tries
  for tries in $(seq 600); do
    "$@" && return
    sleep 0.2
  done
  echo "$* has not come true after $tries tries" >&2
  return 1
}
none_runs() { [ -z "$(squeue -h)" ]; }
all_idle() { [ "$(sinfo -h -t idle -o %D)" = "${#hosts[@]}" ]; }
has_ended() { [ -z "$(squeue -h -j "$job")" ]; }
has_begun() { grep -qs run=begun "slurm-$job.log"; }

# job_ends_well HOW: waits for `job`, which must complete with the flux of the plain loop.
job_ends_well() {
  until_true has_ended
  cat "slurm-$job.log"
  scontrol show job "$job" | grep -E 'JobState=COMPLETED' || { scontrol show job "$job"; exit 1; }
  cmp "$folder/out/flux.lux" "$folder/plain/flux.lux"
  rm -r "$folder/out"
  echo "$1: the flux of job $job is that of luxodus run"
}

cluster=$folder/cluster.toml
write_cluster >"$cluster"
"$program" keygen --cluster "$cluster" >/dev/null
"$program" deploy "$cluster" --for slurm --out "$folder/deploy" --program "$program"
start_slurm
cd "$folder"
until_true all_idle
sinfo -N
"$program" run "$scene" --particles 4M --no-views --out "$folder/plain" >/dev/null

job=$(sbatch --parsable deploy/slurm.sbatch)
job_ends_well "undisturbed"

job=$(sbatch --parsable deploy/slurm.sbatch)
until_true has_begun
kill -9 "$(pgrep -f "^$program node --config $cluster --name n1\$")"
job_ends_well "a worker killed"
grep -q 'n1 ended with 137' "slurm-$job.log"
