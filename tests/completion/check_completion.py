"""The values that a shell completes are those that the command takes: check_completion.py ASPERITY.

Of each option of each command, the answer to a value that cannot be (NONE) is the oracle: where it lists what there is, the shells
offer exactly that. And the program refuses no value that is offered. Shells that are not installed are left out, bash never.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

import shells

NONE = "zzz"
# What a command needs beside the option so that it looks at its value and then stops, mostly since a file is missing.
ARGUMENTS = {
    "area": "no/in -o out", "batch": "no.toml", "bench": "process --mesh no.obj", "calibrate camera": "no.png --board 8x5 --square 1mm --charuco",
    "demo": "--print-config", "export": "no.json -o out --to obj", "feel": "no.json", "import": "--pose no.csv -o out",
    "markers board": "-o no/x.pdf", "markers charuco": "-o no/x.pdf", "markers detect": "no.png",
    "markers ring": "-o no/x.pdf", "markers sheet": "-o no/x.pdf", "merge": "no -o out", "paint": "no.obj --through 0,0,0;1,1,1 --texture no.texture.json -o out",
    "plot": "no -o x.svg", "process": "no -o out", "realism": "no --stroke no", "record": "--probe file:no --uncalibrated --duration 1s -o out",
    "register": "no no.obj -o out", "roughness": "no.csv", "simulate": "--mesh no.obj --surface sine -o out", "studio": "no", "texture compare": "no no",
    "texture fit": "no.csv -o x.texture.json", "track": "no --camera no.json --markers no.json -o x.csv",
}
# Names of formats and such that are said in another way in the answer.
ALIASES = {"aruco:NAME": "aruco:", "aruco:FILE.yml": "aruco:"}
# Commands whose settings' values are compared, too.
SETTINGS = ("process", "register", "simulate", "texture fit")
# What only the studio has, as the answer says itself.
NOT_HERE = {("feel", "--device"): {"mouse"}}
# Lengths, addresses and comma lists beside which there are other values; these are offered.
OPEN = {
    "--mesh-unit": {"m", "cm", "mm", "um", "nm"},
    ("record", "--probe"): {"serial:", "usb:", "udp:", "file:"},
    ("record", "--camera"): {"v4l2:", "y4m:", "images:", "video:"},
    ("record", "--poses"): {"udp:", "pipe:", "file:"},
    ("register", "--placement"): {"auto", "same", "each"},
}


def options_of(manual):
    """{command: [names of each option that takes a value]}, of the manual page."""
    out, command = {}, ""
    for line in manual.replace("\\-", "-").splitlines():
        if line.startswith((".SS asperity ", ".SH ")):
            command = line.removeprefix(".SS asperity ") if line.startswith(".SS") else ""
            out.setdefault(command, [])
        elif heading := re.fullmatch(r"\\fB(-\S+)\\fR \\fI.*", line):
            out[command].append(heading[1].split(","))
    return out


def listed(answer):
    """The alternatives that a refusal lists, or nothing."""
    found = re.search(r"(?:is none of|is not one of|is neither|not in \{|unknown \w+ 'zzz':) ?(.*?)(?:\}|;|\n|$)", answer)
    if not found:
        return set()
    words = [word.strip(" '\"") for word in re.split(r",|\band\b|\bor\b|\bnor\b", found[1])]
    return {ALIASES.get(word, word) for word in words if word} - {"a file"}


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, folder

    def answer(self, command, option, value):
        words = [self.path, *command.split(), *ARGUMENTS.get(command, "").split()]
        if option in words:  # in the place of what ARGUMENTS has
            words[words.index(option) + 1] = value
        else:
            words += [option, value]
        run = subprocess.run(words, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
        return run.stderr if run.returncode else ""


def check(program, options, ask):
    """Faults; ask(lines) gives for each shell what it offers for each line."""
    cases = [(command, names) for command, all_names in options.items() for names in all_names]
    lines = [f"asperity {command} {names[-1]} ".replace("  ", " ") for command, names in cases]
    lines += [line[:-1] + "=" for line in lines]
    lines += [f"asperity {command} {names[0]} ".replace("  ", " ") for command, names in cases]
    by_shell = ask(lines)
    with_values = 0
    for i, (command, names) in enumerate(cases):
        option = names[-1]
        refusal = program.answer(command, option, NONE)
        wanted = listed(refusal) if NONE in refusal else set()
        wanted -= NOT_HERE.get((command, option), set())
        exact = OPEN.get((command, option), OPEN.get(option, set()))
        for shell, answers in by_shell.items():
            for k, form in enumerate(("", "=", "short")):
                got = answers[i + k * len(cases)]
                if exact and got != exact or wanted and not exact and got != wanted:
                    yield f"{shell}: {command} {option}{form}: offers {sorted(got)}, not {sorted(exact or wanted)}"
        got = by_shell["bash"][i]
        with_values += bool(got)
        for value in sorted(got):
            value += "5000" if value.endswith(":") else ""  # the rest of an address: a port, or a file that there is not
            if refusal and NONE in refusal and program.answer(command, option, value) == refusal.replace(NONE, value):
                yield f"{command} {option} {value}: is offered and refused: {refusal.strip()}"
    if with_values < 25:
        yield f"only {with_values} options have values"


def settings_of(program, command):
    """{key: value} of --print-config, whose TOML is the oracle."""
    run = subprocess.run([program.path, *command.split(), "--print-config"], check=True, stdout=subprocess.PIPE, text=True)
    flat = {}

    def add(before, table):
        for key, value in table.items():
            if isinstance(value, dict):
                add(before + key + ".", value)
            else:
                flat[before + key] = value

    add("", tomllib.loads(run.stdout))
    return flat


def check_settings(program, commands, ask):
    """Faults of --set: the keys of each command, and of those that are named in SETTINGS the values."""
    keys = {command: settings_of(program, command) for command in commands}
    forms = ("--set ", "--set=")
    lines = [f"asperity {command} {form}" for command in commands for form in forms]
    for shell, answers in ask(lines).items():
        for line, got in zip(lines, answers):
            command = next(c for c in commands if line.startswith(f"asperity {c} --"))
            wanted = {key + "=" for key in keys[command]}
            if wanted and got != wanted:
                yield f"{shell}: '{line}' offers {len(got)} keys, not the {len(wanted)} of --print-config: {sorted(got ^ wanted)[:5]}"
    with_values = 0
    for command in SETTINGS:
        # Of the numbers, which have no values, every tenth.
        asked = [key for i, key in enumerate(keys[command]) if isinstance(keys[command][key], (bool, str)) or i % 10 == 0]
        lines = [f"asperity {command} {form}{key}=" for key in asked for form in forms]
        by_shell = ask(lines)
        for i, key in enumerate(asked):
            is_switch = isinstance(keys[command][key], bool)
            refusal = "" if is_switch or not isinstance(keys[command][key], str) else program.answer(command, "--set", f"{key}={NONE}")
            wanted = {"true", "false"} if is_switch else listed(refusal) if NONE in refusal else set()
            with_values += bool(wanted)
            for shell, answers in by_shell.items():
                for got in answers[2 * i : 2 * i + 2]:
                    if got != wanted:
                        yield f"{shell}: {command} --set {key}= offers {sorted(got)}, not {sorted(wanted)}"
    if with_values < 40:
        yield f"only {with_values} settings have values"
    for shell, answers in ask(["asperity process --set=method=fu", "asperity process --set profile.remove_noise=f"]).items():
        if answers != [{"fused"}, {"false"}]:
            yield f"{shell}: parts of a value: {answers}"


def main():
    asperity = pathlib.Path(sys.argv[1]).resolve()
    installed = [shell for shell in ("bash", "zsh", "fish") if shutil.which(shell)]
    with tempfile.TemporaryDirectory() as folder:
        scripts = {}
        for shell in installed:
            scripts[shell] = pathlib.Path(folder) / f"completion.{shell}"
            scripts[shell].write_text(subprocess.run([asperity, "--completion", shell], check=True, stdout=subprocess.PIPE, text=True).stdout)
        manual = subprocess.run([asperity, "--man"], check=True, stdout=subprocess.PIPE, text=True).stdout
        work = pathlib.Path(folder) / "work"
        work.mkdir()
        ask = lambda lines: {shell: shells.offered(shell, scripts[shell], lines) for shell in installed}
        program, options = Program(asperity, work), options_of(manual)
        faults = list(check(program, options, ask))
        faults += check_settings(program, [command for command, names in options.items() if command and ["--set"] in names], ask)
        # A part of a value, and what is no value: commands and files.
        for line, expected in {"asperity export x --to sd": {"sdf", "sdf-binary"}, "asperity texture fi": {"fit"},
                               "asperity feel --device=repl": {"replay"}, "asperity bench rend": {"render"}, "asperity process --method -": None}.items():
            for shell, answers in ask([line]).items():
                if expected is not None and answers[0] != expected:
                    faults.append(f"{shell}: '{line}' offers {sorted(answers[0])}, not {sorted(expected)}")
    for fault in faults:
        print(fault)
    if not faults:
        print("as the program takes them, in " + ", ".join(installed))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
