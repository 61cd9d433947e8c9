#!/usr/bin/env bash
# After the cells of the fault matrix, of which a busy machine leaves some open: fails if a fault of a device was measured
# in no program, or if more than a tenth of all cells is open. Before that each open cell has three more tries, one after
# another and with nothing beside them.
#   every_device.sh TALLY CLI_TEST        TALLY: a line "DEVICE measured|open PROGRAM_DEVICE_FAULT" for each cell
set -euo pipefail
tally=$1 program=$2
[[ -f $tally ]] || { echo "no cell has ended"; exit 0; }
# The cells that are not measured yet.
open_cells() { awk '{ seen[$3] = 1; if ($2 == "measured") measured[$3] = 1 }
                    END { for (cell in seen) if (!measured[cell]) print cell }' "$tally" | sort; }
# DEVICE_FAULT of which no program was measured.
missing() { awk '{ fault = $3; sub(/^[^_]*_/, "", fault); seen[fault] = 1; if ($2 == "measured") measured[fault] = 1 }
                 END { for (fault in seen) if (!measured[fault]) print fault }' "$tally" | sort; }
all=$(awk '{ print $3 }' "$tally" | sort -u | wc -l)
echo "$(open_cells | wc -l) of $all cells were left open by a busy machine"
for cell in $(open_cells); do
  for _ in 1 2 3; do
    FAULT_MATRIX_TALLY=$tally "$program" --gtest_filter="*FaultMatrix.Cell/$cell" || exit 1
    open_cells | grep -qx "$cell" || break
  done
done
left=$(missing)
[[ -z $left ]] || { echo "could be measured in no program, since this machine is too busy:" $left >&2; exit 1; }
open=$(open_cells | wc -l)
((10 * open <= all)) || { echo "$open of $all cells could not be measured: this machine is too busy" >&2; exit 1; }
