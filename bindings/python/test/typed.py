"""What a program with types may write: checked by mypy, not run (scripts/check bindings)."""

from pathlib import Path
from typing import Optional

import numpy as np
import numpy.typing as npt

import asperity


def measure(folder: Path) -> Optional[float]:
    recording: asperity.Recording = asperity.read_recording(folder)
    print(len(asperity.read_recording(bytes(folder))))
    result = asperity.process(recording, settings={"profile.remove_noise": False})
    heights: npt.NDArray[np.float64] = result.height_m
    times: npt.NDArray[np.int64] = recording.t_ns
    if not result.trustworthy or times.size == 0:
        for verdict in result.verdicts:
            print(verdict["code"] + ": " + verdict["message"])
        return None
    values: dict[str, float] = asperity.roughness(heights, result.spacing_m)
    return values["Rq_m"]


def touch(folder: Path, mesh: str) -> float:
    registration: asperity.Registration = asperity.register_scans([folder], mesh, mesh_unit_m=1e-3)
    pose: npt.NDArray[np.float64] = registration.T_mesh_world(0)
    renderer = asperity.Renderer(registration.scene(), rate_Hz=2000.0, settings={"friction": 0.2})
    felt = renderer.steps(np.zeros((10, 3)) + pose[:3, 3])
    one: asperity.Touch = renderer.step([0.0, 0.0, 0.1])
    renderer.update(settings={"friction": 0.3})
    triangle: Optional[int] = one.triangle
    print(triangle, one.vibration_N, renderer.rate_Hz)
    return float(felt["force_N"][-1, 2]) + float(one.force_N[2])


def gather(folders: list[Path]) -> asperity.Texture:
    merged = asperity.merge(folders)
    imported = asperity.import_recording("poses.csv", "imu.csv", settings={"mapping.tip_m": [0, 0, -0.1]})
    print(len(imported), imported.problems)
    return merged.texture or asperity.fit_texture(merged.texture_m, merged.spacing_m)


def build(file: Path) -> asperity.Scene:
    mesh = asperity.read_mesh(file, unit_m=1e-3)
    corners: npt.NDArray[np.uint32] = mesh.triangles
    scene = asperity.Scene(mesh.vertices_m, corners)
    texture = asperity.fit_texture(np.zeros(500), 25e-6, model="stochastic").copy()
    texture.friction = 0.3
    scene.paint(texture, mesh.vertices_m[:2])
    scene.set_texture(1, asperity.make_texture(texture.content))
    scene.set_pose(asperity.align_by_hand([0, 0, 0.1], [0, 90, 0]))
    recording = asperity.simulate("sandpaper", mesh=mesh, through_m=mesh.vertices_m[:2], object_motion="held")
    recording.validate()
    findings: list[str] = recording.inspect()["findings"]
    print(findings, asperity.settings("render")["friction"]["default"])
    pose, rms_m = asperity.align_points(np.eye(3), np.eye(3))
    asperity.register_scans([file], file, guess=pose)
    print(rms_m + 1.0)
    return scene
