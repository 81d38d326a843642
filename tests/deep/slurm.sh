#!/bin/sh
# Slurm job arrays on this machine, as the recipes describe them: slurmctld, slurmd and munge, one
# node; a course in shards, problems and cases a task each. If Slurm does not start here, the script
# says why, and runs the tasks of the arrays by hand, one by one.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
lantern=${LANTERN:-$root/build/lantern}
work=$(mktemp -d)
chmod 755 "$work"
started=""
stop() {
  for pid in $started; do kill "$pid" 2>/dev/null || true; done
  sleep 1
  for pid in $started; do kill -KILL "$pid" 2>/dev/null || true; done
  rm -rf "$work"
}
trap stop EXIT
cd "$work"
fail() { echo "FAILED: $*"; exit 1; }
recipe=$root/tests/deep/recipes/slurm.sbatch
course=""
for s in pong_bsp kdtree_atlas n_squared; do course="$course $root/scenarios/$s.toml"; done
export LANTERN="$lantern"
"$lantern" render $course -o one >one.log 2>&1 || fail "one run: $(tail -n 3 one.log)"

each=$root/tests/deep/recipes/each.sbatch
problems="projectile oscillator" cases="root_too_small zeno"
export OPTIONS=""

# What a task each has left: all that was asked for, and one page of what was measured.
each_is_there() {
  "$lantern" measure --from measured/* -o page >page.log 2>&1 || fail "$(cat page.log)"
  for problem in $problems; do
    [ -f "measured/$problem/measure.csv" ] || fail "$problem was not measured: $(cat lantern-*.log)"
  done
  for title in Projectile Oscillator; do
    grep -q "<h2>$title" page/report.html || fail "no $title on the page"
  done
  for case in $cases; do
    grep -q '"finished": true' "tried/$case/stress.json" || fail "$case was not tried: $(cat lantern-*.log)"
  done
}

same_as_one() {
  rm -rf compared
  mkdir compared
  for s in one/*; do cp -r "out/$(basename "$s")" compared/; done
  diff -r one compared || fail "differs from one run"
}

# --- the daemons, all of their files in the work folder ---
why=""
node=$(hostname -s)
start_slurm() {
  for program in munged slurmctld slurmd sbatch; do
    command -v "$program" >/dev/null || { why="there is no $program: apt-get install slurm-wlm"; return 1; }
  done
  [ "$(id -u)" = 0 ] || { why="slurmd must be started by root"; return 1; }
  mkdir munge state spool run
  dd if=/dev/urandom of=munge/key bs=1 count=1024 2>/dev/null
  chmod 700 munge
  chmod 600 munge/key
  munged --foreground --force --key-file="$work/munge/key" --socket="$work/run/munge" \
    --pid-file="$work/munge/pid" --log-file="$work/munge/log" --seed-file="$work/munge/seed" \
    >munged.log 2>&1 &
  started="$!"
  cat >slurm.conf <<END
ClusterName=lantern
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/run/munge
CredType=cred/munge
SlurmctldPort=${SLURM_TEST_PORT:-36817}
SlurmdPort=$((${SLURM_TEST_PORT:-36817} + 1))
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/run/slurmctld.pid
SlurmdPidFile=$work/run/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=10 State=UP
END
  export SLURM_CONF="$work/slurm.conf"
  tries=0
  until [ -S run/munge ]; do
    tries=$((tries + 1))
    [ $tries -lt 100 ] || { why="munged does not start: $(tail -n 2 munged.log munge/log 2>/dev/null)"; return 1; }
    sleep 0.1
  done
  slurmctld -D -f "$SLURM_CONF" >ctld.out 2>&1 &
  started="$started $!"
  slurmd -D -f "$SLURM_CONF" -N "$node" >slurmd.out 2>&1 &
  started="$started $!"
  tries=0
  until sinfo -h -o %T 2>/dev/null | grep -q idle; do
    tries=$((tries + 1))
    [ $tries -lt 150 ] || { why="no node of Slurm gets ready: $(tail -qn 3 slurmctld.log ctld.out slurmd.log slurmd.out 2>/dev/null)"; return 1; }
    sleep 0.2
  done
}

begun=$(date +%s%N)
if start_slurm; then
  job=$(sbatch --parsable --array=1-3 "$recipe" out 4 $course)
  sbatch --wait --dependency=afterany:"$job" --output merge.log --wrap "$lantern merge out" >said 2>&1 &&
    fail "a merge without shard 4"
  grep -q "shard 4/4 of pong_bsp and 2 more is missing: run lantern render" merge.log || fail "$(cat merge.log)"
  sbatch --wait --array=4 "$recipe" out 4 $course >said 2>&1 || fail "shard 4: $(cat said lantern-*.log)"
  sbatch --wait --output merge.log --wrap "$lantern merge out" >said 2>&1 || fail "$(cat said merge.log)"
  same_as_one
  OPTIONS="--quick --no-peers" sbatch --wait --array=1-2 "$each" measured measure $problems >said 2>&1 ||
    fail "measure: $(cat said lantern-*.log)"
  sbatch --wait --array=1-2 "$each" tried stress $cases >said 2>&1 || fail "stress: $(cat said lantern-*.log)"
  each_is_there
  echo "a job array of 4 shards on one node, one of them done again by its number: the same bytes;" \
    "2 problems and 2 cases a task each;" \
    "$(awk -v a="$begun" -v b="$(date +%s%N)" 'BEGIN { printf "%.1f", (b - a) / 1e9 }') s with the daemons"
else
  for task in 1 2 3 4; do
    SLURM_ARRAY_TASK_ID=$task sh "$recipe" out 4 $course >task.log 2>&1 || fail "$(cat task.log)"
  done
  "$lantern" merge out >merge.log 2>&1 || fail "$(cat merge.log)"
  same_as_one
  for task in 1 2; do
    SLURM_ARRAY_TASK_ID=$task OPTIONS="--quick --no-peers" sh "$each" measured measure $problems \
      >task.log 2>&1 || fail "$(cat task.log)"
    SLURM_ARRAY_TASK_ID=$task sh "$each" tried stress $cases >task.log 2>&1 || fail "$(cat task.log)"
  done
  each_is_there
  echo "left out: Slurm does not run here ($(echo $why)); its 4 shards, 2 problems and 2 cases by hand:" \
    "the same bytes"
fi
