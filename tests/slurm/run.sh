#!/usr/bin/env bash
# Proof on a real Slurm: a run through sbatch survives the failure of its node and gives what a run
# without Slurm gives.
#
# For root on a Debian machine or in a container that has no Slurm of its own. Installs slurm-wlm and
# munge if they are missing, and the executor into .venv; writes /etc/slurm/slurm.conf; starts munged,
# slurmctld and slurmd; runs the tiny workflow on a copy; kills slurmd and every process of the jobs
# that run, waits until Slurm has given the node up, starts slurmd again; compares all variables of
# all NetCDF files with those of a local run. Ends what it has started and, if all went well, removes
# what it has written.
set -euo pipefail

PROJECT=$(realpath "$(dirname "$0")/../..")
PYTHON=$PROJECT/.venv/bin/python
MARK="Written by tests/slurm/run.sh"
CONF=/etc/slurm/slurm.conf
TIMEOUT=20     # s without an answer after which a node has failed
CREDENTIAL=30  # s, which Slurm waits before a job that has lost its node starts again
MADE_CONF=no
RUN="" CONTROLLER="" SLURMD="" MUNGED=""  # processes to end, in this order

say() { echo "$(date +%T) $*"; }
fail() { echo "$(date +%T) FAILED: $*" >&2; exit 1; }

# --- Before anything starts ---------------------------------------------------------------------
[ "$(id -u)" = 0 ] || fail "needs root, to start munged, slurmctld and slurmd"
for daemon in slurmctld slurmd; do
  ! pgrep -x "$daemon" > /dev/null || fail "a $daemon runs here already: not for a machine in use"
done
if [ -e "$CONF" ] && ! grep -q "$MARK" "$CONF"; then
  fail "$CONF is not of this script: not for a machine in use"
fi
[ -x "$PYTHON" ] || fail "no $PYTHON: run make draft or make test first"
if ! command -v slurmctld munged sbatch > /dev/null; then
  say "installing slurm-wlm and munge"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends slurm-wlm munge > /dev/null
fi
"$PYTHON" -c "import snakemake_executor_plugin_slurm" 2> /dev/null ||
  "$PYTHON" -m pip install --quiet --disable-pip-version-check \
    -c "$PROJECT/envs/constraints.txt" -r "$PROJECT/envs/slurm.txt"

WORK=$(mktemp -d -t slurm-proof-XXXXXX)
STATE=$WORK/state
export SLURM_CONF=$CONF
export PATH=$PROJECT/.venv/bin:$PATH
mkdir -p "$STATE/ctld" "$STATE/d"
chmod 755 "$WORK" "$STATE"

