"""What the packages bring beside programs: manual pages of all of them, and udev rules that open no more than they should.

    check_packaging.py SOURCE MANUALS     MANUALS has the pages that CMake wrote
"""

import fnmatch
import pathlib
import re
import subprocess
import sys

# Properties of devices as udev has them. KERNELS of a HID device is BUS:VENDOR:PRODUCT.NUMBER, in capitals (Linux, hid-core.c:
# hid_add_device), 0003 for USB and 0005 for Bluetooth.
DEVICES = {
    "DualSense, USB": ({"SUBSYSTEM": "hidraw", "KERNEL": "hidraw0", "KERNELS": "0003:054C:0CE6.0001"}, True),
    "DualShock 4, Bluetooth": ({"SUBSYSTEM": "hidraw", "KERNEL": "hidraw1", "KERNELS": "0005:054C:09CC.0012"}, True),
    "Switch Pro, Bluetooth": ({"SUBSYSTEM": "hidraw", "KERNEL": "hidraw2", "KERNELS": "0005:057E:2009.0003"}, True),
    "keyboard's hidraw": ({"SUBSYSTEM": "hidraw", "KERNEL": "hidraw3", "KERNELS": "0003:046D:C31C.0002"}, False),
    "security key": ({"SUBSYSTEM": "hidraw", "KERNEL": "hidraw4", "KERNELS": "0003:1050:0407.0002"}, False),
    "Sony camera's hidraw": ({"SUBSYSTEM": "hidraw", "KERNEL": "hidraw5", "KERNELS": "0003:054C:0994.0002"}, False),
    "pad's events": ({"SUBSYSTEM": "input", "KERNEL": "event17", "ENV{ID_INPUT_JOYSTICK}": "1"}, True),
    "keyboard's events": ({"SUBSYSTEM": "input", "KERNEL": "event3", "ENV{ID_INPUT_KEYBOARD}": "1"}, False),
    "probe's board": ({"SUBSYSTEM": "tty", "KERNEL": "ttyACM0"}, True),
    "another bridge": ({"SUBSYSTEM": "tty", "KERNEL": "ttyUSB0", "ATTRS{idVendor}": "067b", "ATTRS{idProduct}": "2303"}, False),
    "console": ({"SUBSYSTEM": "tty", "KERNEL": "tty1"}, False),
    "disk": ({"SUBSYSTEM": "block", "KERNEL": "sda"}, False),
}


def rules_of(text):
    """[(matches, assignments)]; a line that is not a rule is a fault."""
    for line in text.splitlines():
        if line and not line.startswith("#"):
            parts = [re.fullmatch(r'\s*([A-Z]+(?:\{\w+\})?)(==|\+=|=)"([^"]*)"\s*', part) for part in line.split(",")]
            if None in parts:
                raise ValueError(line)
            yield {p[1]: p[3] for p in parts if p[2] == "=="}, [p[1] + p[2] + p[3] for p in parts if p[2] != "=="]


def check_rules(text):
    rules = list(rules_of(text))
    for matches, assignments in rules:
        if assignments != ["TAG+=uaccess"]:
            yield f"udev: {assignments}: only the tag uaccess is given"
        if matches.get("SUBSYSTEM") == "hidraw" and not re.fullmatch(r"\*:[0-9A-F]{4}:[0-9A-F]{4}\.\*", matches.get("KERNELS", "")):
            yield f"udev: {matches}: a hidraw rule names one vendor and one product"
    for name, (device, opened) in DEVICES.items():
        given = any(all(fnmatch.fnmatchcase(device.get(key, ""), pattern) for key, pattern in matches.items()) for matches, _ in rules)
        if given != opened:
            yield f"udev: {name}: {'opened' if given else 'not opened'}"


def check_manuals(source, manuals):
    own = [name for file in source.glob("modules/*/CMakeLists.txt") for name in re.findall(r"add_own_program\((\w+)", file.read_text())]
    if not own:
        yield "no program of add_own_program() was found"
    for name in own:  # that of asperity itself is tested with the command line
        page = manuals / f"{name}.1"
        if not page.is_file():
            yield f"{name}: packaging/{name}.1.in is missing"
            continue
        text = page.read_text()
        for section in ("NAME", "SYNOPSIS", "DESCRIPTION", "EXAMPLES", "EXIT STATUS"):
            if f"\n.SH {section}\n" not in text:
                yield f"{page}: no section {section}"
        # Each exit code of main() and its thread.
        main = next(source.glob(f"modules/*/*/{name}.cc")).read_text()
        for code in set(re.findall(r"(?:return|_exit\() ?(\d)\b", main[main.index("void watch") :])):
            if f"\n.TP\n{code}\n" not in text:
                yield f"{page}: the exit code {code} is missing"
        if "@" in text.replace("@example", ""):
            yield f"{page}: a variable was not replaced"
        groff = subprocess.run(["man", "--warnings", "-l", page], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if groff.returncode or groff.stderr:
            yield f"{page}: {groff.stderr}"


def main():
    source, manuals = (pathlib.Path(argument) for argument in sys.argv[1:3])
    faults = [*check_rules((source / "packaging/70-asperity.rules").read_text()), *check_manuals(source, manuals)]
    # The check sees what it should: a rule for all hidraw files.
    if not list(check_rules('SUBSYSTEM=="hidraw", TAG+="uaccess"\n')) or not list(check_rules('KERNEL=="ttyACM0", MODE="0666"\n')):
        faults.append("the check of the rules sees nothing")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
