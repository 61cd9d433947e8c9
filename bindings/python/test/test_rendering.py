"""The renderer's steps: their fields, their clock, changes while they run, against closed forms."""

import threading

import numpy as np
import pytest

import asperity

PLATE = np.array([[0, 0, 0], [0.06, 0, 0], [0.06, 0.02, 0], [0, 0.02, 0]]), np.array([[0, 1, 2], [0, 2, 3]])
FIELDS = ["force_N", "contact_N", "texture_N", "friction_N", "proxy_m", "point_m", "normal", "texture_height_m", "vibration_N",
          "triangle", "object", "touching", "sticking", "starts_inside"]


def stroke(n=400):
    """Down onto the plate and along it, 0.5 mm deep at last."""
    t = np.arange(n) * 1e-3
    return np.column_stack([0.03 + 0.02 * t, np.full_like(t, 0.005), 1e-3 * np.exp(-20 * t) - 0.5e-3])


def test_steps_give_every_field_of_a_touch():
    scene = asperity.Scene(*PLATE)
    one, many = (asperity.Renderer(scene, settings={"friction": 0.3}) for _ in range(2))
    p = stroke()
    felt = many.steps(p)
    assert list(felt) == FIELDS
    for i in range(len(p)):
        touch = one.step(p[i])
        for name in FIELDS:
            expected = getattr(touch, name)
            np.testing.assert_array_equal(felt[name][i], 0xFFFFFFFF if expected is None else expected, err_msg=name)
    last = -1
    # The plate is z = 0, its normal upwards, the tip above its first triangle; the proxy stays within the cone of friction.
    assert felt["touching"][last] and not felt["touching"][0]
    assert felt["object"][last] == 0 and felt["triangle"][last] == 0 and felt["triangle"][0] == 0xFFFFFFFF
    np.testing.assert_allclose(felt["normal"][last], [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(felt["point_m"][last][1:], [0.005, 0.0], atol=1e-6)
    assert abs(felt["point_m"][last][0] - p[last, 0]) <= 0.3 * 1.2 * abs(p[last, 2]) + 1e-6
    assert not felt["starts_inside"].any() and not felt["sticking"][last]  # it slides
    assert asperity.Renderer(scene, settings={"friction": 0.3}).steps(p * [0, 1, 1] + [0.03, 0, 0])["sticking"][last]
    assert np.abs(felt["vibration_N"]).max() > 0.1 and np.all(felt["vibration_N"][~felt["touching"]] == 0)


def test_a_tip_that_begins_inside_says_so():
    corners = np.array([[x, y, z] for z in (0, 0.02) for y in (0, 0.02) for x in (0, 0.02)])
    faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]
    felt = asperity.Renderer(asperity.Scene(corners, faces)).steps(np.full((3, 3), 0.01))
    assert felt["starts_inside"].all() and not np.any(felt["force_N"])


def test_velocities_go_on_from_call_to_call():
    """In parts, one by one or at once: the forces are the same, and those of the differences of the positions."""
    texture = asperity.fit_texture(5e-6 * np.sin(np.arange(4000) / 7), 25e-6, model="stochastic")
    scene = asperity.Scene(*PLATE)
    scene.paint(texture, [[0.005, 0.005, 0], [0.055, 0.005, 0]], half_width_m=0.004)
    p = stroke()
    velocities = np.vstack([np.zeros(3), np.diff(p, axis=0) * 1000.0])
    stated = asperity.Renderer(scene).steps(p, velocities)
    parts = asperity.Renderer(scene)
    pieces = [parts.steps(part) for part in np.array_split(p, 7)]
    one = asperity.Renderer(scene)
    alone = np.array([one.step(q).force_N for q in p])
    for name in ("force_N", "vibration_N"):
        joined = np.concatenate([piece[name] for piece in pieces])
        np.testing.assert_allclose(joined, stated[name], atol=1e-9)  # velocities are rounded differently
    np.testing.assert_allclose(alone, stated["force_N"], atol=1e-9)
    assert np.ptp(stated["texture_N"][:, 2]) > 1e-3


def test_the_time_between_steps_is_that_of_the_rate():
    scene = asperity.Scene(*PLATE)
    p = stroke()
    texture = asperity.fit_vibration_texture(np.random.default_rng(1).normal(size=8000), 0.05, 1.0, 1000.0)  # runs in time
    scene.paint(texture, [[0.005, 0.005, 0], [0.055, 0.005, 0]], half_width_m=0.004)
    fast, stated, slow = (asperity.Renderer(scene, rate_Hz=4000.0) for _ in range(3))
    assert fast.rate_Hz == 4000.0
    felt = fast.steps(p)["force_N"]
    np.testing.assert_array_equal(felt, stated.steps(p, dt_s=2.5e-4)["force_N"])
    assert np.any(felt != slow.steps(p, dt_s=1e-3)["force_N"])


def test_parameters_and_textures_change_while_it_runs():
    scene = asperity.Scene(*PLATE)
    renderer = asperity.Renderer(scene, settings={"stiffness_N_per_m": 1000.0})
    renderer.steps(stroke())
    pressed = np.tile(stroke()[-1], (400, 1))
    depth = -pressed[0, 2]
    assert renderer.steps(pressed)["force_N"][-1, 2] == pytest.approx(1000 * depth, rel=1e-9)
    renderer.update(settings={"stiffness_N_per_m": 500.0})
    eased = renderer.steps(pressed)["force_N"][:, 2]
    assert eased[0] == pytest.approx(1000 * depth, rel=0.05)  # the force does not jump …
    assert eased[-1] == pytest.approx(500 * depth, rel=1e-6)  # … and gets there
    assert np.abs(np.diff(eased)).max() < 0.05 * 500 * depth
    with pytest.raises(ValueError, match="stiffness"):
        renderer.update(settings={"stiffness_N_per_m": -1.0})
    scene.set_material(stiffness_N_per_m=800.0)
    assert renderer.steps(pressed)["force_N"][-1, 2] == pytest.approx(500 * depth, rel=1e-6)  # not before update
    renderer.update(scene)
    assert renderer.steps(pressed)["force_N"][-1, 2] == pytest.approx(800 * depth, rel=1e-6)


def test_another_thread_updates_and_may_not_step():
    renderer = asperity.Renderer(asperity.Scene(*PLATE))
    renderer.steps(stroke())
    pressed = np.tile(stroke()[-1], (1_500_000, 1))
    refused, updated = [], []

    def other():
        for stiffness in (900.0, 700.0, 600.0):
            renderer.update(settings={"stiffness_N_per_m": stiffness})
            updated.append(stiffness)
            try:
                renderer.step([0, 0, 1])
            except RuntimeError as error:
                refused.append(str(error))

    thread = threading.Timer(0.1, other)
    thread.start()
    force = renderer.steps(pressed)["force_N"][:, 2]
    thread.join()
    assert updated == [900.0, 700.0, 600.0] and refused and "steps already" in refused[0]
    assert force[-1] == pytest.approx(600.0 * -pressed[0, 2], rel=1e-6)


def test_a_scene_is_moved_and_written(tmp_path):
    scene = asperity.Scene(*PLATE)
    turned = np.array([[1, 0, 0, 0.1], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])  # the plate's z is the world's -y
    scene.set_pose(turned)
    np.testing.assert_allclose(scene.pose(), turned, atol=1e-12)
    with pytest.raises(ValueError, match="rotation"):
        scene.set_pose(2.0 * np.eye(4))
    texture = asperity.fit_texture(5e-6 * np.sin(np.arange(4000) / 7), 25e-6)
    scene.paint(texture, [[0.005, 0.005, 0], [0.055, 0.005, 0]], half_width_m=0.004)
    scene.paint(texture, [[0.005, 0.015, 0], [0.055, 0.015, 0]], half_width_m=0.002, index=2)
    scene.set_material(friction=0.4)
    scene.write(tmp_path / "plate.scene.json")
    scene.write(tmp_path / "plate.scene.json")  # the same again
    again = asperity.read_scene(tmp_path / "plate.scene.json")
    assert again.texture_indices() == scene.texture_indices() and again.texture_indices()[-1] == 2
    np.testing.assert_allclose(again.pose(), turned, atol=1e-12)
    np.testing.assert_array_equal(again.mesh().vertices_m, PLATE[0])
    np.testing.assert_array_equal(again.mesh().triangles, PLATE[1])
    # Over the moved plate: the world's y is minus the plate's z.
    q = np.column_stack([np.full(300, 0.13), np.linspace(-1e-3, 0.3e-3, 300), np.full(300, 0.005)])
    forces = [asperity.Renderer(s).steps(q)["force_N"] for s in (scene, again)]
    np.testing.assert_array_equal(*forces)
    assert forces[0][-1, 1] < -0.25 and abs(forces[0][-1, 2]) < 1.0
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "mesh.obj").write_text("v 1 2 3")
    with pytest.raises(asperity.Error, match="mesh.obj"):
        scene.write(tmp_path / "other" / "plate.scene.json")
    scene.set_texture(2, asperity.fit_texture(1e-6 * np.sin(np.arange(4000) / 3), 25e-6, name="finer"))
    assert scene.texture(2).name == "finer"


