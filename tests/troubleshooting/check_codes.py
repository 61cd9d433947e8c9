#!/usr/bin/env python3
"""docs/troubleshooting.md has a row with an anchor for each verdict code, with its severity, and for each exit code, and no
other; the messages that it quotes are texts of the sources; each code is in one table of docs/verdicts-*.md, which state how
it is decided: check_codes.py SOURCE. The codes are those of
modules/verdict/src/verdict_codes.cc, the exit codes those of the table of docs/command-line.md."""
import os
import re
import sys


def read(*path):
    with open(os.path.join(sys.argv[1], *path), encoding="utf-8") as file:
        return file.read()


codes = {f"{code} {severity.lower()}"
         for code, severity in re.findall(r'\{"([a-z_]+)",\s*k(Invalid|Limited|Note),', read("modules", "verdict", "src", "verdict_codes.cc"))}
page = read("docs", "troubleshooting.md")
rows = {f"{code} {severity}" for anchor, code, severity in re.findall(r'^\| <a id="([a-z_]+)"></a>`([a-z_]+)` \| (\w+) \| \S', page, re.M)
        if anchor == code}
table = read("docs", "command-line.md").split("\n## Exit codes\n")[1].split("\n## ")[0]
details = [f"{code} {severity}" for name in sorted(os.listdir(os.path.join(sys.argv[1], "docs"))) if re.fullmatch(r"verdicts-.*\.md", name)
           for code, severity in re.findall(r"^\| `([a-z_]+)` \| (invalid|limited|note) \| \S", read("docs", name), re.M)]
exits = {number for cell in re.findall(r"^\| ([\d, ]+) \|", table, re.M) for number in re.findall(r"\d+", cell)}
page_exits = {number for cell in re.findall(r'^\| <a id="exit-\d+"></a>([\d, ]+) \|', page, re.M) for number in re.findall(r"\d+", cell)}
faults = [f"not in docs/troubleshooting.md: {code}" for code in sorted(codes - rows)]
faults += [f"in docs/troubleshooting.md, but not a code: {row}" for row in sorted(rows - codes)]
faults += [f"in docs/verdicts-*.md {details.count(code)} times: {code}" for code in sorted(codes | set(details))
           if details.count(code) != (code in codes)]
faults += [f"exit code {code} is on one page only" for code in sorted(exits ^ page_exits)]
sources = "".join(re.sub(r'"\s*\n\s*"', "", read(os.path.relpath(os.path.join(folder, name), sys.argv[1])))
                  for top in ("modules", "apps") for folder, _, names in os.walk(os.path.join(sys.argv[1], top))
                  for name in names if name.endswith(".cc"))
messages = re.findall(r"^\| `([^`]+)` \|", page.split("\n## Errors that occur often\n")[1].split("\n## ")[0], re.M)
faults += [f"no source has the message '{message}'" for message in messages if message not in sources]
if not messages:
    faults.append("no messages are quoted")
if not codes or not exits:
    faults.append("no codes were found in the sources")
for fault in faults:
    print("troubleshooting:", fault, file=sys.stderr)
sys.exit(1 if faults else 0)
