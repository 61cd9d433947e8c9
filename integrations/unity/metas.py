#!/usr/bin/env python3
"""Writes the .meta file of each file and folder of a Unity package: without them Unity leaves out what is in one.

    metas.py PACKAGE [--check]     --check: writes nothing, ends with 1 if one is missing or has no file

A GUID is the MD5 of the package's name and the path, so that it stays the same. Those that are there are kept.
"""

import hashlib
import os
import sys

IMPORTERS = {".cs": "MonoImporter", ".asmdef": "AssemblyDefinitionImporter", ".md": "TextScriptImporter",
             ".so": "PluginImporter"}
PLUGIN = """  isPreloaded: 0
  platformData:
  - first:
      Any:
    second:
      enabled: 0
      settings: {}
  - first:
      Editor: Editor
    second:
      enabled: 1
      settings:
        CPU: x86_64
        OS: Linux
  - first:
      Standalone: Linux64
    second:
      enabled: 1
      settings:
        CPU: x86_64
"""


def meta_of(package, path, is_folder):
    guid = hashlib.md5(f"com.asperity.feel/{os.path.relpath(path, package)}".encode()).hexdigest()
    lines = ["fileFormatVersion: 2", f"guid: {guid}"]
    if is_folder:
        lines.append("folderAsset: yes")
    suffix = os.path.splitext(path)[1]
    importer = "PackageManifestImporter" if os.path.basename(path) == "package.json" else IMPORTERS.get(suffix, "DefaultImporter")
    lines += [f"{importer}:", "  externalObjects: {}"]
    text = "\n".join(lines) + "\n"
    if importer == "PluginImporter":
        text += PLUGIN
    return text + "  userData: \n  assetBundleName: \n  assetBundleVariant: \n"


def main():
    package, check = sys.argv[1], "--check" in sys.argv[2:]
    wrong = 0
    for folder, folders, files in os.walk(package):
        folders[:] = sorted(f for f in folders if not f.endswith("~"))  # Unity does not see these
        for name in folders + sorted(files):
            path = os.path.join(folder, name)
            if name.endswith(".meta"):
                if not os.path.exists(path[:-5]):
                    print(f"{path}: there is no such file or folder any more")
                    wrong += 1
                continue
            if os.path.exists(path + ".meta"):
                continue
            wrong += 1
            if check:
                print(f"{path} has no .meta")
            else:
                with open(path + ".meta", "w", encoding="utf-8") as file:
                    file.write(meta_of(package, path, name in folders))
    return 1 if check and wrong else 0


if __name__ == "__main__":
    sys.exit(main())
