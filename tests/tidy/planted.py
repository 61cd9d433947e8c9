#!/usr/bin/env python3
"""Faults that are planted in a small repository: scripts/tidy finds those that clang-tidy finds in the same file alone.

In a source and in a header, beside a source that defines the same name and one that does not compile; what is kept of a
run is given up when a header changes. `scripts/check tidy` runs this first.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CLEAN = {
    "modules/a/include/asperity/a/x.h": "#pragma once\nnamespace a {\ninline int next(int x) { return x + 1; }\n}  // namespace a\n",
    "modules/a/src/one.cc": '#include "asperity/a/x.h"\nnamespace a {\nnamespace {\nint helper(int x) { return x; }\n}  // namespace\n'
                            "int one(int x) { return helper(next(x)); }\n}  // namespace a\n",
    # The name's line begins with it: it is seen only when both are compiled as one.
    "modules/a/src/same_name.cc": "namespace a {\nnamespace {\nint\nhelper(int x) { return x; }\n}  // namespace\n"
                                  "int same_name(int x) { return helper(x); }\n}  // namespace a\n",
    "modules/a/src/first_program.cc": "int main() { return 0; }\n",
    "modules/a/src/second_program.cc": "int main() { return 1; }\n",
}
FAULTY_HEADER = "#pragma once\nnamespace a {\ninline int next(int x) { return x + 1; }\ninline int* nothing() { return 0; }\n}  // namespace a\n"
FAULTY_SOURCE = """#include <memory>
#include <string>
#include <string>
#include <vector>

#include "asperity/a/x.h"

namespace a {

int divide(int x) {
  int zero = x > 3 ? 0 : 1;
  if (x > 3) return 7 / zero;
  return next(x);
}
bool has_none(const std::string& s) { return s.size() == 0; }
int BadName(std::vector<int> v) { return static_cast<int>(v.size()); }
int moved(std::unique_ptr<int> p) {
  auto q = std::move(p);
  return *p + *q;
}

}  // namespace a
"""
FOUND = ["modernize-use-nullptr", "readability-duplicate-include", "clang-analyzer-core.DivideZero", "readability-container-size-empty",
         "readability-identifier-naming", "performance-unnecessary-value-param", "bugprone-use-after-move"]


def findings(text):
    return {re.sub(r"^.*?/modules/", "modules/", line) for line in text.splitlines() if re.match(r"^/.*: (error|warning): .*\[", line)}


def main():
    folder = os.path.realpath(tempfile.mkdtemp(prefix="tidy-"))
    flags = f"-I{folder}/modules/a/include -std=c++20 -Wall"

    def write(files):
        for name, text in files.items():
            path = os.path.join(folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        subprocess.run(["git", "add", "."], cwd=folder, check=True)

    def tidy():
        done = subprocess.run(["scripts/tidy"], cwd=folder, capture_output=True, text=True)
        print(done.stdout + done.stderr, end="")
        return done.returncode, findings(done.stdout), done.stdout

    def expect(so, what):
        if not so:
            sys.exit(f"tidy: {what}")

    try:
        os.makedirs(f"{folder}/scripts")
        os.makedirs(f"{folder}/build/debug")
        shutil.copy(f"{ROOT}/scripts/tidy", f"{folder}/scripts/")
        shutil.copy(f"{ROOT}/.clang-tidy", folder)
        sources = [name for name in [*CLEAN, "modules/a/src/planted.cc"] if name.endswith(".cc")]
        with open(f"{folder}/build/debug/compile_commands.json", "w", encoding="utf-8") as file:
            json.dump([{"directory": f"{folder}/build/debug", "file": f"{folder}/{name}",
                        "command": f"c++ {flags} -o x.o -c {folder}/{name}"} for name in sources], file)
        subprocess.run(["git", "init", "-q", "."], cwd=folder, check=True)
        write({".gitignore": "/build/\n", **CLEAN})
        code, _, text = tidy()
        expect(code == 0 and "4 files: 4 passed" in text and "1 halved" in text, "clean files, two of which define one name")
        code, _, text = tidy()
        expect(code == 0 and "4 kept from before" in text, "nothing has changed")
        write({"modules/a/include/asperity/a/x.h": FAULTY_HEADER, "modules/a/src/planted.cc": FAULTY_SOURCE})
        code, found, _ = tidy()
        alone = subprocess.run(["clang-tidy-14", "--quiet", "--warnings-as-errors=*", "--header-filter=/modules/",
                                f"{folder}/modules/a/src/planted.cc", "--", *flags.split()], cwd=folder, capture_output=True, text=True)
        expect(code == 1 and found == findings(alone.stdout), f"{found} and alone {findings(alone.stdout)}")
        for check in FOUND:
            expect(any(f"[{check}" in line for line in found), f"{check} was not found")
        expect(any(line.startswith("modules/a/include/asperity/a/x.h:4:") for line in found), "the header's fault has another place")
        write({"modules/a/include/asperity/a/x.h": CLEAN["modules/a/include/asperity/a/x.h"],
               "modules/a/src/planted.cc": "int x = y;\n"})
        code, found, _ = tidy()
        expect(code == 1 and len(found) == 1 and "planted.cc:1:9:" in min(found), "a file that does not compile")
    finally:
        shutil.rmtree(folder)


main()
