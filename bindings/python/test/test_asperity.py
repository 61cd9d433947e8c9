"""The Python package against NumPy, closed forms, the truth of a simulation, and itself."""

import os
import signal
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest

import asperity


@pytest.fixture(scope="module")
def recording():
    return asperity.simulate(
        "protoboard", speed_mps=0.025, seed=1, settings={"hand.length_m": 0.04, "hand.strokes": 1}
    )


@pytest.fixture(scope="module")
def result(recording):
    return asperity.process(recording, name="board")


def plate():
    """60 x 20 mm in z = 0, facing up."""
    vertices = np.array([[0, 0, 0], [0.06, 0, 0], [0.06, 0.02, 0], [0, 0.02, 0]])
    return vertices, np.array([[0, 1, 2], [0, 2, 3]])


def test_a_scan_becomes_a_texture_and_a_force(result):
    assert result.trustworthy, result.verdict
    assert result.summary["periodicity"]["pitch_m"] == pytest.approx(2.5e-3, rel=0.01)  # the bench's protoboard
    scene = asperity.Scene(*plate())
    scene.paint(result.texture, [[0.005, 0.01, 0], [0.055, 0.01, 0]], half_width_m=0.003)
    renderer = asperity.Renderer(scene, settings={"tip_radius_m": 0.0005, "friction": 0.2})
    x = np.linspace(0.01, 0.05, 4000)
    z = np.linspace(2e-3, -0.2e-3, 500)  # from above
    renderer.steps(np.column_stack([np.full_like(z, x[0]), np.full_like(z, 0.01), z]))
    felt = renderer.steps(np.column_stack([x, np.full_like(x, 0.01), np.full_like(x, z[-1])]))
    assert np.all(np.isfinite(felt["force_N"])) and np.all(felt["touching"])
    assert np.ptp(felt["texture_N"][:, 2]) > 0.05
    assert felt["texture_height_m"].max() > 50e-6  # the holes are deep


def test_a_recording_is_what_was_written(recording, tmp_path):
    folder = tmp_path / "rec"
    recording.write(folder)
    again = asperity.read_recording(folder)
    assert len(again) == len(recording) > 1000
    np.testing.assert_array_equal(again.t_ns, recording.t_ns)
    np.testing.assert_array_equal(again.accel_counts, recording.accel_counts)
    np.testing.assert_allclose(again.tracker_position_m, recording.tracker_position_m, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(again.tracker_orientation_xyzw, axis=1), 1.0, atol=1e-12)
    np.testing.assert_array_equal(again.truth.height_m, recording.truth.height_m)
    assert again.t_ns.dtype == np.int64 and again.accel_counts.shape == (len(again), 3)


def test_the_same_seed_gives_the_same_recording(recording):
    settings = {"hand.length_m": 0.04, "hand.strokes": 1}
    again = asperity.simulate("protoboard", speed_mps=0.025, seed=1, settings=settings)
    np.testing.assert_array_equal(again.accel_counts, recording.accel_counts)
    other = asperity.simulate("protoboard", speed_mps=0.025, seed=2, settings=settings)
    assert len(other) != len(recording) or np.any(other.accel_counts != recording.accel_counts)


def test_arrays_are_views_that_outlive_their_owner():
    owner = asperity.simulate("sine", seed=3, settings={"hand.length_m": 0.02})
    counts = owner.accel_counts
    assert not counts.flags.owndata and not counts.flags.writeable
    assert counts.__array_interface__["data"] == owner.accel_counts.__array_interface__["data"]
    with pytest.raises(ValueError):
        counts[0, 0] = 1.0
    before = counts.copy()
    truth = owner.truth
    heights = truth.height_m
    kept = heights.copy()
    del owner, truth
    np.testing.assert_array_equal(counts, before)
    np.testing.assert_array_equal(heights, kept)


