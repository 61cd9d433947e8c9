"""The files that the program reads, made by itself, each with the commands that read it."""

import math
import os
import shutil
import struct
import subprocess
import zlib


class Reader:
    """`words` read `file`, which is in `folder`; # in them is that folder, @ the inputs', % a new output's name."""

    def __init__(self, name, folder, file, words, is_first, is_json=None):
        self.name, self.folder, self.file, self.words, self.is_first = name, folder, file, words, is_first
        self.is_json = file.endswith(".json") or file.endswith(".gltf") if is_json is None else is_json


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def plane_rows(columns=10, rows=5):
    points = [(4 * i, 4 * j, 0) for j in range(rows + 1) for i in range(columns + 1)]
    faces = []
    for j in range(rows):
        for i in range(columns):
            a = (columns + 1) * j + i
            faces.append((a, a + 1, a + columns + 2, a + columns + 1))
    return points, faces


def plane_obj():
    points, faces = plane_rows()
    return "".join("v %g %g %g\n" % p for p in points) + "".join("f %d %d %d %d\n" % tuple(k + 1 for k in f) for f in faces)


def plane_ply():
    points, faces = plane_rows()
    head = ("ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (len(points), len(faces)))
    return head + "".join("%g %g %g\n" % p for p in points) + "".join("4 %d %d %d %d\n" % f for f in faces)


def plane_stl():
    points, faces = plane_rows(4, 2)
    out = "solid plane\n"
    for a, b, c, d in faces:
        for corners in ((a, b, c), (a, c, d)):
            out += "facet normal 0 0 1\nouter loop\n"
            out += "".join("vertex %g %g %g\n" % points[k] for k in corners) + "endloop\nendfacet\n"
    return out + "endsolid plane\n"


def gray_png(width, height, value):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + bytes([value]) * width for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


WAVE = ('{"format":"asperity-texture","version":1,"name":"wave","model":"fourier1d","fourier1d":{"length_mm":10,'
        '"omega_rad_per_mm":0.6283185307179586,"a_m":[0,0,0,0.0001],"b_m":[0,0,0,0],"mean_m":0},"extra":{}}')
CAMERA = ('{"format":"asperity-calibration","version":1,"camera":{"width_px":64,"height_px":48,"fx_px":60,"fy_px":60,'
          '"cx_px":32,"cy_px":24,"distortion":[0,0,0,0,0]}}')


def make(program, source, root):
    """Makes the inputs below `root` and gives their readers. `source` is the project's folder."""

    def run(*words):
        done = subprocess.run([program, *words, "--quiet"], cwd=root, capture_output=True, text=True)
        if done.returncode not in (0, 3):
            raise RuntimeError(f"{words}: {done.stderr}")

    for name in ("meshes", "tables", "painted", "track"):
        os.makedirs(f"{root}/{name}", exist_ok=True)
    run("simulate", "--surface", "sine", "--seed", "1", "--speed", "40mm/s", "--set", "hand.length_m=0.012", "-o", "rec")
    run("process", "rec", "-o", "processed")
    write(f"{root}/meshes/plane.obj", plane_obj())
    write(f"{root}/meshes/plane.ply", plane_ply())
    write(f"{root}/meshes/plane.stl", plane_stl())
    write(f"{root}/wave.texture.json", WAVE)
    run("paint", "meshes/plane.obj", "--through", "5,7,0;35,7,0", "--texture", "wave.texture.json", "--mesh-unit", "mm", "-o",
        "scene")
    shutil.copy(f"{root}/wave.texture.json", f"{root}/tables/wave.texture.json")
    write(f"{root}/meshes/plane.gltf", plane_gltf())
    write(f"{root}/tables/path.csv", "px_m,py_m,pz_m\n" +
          "".join("%g,%g,0\n" % (0.005 + 0.0005 * i, 0.007 + 0.0001 * (i % 20)) for i in range(60)))
    write(f"{root}/tables/force.csv", "counts,force_N\n48,0\n95,1.14\n100,1.24\n105,1.34\n115,1.54\n128,1.79\n155,2.29\n")
    write(f"{root}/tables/heights.csv", "".join("%g\n" % (1e-5 * math.sin(0.3 * i)) for i in range(400)))
    write(f"{root}/tables/stroke.csv", "t_s,px_m,py_m,pz_m\n" +
          "".join("%g,%g,0.008,0.0005\n" % (0.001 * i, 0.01 + 0.00005 * i) for i in range(100)))
    write(f"{root}/tables/series.csv", "t_s,acceleration_mps2,speed_mps,force_N\n" +
          "".join("%g,%g,0.1,1\n" % (0.0005 * i, math.sin(0.7 * i) + 0.1 * math.sin(2.1 * i)) for i in range(1200)))
    write(f"{root}/tables/imu.csv", "t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps\n" +
          "".join("%g,0.1,0,9.8,0,0,0.1\n" % (0.005 * i) for i in range(200)))
    write(f"{root}/tables/pose.csv", "t_s,px_m,py_m,pz_m,qw,qx,qy,qz\n" +
          "".join("%g,%g,0,0,1,0,0,0\n" % (0.02 * i, 0.001 * i) for i in range(50)))
    write(f"{root}/tables/settings.toml", "[profile]\ncutoff_cycles_per_mm = 0.2\nds_m = 2.5e-5\n[trajectory]\nmethod = \"fused\"\n")
    shutil.copy(f"{source}/fuzz/corpus/study_log/pairs.csv", f"{root}/tables/pairs.study.csv")
    shutil.copy(f"{source}/fuzz/corpus/study_log/staircase.csv", f"{root}/tables/staircase.study.csv")
    shutil.copy(f"{source}/fuzz/corpus/penn_xml/good_arma.xml", f"{root}/tables/arma.xml")
    run("markers", "ring", "--size", "46mm", "--sides", "6", "-o", "track/ring.pdf", "--markers", "track/markers.json")
    write(f"{root}/track/camera.json", CAMERA)
    with open(f"{root}/track/1.png", "wb") as file:
        file.write(gray_png(64, 48, 200))
    return readers(root)


def plane_gltf():
    import base64
    import json
    points, faces = plane_rows(4, 2)
    corners = [c for a, b, d, e in faces for c in (a, b, d, a, d, e)]
    data = b"".join(struct.pack("<3f", *p) for p in points) + b"".join(struct.pack("<H", c) for c in corners)
    first = 12 * len(points)
    return json.dumps({
        "asset": {"version": "2.0", "generator": "by hand"},
        "scene": 0,
        "scenes": [{"nodes": [0], "name": "s"}],
        "nodes": [{"mesh": 0, "scale": [1, 1, 1], "translation": [0, 0, 0], "name": "n"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}], "name": "m"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": [0, 0, 0],
                       "max": [16, 8, 0]},
                      {"bufferView": 1, "componentType": 5123, "count": len(corners), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": first},
                        {"buffer": 0, "byteOffset": first, "byteLength": len(data) - first}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]})


