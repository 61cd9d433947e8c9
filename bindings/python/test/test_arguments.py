"""Which types arguments may have, and what is refused by name: mappings, text, paths, units, names of files."""

import json
import os
import pathlib
import subprocess
import types

import numpy as np
import pytest

import asperity

PLATE = np.array([[0, 0, 0], [0.06, 0, 0], [0.06, 0.02, 0], [0, 0.02, 0]]), np.array([[0, 1, 2], [0, 2, 3]])
WAVE = 5e-6 * np.sin(np.arange(4000) / 7)


def write_mesh(file, side):
    off = file.suffix == ".off"
    lines = [f"{x} {y} 0" for x, y in ((0, 0), (side, 0), (side, side), (0, side))]
    if off:
        file.write_text("OFF\n4 2 0\n" + "\n".join(lines) + "\n3 0 1 2\n3 0 2 3\n")
    else:
        file.write_text("".join(f"v {line}\n" for line in lines) + "f 1 2 3\nf 1 3 4\n")
    return file


def test_a_simulation_asks_for_the_unit_of_its_mesh(tmp_path):
    """120 by 120: in millimetres a plate, in metres a field. Stated, in an argument or a setting, it is taken."""
    plate = write_mesh(tmp_path / "plate.obj", 120.0)
    with pytest.raises(asperity.Error, match=r"170 m large.*1e-3 makes it 170 mm") as error:
        asperity.simulate("sine", mesh=plate)
    assert "--" not in str(error.value)
    for stated in ({"mesh_unit_m": 1e-3}, {"settings": {"shape.mesh_unit_m": 1e-3}}):
        truth = asperity.simulate("sine", mesh=plate, settings={"hand.length_m": 0.03, **stated.pop("settings", {})}, **stated).truth
        assert np.ptp(truth.position_m, axis=0).max() < 0.1
    assert len(asperity.simulate("sine", mesh=plate, mesh_unit_m=1.0, settings={"hand.length_m": 0.03})) > 0
    with pytest.raises(asperity.Error, match="mesh_unit_m"):
        asperity.simulate("sine", mesh=plate, settings={"shape.mesh_unit_m": 1e-300})
    program = os.environ.get("ASPERITY_PROGRAM")
    if not program:
        pytest.skip("ASPERITY_PROGRAM names none")
    command = [program, "simulate", "--surface", "sine", "--mesh", plate, "--set", "hand.length_m=0.03", "-o", tmp_path / "rec"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 1 and "state its unit: --mesh-unit mm makes it 170 mm" in run.stderr
    assert subprocess.run([*command, "--mesh-unit", "mm"], capture_output=True).returncode == 0


def test_settings_are_any_mapping():
    recording = asperity.simulate("sine", settings=types.MappingProxyType({"hand.length_m": 0.03}))
    wave = asperity.fit_texture(WAVE, 25e-6, settings=types.MappingProxyType({"coefficients": 40}))
    assert len(wave.content["fourier1d"]["a_m"]) == 40
    same = asperity.make_texture(types.MappingProxyType({**wave.content, "fourier1d": types.MappingProxyType(wave.content["fourier1d"])}))
    np.testing.assert_array_equal(same.heights([0.001, 0.002]), wave.heights([0.001, 0.002]))
    arrays = {**wave.content["fourier1d"], "a_m": np.array(wave.content["fourier1d"]["a_m"])}
    np.testing.assert_array_equal(asperity.make_texture({**wave.content, "fourier1d": arrays}).heights([0.001]), wave.heights([0.001]))
    renderer = asperity.Renderer(asperity.Scene(*PLATE), settings=types.MappingProxyType({"friction": 0.2}))
    renderer.update(settings=types.MappingProxyType({"friction": 0.3}))
    for call in (lambda s: asperity.simulate(settings=s), lambda s: asperity.process(recording, settings=s), lambda s: recording.inspect(s),
                 lambda s: asperity.roughness(WAVE, 25e-6, s), lambda s: asperity.fit_texture(WAVE, 25e-6, s), lambda s: wave.vibration(s),
                 lambda s: asperity.merge(["a", "b"], s), lambda s: asperity.import_recording("a", settings=s), lambda s: renderer.update(settings=s),
                 lambda s: asperity.register_scans(["a"], "b", settings=s), lambda s: asperity.Renderer(asperity.Scene(*PLATE), settings=s)):
        for wrong in (["friction"], "friction", 3, None):
            with pytest.raises(TypeError, match="^settings: .* mapping is wanted"):
                call(wrong)
    with pytest.raises(TypeError, match="^content: "):
        asperity.make_texture([1])


def test_bytes_are_paths_and_no_names(tmp_path):
    recording = asperity.simulate("sine", settings={"hand.length_m": 0.03})
    recording.write(os.fsencode(tmp_path / "rec"))
    assert len(asperity.read_recording(os.fsencode(tmp_path / "rec"))) == len(recording)
    (tmp_path / "heights.csv").write_text("s_m,h_m\n" + "".join(f"{i * 1e-4:.4f},{1e-5 * np.sin(i):.9f}\n" for i in range(2000)))
    for surface in (tmp_path / "heights.csv", os.fsencode(tmp_path / "heights.csv")):
        assert len(asperity.simulate(surface, settings={"hand.length_m": 0.03})) > 0
    texture = asperity.fit_texture(WAVE, 25e-6)
    for name, call in [("probe", lambda b: asperity.simulate(probe=b)), ("material", lambda b: asperity.simulate(material=b)),
                       ("object_motion", lambda b: asperity.simulate(object_motion=b)), ("name", lambda b: asperity.process(recording, b)),
                       ("model", lambda b: asperity.fit_texture(WAVE, 25e-6, model=b)), ("name", lambda b: asperity.fit_texture(WAVE, 25e-6, name=b)),
                       ("name", lambda b: setattr(texture, "name", b)), ("of", asperity.settings),
                       ("settings: a name", lambda b: asperity.roughness(WAVE, 25e-6, {b: 1})),
                       ("settings: surface.file", lambda b: asperity.simulate(settings={"surface.file": b}))]:
        for wrong in (b"open", b"\xff"):
            with pytest.raises(TypeError, match=f"^{name}: a str.* is wanted, not bytes"):
                call(wrong)
        with pytest.raises(ValueError, match=f"^{name}: a surrogate"):
            call("\udcff")
    for wrong in (None, {}, set(), object(), 1j):
        with pytest.raises(TypeError, match="^settings: surface.file: "):
            asperity.simulate(settings={"surface.file": wrong})
    with pytest.raises(asperity.Error, match="no/such"):
        asperity.simulate(settings={"surface.kind": "file", "surface.file": pathlib.Path("no/such.csv")})


def test_meshes_of_one_stem_are_written_apart(tmp_path):
    given, out = tmp_path / "given", tmp_path / "out"
    given.mkdir()
    for name, side in (("a.off", 0.02), ("a.obj", 0.03), ("b.obj", 0.05)):
        write_mesh(given / name, side)
    objects = [{"mesh": name, "unit_m": 1, "textures": []} for name in ("a.obj", "b.obj", "a.off")]
    first = {"format": "asperity-scene", "version": 1, "mesh": "a.off", "unit_m": 1, "textures": [], "objects": objects}
    (given / "two.scene.json").write_text(json.dumps(first))
    scene = asperity.read_scene(given / "two.scene.json")
    out.mkdir()
    scene.write(out / "two.scene.json")
    again = asperity.read_scene(out / "two.scene.json")
    assert [again.mesh(i).vertices_m.max() for i in range(4)] == [0.02, 0.03, 0.05, 0.02]
    named = json.loads((out / "two.scene.json").read_text())
    names = [named["mesh"], *(each["mesh"] for each in named["objects"])]
    assert len(set(names)) == 4 and names[1:3] == ["a.obj", "b.obj"] and all(name.endswith(".obj") for name in names)


def test_where_x_is_0_in_the_profile():
    """As Texture.heights states it. A window of the wave's noise fits nowhere else: 0.9 of it is of other phases."""
    noise = 1e-6 * np.convolve(np.random.default_rng(4).normal(size=6000), np.hanning(20), "same")
    texture = asperity.fit_texture(noise, 25e-6)
    start = texture.content["extra"]["fit"]["first_sample"]
    inside = slice(30, 350)  # beyond the seam, which is blended
    x_m = 25e-6 * np.arange(400)
    assert start > 0 and np.corrcoef(texture.heights(x_m)[inside], noise[start:start + 400][inside])[0, 1] > 0.99
    result = asperity.process(asperity.simulate("protoboard", seed=2))
    start = round(result.summary["texture"]["start_m"] / result.spacing_m)
    heights = result.texture.heights(result.spacing_m * np.arange(400))
    assert start > 0 and np.corrcoef(heights[inside], result.texture_m[start:start + 400][inside])[0, 1] > 0.99
    assert "start_m" in asperity.Texture.heights.__doc__ and "first_sample" in asperity.Texture.heights.__doc__


@pytest.fixture
def swaying(tmp_path):
    """Poses as Euler angles, and a gyroscope of the same rotation about z, in closed form."""
    t = np.arange(0, 8, 1 / 1000)
    w = 2 * np.pi * 0.7
    angle, rate = 0.4 * np.sin(w * t), 0.4 * w * np.cos(w * t)
    force = 9.81 * np.column_stack([0 * t, 0 * t, 1 + 0 * t])
    columns = [t, force, 0 * t, 0 * t, rate]
    np.savetxt(tmp_path / "imu.csv", np.column_stack(columns), delimiter=",", comments="", fmt="%.9f",
               header="t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps")
    half = angle[::8] / 2
    columns = [t[::8], 0.1 + 0 * half, 0.1 + 0 * half, 0.2 + 0 * half, np.cos(half), 0 * half, 0 * half, np.sin(half)]
    np.savetxt(tmp_path / "poses.csv", np.column_stack(columns), delimiter=",", comments="", fmt="%.9f", header="t_s,px_m,py_m,pz_m,qw,qx,qy,qz")
    return tmp_path


def test_messages_of_an_import_name_settings(swaying):
    """Each way that an import asks for a setting; what is named, settings() lists."""
    def refusal(poses="poses.csv", **settings):
        with pytest.raises(asperity.Error) as error:
            asperity.import_recording(swaying / poses, swaying / "imu.csv", settings={"mapping.clocks": "one", **settings})
        assert "--" not in str(error.value), error.value
        return str(error.value)

    text = (swaying / "poses.csv").read_text()
    (swaying / "untimed.csv").write_text("\n".join(line.split(",", 1)[1] for line in text.splitlines()) + "\n")
    assert "settings={'mapping.pose.rate_Hz': 500}" in refusal("untimed.csv")
    sensor = (swaying / "imu.csv").read_text()
    (swaying / "imu.csv").write_text(sensor.replace("gx_radps,gy_radps,gz_radps", "gz_radps,gx_radps,gy_radps").replace("ax_mps2,ay_mps2,az_mps2", "az_mps2,ax_mps2,ay_mps2"))
    assert "settings={'mapping.imu_axes': '" in refusal()
    known = asperity.settings("import")
    assert {"mapping.pose.rate_Hz", "mapping.invert_rotation", "mapping.imu_axes", "mapping.euler", "mapping.left_handed"} <= set(known)
