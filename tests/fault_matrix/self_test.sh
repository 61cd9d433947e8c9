#!/usr/bin/env bash
# every_device.sh passes where each fault of each device was measured in a program, or is then, and few cells are open.
#   self_test.sh SCRIPT WORK
set -euo pipefail
script=$1 work=$2
rm -rf "$work"
mkdir -p "$work"
fail() { echo "$1" >&2; exit 1; }

# A test program that says each time what `answer` has.
cat >"$work/program" <<'PROGRAM'
#!/usr/bin/env bash
cell=${1#*Cell/}
echo "$cell" >>"${0%/*}/asked"
[[ $(cat "${0%/*}/answer") != fails ]] || exit 1
echo "some $(cat "${0%/*}/answer") $cell" >>"$FAULT_MATRIX_TALLY"
PROGRAM
chmod +x "$work/program"
run() { # ANSWER TALLY_LINES
  echo "$1" >"$work/answer"
  : >"$work/asked"
  printf '%s\n' "$2" >"$work/tally"
  "$script" "$work/tally" "$work/program" >"$work/out" 2>&1
}

ten=$(for i in 0 1 2 3 4 5 6 7 8 9; do echo "dhd measured feel_dhd_$i"; done)
run fails "$ten" || fail "all were measured: $(cat "$work/out")"
[[ ! -s $work/asked ]] || fail "a cell that was measured is tried again"
run measured "$ten"$'\nhaply open feel_haply_SIGSTOP' || fail "the next try was measured: $(cat "$work/out")"
grep -q "1 of 11 cells were left open" "$work/out" || fail "the cells are not counted: $(cat "$work/out")"
[[ $(cat "$work/asked") == feel_haply_SIGSTOP ]] || fail "not that cell alone, once, was tried again: $(cat "$work/asked")"
run open "$ten"$'\nhaply open feel_haply_SIGSTOP' && fail "a fault of haply was measured in no program"
grep -q "no program.*haply_SIGSTOP" "$work/out" || fail "the fault is not named: $(cat "$work/out")"
[[ $(wc -l <"$work/asked") == 3 ]] || fail "not three tries: $(cat "$work/asked")"
run open "$ten"$'\nhaply open feel_haply_SIGSTOP\nhaply measured studio_haply_SIGSTOP' || fail "one of 12 is open, the other program was measured: $(cat "$work/out")"
run open $'dhd open feel_dhd_1\ndhd measured studio_dhd_1' && fail "half of the cells are open"
grep -q "1 of 2 cells could not be measured" "$work/out" || fail "their number is not stated: $(cat "$work/out")"
run fails $'haply open feel_haply_SIGSTOP' && fail "a cell that fails is no success"
"$script" "$work/nothing" "$work/program" >"$work/out" || fail "no cell has ended, and that failed"
