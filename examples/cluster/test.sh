#!/usr/bin/env bash
# Runs the scripts of this folder on a Slurm of one machine (Debian's slurm-wlm, as root) and on HyperQueue (in the Python of
# $PYTHON), with a task that is killed, and holds the stores against one computed at once.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
export IMPACT_ATLAS=${IMPACT_ATLAS:-$(command -v impact-atlas)}
export PLANE="--x omega=0.3:3.9:96 --y delta=0.05:0.5:64 --transient 150 --observe 50 --fixed-periods --tile 16"
PYTHON=${PYTHON:-python3}
work=$(mktemp -d)
trap 'stop' EXIT

stop() {
    for daemon in slurmd slurmctld munged; do
        [ -f "$work/$daemon.pid" ] && kill "$(cat "$work/$daemon.pid")" 2>/dev/null || true
    done
    sleep 1
    rm -rf "$work" || true
}

start_slurm() {
    # A munge and a Slurm of its own, in a folder of its own.
    dd if=/dev/urandom of="$work/munge.key" bs=1024 count=1 2>/dev/null
    chown -R munge: "$work/munge.key" && chmod 400 "$work/munge.key"
    chmod 755 "$work"
    mkdir -p "$work/munge" && chown munge: "$work/munge" && chmod 755 "$work/munge"
    mv "$work/munge.key" "$work/munge/key"
    runuser -u munge -- munged --key-file="$work/munge/key" --socket="$work/munge/socket" \
        --pid-file="$work/munge/munged.pid" --log-file="$work/munge/log" --seed-file="$work/munge/seed" --force
    cp "$work/munge/munged.pid" "$work/munged.pid"
    local host cores
    host=$(hostname -s)
    cores=$(nproc)
    cat >"$work/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobRequeue=1
MaxArraySize=1001
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores State=UNKNOWN
PartitionName=test Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
    export SLURM_CONF=$work/slurm.conf
    mkdir -p "$work/state" "$work/spool"
    slurmctld
    slurmd
    for _ in $(seq 30); do
        sinfo -h -o %T 2>/dev/null | grep -q idle && return
        sleep 1
    done
    sinfo || true
    cat "$work/slurmctld.log" "$work/slurmd.log"
    exit 1
}

# Waits until no job is left in the queue.
drained() {
    for _ in $(seq 300); do
        [ -z "$(squeue -h)" ] && return
        sleep 1
    done
    squeue
    exit 1
}

same() {
    diff -rq --exclude=.impact-atlas "$work/whole.zarr" "$1" && echo "$1: the same bits as at once"
}

cd "$work"
cp "$here"/* .
echo "computing the plane at once"
# shellcheck disable=SC2086 # the plane is several words
"$IMPACT_ATLAS" -q map $PLANE --backend cpu --data whole.zarr >/dev/null

start_slurm
echo "Slurm $(sinfo -V): an array of 6 tasks, one killed and put back into the queue"
DATA=$work/slurm.zarr sbatch --array=1-6 --cpus-per-task=1 slurm-cpu.sh
for _ in $(seq 300); do
    # Some tile of a part under way is there.
    task=$(squeue -h -t R -o '%i' | head -n 1)
    [ -n "$task" ] && ls slurm.zarr/regime/c/*/* >/dev/null 2>&1 && break
    sleep 0.2
done
[ -n "$task" ] || { echo "no task ran" >&2; squeue -o "%i %t %r"; sinfo -N -l; tail -n 5 "$work"/*.log; exit 1; }
pid=$(pgrep -f -- "--data $work/slurm.zarr --part" | head -n 1)
kill -9 "$pid"
scontrol requeue "$task" || true
echo "killed process $pid, requeued task $task"
drained
"$IMPACT_ATLAS" status slurm.zarr
missing=$("$IMPACT_ATLAS" status slurm.zarr --json | "$PYTHON" -c 'import json, sys; print(json.load(sys.stdin)["missing"])')
if [ "$missing" != 0 ]; then
    # The killed process may have been another task's than the requeued one: that one failed, and is run again.
    PARTS=6 DATA=$work/slurm.zarr sbatch --array=1-6 --cpus-per-task=1 slurm-cpu.sh
    drained
fi
same "$work/slurm.zarr"

if "$PYTHON" -c 'import hyperqueue' 2>/dev/null; then
    echo "HyperQueue: 6 tasks, one killed"
    export DATA=$work/hq.zarr
    "$PYTHON" hyperqueue-parts.py 6 >hq.log 2>&1 &
    queue=$!
    for _ in $(seq 100); do
        ls hq.zarr/regime/c/*/* >/dev/null 2>&1 && break
        sleep 0.2
    done
    kill -9 "$(pgrep -f -- "--data $work/hq.zarr --part" | head -n 1)"
    wait "$queue" || true
    "$IMPACT_ATLAS" status hq.zarr
    # HyperQueue counts a task that was killed as failed; the same job again finishes it.
    "$PYTHON" hyperqueue-parts.py 6 >>hq.log 2>&1 || { cat hq.log; exit 1; }
    same "$work/hq.zarr"
else
    echo "HyperQueue is not installed in $PYTHON: not tested"
fi
