#!/usr/bin/env bash
# After the cells of the fault matrix: fails if there is a device of which none was measured, for the machine was busy.
# Before that such a device has three more tries, one after another and with nothing beside them.
#   every_device.sh TALLY CLI_TEST        TALLY: a line "DEVICE measured" or "DEVICE open" for each cell
set -euo pipefail
tally=$1 program=$2
[[ -f $tally ]] || { echo "no cell has ended"; exit 0; }
awk '{ ++all; if ($2 == "open") ++open }
     END { printf "%d of %d cells were left open by a busy machine\n", open, all }' "$tally"
missing() { awk '{ seen[$1] = 1; if ($2 == "measured") measured[$1] = 1 }
                 END { for (device in seen) if (!measured[device]) print device }' "$tally" | sort; }
for device in $(missing); do
  for _ in 1 2 3; do
    FAULT_MATRIX_TALLY=$tally "$program" --gtest_filter="*FaultMatrix.Cell/feel_${device}_SIGSTOP" || exit 1
    missing | grep -qx "$device" || break
  done
done
left=$(missing)
[[ -z $left ]] || { echo "no cell of" $left "could be measured: this machine is too busy" >&2; exit 1; }
