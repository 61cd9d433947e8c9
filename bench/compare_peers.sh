#!/usr/bin/env bash
# Resample + zero-phase filter + Verlet over 10^6 samples: ours, SciPy's and Octave's, in one run, one core each,
# processor time, so that a busy machine matters less.
#   bench/compare_peers.sh [BIN]     BIN: folder of signal_bench, by default build/release/bin
# A peer that is not installed is skipped; apt-get install python3-scipy octave octave-signal brings both.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=${1:-$here/../build/release/bin}
[[ -x $bin/signal_bench ]] || { echo "compare_peers: $bin/signal_bench is missing; build it first" >&2; exit 1; }
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

rows=()
# "chain_median",iterations,real_time,cpu_time,…,"rms_m"
ours=$("$bin/signal_bench" --benchmark_filter='^chain$' --benchmark_repetitions=9 --benchmark_report_aggregates_only=true \
  --benchmark_format=csv 2>/dev/null | awk -F, '/^"chain_median"/ {print $4, $NF}')
read -r our_ms our_rms <<<"$ours"
rows+=("asperity - $our_ms $our_rms")
# The first Python that has SciPy: another one may stand before Debian's.
python=""
for candidate in python3 /usr/bin/python3; do
  if "$candidate" -c 'import scipy' 2>/dev/null; then python=$candidate && break; fi
done
if [[ -n $python ]]; then
  rows+=("$("$python" "$here/peers/filtfilt_scipy.py")")
else
  echo "SciPy: not installed, skipped"
fi
# Octave may fail while it exits, after it has printed its line.
octave_row=$(octave-cli --norc "$here/peers/filtfilt_octave.m" 2>/dev/null | grep '^octave ' || true)
if [[ -n $octave_row ]]; then
  rows+=("$octave_row")
else
  echo "Octave with its signal package: not installed, skipped"
fi

printf '%-10s %-10s %12s %8s %16s\n' tool version cpu_ms ratio rms_m
for row in "${rows[@]}"; do
  read -r tool version ms rms <<<"$row"
  awk -v t="$tool" -v v="$version" -v ms="$ms" -v rms="$rms" -v own="$our_ms" \
    'BEGIN {printf "%-10s %-10s %12.2f %8.2f %16.6e\n", t, v, ms, ms / own, rms}'
  awk -v a="$rms" -v b="$our_rms" 'BEGIN {d = a / b - 1; exit !(d < 1e-5 && d > -1e-5)}' ||
    { echo "compare_peers: $tool's result differs from ours" >&2; exit 1; }
done
