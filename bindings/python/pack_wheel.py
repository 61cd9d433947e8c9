"""Packs a built package folder as a wheel (PEP 427): pack_wheel.py PACKAGE LICENSE COPYRIGHT FOLDER. The same bytes each time.

COPYRIGHT has the licences of what is compiled into the module; it lies beside LICENSE in the wheel."""

import base64
import hashlib
import os
import pathlib
import sys
import sysconfig
import zipfile


def main() -> int:
    package, license_file, copyright_file, folder = (pathlib.Path(argument) for argument in sys.argv[1:5])
    modules = list(package.glob("_asperity.*.so"))
    if len(modules) != 1:
        print(f"wheel: {package}: _asperity.*.so is not there; build the target asperity_python first", file=sys.stderr)
        return 1
    sys.path.insert(0, str(package.parent))
    import asperity

    version = asperity.__version__
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"asperity-{version}.dist-info"
    files = {
        f"asperity/{file.name}": file.read_bytes()
        for file in sorted([*package.glob("*.py"), *package.glob("*.pyi"), package / "py.typed", *modules])
    }
    files[f"{info}/METADATA"] = (
        f"Metadata-Version: 2.1\nName: asperity\nVersion: {version}\n"
        "Summary: Fine surfaces, measured with a hand-held probe and felt again\n"
        "License: BSD-3-Clause\nRequires-Python: >=3.11\nRequires-Dist: numpy\n"
    ).encode()
    files[f"{info}/LICENSE"] = license_file.read_bytes()
    files[f"{info}/COPYRIGHT"] = copyright_file.read_bytes()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: asperity\nRoot-Is-Purelib: false\nTag: {tag}-{tag}-{platform}\n"
    ).encode()
    digest = lambda data: base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    record = "".join(f"{name},sha256={digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()

    folder.mkdir(parents=True, exist_ok=True)
    wheel = folder / f"asperity-{version}-{tag}-{tag}-{platform}.whl"
    temporary = wheel.with_name(f".{wheel.name}.{os.getpid()}")
    try:
        with zipfile.ZipFile(temporary, "x", zipfile.ZIP_DEFLATED) as archive:
            for name, data in files.items():
                entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
                entry.external_attr = 0o644 << 16
                entry.compress_type = zipfile.ZIP_DEFLATED
                archive.writestr(entry, data)
        os.replace(temporary, wheel)
    finally:
        temporary.unlink(missing_ok=True)
    print(wheel)
    return 0


if __name__ == "__main__":
    sys.exit(main())
