"""SIGINT ends each long call within a second, and other threads of Python run meanwhile."""

import os
import subprocess
import sys
import textwrap

import pytest

# What each call needs, and the call, which takes some seconds if nothing ends it. `after` shows that what was worked
# on is usable and as it was.
PREPARE = """
import numpy as np, asperity
def grid(n):
    x = np.arange(n) * 1e-4
    u, v = (a.ravel() for a in np.meshgrid(x, x))
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    vertices = np.column_stack([u, v, 2e-4 * np.sin(300 * u) * np.cos(200 * v)])
    return vertices, np.vstack([np.column_stack([i, i + 1, i + n + 1]), np.column_stack([i, i + n + 1, i + n])])
rng = np.random.default_rng(1)
"""
CALLS = {
    "steps": (
        "r = asperity.Renderer(asperity.Scene(*grid(100))); p = np.tile([0.005, 0.005, -1e-4], (5_000_000, 1))\n"
        "p[:, 0] += 1e-3 * np.sin(1e-3 * np.arange(len(p)))\n"
        "start = np.tile([0.005, 0.005, 1e-3], (5, 1)); r.steps(start); twin = asperity.Renderer(asperity.Scene(*grid(100))); twin.steps(start)",
        "r.steps(p)",
        "np.array_equal(r.steps(p[:50])['force_N'], twin.steps(p[:50])['force_N'])",
    ),
    "closest_points": (
        "m = asperity.Mesh(*grid(300)); p = rng.uniform(-0.05, 0.1, (5_000_000, 3))",
        "m.closest_points(p)",
        "len(m.closest_points(p[:3])[1]) == 3",
    ),
    "cast_rays": (
        "m = asperity.Mesh(*grid(300)); p = rng.uniform(0, 0.03, (6_000_000, 3)); d = np.tile([0.9, 0.3, -0.1], (len(p), 1))",
        "m.cast_rays(p, d)",
        "len(m.cast_rays(p[:3], d[:3])[0]) == 3",
    ),
    "heights": (
        "t = asperity.fit_texture(rng.normal(size=4000) * 1e-6, 25e-6); x = np.arange(20_000_000) * 1e-7",
        "t.heights(x)",
        "t.heights(0.001).shape == (1,)",
    ),
    "vibration": (
        "t = asperity.fit_texture(rng.normal(size=4000) * 1e-6, 25e-6)",
        "t.vibration({'duration_s': 3600})",
        "t.vibration({'duration_s': 0.01}).shape == (80,)",
    ),
    "roughness": (
        "z = rng.normal(size=8_000_000) * 1e-6",
        "asperity.roughness(z, 1e-6)",
        "asperity.roughness(z[:9000], 1e-6)['Rq_m'] > 0",
    ),
    "robust roughness": (
        "z = rng.normal(size=1_000_000) * 1e-6",
        "asperity.roughness(z, 1e-6, {'lambda_c_mm': 0.8, 'filter': 'robust'})",
        "asperity.roughness(z[:9000], 1e-6)['Rq_m'] > 0",
    ),
    "fit_texture": (
        "z = rng.normal(size=1_000_000) * 1e-6",
        "asperity.fit_texture(z, 1e-6, {'length_mm': 500, 'coefficients': 20000})",
        "asperity.fit_texture(z[:20000], 1e-6).model == 'fourier1d'",
    ),
    "fit_areal_texture": (
        "x, y = rng.uniform(0, 0.05, (2, 1_000_000)); z = 1e-5 * np.sin(900 * x + 300 * y)",
        "asperity.fit_areal_texture(x, y, z, {'iterations': 100000, 'smoothness': 1e-9, 'spacing_mm': 0.05})",
        "True",
    ),
    "Mesh": ("v, t = grid(1500)", "asperity.Mesh(v, t)", "len(asperity.Mesh(v, t[:9])) == 9"),
    "Renderer": ("s = asperity.Scene(*grid(1500))", "asperity.Renderer(s)", "len(s) == 1"),
    "paint": (
        "s = asperity.Scene(*grid(1200)); t = asperity.fit_texture(rng.normal(size=4000) * 1e-6, 25e-6)",
        "s.paint(t, [[0.005, 0.005, 0], [0.11, 0.1, 0], [0.1, 0.01, 0], [0.01, 0.1, 0]], half_width_m=0.01)",
        "s.texture_indices() == []",
    ),
    "read_mesh": (
        "v, t = grid(1200)\n"
        "with open('large.obj', 'w') as f:\n"
        "    np.savetxt(f, v, 'v %.9f %.9f %.9f'); np.savetxt(f, t + 1, 'f %d %d %d')",
        "asperity.read_mesh('large.obj')",
        "True",
    ),
    "read_scene": (
        "v, t = grid(1200)\n"
        "with open('large.obj', 'w') as f:\n"
        "    np.savetxt(f, v, 'v %.9f %.9f %.9f'); np.savetxt(f, t + 1, 'f %d %d %d')",
        "asperity.read_scene('large.obj')",
        "True",
    ),
    "import_recording": (
        "t = np.arange(1_500_000) / 1000; z = 0 * t; w = 4.4 * t; s = np.sin(w)\n"
        "np.savetxt('imu.csv', np.column_stack([t, s, z, z + 9.81, z, z, 0.1 * s]), fmt='%.9f', delimiter=',', comments='',\n"
        "           header='t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps')\n"
        "np.savetxt('pose.csv', np.column_stack([t[::10], 0.1 * s[::10], z[::10], z[::10], z[::10] + 1, z[::10], z[::10], z[::10]]),\n"
        "           fmt='%.9f', delimiter=',', comments='', header='t_s,px_m,py_m,pz_m,qw,qx,qy,qz')",
        "asperity.import_recording('pose.csv', 'imu.csv', unchecked=True)",
        "True",
    ),
    "simulate": (
        "",
        "asperity.simulate('sine', settings={'hand.length_m': 0.8, 'hand.speed_mps': 0.01})",
        "True",
    ),
}
LONGEST_S = 1.0  # from the signal to KeyboardInterrupt; on a quiet machine half of it and less


@pytest.mark.parametrize("name", CALLS)
def test_sigint_ends_it(name, tmp_path):
    prepare, call, after = CALLS[name]
    code = PREPARE + prepare + textwrap.dedent(
        f"""
        import os, signal, threading, time
        sent, counted, stop = [0.0], [0], threading.Event()
        def other():
            time.sleep(0.15)
            before = counted[0]
            while time.monotonic() < began + 0.3 and not stop.is_set():
                counted[0] += 1
                time.sleep(1e-3)
            sent[0] = time.thread_time(), time.monotonic(), time.process_time()
            os.kill(os.getpid(), signal.SIGINT)
        thread = threading.Thread(target=other)
        began = time.monotonic()
        thread.start()
        try:
            {call}
            print("ended by itself after", time.monotonic() - began)
        except KeyboardInterrupt:
            now, work = time.monotonic(), time.process_time()
            print("interrupted", now - sent[0][1], work - sent[0][2], counted[0], bool({after}))
        stop.set()
        """
    )
    environment = {**os.environ, "PYTHONPATH": os.environ.get("PYTHONPATH", ""), "OMP_NUM_THREADS": "1"}
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120)
    words = run.stdout.split()
    assert words[:1] == ["interrupted"], run.stdout + run.stderr
    # A machine that has other work slows the clock, not the work: that of this process is what the call needed.
    assert min(float(words[1]), float(words[2])) < LONGEST_S, run.stdout
    assert int(words[3]) >= 5, "another thread did not run: " + run.stdout
    assert words[4] == "True", run.stdout
