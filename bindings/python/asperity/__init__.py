"""Fine surfaces, measured with a hand-held probe and felt again.

    import asperity
    recording = asperity.simulate("protoboard", speed_mps=0.025, seed=1)
    result = asperity.process(recording)
    print(result.trustworthy, result.summary["roughness"]["Rq_m"], result.summary["roughness"]["Rq_stderr_m"])

Lengths are metres, forces newtons, times seconds unless a name says otherwise. Arrays of recordings and results are
read-only views without a copy. What cannot be used raises asperity.Error, a ValueError; Ctrl-C raises KeyboardInterrupt.
"""

from ._asperity import (
    Error,
    Mesh,
    Recording,
    Registration,
    Renderer,
    Result,
    Scene,
    Texture,
    Touch,
    Truth,
    __version__,
    align_by_hand,
    align_points,
    extract_texture,
    fit_areal_texture,
    fit_texture,
    fit_vibration_texture,
    import_recording,
    make_texture,
    merge,
    process,
    read_mesh,
    read_recording,
    read_scene,
    read_texture,
    register_scans,
    roughness,
    settings,
    simulate,
)

__all__ = [
    "Error",
    "Mesh",
    "Recording",
    "Registration",
    "Renderer",
    "Result",
    "Scene",
    "Texture",
    "Touch",
    "Truth",
    "__version__",
    "align_by_hand",
    "align_points",
    "extract_texture",
    "fit_areal_texture",
    "fit_texture",
    "fit_vibration_texture",
    "import_recording",
    "make_texture",
    "merge",
    "process",
    "read_mesh",
    "read_recording",
    "read_scene",
    "read_texture",
    "register_scans",
    "roughness",
    "settings",
    "simulate",
]