def readers(root):
    out = []

    def add(folder, file, *commands, is_json=None):
        for words in commands:
            first = not any(reader.file == file for reader in out)
            out.append(Reader(f"{file}: {' '.join(words[:2])}", f"{root}/{folder}", file, list(words), first, is_json))

    process = ("process", "#", "-o", "%", "--json")
    for file in ("recording.json", "calibration.json"):
        add("rec", file, process, ("inspect", "#", "--json"), ("calibrate", "imu", "#"), ("calibrate", "tip", "#"))
    add("rec", "calibration.json", ("calibrate", "latency", "#"), ("check-rig", "#"), ("process", "#", "-o", "%", "--method", "thesis"),
        ("register", "#", "@/meshes/plane.obj", "--mesh-unit", "mm", "-o", "%"))
    for file in ("probe.csv", "tracker.csv"):
        add("rec", file, process, ("inspect", "#"), ("calibrate", "latency", "#"))
    add("rec", "truth.csv", process)
    add("rec", "checksums.txt", ("inspect", "#"), ("recover", "#", "-o", "%"))
    add("processed", "result.json", ("report", "#", "-o", "%.html"))
    add("processed", "profile.csv", ("roughness", "#/profile.csv"), ("texture", "fit", "#/profile.csv", "-o", "%.texture.json"),
        ("report", "#", "-o", "%.html"), ("texture", "compare", "#/profile.csv", "@/wave.texture.json"))
    add("processed", "texture.json", ("texture", "info", "#/texture.json"), ("export", "#/texture.json", "--to", "x3p", "-o", "%"))
    add("processed", "trajectory.csv", ("register", "#/trajectory.csv", "@/meshes/plane.obj", "--mesh-unit", "mm", "--guess",
                                        "0,0,0,1,0,0,0", "-o", "%"))
    mesh = ("register", "@/tables/path.csv", "#/MESH", "--mesh-unit", "mm", "--guess", "0,0,0,1,0,0,0", "-o", "%")
    for kind in ("obj", "ply", "stl", "gltf"):
        file = f"plane.{kind}"
        add("meshes", file, tuple(w.replace("MESH", file) for w in mesh),
            ("feel", f"#/{file}", "--mesh-unit", "mm", "--duration", "200ms"),
            ("paint", f"#/{file}", "--through", "5,7,0;35,7,0", "--texture", "@/wave.texture.json", "--mesh-unit", "mm", "-o", "%"))
    for file in ("scene.json", "textured.obj", "paint.json"):
        if os.path.exists(f"{root}/scene/{file}"):
            add("scene", file, ("feel", "#", "--duration", "200ms", "--json"), ("export", "#", "--to", "gltf", "-o", "%"))
    add("tables", "wave.texture.json", ("texture", "info", "#/wave.texture.json"),
        ("texture", "synthesize", "#/wave.texture.json", "-o", "%.csv"), ("texture", "synthesize", "#/wave.texture.json", "-o", "%.png"),
        ("texture", "compare", "#/wave.texture.json", "@/processed/profile.csv"),
        ("export", "#/wave.texture.json", "--to", "wav", "-o", "%"), ("export", "#/wave.texture.json", "--to", "stl", "-o", "%"))
    add("tables", "path.csv", ("register", "#/path.csv", "@/meshes/plane.obj", "--mesh-unit", "mm", "--guess", "0,0,0,1,0,0,0",
                               "-o", "%"), ("register", "#/path.csv", "@/meshes/plane.obj", "--mesh-unit", "mm", "-o", "%"))
    add("tables", "force.csv", ("calibrate", "force", "#/force.csv", "--json"), ("calibrate", "force", "#/force.csv"))
    add("tables", "heights.csv", ("roughness", "#/heights.csv", "--spacing", "25um"),
        ("texture", "fit", "#/heights.csv", "--spacing", "25um", "-o", "%.texture.json"))
    add("tables", "stroke.csv", ("feel", "@/scene", "--replay", "#/stroke.csv"))
    add("tables", "series.csv", ("texture", "fit", "#/series.csv", "--model", "autoregressive", "-o", "%.texture.json"),
        ("texture", "fit", "#/series.csv", "--model", "decaying_sinusoids", "-o", "%.texture.json"))
    add("tables", "imu.csv", ("import", "--imu", "#/imu.csv", "--pose", "@/tables/pose.csv", "-o", "%"))
    add("tables", "pose.csv", ("import", "--imu", "@/tables/imu.csv", "--pose", "#/pose.csv", "-o", "%"))
    add("tables", "settings.toml", ("process", "@/rec", "--config", "#/settings.toml", "-o", "%"))
    for kind in ("pairs", "staircase"):
        add("tables", f"{kind}.study.csv", ("study", "summarize", f"#/{kind}.study.csv"))
    add("tables", "arma.xml", ("texture", "fit", "#/arma.xml", "--model", "autoregressive", "-o", "%.texture.json"))
    track = ("track", "@/track/1.png", "--camera", "#/camera.json", "--markers", "#/markers.json", "--rate", "30", "-o", "%.csv")
    add("track", "markers.json", track)
    add("track", "camera.json", track)
    return out
