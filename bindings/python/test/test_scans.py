"""Importing, merging and registering from Python: against known motion, poses, and the program."""

import json
import os
import subprocess

import numpy as np
import pytest

import asperity


def write_table(file, header, columns):
    np.savetxt(file, np.column_stack(columns), delimiter=",", header=header, comments="", fmt="%.9f")


def rotation_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


@pytest.fixture
def motion(tmp_path):
    """A body that sways and turns about z: poses at 120 Hz, an inertial sensor at 1 kHz, in closed form."""
    t = np.arange(0, 8, 1 / 1000)
    w = 2 * np.pi * 0.7
    angle, rate = 0.4 * np.sin(w * t), 0.4 * w * np.cos(w * t)
    accel = np.column_stack([-0.05 * (2 * w) ** 2 * np.sin(2 * w * t), -0.03 * w**2 * np.cos(w * t), 0 * t])
    force = accel + [0, 0, 9.81]
    body = np.array([rotation_z(a).T @ f for a, f in zip(angle, force)])
    write_table(tmp_path / "imu.csv", "t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps", [t, body, 0 * t, 0 * t, rate])
    t = np.arange(0, 8, 1 / 120)
    angle = 0.4 * np.sin(w * t)
    position = np.column_stack([0.05 * np.sin(2 * w * t), 0.03 * np.cos(w * t), 0 * t + 0.2])
    half = angle / 2
    write_table(tmp_path / "poses.csv", "t_s,px_m,py_m,pz_m,qw,qx,qy,qz",
                [t, position, np.cos(half), 0 * t, 0 * t, np.sin(half)])
    return tmp_path, t, position, angle


def test_tables_of_others_become_a_recording(motion):
    folder, t, position, angle = motion
    recording = asperity.import_recording(folder / "poses.csv", folder / "imu.csv")
    assert len(recording) == 8000
    np.testing.assert_allclose(recording.tracker_position_m, position, atol=1e-6)
    np.testing.assert_allclose(recording.tracker_orientation_xyzw[:, 2], np.sin(angle / 2), atol=1e-6)
    named = asperity.import_recording(folder / "poses.csv", folder / "imu.csv",
                                      settings={"import.object": "swaying body", "mapping.tip_m": [0, 0, -0.1]})
    assert named.object == "swaying body"


def test_a_wrong_unit_is_refused(motion):
    folder = motion[0]
    text = (folder / "poses.csv").read_text().replace("px_m,py_m,pz_m", "px_mm,py_mm,pz_mm")
    (folder / "poses.csv").write_text(text)
    with pytest.raises(asperity.Error, match="poses.csv"):
        asperity.import_recording(folder / "poses.csv", folder / "imu.csv")
    with pytest.raises(asperity.Error, match="no/such.csv"):
        asperity.import_recording("no/such.csv", folder / "imu.csv")


def stroke(folder, line, seed):
    asperity.simulate("sandpaper", seed=seed, settings={"hand.length_m": 0.04, "surface.seed": line, "hand.path_seed": line}).write(folder)


