#!/usr/bin/env bash
# Resample + zero-phase filter + Verlet over 10^6 samples: ours, SciPy's and Octave's, in one run, one core each.
#   bench/compare_peers.sh [BIN]     BIN: folder of signal_bench, by default build/release/bin
# A peer that is not installed is skipped; apt-get install python3-scipy octave octave-signal brings both.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=${1:-$here/../build/release/bin}
[[ -x $bin/signal_bench ]] || { echo "compare_peers: $bin/signal_bench is missing; build it first" >&2; exit 1; }
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

rows=()
# "chain_median",iterations,real_time,…,"rms_m"
ours=$("$bin/signal_bench" --benchmark_filter='^chain$' --benchmark_repetitions=9 --benchmark_report_aggregates_only=true \
  --benchmark_format=csv 2>/dev/null | awk -F, '/^"chain_median"/ {print $3, $NF}')
read -r our_ms our_rms <<<"$ours"
rows+=("asperity - $our_ms $our_rms")
if /usr/bin/env python3 -c 'import scipy' 2>/dev/null; then
  rows+=("$(python3 "$here/peers/filtfilt_scipy.py")")
else
  echo "SciPy: not installed, skipped"
fi
if command -v octave-cli >/dev/null && octave-cli --eval 'pkg load signal' >/dev/null 2>&1; then
  rows+=("$(octave-cli --no-gui-libs --norc "$here/peers/filtfilt_octave.m" 2>/dev/null)")
else
  echo "Octave with its signal package: not installed, skipped"
fi

printf '%-10s %-10s %12s %8s %16s\n' tool version median_ms ratio rms_m
for row in "${rows[@]}"; do
  read -r tool version ms rms <<<"$row"
  awk -v t="$tool" -v v="$version" -v ms="$ms" -v rms="$rms" -v own="$our_ms" \
    'BEGIN {printf "%-10s %-10s %12.2f %8.2f %16.6e\n", t, v, ms, ms / own, rms}'
  awk -v a="$rms" -v b="$our_rms" 'BEGIN {d = a / b - 1; exit !(d < 1e-6 && d > -1e-6)}' ||
    { echo "compare_peers: $tool's result differs from ours" >&2; exit 1; }
done
