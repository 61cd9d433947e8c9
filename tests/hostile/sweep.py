#!/usr/bin/env python3
"""Absurd values in every file that the program reads: each scalar is replaced, and the command that reads it is run.

    sweep.py PROGRAM SOURCE [--sample N] [--skip N] [--only WORD] [--each N] [--jobs N] [--list FILE]

The program must end within 20 s of the processor and 4 GiB without a signal. What it prints must hold no control character and no
name of a library's exception; at exit 0 and 3 no nan or inf, neither in what is printed nor in the JSON that it wrote.
A refusal names the file. Figures that are finite and huge at exit 0 are listed and are no fault. --sample takes N of all
cases by a fixed seed, beside those that once failed (failed.txt); --skip leaves out the first N of these, which an
interrupted run has done.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile

import inputs
import mutations

TIME_S, MEMORY = 20, 4 << 30  # of the processor: on a busy machine a run lasts longer
LONGEST_S = 300
EXCEPTIONS = re.compile(r"json\.exception|std::|\bstoi\b|\bstod\b|bad_alloc|\[toml|Eigen::|what\(\)|\bcv::|OpenCV|_M_|vector::|"
                        r"basic_string|CLI::|boost::|terminate called|Assertion|tinygltf|pugi")
NOT_FINITE = re.compile(r"(?<![A-Za-z_/.\-'\"])[-+±]?(nan|inf|infinity)(?![A-Za-z_])", re.IGNORECASE)
HUGE = re.compile(r"\d[eE]\+?(\d{2,3})|(?<![.\d])\d{16,}")
CHECKSUM = re.compile(r"(?<![0-9a-z])(?=[0-9]*[a-f])[0-9a-f]{64,}(?![0-9a-z])")
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff]")


def texts_below(path):
    for found in [path, path + ".html", path + ".csv", path + ".texture.json"]:
        if os.path.isdir(found):
            for folder, _, files in os.walk(found):
                yield from (os.path.join(folder, name) for name in files if name.endswith(".json"))
        elif found.endswith(".json") and os.path.isfile(found):
            yield found


def faults_of(reader, program, root, text):
    """What is wrong with the way in which `reader` takes `text`; (kind, words) pairs, and the exit code."""
    with tempfile.TemporaryDirectory(prefix="hostile-") as work:
        shutil.copytree(reader.folder, f"{work}/in")
        with open(f"{work}/in/{reader.file}", "w", encoding="utf-8", newline="") as file:
            file.write(text)
        words = [w.replace("#", f"{work}/in").replace("@", root).replace("%", f"{work}/out") for w in reader.words]
        try:
            done = subprocess.run(["prlimit", f"--as={MEMORY}", f"--cpu={TIME_S}", "--core=0", program, *words], capture_output=True, timeout=LONGEST_S,
                                  stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return [("time", f"more than {LONGEST_S} s")], None
        code, faults = done.returncode, []
        try:
            out, err = done.stdout.decode(), done.stderr.decode()
        except UnicodeDecodeError:
            out, err = done.stdout.decode("latin-1"), done.stderr.decode("latin-1")
            faults.append(("bytes", "what is printed is not UTF-8"))
        both = out + err
        if code == -signal.SIGXCPU:
            faults.append(("time", f"more than {TIME_S} s of the processor"))
        elif code < 0 or code >= 128:
            faults.append(("crash", f"{code}: {err[:300]}"))
        for found in CONTROL.finditer(both):
            faults.append(("control", repr(both[max(0, found.start() - 40):found.end() + 20])))
            break
        plain = both.replace(work, "").replace(root, "")
        for found in EXCEPTIONS.finditer(plain):
            faults.append(("library", plain[max(0, found.start() - 80):found.end() + 80]))
            break
        if "not enough memory" in err:
            faults.append(("memory", err[:200]))
        if code in (0, 3):
            for found in NOT_FINITE.finditer(out):
                faults.append(("finite", repr(out[max(0, found.start() - 60):found.end() + 20])))
                break
            if "--json" in words:
                try:
                    json.loads(out)
                except ValueError as error:
                    faults.append(("json", f"what is printed is not JSON: {error}"))
            for path in texts_below(f"{work}/out"):
                with open(path, encoding="utf-8") as file:
                    found = NOT_FINITE.search(file.read())
                if found:
                    faults.append(("finite", f"in {os.path.basename(path)}"))
            for found in HUGE.finditer(CHECKSUM.sub("", out.replace(work, ""))):
                if found.group(1) is None or int(found.group(1)) > 15:
                    faults.append(("huge", repr(out[max(0, found.start() - 60):found.end() + 20])))
                    break
        elif code == 1 and reader.file not in err and f"{work}/in" not in err:
            faults.append(("unnamed", err[:300]))
        elif code not in (0, 1, 3) and code >= 0:
            faults.append(("code", f"{code}: {err[:200]}"))
        return faults, code


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("source")
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--skip", type=int, default=0)
    parser.add_argument("--only", default="")
    parser.add_argument("--each", type=int, default=2)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list")
    asked = parser.parse_args()
    program = os.path.abspath(asked.program)
    # Many short runs: the pools of the linear algebra are not wanted in each.
    os.environ["OMP_NUM_THREADS"] = "1"
    with tempfile.TemporaryDirectory(prefix="hostile-inputs-") as root:
        cases = []
        for reader in inputs.make(program, os.path.abspath(asked.source), root):
            if asked.only not in reader.name:
                continue
            with open(f"{reader.folder}/{reader.file}", encoding="utf-8") as file:
                text = file.read()
            cases += [(reader, what, new) for what, new in mutations.mutations(text, reader.is_json, asked.each, reader.is_first)]
        total = len(cases)
        random.Random(1).shuffle(cases)
        if asked.sample:
            known = open(os.path.join(os.path.dirname(__file__), "failed.txt"), encoding="utf-8").read().splitlines()
            chosen = [c for c in cases if f"{c[0].name}: {c[1]}" in known]
            cases = chosen + cases[:asked.sample]
        cases = cases[asked.skip:]
        kept = open(asked.list, "w", encoding="utf-8") if asked.list else None
        counts, kinds, lines = collections.Counter(), collections.Counter(), []
        with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
            running = {pool.submit(lambda case: faults_of(case[0], program, root, case[2]()), case): case[:2] for case in cases}
            for done in concurrent.futures.as_completed(running):
                reader, what = running[done]
                faults, code = done.result()
                counts[code] += 1
                for kind, words in faults:
                    kinds[kind] += 1
                    lines.append(f"{kind}\t{reader.name}: {what}\t{words}")
                    if kept:
                        print(lines[-1].replace("\n", " | "), file=kept, flush=True)
                if kept and sum(counts.values()) % 100 == 0:
                    print(f"done\t{sum(counts.values())} of {len(cases)}", file=kept, flush=True)
        lines.sort()
        for line in lines[:40]:
            print(line.encode("unicode_escape").decode())
        codes = ", ".join(f"{n} ended with {code}" for code, n in sorted(counts.items(), key=lambda item: str(item[0])))
        print(f"{sum(counts.values())} of {total} absurd files: {codes}; {len(lines)} faults {dict(kinds)}")
        return 1 if any(kind != "huge" for kind in kinds) else 0


if __name__ == "__main__":
    sys.exit(main())
