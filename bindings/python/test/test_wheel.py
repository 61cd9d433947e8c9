"""The wheel unpacks to a package that works, and its RECORD is true."""

import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import zipfile

import asperity

ROOT = pathlib.Path(__file__).parents[3]


def pack(folder):
    package = pathlib.Path(asperity.__file__).parent
    command = [sys.executable, ROOT / "bindings/python/pack_wheel.py", package, ROOT / "LICENSE", folder]
    return pathlib.Path(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip())


def test_the_wheel_is_a_package(tmp_path):
    wheel = pack(tmp_path / "wheel")
    assert pack(tmp_path / "again").read_bytes() == wheel.read_bytes()
    with zipfile.ZipFile(wheel) as archive:
        record = next(name for name in archive.namelist() if name.endswith("/RECORD"))
        lines = archive.read(record).decode().splitlines()
        assert {line.split(",")[0] for line in lines} == set(archive.namelist())
        for line in lines:
            name, digest, size = line.split(",")
            if name == record:
                continue
            data = archive.read(name)
            assert len(data) == int(size)
            assert digest == "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        archive.extractall(tmp_path / "unpacked")
    where = subprocess.run(
        [sys.executable, "-c", "import asperity; print(asperity.__file__, asperity.roughness([0, 1e-6] * 500, 1e-6)['Ra_m'])"],
        env={**os.environ, "PYTHONPATH": str(tmp_path / "unpacked")},
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    ).stdout.split()
    assert where[0].startswith(str(tmp_path / "unpacked"))
    assert 0.0 < float(where[1]) < 1e-6


def test_an_empty_folder_is_refused(tmp_path):
    (tmp_path / "asperity").mkdir()
    command = [sys.executable, ROOT / "bindings/python/pack_wheel.py", tmp_path / "asperity", ROOT / "LICENSE", tmp_path / "out"]
    run = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    assert run.returncode == 1 and "asperity_python" in run.stderr
    assert not (tmp_path / "out").exists()
