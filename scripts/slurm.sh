#!/usr/bin/env bash
# A sweep as an array job of Slurm on two nodes, both on this machine: two tasks are cancelled under way, what is open is submitted
# again, and the shards together are the bytes of the whole. Needs Debian's packages slurm-wlm and munge, root, and `closeranks`:
#
#     apt-get install --no-install-recommends slurm-wlm munge
#     cargo build --release -p closeranks && scripts/slurm.sh target/release/closeranks
set -euo pipefail
closeranks=$(realpath "${1:?which closeranks? such as target/release/closeranks}")
runs=${2:-120}
file=$(realpath "$(dirname "$0")/../scenarios/campaign.toml")
work=$(mktemp -d)
cd "$work"
export SLURM_CONF=$work/slurm.conf
started=()
trap 'kill "${started[@]}" 2> /dev/null || true; wait; rm -rf "$work"' EXIT

mkdir state n1 n2
cat > slurm.conf << END
ClusterName=two
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
StateSaveLocation=$work/state
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/%n.pid
SlurmdSpoolDir=$work/%n
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
NodeName=n1 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=17001 CPUs=1
NodeName=n2 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=17002 CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES State=UP
END
if ! munge -n > /dev/null 2>&1; then
  install -d -o munge /run/munge
  su -s /bin/sh munge -c /usr/sbin/munged
fi
for daemon in "slurmctld -D" "slurmd -D -N n1" "slurmd -D -N n2"; do
  $daemon > "daemon-${#started[@]}.log" 2>&1 &
  started+=($!)
done
# Until a condition holds, at most two minutes.
until_() { for _ in $(seq 240); do if "$@"; then return; fi; sleep 0.5; done; echo "waited in vain: $*"; exit 1; }
both_idle() { test "$(sinfo -h -t idle -o %D 2> /dev/null)" = 2; }
until_ both_idle
sinfo

cat > sweep.sh << END
#!/bin/sh
export CLOSERANKS_SHARDS=6
exec "$closeranks" sweep "$file" --runs $runs --shard auto --jobs 1 --quiet -o out-\$SLURM_ARRAY_TASK_ID
END
# Exit code 1 says that a law was broken, as laws of \`composed\` are; a job that runs to its end is a good one here.
job=$(sbatch --parsable --array=1-6 --output=task-%a.log sweep.sh)
two_begun() { ls out-1/part-* out-2/part-* > /dev/null 2>&1; }
until_ two_begun
scancel --signal=KILL --full "${job}_1" "${job}_2"
none_left() { test -z "$(squeue -h)"; }
until_ none_left
echo "-- after the first submission, of which two tasks were killed:"
"$closeranks" sweep --status out-* | tee status || true
open=$(sed -n 's/^open: //p' status)
echo "-- sbatch --array=$open"
sbatch --parsable --array="$open" --output=again-%a.log sweep.sh
until_ none_left
"$closeranks" sweep --status out-*
"$closeranks" sweep merge out-* -o merged --quiet || true
"$closeranks" sweep "$file" --runs "$runs" --quiet -o whole || true
cmp merged/runs.parquet whole/runs.parquet
echo "-- merged/runs.parquet and whole/runs.parquet: the same $(stat -c %s whole/runs.parquet) bytes"
