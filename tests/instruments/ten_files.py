#!/usr/bin/env python3
"""Ten files of ten instruments or programs, one command each, the same numbers (docs/surfaces.md).

    ten_files.py PROGRAM [FOLDER]     PROGRAM: the asperity that is checked; FOLDER: keep the files there

One profile in five forms and one map in five, each written here by the format's public description, not by asperity's
writer. `asperity roughness FILE` must give the values that this script computes of the heights themselves, to what the
form's digits or steps allow. Exits with 1 where one does not.
"""
import json
import math
import os
import random
import struct
import subprocess
import sys
import tempfile
import zipfile

POINTS, STEP_M = 4000, 0.5e-6
COLUMNS, ROWS, STEP_X_M, STEP_Y_M = 81, 61, 5e-6, 4e-6


def profile():
    """Heights in m, in whole nanometres, so that every form below holds them exactly."""
    noise = random.Random(1)
    return [round(1e3 * (1.2 * math.sin(2 * math.pi * 5e3 * i * STEP_M) + 0.4 * math.sin(2 * math.pi * 21e3 * i * STEP_M)
                         + noise.gauss(0, 0.1))) * 1e-9 for i in range(POINTS)]


def relief():
    noise = random.Random(2)
    return [round(1e3 * (math.cos(0.31 * c) * math.cos(0.22 * r) + noise.gauss(0, 0.05))) * 1e-9
            for r in range(ROWS) for c in range(COLUMNS)]


# Profiles.
def one_column(heights):
    return "".join(f"{1e6 * z:.3f}\n" for z in heights).encode()


def german(heights):
    rows = "".join(f"{1e3 * STEP_M * i:.4f};{1e6 * z:.3f}\n".replace(".", ",") for i, z in enumerate(heights))
    return ("Datum;22.11.2026\nMessgerät;Tastschnitt\nX [mm];Z [µm]\n" + rows).encode("latin-1")


def tabs(heights):
    rows = "".join(f"{1e3 * STEP_M * i:.4f}\t{1e6 * z:.3f}\n" for i, z in enumerate(heights))
    return ("Profile 1\nX\tZ\nmm\tµm\n" + rows).encode()


def named_columns(heights):
    return ("x_mm,z_um\n" + "".join(f"{1e3 * STEP_M * i:.4f},{1e6 * z:.3f}\n" for i, z in enumerate(heights))).encode()


def sdf_text(heights):
    """ISO 25178-71 in its text form: whole numbers times Zscale, one profile."""
    head = (f"aISO-1.0\nManufacID = script\nCreateDate = 221120261200\nModDate = 221120261200\nNumPoints = {POINTS}\n"
            f"NumProfiles = 1\nXscale = {STEP_M!r}\nYscale = {STEP_M!r}\nZscale = 1e-9\nZresolution = -1\n"
            "Compression = 0\nDataType = 6\nCheckType = 0\n*\n")
    return (head + "\n".join(str(round(1e9 * z)) for z in heights) + "\n*\n").encode()


# Maps.
def xyz(heights):
    return ("x_mm,y_mm,z_um\n" + "".join(f"{1e3 * STEP_X_M * (i % COLUMNS):.3f},{1e3 * STEP_Y_M * (i // COLUMNS):.3f},"
                                         f"{1e6 * z:.3f}\n" for i, z in enumerate(heights))).encode()


def gsf(heights):
    """Gwyddion Simple Field 1.0 (Gwyddion's user guide): text header, padded by zeros to four bytes, floats."""
    head = (f"Gwyddion Simple Field 1.0\nXRes = {COLUMNS}\nYRes = {ROWS}\nXReal = {COLUMNS * STEP_X_M!r}\n"
            f"YReal = {ROWS * STEP_Y_M!r}\nXYUnits = m\nZUnits = m\n").encode()
    return head + b"\0" * (4 - len(head) % 4) + struct.pack(f"<{len(heights)}f", *heights)


def sdf_binary(heights):
    """ISO 25178-71 in its binary form: 32-bit whole numbers (type 6) times Zscale."""
    head = struct.pack("<8s10s12s12sHHddddBBB", b"bISO-1.0", b"script    ", b"221120261200", b"221120261200", COLUMNS, ROWS,
                       STEP_X_M, STEP_Y_M, 1e-9, -1.0, 0, 6, 0)
    return head + struct.pack(f"<{len(heights)}i", *(round(1e9 * z) for z in heights))


