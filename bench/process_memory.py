#!/usr/bin/env python3
"""Memory at the peak and processor time of `asperity process` over the length of the recording.

    bench/process_memory.py build/release/bin/asperity [OTHER_PROGRAM ...] [--strokes 18,36,72] [--repeats 3]

Simulates sandpaper scanned back and forth with the open probe (4 kHz), a minute for 17 strokes, and processes each
recording with every program in turn, with the truth that a simulation knows and without it, as of a real probe.
Prints the medians: samples, MB, bytes a sample, s of processor time (user). The last line of each is what one more
sample takes, between the two longest recordings.
"""
import argparse, os, pathlib, shutil, statistics, subprocess, tempfile


def process(program, recording, output):
    """Peak memory in bytes and processor time in s of one run."""
    shutil.rmtree(output, ignore_errors=True)
    child = subprocess.Popen([program, "process", str(recording), "-o", str(output), "--quiet"],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if os.waitstatus_to_exitcode(status) not in (0, 3):  # 3: measured, and a verdict is invalid
        raise SystemExit(f"{program} process {recording}: exit code {os.waitstatus_to_exitcode(status)}")
    return used.ru_maxrss * 1024, used.ru_utime


def sample_count(recording):
    with open(recording / "probe.csv", "rb") as file:
        return sum(1 for _ in file) - 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--strokes", default="18,36,72")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        recordings = []
        for strokes in options.strokes.split(","):
            recording = place / strokes
            subprocess.run([options.programs[0], "simulate", "--quiet", "--surface", "sandpaper", "--probe", "open",
                            "--speed", "25mm/s", "--seed", "1", "--set", "hand.path=back_and_forth",
                            "--set", f"hand.strokes={strokes}", "-o", str(recording)], check=True)
            recordings.append(recording)
        for truth in ("with", "without"):
            rows = {program: [] for program in options.programs}
            for recording in recordings:
                if truth == "without":
                    (recording / "truth.csv").unlink()
                samples = sample_count(recording)
                runs = {program: [] for program in options.programs}
                for _ in range(options.repeats):
                    for program in options.programs:
                        runs[program].append(process(program, recording, place / "out"))
                for program, each in runs.items():
                    rows[program].append((samples, statistics.median(memory for memory, _ in each),
                                          statistics.median(time for _, time in each)))
            for program, of_program in rows.items():
                print(f"{program}, {truth} truth")
                for samples, memory, time in of_program:
                    print(f"  {samples:9d} samples  {memory / 1e6:7.0f} MB  {memory / samples:5.0f} B/sample  {time:6.2f} s")
                if len(of_program) > 1:
                    (fewer, less, _), (samples, memory, _) = of_program[-2:]
                    print(f"  a further sample takes {(memory - less) / (samples - fewer):.0f} B")


if __name__ == "__main__":
    main()
