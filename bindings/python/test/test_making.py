"""Texture models, simulation over a mesh, inspection and alignment, against closed forms and truths."""

import numpy as np
import pytest

import asperity


def test_each_model_is_fitted():
    rng = np.random.default_rng(4)
    x = 25e-6 * np.arange(8000)
    wave, noise = 20e-6 * np.cos(2 * np.pi * x / 2e-3), 5e-6 * rng.normal(size=8000)
    series = asperity.fit_texture(wave, 25e-6, name="wave")
    assert (series.model, series.name) == ("fourier1d", "wave")
    assert series.roughness["Rq_m"] == pytest.approx(20e-6 / np.sqrt(2), rel=0.01)
    pattern = asperity.fit_texture(wave, 25e-6, model="fourier2d")
    assert pattern.model == "fourier2d"
    at = np.linspace(0, 0.008, 400)
    # A pattern has the profile along the line of its deepest hole, and repeats across as along.
    np.testing.assert_allclose(pattern.heights(at, 0.001), pattern.heights(0.001 + 0 * at, at), atol=0.5e-6)
    image = asperity.fit_texture(wave, 25e-6, model="heightmap")
    np.testing.assert_allclose(image.heights(at, 0.001), pattern.heights(at, 0.001), atol=2e-6)
    random = asperity.fit_texture(noise, 25e-6, model="stochastic")
    assert random.model == "stochastic"
    # σ k / m of white heights, docs/texture.md: the vibration's standard deviation is in proportion to the heights'.
    twice = asperity.fit_texture(2 * noise, 25e-6, model="stochastic")
    still = {"duration_s": 1.0}
    assert np.std(twice.vibration(still)) == pytest.approx(2 * np.std(random.vibration(still)), rel=1e-6)
    with pytest.raises(ValueError, match="cheese.*fourier1d"):
        asperity.fit_texture(wave, 25e-6, model="cheese")
    with pytest.raises(ValueError, match="height_across_m"):
        asperity.fit_texture(wave, 25e-6, height_across_m=wave)


def test_a_surface_is_fitted_to_scattered_heights():
    rng = np.random.default_rng(5)
    x, y = rng.uniform(0, 0.01, (2, 20000))
    surface = lambda x, y: 10e-6 * np.sin(900 * x) * np.cos(700 * y)
    z = np.ma.masked_array(surface(x, y), mask=False)
    z[::10] = 1.0
    z[::10] = np.ma.masked
    texture = asperity.fit_areal_texture(x, y, z, {"spacing_mm": 0.1})
    assert texture.model == "areal"
    u, v = rng.uniform(0.001, 0.009, (2, 500))
    np.testing.assert_allclose(texture.heights(u, v), surface(u, v), atol=0.3e-6)  # of 10 µm, at 0.1 mm


def test_a_vibration_is_fitted_and_synthesised():
    """An autoregressive process of order 2 whose poles are known: the synthesis has its spectrum."""
    rng = np.random.default_rng(6)
    a1, a2 = 1.2, -0.7
    noise = rng.normal(size=20000)
    z = np.zeros_like(noise)
    for i in range(2, len(z)):
        z[i] = a1 * z[i - 1] + a2 * z[i - 2] + noise[i]
    texture = asperity.fit_vibration_texture(z, 0.05, 1.0, 1000.0, {"high_pass_Hz": 0})
    assert texture.model == "autoregressive"
    again = texture.vibration({"rate_Hz": 1000, "duration_s": 20, "speed_mps": 0.05, "force_N": 1.0})
    lag = lambda s, k: np.mean(s[k:] * s[: len(s) - k]) / np.mean(s * s)
    assert lag(again, 1) == pytest.approx(a1 / (1 - a2), abs=0.03)  # Yule-Walker
    assert np.var(again) == pytest.approx(np.var(z), rel=0.1)
    with pytest.raises(asperity.Error, match="no heights"):
        texture.heights([0.0])


def test_a_texture_is_made_of_coefficients():
    """The Fourier series of docs/texture.md: one harmonic is a cosine."""
    made = asperity.fit_texture(1e-6 * np.sin(np.arange(4000) / 7), 25e-6, {"coefficients": 4})
    content = made.content
    block = content["fourier1d"]
    assert asperity.make_texture(content).content == content
    block["a_m"], block["b_m"] = [0.0, 3e-6, 0.0, 0.0], [0.0] * 4
    x = np.linspace(0, 0.01, 100)
    length_m = 1e-3 * block["length_mm"]
    expected = 3e-6 * np.cos(2 * np.pi * 2 * x / length_m)
    heights = asperity.make_texture(content).heights(x)
    np.testing.assert_allclose(heights - heights.mean(), expected - expected.mean(), atol=1e-12)
    with pytest.raises(asperity.Error, match="wurst"):
        asperity.make_texture({**content, "wurst": 1})


