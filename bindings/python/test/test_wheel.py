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
LICENCES = [ROOT / "LICENSE", ROOT / "packaging/copyright"]


def pack(folder):
    package = pathlib.Path(asperity.__file__).parent
    command = [sys.executable, ROOT / "bindings/python/pack_wheel.py", package, *LICENCES, folder]
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


def test_the_licences_of_what_is_compiled_in_are_in_the_wheel(tmp_path):
    with zipfile.ZipFile(pack(tmp_path)) as archive:
        names = {name.split("/")[-1]: name for name in archive.namelist()}
        assert archive.read(names["LICENSE"]) == (ROOT / "LICENSE").read_bytes()
        notice = archive.read(names["COPYRIGHT"]).decode()
    # What bindings/python/CMakeLists.txt and its modules compile in, by the holder's name in each one's own header.
    for holder in ("Wenzel Jakob", "Gael Guennebaud", "Victor Zverovich", "Niels Lohmann", "Syoyo Fujita"):
        assert holder in notice
    # The texts that their licences ask to keep, and where the source of MPL's part is.
    for text in ("Redistributions in binary form must reproduce", "Permission is hereby granted", "https://www.mozilla.org/MPL/2.0/", "gitlab.com/libeigen"):
        assert text in notice


def test_an_empty_folder_is_refused(tmp_path):
    (tmp_path / "asperity").mkdir()
    command = [sys.executable, ROOT / "bindings/python/pack_wheel.py", tmp_path / "asperity", *LICENCES, tmp_path / "out"]
    run = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    assert run.returncode == 1 and "asperity_python" in run.stderr
    assert not (tmp_path / "out").exists()
