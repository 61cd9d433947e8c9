#!/usr/bin/python3
"""The schemas of docs/schemas hold for what the program writes: check_schemas.py PROGRAM SOURCE

Every schema is one of draft 2020-12. Results, registrations, textures and scenes of several commands are valid, also when
the schema is closed: then a key that it does not have is an error, except in objects marked "x-open". Each kind of damage to a
written file is found. The keys of textures and scenes are those of docs/texture.md and docs/scene.md. Needs python3-jsonschema."""
import copy
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import jsonschema

PROGRAM, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
NAMES = ("result", "registration", "texture", "scene")


def run(*words, codes=(0, 3)):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    if done.returncode not in codes:
        sys.exit(f"schemas: {' '.join(words)}: {done.returncode}\n{done.stderr}")


def closed(schema):
    """The schema with no other keys than those it names."""
    if isinstance(schema, dict):
        out = {key: closed(value) for key, value in schema.items()}
        if "properties" in out and isinstance(out.get("properties"), dict) and ("type" in out or "$schema" in out) and not out.get("x-open"):
            out.setdefault("additionalProperties", False)
        return out
    return [closed(item) for item in schema] if isinstance(schema, list) else schema


def bumpy_sphere(name, radius_mm=30.0, rows=40, columns=80):
    """A closed body without symmetry, so that a path on it has one pose."""
    def point(i, j):
        a, b = math.pi * i / rows, 2 * math.pi * j / columns
        r = radius_mm * (1 + 0.06 * math.sin(3 * b) * math.sin(a) ** 2 + 0.05 * math.cos(2 * a + b) * math.sin(a))
        return r * math.sin(a) * math.cos(b), 0.8 * r * math.sin(a) * math.sin(b), 0.6 * r * math.cos(a)
    with open(name, "w", encoding="utf-8") as file:
        for i in range(1, rows):
            for j in range(columns):
                file.write("v %.6f %.6f %.6f\n" % point(i, j))
        file.write("v %.6f %.6f %.6f\nv %.6f %.6f %.6f\n" % (*point(0, 0), *point(rows, 0)))
        at = lambda i, j: (i - 1) * columns + j % columns + 1
        top, bottom = (rows - 1) * columns + 1, (rows - 1) * columns + 2
        for j in range(columns):
            file.write(f"f {top} {at(1, j)} {at(1, j + 1)}\nf {bottom} {at(rows - 1, j + 1)} {at(rows - 1, j)}\n")
            for i in range(1, rows - 1):
                file.write(f"f {at(i, j)} {at(i + 1, j)} {at(i + 1, j + 1)} {at(i, j + 1)}\n")


def write_files(folder):
    path = lambda name: os.path.join(folder, name)
    short = ("--set", "hand.length_m=0.04", "--quiet")
    for surface, more in (("protoboard", ()), ("sandpaper", ("--probe", "what")), ("clay_pot", ("--set", "probe.force3=true"))):
        run("simulate", "--surface", surface, "--seed", "1", *more, *short, "-o", path("rec-" + surface))
        run("process", path("rec-" + surface), "-o", path("fused-" + surface), "--quiet")
    run("process", path("rec-protoboard"), "--method", "thesis", "-o", path("thesis"), "--quiet")
    run("process", path("rec-protoboard"), "--method", "raw", "--set", "profile.tip.mode=erode", "-o", path("raw"), "--quiet")
    run("simulate", "--surface", "sandpaper", "--object-motion", "held", *short, "-o", path("rec-held"))
    run("process", path("rec-held"), "-o", path("held"), "--quiet")
    for model in ("fourier2d", "heightmap", "stochastic"):
        run("texture", "fit", path("fused-protoboard/profile.csv"), "--model", model, "-o", path(model + ".texture.json"))
    bumpy_sphere(path("body.obj"))
    mesh = (path("body.obj"), "--mesh-unit", "mm")
    run("simulate", "--surface", "sandpaper", "--mesh", *mesh, "--quiet", "-o", path("rec-body"))
    with open(path("rec-body/recording.json"), encoding="utf-8") as file:
        pose = ",".join(str(x) for x in json.load(file)["extra"]["T_mesh_world"])
    run("register", path("rec-body"), *mesh, "--guess", pose, "--date", "2026-01-02", "-o", path("object"), "--quiet")
    run("paint", path("object/scene.json"), "--through", "0.01,0,0.018;0,0.01,0.018", "--texture", path("heightmap.texture.json"),
        "-o", path("painted"), "--quiet")
    found = lambda *patterns: [f for p in patterns for f in sorted(glob.glob(path(p)))]
    return {"result": found("fused-*/result.json", "thesis/result.json", "raw/result.json", "held/result.json", "object/result.json"),
            "registration": found("object/registration.json"), "scene": found("object/scene.json", "painted/scene.json"),
            "texture": found("*.texture.json", "fused-*/texture.json", "object/*.texture.json", "painted/*.texture.json")}


def damages(document):
    """Documents that are wrong, one in each way."""
    for key in ("format", "version"):
        wrong = copy.deepcopy(document)
        del wrong[key]
        yield f"without {key}", wrong
    for key, value in (("format", "another"), ("version", 2)):
        yield f"{key} {value}", dict(document, **{key: value})
    for key, value in document.items():
        if isinstance(value, (list, dict)):
            yield f"{key} is text", dict(document, **{key: "text"})


def main():
    faults = 0

    def fault(text):
        nonlocal faults
        faults += 1
        print("schemas:", text, file=sys.stderr)

    schemas = {}
    for name in NAMES:
        with open(os.path.join(SOURCE, "docs", "schemas", name + ".schema.json"), encoding="utf-8") as file:
            schemas[name] = json.load(file)
        jsonschema.Draft202012Validator.check_schema(schemas[name])
    for name in ("texture", "scene"):
        with open(os.path.join(SOURCE, "docs", name + ".md"), encoding="utf-8") as file:
            documented = set(re.findall(r"[`\"]([A-Za-z_0-9]+)[`\"]", file.read()))
        for key in sorted(set(schemas[name]["properties"]) - documented):
            fault(f"{name}: the key {key} is not in docs/{name}.md")
    with tempfile.TemporaryDirectory() as folder:
        files = write_files(folder)
        for name in NAMES:
            if not files[name]:
                fault(f"no {name} was written")
            open_one = jsonschema.Draft202012Validator(schemas[name])
            closed_one = jsonschema.Draft202012Validator(closed(schemas[name]))
            for file_name in files[name]:
                with open(file_name, encoding="utf-8") as file:
                    document = json.load(file)
                for error in list(open_one.iter_errors(document)) + list(closed_one.iter_errors(document)):
                    fault(f"{os.path.relpath(file_name, folder)}: {'/'.join(map(str, error.path))}: {error.message[:200]}")
                for what, wrong in damages(document):
                    if open_one.is_valid(wrong):
                        fault(f"{os.path.relpath(file_name, folder)}: {what} is not found")
                if closed_one.is_valid(dict(document, another_key=1)):
                    fault(f"{os.path.relpath(file_name, folder)}: another key is not found")
        print("schemas:", ", ".join(f"{len(files[name])} of {name}" for name in NAMES))
    return 1 if faults else 0


sys.exit(main())