def test_a_result_is_its_files(result, tmp_path):
    folder = tmp_path / "out"
    result.write(folder)
    table = np.genfromtxt(folder / "profile.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["height_m"], result.height_m)
    np.testing.assert_array_equal(table["texture_sigma_m"], result.texture_sigma_m)
    path = np.genfromtxt(folder / "trajectory.csv", delimiter=",", names=True)
    np.testing.assert_allclose(path["px_m"], result.position_m[:, 0], atol=1e-12)
    np.testing.assert_allclose(path["qw"], result.orientation_xyzw[:, 3], atol=1e-12)
    texture = asperity.read_texture(folder / "texture.json")
    assert repr(asperity.read_texture(os.fsencode(folder / "texture.json"))) == repr(texture)  # a name of bytes
    x = np.linspace(0.0, 0.02, 500)
    np.testing.assert_array_equal(texture.heights(x), result.texture.heights(x))
    assert result.summary["trustworthy"] is True
    assert len(result.s_m) == len(result.height_m) == len(result.texture_m)
    (tmp_path / "letter.txt").write_text("dear friend")
    with pytest.raises(asperity.Error):
        result.write(tmp_path)  # not ours to replace
    assert (tmp_path / "letter.txt").read_text() == "dear friend"


def test_a_command_line_that_is_at_hand_agrees(recording, result, tmp_path):
    program = os.environ.get("ASPERITY_PROGRAM")
    if not program:
        pytest.skip("ASPERITY_PROGRAM names none")
    recording.write(tmp_path / "board")
    subprocess.run([program, "process", tmp_path / "board", "-o", tmp_path / "out", "--quiet"], check=True)
    table = np.genfromtxt(tmp_path / "out" / "profile.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["height_m"], result.height_m)
    np.testing.assert_array_equal(table["texture_m"], result.texture_m)


def test_the_texture_is_that_of_a_result(result):
    texture = asperity.extract_texture(result.height_m, result.spacing_m)
    assert np.corrcoef(texture[200:-200], result.texture_m[200:-200])[0, 1] > 0.99  # its noise was taken off
    x = 25e-6 * np.arange(8000)
    short, long = (np.sin(2 * np.pi * x / wave) for wave in (1e-3, 50e-3))
    np.testing.assert_allclose(asperity.extract_texture(short + long, 25e-6)[800:-800], short[800:-800], atol=0.05)


def test_roughness_of_a_sine_is_in_closed_form():
    spacing, amplitude = 1e-6, 3e-6
    z = amplitude * np.sin(2 * np.pi * np.arange(40000) * spacing / 0.2e-3)
    values = asperity.roughness(z, spacing)
    # λc of 0.8 mm lets a wave of 0.2 mm through by 1 - exp(-π (α 0.8 / 0.2)⁻²) ≈ 0.96; filters are named in the settings.
    assert values["Ra_m"] == pytest.approx(2 / np.pi * values["Rq_m"] * np.sqrt(2), rel=2e-3)
    assert values["RSm_m"] == pytest.approx(0.2e-3, rel=2e-3)
    assert values["Rku"] == pytest.approx(1.5, abs=0.02)
    assert 0.9 * amplitude < values["Rq_m"] * np.sqrt(2) < 1.02 * amplitude


def test_a_fitted_texture_is_the_wave():
    spacing = 25e-6
    x = np.arange(4000) * spacing
    z = 20e-6 * np.cos(2 * np.pi * x / 2e-3)
    texture = asperity.fit_texture(z, spacing, settings={"length_mm": 20, "coefficients": 64})
    at = np.linspace(0.0, 0.019, 300)
    ours = texture.heights(at)
    assert np.abs(ours - 20e-6 * np.cos(2 * np.pi * at / 2e-3)).max() < 0.2e-6
    assert texture.heights(0.0).shape == (1,)
    np.testing.assert_array_equal(texture.heights(at, 0.003), texture.heights(at, np.full_like(at, 0.003)))
    with pytest.raises(ValueError, match="y_m"):
        texture.heights(at, at[:5])
    samples = texture.vibration({"rate_Hz": 4000, "duration_s": 0.5, "speed_mps": 0.05})
    assert samples.shape == (2000,)
    # v² h'' of the wave: its largest value
    assert np.abs(samples).max() == pytest.approx(20e-6 * (2 * np.pi / 2e-3 * 0.05) ** 2, rel=0.03)


def test_nearest_points_and_rays_are_those_of_the_plate():
    mesh = asperity.Mesh(*plate())
    rng = np.random.default_rng(5)
    points = rng.uniform([-0.01, -0.01, -0.05], [0.07, 0.03, 0.05], (2000, 3))
    nearest, distance, triangle = mesh.closest_points(points)
    expected = np.clip(points, [0, 0, 0], [0.06, 0.02, 0])
    np.testing.assert_allclose(nearest, expected, atol=1e-15)
    np.testing.assert_allclose(distance, np.linalg.norm(points - expected, axis=1), atol=1e-15)
    assert set(triangle) <= {0, 1} and len(mesh) == 2
    origins = np.column_stack([points[:, 0], points[:, 1], np.full(len(points), 0.3)])
    t, hit = mesh.cast_rays(origins, np.tile([0.0, 0.0, -1.0], (len(points), 1)))
    inside = (points[:, 0] > 0) & (points[:, 0] < 0.06) & (points[:, 1] > 0) & (points[:, 1] < 0.02)
    np.testing.assert_allclose(t[inside], 0.3, atol=1e-15)
    assert np.all(np.isinf(t[~inside])) and np.all(hit[~inside] == 0xFFFFFFFF)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_points_and_rays_that_are_not_finite_are_named(bad):
    mesh = asperity.Mesh(*plate())
    points = np.full((5, 3), 0.01)
    points[3, 1] = bad
    with pytest.raises(ValueError, match="points_m: row 3 is not finite"):
        mesh.closest_points(points)
    with pytest.raises(ValueError, match="origins_m: row 3 is not finite"):
        mesh.cast_rays(points, np.ones((5, 3)))
    with pytest.raises(ValueError, match="directions: row 3 is not finite"):
        mesh.cast_rays(np.ones((5, 3)), points)


def test_steps_are_steps():
    scene = asperity.Scene(*plate())
    one, all_at_once = asperity.Renderer(scene), asperity.Renderer(scene)
    t = np.arange(500) * 1e-3
    p = np.column_stack([0.01 + 0.03 * t, np.full_like(t, 0.01), 1e-3 * np.exp(-20 * t) - 0.5e-3])
    v = np.gradient(p, 1e-3, axis=0)
    felt = all_at_once.steps(p, v)
    for i in range(len(t)):
        touch = one.step(p[i], v[i])
        np.testing.assert_array_equal(touch.force_N, felt["force_N"][i])
        assert touch.touching == felt["touching"][i]
    assert felt["force_N"][-1] == pytest.approx([0, 0, -1000 * p[-1, 2]], abs=1e-9)  # 1000 N/m
    one.reset()
    np.testing.assert_array_equal(one.steps(p, v)["force_N"], felt["force_N"])
    np.testing.assert_array_equal(one.step([0.01, 0.01, 0.1]).force_N, [0, 0, 0])


def test_python_runs_while_it_works():
    """Steps release Python's lock: another thread goes on."""
    scene = asperity.Scene(*plate())
    renderer = asperity.Renderer(scene)
    p = np.tile([0.01, 0.01, -1e-3], (400_000, 1))
    stop, counted = threading.Event(), [0]

    def count():
        while not stop.is_set():
            counted[0] += 1

    other = threading.Thread(target=count)
    other.start()
    before = counted[0]
    renderer.steps(p)
    during = counted[0] - before
    stop.set()
    other.join()
    assert during > 10


def test_ctrl_c_ends_a_long_simulation():
    code = textwrap.dedent(
        """
        import asperity
        print("begin", flush=True)
        try:
            asperity.simulate("sandpaper", settings={"hand.length_m": 2.0, "hand.speed_mps": 0.01})
        except KeyboardInterrupt:
            print("interrupted", flush=True)
        """
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begin\n"
    timer = threading.Timer(0.3, lambda: process.send_signal(signal.SIGINT))
    timer.start()
    out, _ = process.communicate(timeout=60)
    timer.cancel()
    assert out == "interrupted\n" and process.returncode == 0


@pytest.mark.parametrize(
    "call, kind, text",
    [
        (lambda: asperity.read_recording("no/such/folder"), asperity.Error, "no/such/folder"),
        (lambda: asperity.simulate("cheese"), asperity.Error, "cheese"),
        (lambda: asperity.simulate("sine", settings={"hand.lenght_m": 1}), asperity.Error, "hand.length_m"),
        (lambda: asperity.roughness(np.zeros((3, 3)), 1e-6), ValueError, "one dimension"),
        (lambda: asperity.roughness(np.zeros(300), -1.0), asperity.Error, "spacing"),
        (lambda: asperity.Mesh([[0, 0, 0]], [[0, 0, 1]]), IndexError, "vertex 1"),
        (lambda: asperity.Mesh([[0, 0]], [[0, 0, 0]]), ValueError, "vertices_m"),
        (lambda: asperity.Mesh([[0, 0, 0]], [[0, 0, -1]]), IndexError, "vertex -1"),
        (lambda: asperity.Mesh(np.zeros((9, 3)), [[0, 1, 2**32 + 2]]), IndexError, "4294967298"),
        (lambda: asperity.Mesh(np.zeros((9, 3)), [[0.0, 1.9, 2.0]]), ValueError, "whole"),
        (lambda: asperity.process(None), TypeError, "process"),
        (lambda: asperity.Renderer(asperity.Scene(*plate()), rate_Hz=float("nan")), ValueError, "rate_Hz"),
        (lambda: asperity.Scene(*plate()).paint(asperity.Texture, [[0, 0, 0]]), TypeError, "paint"),
        (lambda: asperity.Renderer(asperity.Scene(*plate()), settings={"friction": -1}), asperity.Error, "friction"),
        (lambda: asperity.Renderer(asperity.Scene(*plate())).step([0, 0]), ValueError, "position_m"),
        (lambda: asperity.Renderer(asperity.Scene(*plate())).step([0, 0, 0], dt_s=-1.0), ValueError, "dt_s"),
        (lambda: asperity.Renderer(asperity.Scene(*plate())).steps([0, 0]), ValueError, "positions_m"),
        (lambda: asperity.read_scene("nothing.scene.json"), asperity.Error, "nothing.scene.json"),
    ],
)
def test_what_cannot_be_used_is_named(call, kind, text):
    with pytest.raises(kind, match=text):
        call()


def test_the_texture_of_a_result_is_not_changed_by_accident(result):
    for name, value in (("friction", 0.3), ("stiffness_N_per_m", 500.0), ("name", "other")):
        with pytest.raises(AttributeError, match="copy"):
            setattr(result.texture, name, value)
    own = result.texture.copy()
    own.friction = 0.3
    assert own.friction == 0.3 and result.texture.friction != 0.3
    scene = asperity.Scene(*plate())
    with pytest.raises(ValueError, match="half_width_m"):
        scene.paint(own, [[0.005, 0.01, 0], [0.055, 0.01, 0]], half_width_m=-1.0)
    scene.paint(own, [[0.005, 0.01, 0], [0.055, 0.01, 0]])
    own.friction = 0.7
    assert scene.texture(1).friction == 0.3  # the scene's is that of the painting
    with pytest.raises(AttributeError, match="scene"):
        scene.texture(1).friction = 0.1


def test_noise_is_not_trusted():
    """A tip that touches nothing is no surface."""
    air = asperity.simulate("sandpaper", seed=4, settings={"hand.length_m": 0.03, "hand.force_N": 0.0})
    assert not asperity.process(air).trustworthy