# --- Processes ----------------------------------------------------------------------------------
below() { # process $1 and all of its descendants
  local child
  echo "$1"
  for child in $(cat /proc/"$1"/task/*/children 2> /dev/null || true); do below "$child"; done
}

steps() { # slurmstepd processes of the jobs in the queue, each with its tasks
  local job pid
  for job in $(squeue --noheader --states=running --format=%A); do
    for pid in $(pgrep -f "^slurmstepd: \[$job\." || true); do below "$pid"; done
  done
}

end() { # end processes by id and wait until they are gone
  local pid
  for pid in "$@"; do
    kill "$pid" 2> /dev/null || continue
    for _ in $(seq 50); do kill -0 "$pid" 2> /dev/null || break; sleep 0.2; done
    kill -9 "$pid" 2> /dev/null || true
  done
}

finish() {
  local code=$?
  trap - EXIT
  set +e
  # shellcheck disable=SC2086  # those that were not started are left out
  end $RUN
  if [ -n "$CONTROLLER" ] && [ -n "$(timeout 10 squeue --noheader --states=running)" ]; then
    timeout 10 scancel --user=root
    sleep 8  # longer than KillWait
  fi
  # shellcheck disable=SC2086
  end $CONTROLLER $SLURMD $MUNGED
  [ $MADE_CONF = no ] || rm -f "$CONF"
  if [ $code != 0 ]; then
    echo "what there is: $WORK" >&2
  else
    rm -rf "$WORK"
  fi
  exit $code
}
trap finish EXIT

start_slurmd() {
  slurmd -D -f "$CONF" > "$STATE/slurmd.out" 2>&1 &
  SLURMD=$!
}

wait_for() { # seconds, what is waited for, command...
  local deadline=$((SECONDS + $1)) what=$2
  shift 2
  until "$@"; do
    [ $SECONDS -lt $deadline ] || fail "$what: not within the time"
    sleep 1
  done
}

node_is() { sinfo --noheader --format=%T 2> /dev/null | grep -Eq "^($1)"; }
restarted() { [ -n "$(squeue --noheader --states=running,completed --format=%A --jobs="${LOST// /,}")" ]; }
solving() { # a job with realisations to solve is on the node, and one has begun to be solved
  squeue --noheader --states=running --format=%k | grep -Eq "rule_(repulsive|adhesive)_" &&
    [ -n "$(find "$WORK/run/results" -path '*/logs/solve_[ra]*.log' -print -quit)" ]
}

# --- Slurm --------------------------------------------------------------------------------------
dd if=/dev/urandom of="$STATE/munge.key" bs=128 count=1 status=none
chmod 400 "$STATE/munge.key"
munged --foreground --force --key-file="$STATE/munge.key" --socket="$STATE/munge.socket" \
  --pid-file="$STATE/munged.pid" --seed-file="$STATE/munged.seed" \
  > "$STATE/munged.out" 2>&1 &
MUNGED=$!
wait_for 10 "munged" test -S "$STATE/munge.socket"

mkdir -p "$(dirname $CONF)"
MADE_CONF=yes
sed -e "s|@MARK@|$MARK|" -e "s|@HOST@|$(hostname -s)|" -e "s|@STATE@|$STATE|" \
  -e "s|@CPUS@|$(nproc)|" -e "s|@TIMEOUT@|$TIMEOUT|" -e "s|@CREDENTIAL@|$CREDENTIAL|" \
  -e "s|@MEMORY@|$(awk '/MemTotal/ {print int($2 / 1024 * 0.9)}' /proc/meminfo)|" \
  "$PROJECT/tests/slurm/slurm.conf.in" > $CONF
slurmctld -D -f $CONF > "$STATE/slurmctld.out" 2>&1 &
CONTROLLER=$!
start_slurmd
wait_for 60 "the node is idle" node_is idle
say "Slurm $(sinfo --version | cut -d' ' -f2) on $(hostname -s), no accounting"

# --- The run ------------------------------------------------------------------------------------
"$PYTHON" "$PROJECT/tests/helpers/copy_workflow.py" "$WORK/run"
cd "$WORK/run"
CHOSEN=(--configfile config/config.yaml config/tiny.yaml)
BEGIN=$SECONDS
"$PYTHON" -m snakemake --profile profiles/slurm "${CHOSEN[@]}" --slurm-no-account \
  --slurm-status-command squeue --slurm-init-seconds-before-status-checks 5 --latency-wait 20 \
  --slurm-keep-successful-logs > "$WORK/slurm.log" 2>&1 &
RUN=$!
say "snakemake through sbatch"

# --- The failure --------------------------------------------------------------------------------
wait_for 1800 "a simulation runs" solving
sleep 2
LOST=$(squeue --noheader --states=running --format=%A | tr '\n' ' ')
FAILURE=$SECONDS
mapfile -t VICTIMS < <(steps)
kill -9 "$SLURMD" "${VICTIMS[@]}" 2> /dev/null || true  # some may just have ended
wait "$SLURMD" 2> /dev/null || true
say "killed slurmd and ${#VICTIMS[@]} processes of jobs $LOST"
wait_for 180 "Slurm gives the node up" node_is down
say "Slurm has given the node up: $(squeue --noheader --states=all --format='%A %T %r' --jobs="${LOST// /,}" | tr '\n' ';')"
start_slurmd
wait_for 120 "the node is back" node_is 'idle|mixed|allocated'
say "slurmd is back"
wait_for 300 "a lost job starts again" restarted
say "a lost job has started again, $((SECONDS - FAILURE)) s after the failure"

FAILED=no
wait "$RUN" || FAILED=yes
RUN=""
if [ $FAILED = yes ]; then
  tail -40 "$WORK/slurm.log" >&2
  fail "the run has not completed"
fi
say "the run has completed after $((SECONDS - BEGIN)) s"

RESTARTED=0
for job in $LOST; do
  ! grep -qi "requeue job JobId=$job due to failure of node" "$STATE/slurmctld.log" ||
    RESTARTED=$((RESTARTED + 1))
done
[ $RESTARTED -gt 0 ] || fail "none of the jobs $LOST was queued again"
AGAIN=$("$PYTHON" -m snakemake -n "${CHOSEN[@]}" --quiet host)
grep -q "Nothing to be done" <<< "$AGAIN" || fail "not everything is there: $AGAIN"

# --- The comparison -----------------------------------------------------------------------------
say "the same without Slurm"
"$PYTHON" "$PROJECT/tests/helpers/copy_workflow.py" "$WORK/local"
(cd "$WORK/local" && "$PYTHON" -m snakemake -j"$(nproc)" "${CHOSEN[@]}") > "$WORK/local.log" 2>&1 ||
  fail "the local run"
"$PYTHON" "$PROJECT/tests/slurm/compare.py" "$WORK/run/results/tiny" "$WORK/local/results/tiny"
JOBS=$(grep -c "has been submitted with SLURM jobid" "$WORK/slurm.log")
say "PASSED: $JOBS jobs of Slurm, $RESTARTED started again after the failure"
