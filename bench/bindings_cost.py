"""What Python costs beside C++, C and idioms of NumPy, SciPy and Open3D: bindings_cost.py PROGRAM [REPEATS]

PROGRAM is build/release/bin/bindings_cost; PYTHONPATH has the package. Medians of REPEATS (5) interleaved runs, of the
processor's time. A peer that is not installed (python3-scipy, python3-open3d) is left out.
"""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import asperity

program, repeats = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
folder = Path(tempfile.mkdtemp())
POINTS, HEIGHTS, STEPS = 100_000, 1_000_000, 20_000
took: dict[str, list[float]] = {}


def timed(name, count, work):
    began = time.thread_time()
    out = work()
    took.setdefault(name, []).append(1e9 * (time.thread_time() - began) / count)
    return out


def by_cpp():
    for line in subprocess.check_output([program, str(folder), "1"], text=True).splitlines():
        words = line.split()
        if len(words) == 2:
            took.setdefault("C++ " + words[0], []).append(float(words[1]))


by_cpp()
took.clear()
mesh = asperity.read_mesh(folder / "ball.obj")
texture = asperity.read_texture(folder / "stroke.texture.json")
angle = 0.06 * np.arange(41)
scene = asperity.read_scene(folder / "ball.obj")
scene.paint(texture, 0.03 * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle]), half_width_m=0.004)
renderer = asperity.Renderer(scene, settings={"tip_radius_m": 0.0005})
i = np.arange(STEPS)
depth = np.minimum(1e-6 * i, 0.8e-3) - 0.5e-3
turn = 0.1 + 2e-4 * (i % 10000)
tip = (0.03 - depth)[:, None] * np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
points = np.random.default_rng(2).uniform(-0.06, 0.06, (POINTS, 3))
x = 1e-7 * np.arange(HEIGHTS)
vertices = mesh.vertices_m
lines = (folder / "ball.obj").read_text().splitlines()
faces = np.array([[int(word) - 1 for word in line.split()[1:]] for line in lines if line.startswith("f ")], dtype=np.uint32)

try:
    from scipy.spatial import cKDTree

    tree = cKDTree(vertices)
except ImportError:
    tree = None
try:
    import open3d

    rays = open3d.t.geometry.RaycastingScene()
    rays.add_triangles(open3d.core.Tensor(vertices.astype(np.float32)), open3d.core.Tensor(faces))
    queries = open3d.core.Tensor(points.astype(np.float32))
except ImportError:
    rays = None

# A Fourier series as NumPy users write it: a matrix of cosines, in pieces that fit the memory.
a, period = np.random.default_rng(3).normal(size=128), 0.01
j = 2 * np.pi / period * np.arange(1, 129)


def numpy_series():
    return np.concatenate([np.cos(np.outer(part, j)) @ a for part in np.array_split(x, 50)])


for _ in range(repeats):
    by_cpp()
    nearest, distance, _triangle = timed("Python closest_points", POINTS, lambda: mesh.closest_points(points))
    timed("Python heights", HEIGHTS, lambda: texture.heights(x))
    renderer.reset()
    felt = timed("Python steps", STEPS, lambda: renderer.steps(tip, dt_s=1e-3))
    renderer.reset()
    timed("Python step, a loop", STEPS, lambda: [renderer.step(p, dt_s=1e-3) for p in tip])
    timed("NumPy series of 128 cosines", HEIGHTS, numpy_series)
    if tree is not None:
        timed("SciPy cKDTree, vertices only", POINTS, lambda: tree.query(points))
    if rays is not None:
        found = timed("Open3D closest points, float", POINTS, lambda: rays.compute_closest_points(queries, 1))

median = {name: statistics.median(times) for name, times in took.items()}
ROWS = [
    ("closest point, 69,696 triangles", "Python closest_points", "C++ closest_point", ["SciPy cKDTree, vertices only", "Open3D closest points, float"]),
    ("height of a texture of 128 harmonics", "Python heights", "C++ texture_height", ["NumPy series of 128 cosines"]),
    ("step of the renderer, many at once", "Python steps", "C++ render_step_and_vibration", []),
    ("step of the renderer, one at a time", "Python step, a loop", "C++ render_step_and_vibration", []),
    ("the same from C, one at a time", "C++ asperity_feel_step", "C++ render_step_and_vibration", []),
    ("the same from C, many at once", "C++ asperity_feel_steps", "C++ render_step_and_vibration", []),
]
print("| Work | ns each | C++, ns | over C++ | a peer, ns |\n|---|---|---|---|---|")
for work, ours, cpp, peers in ROWS:
    beside = "; ".join(f"{peer}: {median[peer]:.0f}" for peer in peers if peer in median) or "–"
    print(f"| {work} | {median[ours]:.0f} | {median[cpp]:.0f} | {median[ours] / median[cpp]:.2f} | {beside} |")
if rays is not None:
    difference = np.abs(np.linalg.norm(found["points"].numpy() - points, axis=1) - distance)
    print(f"\ndistances as Open3D's to {1e6 * difference.max():.2f} µm (its are of single precision)")
recording = asperity.simulate("sine", seed=1, settings={"hand.length_m": 0.02})
views = [recording.t_ns, recording.accel_counts, recording.force_counts, recording.gyro_counts]
result = asperity.process(recording)
views += [result.height_m, result.texture_m, result.texture_sigma_m, result.position_m, result.orientation_xyzw]
print(f"copies: {sum(v.flags.owndata for v in views)} of {len(views)} arrays of a recording and its result; largest force {np.linalg.norm(felt['force_N'], axis=1).max():.6f} N")
