#!/usr/bin/env python3
"""Compares asperity with Gwyddion on the same files (docs/surfaces.md, docs/roughness.md).

    compare.py PROGRAM     PROGRAM: the asperity that is checked

1. Maps, one with missing points, and a profile are written by `asperity export` as X3P, SDF (both forms) and GSF; Gwyddion
   must read the size, the spacing, which points are missing, and the heights.
2. The areal parameters that Gwyddion has too are printed with their differences. Those of the heights must agree to 1e-6;
   slopes, which the two take by other formulas, to 2 % on a surface that is smooth over its spacing.
Exits with 1 where something does not hold.
"""
import json
import math
import os
import random
import struct
import subprocess
import sys
import tempfile

READER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "gwyddion_reader.py")
failures = []


def fail(text):
    failures.append(text)
    print("FAILED  " + text)


def gsf(columns, rows, step_x_m, step_y_m, heights):
    """A file by the format's description, not by asperity's writer."""
    out = (f"Gwyddion Simple Field 1.0\nXRes = {columns}\nYRes = {rows}\nXReal = {columns * step_x_m!r}\n"
           f"YReal = {rows * step_y_m!r}\nXYUnits = m\nZUnits = m\n").encode()
    out += b"\0" * (4 - len(out) % 4)
    return out + struct.pack(f"<{len(heights)}f", *heights)


def by_gwyddion(path):
    done = subprocess.run([sys.executable, READER, path], capture_output=True, text=True)
    if done.returncode != 0:
        return None, done.stderr.strip().split("\n")[-1]
    return json.loads(done.stdout), ""


def run(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def relief(columns, rows, holes, seed):
    noise = random.Random(seed)
    out = []
    for row in range(rows):
        for column in range(columns):
            z = 1e-6 * math.cos(0.11 * column) * math.cos(0.07 * row) + 3e-9 * column - 2e-9 * row
            z += 4e-7 * math.sin(0.05 * column + 0.03 * row) ** 3
            if holes and noise.random() < 0.05:
                z = math.nan
            out.append(struct.unpack("<f", struct.pack("<f", z))[0])
    return out


def check_written(program, folder, name, columns, rows, heights):
    source = os.path.join(folder, name + ".gsf")
    with open(source, "wb") as file:
        file.write(gsf(columns, rows, 1e-6, 2e-6, heights))
    for to, ending in (("x3p", "x3p"), ("sdf", "sdf"), ("sdf-binary", "sdf"), ("gsf", "gsf")):
        if to == "sdf" and any(map(math.isnan, heights)):
            continue  # Gwyddion 2.62 ends with an error at the BAD of SDF's text
        if to == "x3p" and rows == 1:
            continue  # Gwyddion makes a graph of it, which has no map
        target = os.path.join(folder, f"{name}-{to}")
        run(program, "export", source, "--to", to, "-o", target, "--quiet")
        got, reason = by_gwyddion(os.path.join(target, f"{name}.{ending}"))
        where = f"{name} as {to}"
        if got is None:
            fail(f"{where}: {reason}")
            continue
        if (got["columns"], got["rows"]) != (columns, rows):
            fail(f"{where}: {got['columns']} x {got['rows']} points instead of {columns} x {rows}")
            continue
        if abs(got["x_spacing_m"] - 1e-6) > 1e-14 or rows > 1 and abs(got["y_spacing_m"] - 2e-6) > 1e-14:
            fail(f"{where}: spacing {got['x_spacing_m']} x {got['y_spacing_m']} m")
        lost = sum((b is None) != math.isnan(a) for a, b in zip(heights, got["height_m"]))
        worst = max(abs(a - b) for a, b in zip(heights, got["height_m"]) if b is not None and not math.isnan(a))
        if lost or worst > 1e-15:
            fail(f"{where}: {lost} points are missing in one only, heights differ by up to {worst:.2g} m")
        else:
            print(f"{where}: read by Gwyddion, {got['missing']} missing points, heights within {worst:.1g} m")


def check_roughness(program, folder, name, columns, rows, heights):
    source = os.path.join(folder, name + ".gsf")
    with open(source, "wb") as file:
        file.write(gsf(columns, rows, 1e-6, 2e-6, heights))
    ours = json.loads(run(program, "roughness", source, "--json"))["roughness"]
    theirs, reason = by_gwyddion(source)
    if theirs is None:
        fail(f"{name}: {reason}")
        return
    print(f"{name}: {columns} x {rows}\n{'':6} {'asperity':>14} {'Gwyddion':>14} {'difference':>12}")
    for key, value in theirs["roughness"].items():
        scale = max(abs(value), 1e-3 if key == "Ssk" else 0.0)
        difference = abs(ours[key] - value) / scale
        print(f"{key:6} {ours[key]:14.7g} {value:14.7g} {difference:12.2g}")
        if difference > (2e-2 if key in ("Sdq", "Sdr") else 1e-6):
            fail(f"{name}: {key} differs by {difference:.2g}")


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        check_written(program, folder, "whole", 96, 70, relief(96, 70, False, 1))
        check_written(program, folder, "holes", 64, 81, relief(64, 81, True, 2))
        check_written(program, folder, "line", 500, 1, relief(500, 1, True, 3))
        check_roughness(program, folder, "smooth", 300, 220, relief(300, 220, False, 4))
    print("the same" if not failures else f"{len(failures)} differences")
    return 1 if failures else 0


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
