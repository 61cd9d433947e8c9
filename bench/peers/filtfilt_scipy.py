"""The chain of signal_bench.cc in SciPy: prints `scipy VERSION MEDIAN_CPU_ms RMS_m`."""
import time

import numpy as np
import scipy
from scipy import signal

N, PERIOD, SPACING, CUTOFF = 1_000_000, 0.25e-3, 0.025, 0.4
k = np.arange(N, dtype=float)
a = np.sin(0.05 * k) + 0.5 * np.cos(0.31 * k)
s = SPACING * (k + 0.3 * np.sin(0.7 * k))
grid = SPACING * np.arange(N - 1)
# Each pass at 0.802 of the cut-off, as an analogue frequency: -3 dB for both together.
corner = np.arctan((2**0.5 - 1) ** 0.25 * np.tan(np.pi * CUTOFF * SPACING)) / (np.pi * SPACING)
sections = signal.butter(2, corner, "highpass", fs=1 / SPACING, output="sos")


def chain():
    step = a * PERIOD**2
    step[0] *= 0.5
    h = np.empty(N)
    h[0] = 0.0
    h[1:] = np.cumsum(np.cumsum(step))[:-1]
    return signal.sosfiltfilt(sections, np.interp(grid, s, h))


chain()
times = []
for _ in range(9):
    start = time.process_time()
    x = chain()
    times.append(time.process_time() - start)
middle = x[x.size // 4 : 3 * x.size // 4]
print(f"scipy {scipy.__version__} {1e3 * np.median(times):.3f} {np.sqrt(np.mean(middle**2)):.9e}")
