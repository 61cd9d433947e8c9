#!/usr/bin/env bash
# every_device.sh passes where each device has a cell that was measured, or gets one, and fails otherwise.
#   self_test.sh SCRIPT WORK
set -euo pipefail
script=$1 work=$2
rm -rf "$work"
mkdir -p "$work"
fail() { echo "$1" >&2; exit 1; }

# A test program that says each time what `answer` has.
cat >"$work/program" <<'PROGRAM'
#!/usr/bin/env bash
device=${1#*feel_} device=${device%_SIGSTOP}
echo "$device" >>"${0%/*}/asked"
[[ $(cat "${0%/*}/answer") != fails ]] || exit 1
echo "$device $(cat "${0%/*}/answer")" >>"$FAULT_MATRIX_TALLY"
PROGRAM
chmod +x "$work/program"
run() { # ANSWER TALLY_LINES
  echo "$1" >"$work/answer"
  : >"$work/asked"
  printf '%s\n' "$2" >"$work/tally"
  "$script" "$work/tally" "$work/program" >"$work/out" 2>&1
}

run fails $'2diy measured\n2diy open\ndhd measured' || fail "each device has a cell: $(cat "$work/out")"
grep -q "1 of 3 cells were left open" "$work/out" || fail "the cells are not counted: $(cat "$work/out")"
[[ ! -s $work/asked ]] || fail "a device that was measured is tried again"
run measured $'2diy measured\nhaply open\nhaply open' || fail "the next try was measured: $(cat "$work/out")"
[[ $(cat "$work/asked") == haply ]] || fail "not haply alone, once, was tried again: $(cat "$work/asked")"
run open $'2diy measured\nhaply open' && fail "no cell of haply was measured"
grep -q "no cell of haply" "$work/out" || fail "the device is not named: $(cat "$work/out")"
[[ $(wc -l <"$work/asked") == 3 ]] || fail "not three tries: $(cat "$work/asked")"
run fails $'haply open' && fail "a cell that fails is no success"
"$script" "$work/nothing" "$work/program" >"$work/out" || fail "no cell has ended, and that failed"