def ball(radius=0.03, around=96, up=48):
    longitude, latitude = np.meshgrid(np.arange(around) * 2 * np.pi / around, (np.arange(1, up) / up - 0.5) * np.pi)
    points = [(np.cos(latitude) * np.cos(longitude)).ravel(), (np.cos(latitude) * np.sin(longitude)).ravel(), np.sin(latitude).ravel()]
    vertices = radius * np.vstack([np.column_stack(points), [0, 0, -1], [0, 0, 1]])
    index = lambda row, column: row * around + column % around
    faces = [[index(r, c), index(r, c + 1), index(r + 1, c + 1)] for r in range(up - 2) for c in range(around)]
    faces += [[index(r, c), index(r + 1, c + 1), index(r + 1, c)] for r in range(up - 2) for c in range(around)]
    south, north = len(vertices) - 2, len(vertices) - 1
    faces += [[south, index(0, c + 1), index(0, c)] for c in range(around)]
    faces += [[index(up - 2, c), index(up - 2, c + 1), north] for c in range(around)]
    return vertices, np.array(faces)


def test_a_scan_over_a_mesh_is_on_the_mesh(tmp_path):
    vertices, faces = ball()
    through = 0.03 * np.column_stack([np.cos([0.0, 0.6, 1.2]), np.sin([0.0, 0.6, 1.2]), np.zeros(3)])
    settings = {"hand.strokes": 1}
    recording = asperity.simulate("sandpaper", seed=2, mesh=asperity.Mesh(vertices, faces), through_m=through, settings=settings)
    path = recording.truth.position_m
    # On a ball of 30 mm wherever it is: the fitted centre's distances, but for the relief and the facets' 16 µm.
    touching = recording.truth.force_N > 0.05
    p = path[touching]
    system = np.column_stack([2 * p, np.ones(len(p))])
    solution = np.linalg.lstsq(system, np.sum(p * p, axis=1), rcond=None)[0]
    distance = np.linalg.norm(p - solution[:3], axis=1)
    assert np.std(distance) < 0.1e-3
    assert np.linalg.norm(np.diff(p, axis=0), axis=1).sum() > 0.9 * 1.2 * 0.03
    file = tmp_path / "ball.obj"
    with open(file, "w") as out:
        np.savetxt(out, vertices, "v %.17g %.17g %.17g")
        np.savetxt(out, faces + 1, "f %d %d %d")
    same = asperity.simulate("sandpaper", seed=2, mesh=file, through_m=through, settings=settings)
    np.testing.assert_array_equal(same.truth.position_m, path)
    with pytest.raises(asperity.Error):  # the path is not on a ball of 30 µm
        asperity.simulate("sandpaper", seed=2, mesh=file, mesh_unit_m=1e-3, through_m=through, settings=settings)
    held = asperity.simulate("sandpaper", seed=2, object_motion="held", material="cork", settings={"hand.length_m": 0.02})
    assert len(held) > 100
    for wrong in ({"through_m": through}, {"mesh_unit_m": 1.0}, {"mesh": asperity.Mesh(vertices, faces), "mesh_unit_m": 1e-3}):
        with pytest.raises(ValueError, match="mesh"):
            asperity.simulate("sandpaper", **wrong)


def test_a_recording_is_inspected_and_validated():
    recording = asperity.simulate("sine", seed=3, settings={"hand.length_m": 0.02})
    recording.validate()
    found = recording.inspect()
    interval = np.median(np.diff(recording.t_ns)) * 1e-9
    assert found["probe"]["median_rate_hz"] == pytest.approx(1 / interval, rel=1e-6)
    assert found["probe"]["rows"] == len(recording)
    with pytest.raises(asperity.Error, match="quiet_s"):
        recording.inspect({"quiet_s": -1})


def test_picked_points_and_hands_give_a_pose():
    rng = np.random.default_rng(7)
    pose = asperity.align_by_hand([0.1, -0.05, 0.02], [0, 0, 30])
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    np.testing.assert_allclose(pose, [[c, -s, 0, 0.1], [s, c, 0, -0.05], [0, 0, 1, 0.02], [0, 0, 0, 1]], atol=1e-15)
    world = rng.uniform(-0.05, 0.05, (6, 3))
    mesh = world @ pose[:3, :3].T + pose[:3, 3]
    found, rms_m = asperity.align_points(world, mesh)
    np.testing.assert_allclose(found, pose, atol=1e-12)
    assert rms_m < 1e-12
    with pytest.raises(asperity.Error):
        asperity.align_points(world[:2], mesh[:2])


def test_objects_say_what_they_are():
    vertices, faces = ball(around=8, up=6)
    mesh, scene = asperity.Mesh(vertices, faces), asperity.Scene(vertices, faces)
    assert repr(mesh) == f"<asperity.Mesh: {len(vertices)} vertices, {len(faces)} triangles>"
    assert repr(scene) == f"<asperity.Scene: objects 1, triangles {len(faces)}, textures 0>"
    renderer = asperity.Renderer(scene, rate_Hz=2000)
    assert "2000 Hz" in repr(renderer) and "free" in repr(renderer.step([1, 1, 1]))
    for name in asperity.__all__:
        thing = getattr(asperity, name)
        for key, member in vars(thing).items() if isinstance(thing, type) else ():
            if not key.startswith("_"):
                assert member.__doc__, f"{name}.{key}"
