#!/usr/bin/env python3
"""run_pages.py on made pages: what is right passes, each kind of difference is found: self_test.py RUN_PAGES.py"""
import os
import subprocess
import sys
import tempfile

F = "```"


def run(page, *options):
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "page.md")
        with open(name, "w", encoding="utf-8") as file:
            file.write(page)
        done = subprocess.run([sys.executable, sys.argv[1], "--bin", folder, "--python", sys.executable, *options, name], capture_output=True, text=True)
        with open(name, encoding="utf-8") as file:
            return done.returncode, file.read()


def expect(passes, page, what):
    code, _ = run(page)
    if (code == 0) != passes:
        sys.exit(f"tutorials: {what}: exit code {code}")


expect(True, f"# A\n{F}console\n$ echo one\none\n$ echo two\ntwo\n{F}\n", "right output")
expect(True, f"{F}console\n$ n=3; cd /\n$ echo $n; pwd\n3\n/\n{F}\n", "one shell a page")
expect(True, f"{F}console\n$ cat <<'END'\n> a\n>\n> b\n> END\na\n\nb\n{F}\n", "continued command")
expect(True, f"{F}console\n$ printf 'a 1 b\\nx\\ny\\nz\\n'\na … b\n…\nz\n{F}\n", "left out text")
expect(True, f"<!-- exit: 3 -->\n{F}console\n$ echo out; echo error >&2; (exit 3)\nout\nerror\n{F}\n", "stated exit code")
expect(False, f"{F}console\n$ echo one\ntwo\n{F}\n", "other output")
expect(False, f"{F}console\n$ echo one\n{F}\n", "output that the page does not show")
expect(False, f"{F}console\n$ true\nline\n{F}\n", "output that does not come")
expect(False, f"{F}console\n$ false\n{F}\n", "a command that fails")
expect(False, f"<!-- exit: 3 -->\n{F}console\n$ true\n{F}\n", "a command that does not fail")
expect(False, f"{F}console\n$ printf 'a\\nz\\n'\na\n…\ny\n{F}\n", "other text after what is left out")
expect(True, f"<!-- file: a.txt lines: 3 -->\n{F}text\none\ntwo\n{F}\n{F}console\n$ cat a.txt\none\ntwo\n{F}\n", "a file")
expect(False, f"<!-- file: a.txt lines: 2 -->\n{F}text\none\ntwo\n{F}\n{F}console\n$ true\n{F}\n", "a file of too many lines")
expect(False, f"<!-- file: a.txt -->\n\n{F}console\n$ true\n{F}\n", "a file without a block")
expect(False, "nothing\n", "no command")
code, text = run(f"{F}console\n$ echo one\ntwo\n$ echo three\n{F}\n", "--update")
if code != 0 or text != f"{F}console\n$ echo one\none\n$ echo three\nthree\n{F}\n":
    sys.exit(f"tutorials: --update: {code} {text!r}")
