#!/usr/bin/env python3
"""Poses of a topic of ROS 2 as lines for `asperity record --poses` (docs/trackers.md). Needs Python 3 alone; reads what
`ros2 topic echo --csv` prints.

    PYTHONUNBUFFERED=1 ros2 topic echo --csv /probe/pose | ros2_poses.py --udp 127.0.0.1:9001
    asperity record --poses udp:9001 …"""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../ros2/asperity_ros2"))
import pose_lines  # noqa: E402
from asperity_ros2.csv_messages import pose_of_line  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    pose_lines.add_options(parser)

    def send(output):
        for line in sys.stdin:
            pose = pose_of_line(line)
            if pose:
                output.write(pose.t_ns, pose.position_m, pose.xyzw)
            elif line.strip():
                output.refused += 1

    pose_lines.run(parser.parse_args(), send)


if __name__ == "__main__":
    main()