def test_strokes_over_one_line_are_merged(tmp_path):
    for name, seed in (("a", 11), ("b", 12)):
        stroke(tmp_path / name, 1, seed)
    merged = asperity.merge([tmp_path / "a", tmp_path / "b"])
    assert merged.trustworthy, merged.verdict
    assert [one["name"] for one in merged.summary["passes"]] == ["a", "b"]
    single = asperity.process(asperity.read_recording(tmp_path / "a"))
    shared = np.isfinite(merged.texture_m)
    assert shared.sum() > 500
    assert np.nanmedian(merged.texture_sigma_m) < np.nanmedian(single.texture_sigma_m)
    merged.write(tmp_path / "out")
    table = np.genfromtxt(tmp_path / "out" / "profile.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(table["texture_m"], merged.texture_m)
    with pytest.raises(ValueError, match="two"):
        asperity.merge([tmp_path / "a"])
    with pytest.raises(asperity.Error):
        asperity.merge([tmp_path / "a", tmp_path / "nothing"])


def body_point(longitude, latitude):
    """A body that looks the same from no two sides, m."""
    radius = 0.03 * (1 + 0.2 * np.sin(2 * longitude + 0.3) * np.cos(latitude) ** 2 + 0.15 * np.sin(3 * latitude) + 0.1 * np.cos(longitude - 1) * np.cos(latitude))
    return np.stack([1.4 * radius * np.cos(latitude) * np.cos(longitude), radius * np.cos(latitude) * np.sin(longitude),
                     0.9 * radius * np.sin(latitude)], axis=-1)


def write_body(file):
    around, up = 360, 180  # facets of 0.7 mm: with those of 2.2 mm the pose is 0.5 degrees off
    longitude, latitude = np.meshgrid(np.arange(around) * 2 * np.pi / around, (np.arange(1, up) / up - 0.5) * np.pi)
    points = 1e3 * np.vstack([body_point(longitude, latitude).reshape(-1, 3), body_point(0.0, -np.pi / 2)[None], body_point(0.0, np.pi / 2)[None]])
    lines = ["v %.6f %.6f %.6f" % tuple(p) for p in points]
    index = lambda row, column: row * around + column % around + 1
    for row in range(up - 2):
        for column in range(around):
            lines.append("f %d %d %d %d" % (index(row, column), index(row, column + 1), index(row + 1, column + 1), index(row + 1, column)))
    south, north = len(points) - 1, len(points)
    for column in range(around):
        lines.append("f %d %d %d" % (south, index(0, column + 1), index(0, column)))
        lines.append("f %d %d %d" % (index(up - 2, column), index(up - 2, column + 1), north))
    file.write_text("\n".join(lines) + "\n")


@pytest.fixture
def body(tmp_path):
    """Its mesh in mm, and a path round it in a world that is turned by 0.3 rad and moved by 11 cm."""
    write_body(tmp_path / "body.obj")
    angle = np.linspace(0, 4, 2000)
    on_body = body_point(angle, 0.5 * np.sin(2 * angle))
    turn, shift = rotation_z(0.3), np.array([0.1, -0.05, 0.02])
    world = on_body @ turn.T + shift + np.random.default_rng(3).normal(0, 2e-5, on_body.shape)
    write_table(tmp_path / "path.csv", "px_m,py_m,pz_m", [world])
    T_mesh_world = np.eye(4)
    T_mesh_world[:3, :3], T_mesh_world[:3, 3] = turn.T, -turn.T @ shift
    return tmp_path, T_mesh_world


def test_a_path_is_registered_to_a_mesh(body):
    folder, truth = body
    guess = [*(truth[:3, 3] + [3e-3, -2e-3, 1e-3]), np.cos(0.13), 0, 0, -np.sin(0.13)]
    registration = asperity.register_scans([folder / "path.csv"], folder / "body.obj", mesh_unit_m=1e-3, guess=guess)
    found = registration.T_mesh_world(0)
    assert found.shape == (4, 4)
    np.testing.assert_allclose(found, truth, atol=2e-3)  # rotations to 0.1 degrees, lengths to 2 mm
    world = np.loadtxt(folder / "path.csv", delimiter=",", skiprows=1)
    moved = (found - truth) @ np.column_stack([world, np.ones(len(world))]).T
    assert np.sqrt(np.mean(np.sum(moved**2, axis=0))) < 0.5e-3
    covariance = registration.covariance()
    np.testing.assert_allclose(covariance, covariance.T)
    assert len(registration) == 1 and registration.names == ["path"]
    scan = registration.scan(0)
    assert scan["point_m"].shape == (len(scan["s_m"]), 3)
    assert np.all(np.abs(np.linalg.norm(scan["point_m"], axis=1) - 0.03) < 0.03)
    assert registration.summary["scans"][0]["name"] == "path"
    registration.write(folder / "out")
    stored = json.loads((folder / "out" / "registration.json").read_text())
    np.testing.assert_allclose(stored["T_mesh_world"][:3], found[:3, 3], atol=1e-9)
    renderer = asperity.Renderer(registration.scene(), settings={"tip_radius_m": 0.0005})
    assert renderer.step([0.2, 0.2, 0.2]).touching is False
    with pytest.raises(IndexError):
        registration.T_mesh_world(1)
    with pytest.raises(ValueError, match="seven"):
        asperity.register_scans([folder / "path.csv"], folder / "body.obj", mesh_unit_m=1e-3, guess=[0, 0, 0])


def test_the_program_finds_the_same_pose(body):
    program = os.environ.get("ASPERITY_PROGRAM")
    if not program:
        pytest.skip("ASPERITY_PROGRAM names none")
    folder, truth = body
    guess = [*truth[:3, 3], np.cos(0.15), 0, 0, -np.sin(0.15)]
    registration = asperity.register_scans([folder / "path.csv"], folder / "body.obj", mesh_unit_m=1e-3, guess=guess)
    registration.write(folder / "here")
    code = subprocess.run([program, "register", folder / "path.csv", folder / "body.obj", "--mesh-unit", "mm", "--guess",
                           ",".join(map(repr, map(float, guess))), "-o", folder / "there", "--quiet"], capture_output=True).returncode
    assert code == (0 if registration.trustworthy else 3)
    here, there = (json.loads((folder / name / "registration.json").read_text()) for name in ("here", "there"))
    assert here["T_mesh_world"] == there["T_mesh_world"]
    assert here["verdicts"] == there["verdicts"]
