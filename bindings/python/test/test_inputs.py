"""What is no object, no array of numbers or no plausible length is refused, by name."""

import copy
import os
import subprocess
import sys

import numpy as np
import pytest

import asperity

PLATE = np.array([[0, 0, 0], [0.06, 0, 0], [0.06, 0.02, 0], [0, 0.02, 0]]), np.array([[0, 1, 2], [0, 2, 3]])
CLASSES = [getattr(asperity, name) for name in asperity.__all__ if isinstance(getattr(asperity, name), type)]


@pytest.mark.parametrize("made", [c for c in CLASSES if c is not asperity.Error], ids=lambda c: c.__name__)
def test_an_object_without_its_constructor_is_refused(made):
    """Every property and method of it, in a process of its own: a crash would end it."""
    code = f"""
import asperity
thing = asperity.{made.__name__}.__new__(asperity.{made.__name__})
tried = 0
for name in dir(type(thing)):
    if name.startswith("__") and name not in ("__len__", "__repr__"):
        continue
    try:
        value = getattr(thing, name)
        if callable(value):
            for arguments in ((), ([[0, 0, 0.0]],), (0,), ([[0, 0, 0.0]], [[0, 0, 1.0]]), ("x",), ({{}},)):
                try:
                    value(*arguments)
                    raise SystemExit(name + " worked")
                except (TypeError, ValueError):
                    tried += 1
        else:
            raise SystemExit(name + " worked")
    except (TypeError, ValueError):
        tried += 1
for function in (asperity.process, asperity.Renderer, asperity.simulate):
    try:
        function(thing) if function is not asperity.simulate else function(mesh=thing)
        raise SystemExit("a function took it")
    except (TypeError, ValueError):
        tried += 1
print("refused", tried)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.returncode == 0 and run.stdout.startswith("refused"), (run.returncode, run.stdout, run.stderr)
    assert int(run.stdout.split()[1]) > 8


def test_a_copy_by_python_is_refused_and_ours_works():
    texture = asperity.fit_texture(np.sin(np.arange(4000) / 10) * 1e-6, 25e-6)
    with pytest.raises(TypeError):
        copy.copy(asperity.Mesh(*PLATE)).closest_points([[0, 0, 0]])
    np.testing.assert_array_equal(texture.copy().heights([0.001]), texture.heights([0.001]))


WRONG = {
    "complex": np.zeros((4, 3), dtype=complex),
    "text": np.full((4, 3), "1.0"),
    "None": np.full((4, 3), None),
    "objects": np.full((4, 3), 1.0, dtype=object),
    "booleans": np.ones((4, 3), dtype=bool),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_arrays_that_hold_no_numbers_are_refused(wrong):
    rows = WRONG[wrong]
    column = rows[:, 0]
    mesh, scene = asperity.Mesh(*PLATE), asperity.Scene(*PLATE)
    renderer = asperity.Renderer(scene)
    texture = asperity.fit_texture(np.sin(np.arange(4000) / 10) * 1e-6, 25e-6)
    for name, call in [
        ("vertices_m", lambda: asperity.Mesh(rows, PLATE[1])),
        ("vertices_m", lambda: asperity.Scene(rows, PLATE[1])),
        ("points_m", lambda: mesh.closest_points(rows)),
        ("origins_m", lambda: mesh.cast_rays(rows, np.ones((4, 3)))),
        ("directions", lambda: mesh.cast_rays(np.ones((4, 3)), rows)),
        ("points_m", lambda: scene.paint(texture, rows)),
        ("positions_m", lambda: renderer.steps(rows)),
        ("velocities_mps", lambda: renderer.steps(np.zeros((4, 3)), rows)),
        ("position_m", lambda: renderer.step(rows[0])),
        ("x_m", lambda: texture.heights(column)),
        ("y_m", lambda: texture.heights(np.zeros(4), column)),
        ("height_m", lambda: asperity.roughness(column, 1e-6)),
        ("height_m", lambda: asperity.extract_texture(column, 1e-6)),
        ("height_m", lambda: asperity.fit_texture(column, 1e-6)),
    ]:
        with pytest.raises(TypeError, match=name):
            call()


def test_masked_heights_are_missing_and_other_masked_values_refused():
    z = 7e-6 * np.sin(np.arange(8000) / 12)
    spoiled = z.copy()
    spoiled[::50] = 0.1  # what the mask hides: 100 mm
    masked = np.ma.masked_array(spoiled, mask=spoiled > 0.01)
    holes = np.where(spoiled > 0.01, np.nan, z)
    assert asperity.roughness(masked, 1e-6) == pytest.approx(asperity.roughness(holes, 1e-6), nan_ok=True)
    assert asperity.roughness(masked, 1e-6)["Rq_m"] < 8e-6
    assert asperity.roughness(masked, 1e-6)["missing"] == 160
    np.testing.assert_array_equal(asperity.extract_texture(masked, 1e-6), asperity.extract_texture(holes, 1e-6))
    points = np.ma.masked_array(np.zeros((4, 3)), mask=np.eye(4, 3))
    for call in (lambda: asperity.Mesh(*PLATE).closest_points(points), lambda: asperity.Renderer(asperity.Scene(*PLATE)).steps(points)):
        with pytest.raises(ValueError, match="masked"):
            call()
    unmasked = np.ma.masked_array(np.ones((4, 3)))
    assert len(asperity.Mesh(*PLATE).closest_points(unmasked)[1]) == 4


def write_plate(file, side):
    file.write_text(f"v 0 0 0\nv {side} 0 0\nv {side} {side} 0\nv 0 {side} 0\nf 1 2 3\nf 1 3 4\n")
    return file


def test_a_unit_is_stated_or_plausible(tmp_path):
    plate = write_plate(tmp_path / "q.obj", 42.0)
    for unit in (0.0, -1.0, 1e300, float("nan")):
        with pytest.raises(ValueError, match="unit_m"):
            asperity.read_mesh(plate, unit)
        with pytest.raises(ValueError, match="unit_m"):
            asperity.read_scene(plate, unit)
    for read in (asperity.read_mesh, asperity.read_scene):
        with pytest.raises(asperity.Error, match=r"59\.4 m large.*1e-3 makes it 59\.4 mm") as error:
            read(plate)
        assert "--" not in str(error.value)
        assert len(read(plate, unit_m=1.0)) > 0
    np.testing.assert_allclose(asperity.read_mesh(plate, 1e-3).vertices_m.max(), 0.042)
    np.testing.assert_allclose(asperity.read_scene(plate, 1e-3).mesh().vertices_m.max(), 0.042)
    with pytest.raises(asperity.Error, match="mm large.*unit_m"):
        asperity.read_mesh(write_plate(tmp_path / "small.obj", 1e-5))


def test_the_command_line_refuses_the_same_plate(tmp_path):
    program = os.environ.get("ASPERITY_PROGRAM")
    if not program:
        pytest.skip("ASPERITY_PROGRAM names none")
    plate = write_plate(tmp_path / "q.obj", 42.0)
    run = subprocess.run([program, "feel", plate, "--duration", "0.01s", "--json"], capture_output=True, text=True)
    assert run.returncode == 1 and "59.4 m large" in run.stderr and "--mesh-unit mm" in run.stderr
    right = subprocess.run([program, "feel", plate, "--mesh-unit", "mm", "--duration", "0.01s", "--json"], capture_output=True, text=True)
    assert right.returncode != 1, right.stderr


def test_materials_have_the_limits_of_the_renderer():
    texture = asperity.fit_texture(np.sin(np.arange(4000) / 10) * 1e-6, 25e-6)
    for name, value in [("friction", -5.0), ("friction", 1e9), ("friction", float("nan")),
                        ("stiffness_N_per_m", -1e9), ("stiffness_N_per_m", 1e12), ("stiffness_N_per_m", 0.0)]:
        with pytest.raises(ValueError, match=name):
            setattr(texture, name, value)
        with pytest.raises(ValueError, match=name):
            asperity.Scene(*PLATE).set_material(**{name: value})
        with pytest.raises(ValueError, match=name):
            asperity.Renderer(asperity.Scene(*PLATE), settings={name: value})
    texture.friction, texture.stiffness_N_per_m = 10.0, 1e6
    assert (texture.friction, texture.stiffness_N_per_m) == (10.0, 1e6)
    texture.friction = None
    assert texture.friction is None


def test_messages_are_of_python(tmp_path):
    scene = asperity.Scene(*PLATE)
    with pytest.raises(asperity.Error, match="did you mean 'tip_radius_m'"):
        asperity.Renderer(scene, settings={"render.tip_radius_m": 0.001})
    with pytest.raises(asperity.Error, match=r"settings\(\) lists them all") as error:
        asperity.Renderer(scene, settings={"wurst": 1})
    assert "--" not in str(error.value)
    with pytest.raises(asperity.Error, match="folder"):
        asperity.read_mesh(tmp_path)
    with pytest.raises(asperity.Error) as error:
        asperity.read_mesh(os.fsdecode(b"no\xffsuch.obj"))
    assert "such.obj" in str(error.value)
    for tip in ((0, 0, -0.1), np.array([0, 0, -0.1]), [0.0, 0.0, np.float64(-0.1)]):
        with pytest.raises(asperity.Error, match="no/such.csv"):  # the setting is taken, the file is not there
            asperity.import_recording("no/such.csv", settings={"mapping.tip_m": tip})


def test_settings_are_listed():
    for of in ("simulate", "process", "inspect", "merge", "import", "register", "roughness", "fit", "vibration", "render"):
        for name, one in asperity.settings(of).items():
            assert set(one) == {"default", "meaning"} and one["meaning"], name
    assert asperity.settings("render")["stiffness_N_per_m"]["default"] == 1000.0
    with pytest.raises(ValueError, match="render"):
        asperity.settings("cheese")


@pytest.mark.parametrize("made", [c for c in CLASSES if c is not asperity.Error], ids=lambda c: c.__name__)
def test_no_protocol_of_pickle_ends_the_process(made):
    """In a process of its own: pybind11's base class cannot be made, and ends it."""
    code = f"""
import copy, pickle, asperity
thing = asperity.{made.__name__}.__new__(asperity.{made.__name__})
for take in [copy.copy, copy.deepcopy, *[lambda x, p=p: pickle.dumps(x, p) for p in range(6)], lambda x: x.__reduce__()]:
    try:
        take(thing)
        raise SystemExit("it was taken")
    except TypeError:
        pass
"""
    assert subprocess.run([sys.executable, "-c", code], env=os.environ, check=False).returncode == 0