def test_the_second_of_two_updates_at_once_is_refused_and_none_is_lost():
    renderer = asperity.Renderer(asperity.Scene(*PLATE), settings={"stiffness_N_per_m": 1000.0})
    x, y = np.meshgrid(np.linspace(0, 0.06, 300), np.linspace(0, 0.02, 300), indexing="ij")
    v = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    corner = (np.arange(299)[:, None] * 300 + np.arange(299)).ravel()
    t = np.vstack([np.column_stack([corner, corner + 300, corner + 301]), np.column_stack([corner, corner + 301, corner + 1])])
    fine = asperity.Scene(v, t)
    outcomes = []

    def update(**given):
        try:
            renderer.update(**given)
            outcomes.append("done")
        except RuntimeError as error:
            assert "is updated already" in str(error)
            outcomes.append("refused")

    threads = [threading.Thread(target=update, kwargs=k) for k in ({"scene": fine}, {"settings": {"tip_radius_m": 0.001}})]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert "done" in outcomes
    if outcomes.count("done") == 2:  # one after the other: both are there
        touch = renderer.steps(np.tile([0.0301, 0.0101, 0.0005], (50, 1)))
        assert touch["triangle"][-1] > 2 and touch["force_N"][-1, 2] == pytest.approx(0.5, rel=1e-3)


def test_a_position_that_is_no_number_costs_one_step():
    renderer = asperity.Renderer(asperity.Scene(*PLATE))
    p = np.tile([0.03, 0.005, -1e-4], (8, 1))
    p[:4, 2] = [1e-3, 5e-4, 1e-4, -1e-4]
    p[5] = np.nan
    force = renderer.steps(p)["force_N"][:, 2]
    assert force[5] == 0.0
    assert force[6] == pytest.approx(force[4], rel=0.05)
