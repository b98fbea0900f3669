#!/bin/sh
# A Slurm cluster of this one machine, for tests: its own keys, ports and files, all in FOLDER, beside whatever Slurm
# may run here. Needs slurm-wlm and munge, but no accounting, no systemd and no root.
#   local_slurm.sh start FOLDER    starts it and waits until it takes jobs; use it with SLURM_CONF=FOLDER/slurm.conf
#   local_slurm.sh stop FOLDER     ends its jobs and its daemons
set -eu
PATH=$PATH:/usr/sbin:/sbin

fail() {
    echo "local_slurm.sh: $*" >&2
    exit 1
}

# What was started already is ended.
give_up() {
    stop
    fail "$@"
}

free_ports() {
    python3 - <<'PYTHON'
import socket
holders = [socket.socket() for _ in range(2)]
for holder in holders:
    holder.bind(("127.0.0.1", 0))
print(*(holder.getsockname()[1] for holder in holders))
PYTHON
}

write_configuration() {
    read -r controller_port node_port <<PORTS
$(free_ports)
PORTS
    cat > slurm.conf <<CONF
ClusterName=samara-test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$controller_port
SlurmdPort=$node_port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ReturnToService=2
KillWait=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=test Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
}

start() {
    for program in munged slurmctld slurmd sinfo; do
        command -v "$program" > /dev/null || fail "$program is not installed; on Debian: apt install slurm-wlm munge"
    done
    [ -e slurm.conf ] && fail "$folder holds a cluster; stop it first"
    mkdir -p state spool
    head -c 128 /dev/urandom > munge.key
    chmod 600 munge.key
    chmod 755 .
    munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
        --log-file="$folder/munged.log" --seed-file="$folder/munged.seed" > munged.out 2>&1 ||
        fail "munged did not start: $(tail -n 1 munged.out)"
    write_configuration
    slurmctld -f "$folder/slurm.conf" || give_up "slurmctld did not start; see $folder/slurmctld.log"
    slurmd -f "$folder/slurm.conf" || give_up "slurmd did not start; see $folder/slurmd.log"
    for _ in $(seq 150); do
        state=$(sinfo --noheader --format=%T 2>> sinfo.out || true)
        [ "$state" = idle ] && return
        sleep 0.2
    done
    give_up "the node does not come up: state '$state'; see $folder/slurmctld.log and slurmd.log"
}

# Ends the process whose id a file holds, and waits for it.
end() {
    [ -s "$1" ] || return 0
    id=$(cat "$1")
    kill "$id" 2> /dev/null || return 0
    for _ in $(seq 50); do
        kill -0 "$id" 2> /dev/null || return 0
        sleep 0.1
    done
    kill -9 "$id" 2> /dev/null || true
}

stop() {
    if [ -e slurm.conf ]; then
        scancel --user="$user" 2> /dev/null || true
        for _ in $(seq 50); do
            [ -z "$(squeue --noheader 2> /dev/null)" ] && break
            sleep 0.2
        done
    fi
    for daemon in slurmd slurmctld munged; do
        end "$daemon.pid"
    done
    rm -f slurm.conf
}

[ $# -eq 2 ] || fail "usage: local_slurm.sh start|stop FOLDER"
mkdir -p "$2"
cd "$2"
folder=$(pwd -P)
user=$(id -un)
host=$(hostname -s)
export SLURM_CONF="$folder/slurm.conf"
case "$1" in
    start) start ;;
    stop) stop ;;
    *) fail "usage: local_slurm.sh start|stop FOLDER" ;;
esac