def test_masked_values_that_are_no_numbers_are_refused():
    mask = [True] + 99 * [False]
    for values in (np.full(100, 1 + 2j), np.full(100, "1.5"), np.full(100, True), np.full(100, 1, dtype=object)):
        with pytest.raises(TypeError, match="real numbers are wanted"):
            asperity.roughness(np.ma.array(values, mask=mask), 1e-5)


CALLS_AT_THE_END = {
    "steps": "asperity.Renderer(asperity.Scene(v, t)).steps(p)",
    "closest_points": "asperity.Mesh(v, t).closest_points(p)",
    "many short calls": "[r.steps(p[:1000]) for _ in range(100000)]",
}


@pytest.mark.parametrize("call", CALLS_AT_THE_END)
def test_a_thread_that_computes_at_the_end_does_not_crash_the_process(call):
    code = f"""
import threading, time, numpy as np, asperity
v, t = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
p = np.full((3_000_000, 3), 0.01)
r = asperity.Renderer(asperity.Scene(v, t))
threading.Thread(target=lambda: {CALLS_AT_THE_END[call]}, daemon=True).start()
time.sleep(0.15)
"""
    for _ in range(3):
        run = subprocess.run([sys.executable, "-c", code], env=os.environ, check=False, timeout=60)
        assert run.returncode == 0
