#!/usr/bin/env python3
"""Forces of a scene for poses of a topic of ROS 2, without its libraries (docs/trackers.md). Reads what
`ros2 topic echo --csv` prints, a pose a line, in the scene's frame; prints a force a line. Needs python3-asperity.

    PYTHONUNBUFFERED=1 ros2 topic echo --csv /stylus/pose | feel_csv.py plate/scene.json > forces.csv"""
import argparse
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "asperity_ros2"))
from asperity_ros2.csv_messages import WRENCH_COLUMNS, pose_of_line, wrench_line, wrench_yaml  # noqa: E402
from asperity_ros2.feel_stepper import FeelStepper, settings_of  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="a scene.json of `asperity paint` or `register`, or a mesh in metres")
    parser.add_argument("--rate", type=float, default=1000.0, metavar="HZ", help="of the poses, for the texture's filters (1000)")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a setting of the renderer, such as friction=0.2")
    parser.add_argument("--yaml", action="store_true", help="WrenchStamped as YAML for `ros2 topic pub --yaml-file`, instead of CSV")
    parser.add_argument("--header", action="store_true", help="names of the columns first")
    options = parser.parse_args()
    try:
        stepper = FeelStepper(options.scene, options.rate, settings_of(options.set))
    except ValueError as error:  # asperity.Error is one
        raise SystemExit(str(error)) from None
    if options.header and not options.yaml:
        print(WRENCH_COLUMNS)
    write = wrench_yaml if options.yaml else wrench_line
    poses = refused = 0
    try:
        for line in sys.stdin:
            pose = pose_of_line(line)
            if pose is None:
                refused += 1 if line.strip() else 0
                continue
            t_ns = time.monotonic_ns() if pose.t_ns is None else pose.t_ns
            print(write(t_ns, pose.frame_id, stepper.step(t_ns, pose.position_m)), flush=True)
            poses += 1
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # Python flushes it once more at the end
    print(f"{poses} poses" + (f", {refused} lines that were not poses" if refused else ""), file=sys.stderr)


if __name__ == "__main__":
    main()
