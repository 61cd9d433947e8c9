#!/usr/bin/env python3
"""Runs the commands of documentation pages and compares what they print with what the page shows.

    run_pages.py --bin DIR [--root SOURCE] [--build BUILD] [--python PYTHON] [--update] [--times] PAGE.md...

Of a page every block ```console is taken: a line `$ command` is a command, lines `> …` after it continue it, the lines
up to the next command are its output. The commands of a page run one after another in one bash and one empty folder,
with DIR first on PATH, and with the Python package and the C library of BUILD, so that a page may set a variable or
change the folder. Output and error output are compared together.

In a page's output `…` stands for any text within a line, and a line that is `…` alone for any number of lines.
`<!-- exit: N -->` on the line before a block states the exit code that its last command has; else every command ends
with 0. A block of any language behind the line `<!-- file: NAME -->` is written to the file NAME of the folder; with
`lines: N` before the `-->` it must have fewer than N lines. --update writes the output as it is into the page, except where it matches already."""
import argparse
import difflib
import os
import re
import subprocess
import sys
import tempfile
import time

FENCE = re.compile(r"^( *)```console *$")
FILE = re.compile(r"^<!-- file: ([\w.-]+)(?: lines: (\d+))? -->$")
EXIT = re.compile(r"^ *<!-- exit: (\d+) -->$")


class Command:
    def __init__(self, line, text):
        self.line, self.text, self.output, self.exit = line, text, [], 0
        self.first = self.last = line  # of the output, in lines of the page from 0


def files_of(lines):
    """Blocks that the page calls files: name and text."""
    found = {}
    for at, line in enumerate(lines):
        stated = FILE.match(line)
        if not stated:
            continue
        if at + 1 == len(lines) or not lines[at + 1].startswith("```"):
            raise SystemExit(f"line {at + 1}: no block follows the name of a file")
        block = lines[at + 2:lines.index("```", at + 2)]
        if stated.group(2) and len(block) >= int(stated.group(2)):
            raise SystemExit(f"line {at + 1}: {stated.group(1)} has {len(block)} lines and not fewer than {stated.group(2)}")
        found[stated.group(1)] = "\n".join(block) + "\n"
    return found


def commands_of(lines):
    found, at = [], 0
    while at < len(lines):
        fence = FENCE.match(lines[at])
        if not fence:
            at += 1
            continue
        indent, begin = fence.group(1), at
        at += 1
        block = []
        while at < len(lines) and lines[at].strip() != "```":
            line = lines[at][len(indent):]
            if line.startswith("$ "):
                block.append(Command(at, line[2:]))
                block[-1].first = block[-1].last = at + 1
            elif not block:
                raise SystemExit(f"line {at + 1}: output before a command")
            elif line.startswith("> ") and not block[-1].output:
                block[-1].text += "\n" + line[2:]
                block[-1].first = block[-1].last = at + 1
            elif line == ">" and not block[-1].output:
                block[-1].text += "\n"
                block[-1].first = block[-1].last = at + 1
            else:
                block[-1].output.append(line)
                block[-1].last = at + 1
            at += 1
        stated = EXIT.match(lines[begin - 1]) if begin else None
        if stated and block:
            block[-1].exit = int(stated.group(1))
        found += block
    return found


def matches(expected, printed):
    """Whether printed lines are the expected ones, in which `…` stands for anything."""
    pattern = ""
    for line in expected:
        if line.strip() == "…":
            pattern += r"(?:[^\n]*\n)*?"
        else:
            pattern += ".*".join(re.escape(part) for part in line.split("…")) + r"\n"
    return re.fullmatch(pattern, "".join(line + "\n" for line in printed)) is not None


def run_page(page, options):
    with open(page, encoding="utf-8") as file:
        lines = file.read().split("\n")
    commands = commands_of(lines)
    if not commands:
        raise SystemExit(f"{page}: no command")
    environment = dict(os.environ, LC_ALL="C.UTF-8", ASPERITY_SOURCE=options.root)
    build = options.build
    environment.update(PYTHONPATH=f"{build}/python", CPATH=f"{options.root}/bindings/c/include", LIBRARY_PATH=f"{build}/lib",
                       LD_LIBRARY_PATH=f"{build}/lib")
    failed, changes, mark = 0, [], "end-of-output-4711"
    with tempfile.TemporaryDirectory(prefix="asperity-page-") as folder, tempfile.TemporaryDirectory() as links:
        if any("cmake " in command.text for command in commands):  # find_package needs an installation
            for component in ("feel", "dev"):
                subprocess.run(["cmake", "--install", build, "--component", component, "--prefix", f"{links}/installed"],
                               stdout=subprocess.DEVNULL, check=True)
            environment["CMAKE_PREFIX_PATH"] = f"{links}/installed"
        for name, text in files_of(lines).items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        os.symlink(options.python, os.path.join(links, "python3"))
        environment["PATH"] = f"{options.bin}:{links}:{os.environ['PATH']}"
        shell = subprocess.Popen(["bash", "--norc", "--noprofile"], cwd=folder, env=environment, stdin=subprocess.PIPE,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, encoding="utf-8")
        for command in commands:
            start = time.monotonic()
            shell.stdin.write(f"{{ {command.text}\n}} </dev/null 2>&1\nprintf '\\n%s %d\\n' {mark} $?\n")
            shell.stdin.flush()
            printed, code = [], None
            for line in shell.stdout:
                line = line.rstrip("\n").replace(folder, "…")
                if line.startswith(mark + " "):
                    code = int(line.split()[1])
                    break
                printed.append(line)
            if printed and printed[-1] == "":
                printed.pop()
            if options.times:
                print(f"{time.monotonic() - start:6.2f} s  {command.text.splitlines()[0]}")
            if code is None:
                raise SystemExit(f"{page}:{command.line + 1}: the shell ended")
            if code != command.exit:
                print(f"{page}:{command.line + 1}: exit code {code} and not {command.exit}: {command.text}", file=sys.stderr)
                failed += 1
            if not matches(command.output, printed):
                changes.append((command, printed))
                if not options.update:
                    failed += 1
                    print(f"{page}:{command.line + 1}: $ {command.text}", file=sys.stderr)
                    for line in difflib.unified_diff(command.output, printed, "the page", "the program", lineterm=""):
                        print(line, file=sys.stderr)
        shell.stdin.close()
        shell.wait()
    if options.update:
        for command, printed in reversed(changes):
            lines[command.first:command.last] = printed
        with open(page, "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
    print(f"{page}: {len(commands)} commands, " + (f"{failed} differ" if failed else "as the page shows"))
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True, type=os.path.abspath, help="folder of the program")
    parser.add_argument("--root", type=os.path.abspath, default=os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
    parser.add_argument("--build", type=os.path.abspath, help="build folder; that of --bin unless given")
    parser.add_argument("--python", default="/usr/bin/python3", help="the Python of the pages: that of the Python package")
    parser.add_argument("--update", action="store_true", help="write what was printed into the pages")
    parser.add_argument("--times", action="store_true", help="print how long each command took")
    parser.add_argument("pages", nargs="+")
    options = parser.parse_args()
    options.root = os.path.normpath(options.root)
    options.build = options.build or os.path.dirname(options.bin)
    return 1 if sum(run_page(page, options) for page in options.pages) else 0


if __name__ == "__main__":
    sys.exit(main())
