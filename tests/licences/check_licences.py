"""What is compiled into the programs and libraries is in packaging/copyright, and nothing else is.

    check_licences.py BUILD SOURCE [COPYRIGHT]

Of the objects in BUILD, ninja knows each header that the compiler read, dpkg the package of Debian that each is of;
package-lock.json lists what the studio's bundle is made of. Ends with 1 where a package has no stanza, where a stanza has no
package, and where a holder that a package of npm names is missing.
"""

import fnmatch
import json
import pathlib
import re
import subprocess
import sys

# Of these the headers give declarations, constants and short macros, of the system or of a library that is loaded when a
# program begins and whose package has its own licence.
LOADED = """libc6-dev linux-libc-dev libstdc++-12-dev libgcc-12-dev libcrypt-dev zlib1g-dev libzip-dev libpng-dev
libjpeg62-turbo-dev libpugixml-dev libssl-dev libsdl2-dev libapriltag-dev libcairo2-dev libtiff-dev libpython3.11-dev""".split()
# Objects that are in no package.
NOT_SHIPPED = re.compile(r"(^|/)(tests?|testkit|bench|examples|fuzz)/|_test\.dir|/asperity_test_precompiled\.dir/|/feel_in_c\.dir/|/adding")
# In the bundle beside the packages that package-lock.json has as its dependencies: vite's loader of parts.
BUNDLERS = {"vite"}


def headers_of(build):
    """The paths in /usr/include that the objects of packages were compiled with."""
    out, shipped = set(), False
    deps = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, stdout=subprocess.PIPE, text=True).stdout
    for line in deps.splitlines():
        if line and not line[0].isspace():
            shipped = not NOT_SHIPPED.search(line.split(":")[0])
        elif shipped and line.strip().startswith("/usr/include/"):
            out.add(line.strip())
    return out


def packages_of(headers):
    found = subprocess.run(["dpkg", "-S", *sorted(headers)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    out = {line.split(": ", 1)[0].split(",")[0].split(":")[0] for line in found.stdout.splitlines() if not line.startswith("diversion")}
    return out


def stanzas_of(text):
    """(patterns, holders) of each paragraph with files, but that of the project's own."""
    out = []
    for paragraph in re.split(r"\n\s*\n", text):
        fields = dict(re.findall(r"^(\S+):\s*(.*(?:\n[ \t].*)*)", paragraph, flags=re.M))
        if "Files" in fields and fields["Files"] != "*":
            out.append(([each.removesuffix("/*") for each in fields["Files"].split()], fields["Copyright"]))
    return out


def plain(text):
    return re.sub(r"[^a-z0-9]+", " ", text.lower().replace("(c)", "").replace("©", "")).strip()


def main():
    build, source = (pathlib.Path(argument) for argument in sys.argv[1:3])
    listed = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else source / "packaging/copyright"
    faults = []
    stanzas = stanzas_of(listed.read_text(encoding="utf-8"))
    patterns = [pattern for names, _ in stanzas for pattern in names]
    compiled_in = packages_of(headers_of(build)) - set(LOADED)
    modules = json.loads((source / "studio/web/package-lock.json").read_text())["packages"]
    bundled = {path.removeprefix("node_modules/") for path, one in modules.items() if path and not one.get("dev") and not one.get("optional")} | BUNDLERS
    if "libeigen3-dev" not in compiled_in:
        faults.append(f"{build}: no object was compiled with Eigen: is it built, by ninja?")
    for name in sorted(compiled_in | bundled):
        if not any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns):
            faults.append(f"packaging/copyright: '{name}' is compiled in and has no paragraph")
    for pattern in patterns:
        if not any(fnmatch.fnmatchcase(name, pattern) for name in compiled_in | bundled):
            faults.append(f"packaging/copyright: nothing that is compiled in is called '{pattern}'")
    for name in sorted(bundled - BUNDLERS):
        licences = sorted((source / "studio/web/node_modules" / name).glob("LICEN*")) or sorted((build / "studio/web/node_modules" / name).glob("LICEN*"))
        for file in licences[:1]:
            holder = re.search(r"^\s*(?:The MIT License.*\n\s*)?Copyright\s+(.*)$", file.read_text(encoding="utf-8"), flags=re.M)
            named = [plain(holders) for names, holders in stanzas if any(fnmatch.fnmatchcase(name, each) for each in names)]
            if holder and not any(plain(holder[1]) in each for each in named):
                faults.append(f"packaging/copyright: '{name}' is of '{holder[1]}', which its paragraph does not name")
    # A report is one file that is passed on: the holders and the terms are in its script.
    script = build / "studio/web/report/report.js"
    if script.is_file():
        begin = plain(script.read_text(encoding="utf-8")[:4000])
        for text in ("three js authors", "garrett johnson", "jason miller", "preact team", "leon sorokin", "permission is hereby granted"):
            if text not in begin:
                faults.append(f"{script}: '{text}' is not at its begin")
    for fault in faults:
        print(fault)
    if not faults:
        print(f"{len(compiled_in)} packages of Debian and {len(bundled)} of npm: " + " ".join(sorted(compiled_in | bundled)))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