def sur(heights):
    """Digital Surf, uncompressed (the layout as Gwyddion's documentation has it): a header of 512 bytes, 32-bit steps."""
    steps = [round(1e9 * z) for z in heights]
    text = lambda value, length: value.encode().ljust(length)
    head = text("DIGITAL SURF", 12) + struct.pack("<hhhh", 0, 1, 1, 2) + text("script", 30) + text("", 30)
    head += struct.pack("<hhhhh", 0, 0, 0, 0, 1) + b"\0" * 8
    head += struct.pack("<hiiiii", 32, min(steps), max(steps), COLUMNS, ROWS, len(steps))
    head += struct.pack("<fff", 1e3 * STEP_X_M, 1e3 * STEP_Y_M, 1e-3)
    head += text("X", 16) + text("Y", 16) + text("Z", 16)
    head += text("mm", 16) + text("mm", 16) + text("µm", 16)
    head += text("mm", 16) + text("mm", 16) + text("µm", 16)
    head += struct.pack("<fff", 1.0, 1.0, 1.0) + struct.pack("<hhh", 0, 0, 0) + b"\0" * 12
    head += struct.pack("<hhhhhhh", 0, 0, 12, 22, 11, 2026, 0) + struct.pack("<f", 0.0) + b"\0" * 10
    head += struct.pack("<hh", 0, 0) + b"\0" * 128 + struct.pack("<fff", 0.0, 0.0, 0.0)
    head = head.ljust(512, b"\0")
    assert len(head) == 512
    return head + struct.pack(f"<{len(steps)}i", *steps)


def x3p(path, heights):
    """ISO 25178-72 (openGPS): a zip of main.xml and the doubles of the matrix."""
    axis = lambda name, kind, step: (f"<{name}><AxisType>{kind}</AxisType><DataType>D</DataType>"
                                     f"<Increment>{step!r}</Increment><Offset>0</Offset></{name}>")
    xml = ('<?xml version="1.0" encoding="UTF-8"?>\n<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">'
           "<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>"
           + axis("CX", "I", STEP_X_M) + axis("CY", "I", STEP_Y_M) + axis("CZ", "A", 1.0)
           + "</Axes></Record1><Record2><Date>2026-11-22T12:00:00</Date></Record2>"
           f"<Record3><MatrixDimension><SizeX>{COLUMNS}</SizeX><SizeY>{ROWS}</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
           "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3>"
           "<Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4></p:ISO5436_2>\n")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", xml)
        archive.writestr("bindata/data.bin", struct.pack(f"<{len(heights)}d", *heights))


def moments(heights):
    mean = math.fsum(heights) / len(heights)
    parts = [z - mean for z in heights]
    return math.fsum(abs(z) for z in parts) / len(parts), math.sqrt(math.fsum(z * z for z in parts) / len(parts))


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = sys.argv[2] if len(sys.argv) == 3 else tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    line, area = profile(), relief()
    failed = 0
    print(f"{'file':<22} {'Ra or Sa, nm':>14} {'Rq or Sq, nm':>14} {'difference':>11}")
    # The values of a map are those of the heights after their mean alone: areal.form=mean.
    for name, content, options in (
            ("column.txt", one_column(line), ["--spacing", "0.5um"]), ("german.csv", german(line), []),
            ("tabs.txt", tabs(line), []), ("columns.csv", named_columns(line), []), ("profile.sdf", sdf_text(line), []),
            ("xyz.csv", xyz(area), None), ("map.gsf", gsf(area), None), ("map.sdf", sdf_binary(area), None),
            ("map.sur", sur(area), None), ("map.x3p", None, None)):
        path = os.path.join(folder, name)
        if content is None:
            x3p(path, area)
        else:
            with open(path, "wb") as file:
                file.write(content)
        is_map = options is None
        command = [sys.argv[1], "roughness", path, "--json"] + (["--set", "areal.form=mean"] if is_map else options)
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            failed += 1
            print(f"{name:<22} FAILED: {done.stderr.strip()}")
            continue
        found = json.loads(done.stdout)
        values = [found["roughness"][key] for key in (("Sa_m", "Sq_m") if is_map else ("Ra_m", "Rq_m"))]
        expected = moments(area if is_map else line)
        size = (found["columns"], found["rows"]) if is_map else (found["samples"],)
        steps = (found["x_spacing_m"], found["y_spacing_m"]) if is_map else (found["spacing_m"],)
        difference = max(abs(a / b - 1) for a, b in zip(values, expected))
        # Whole nanometres are exact in every form but floats (GSF, and the steps of SUR): 6e-8 of each height.
        holds = difference < 1e-6 and size == ((COLUMNS, ROWS) if is_map else (POINTS,))
        holds = holds and all(abs(a / b - 1) < 1e-6 for a, b in zip(steps, (STEP_X_M, STEP_Y_M) if is_map else (STEP_M,)))
        failed += 0 if holds else 1
        print(f"{name:<22} {1e9 * values[0]:>14.6f} {1e9 * values[1]:>14.6f} {difference:>11.1e}"
              + ("" if holds else f"  FAILED: {size}, {steps}, expected {expected}"))
    sys.exit(1 if failed else 0)


main()
