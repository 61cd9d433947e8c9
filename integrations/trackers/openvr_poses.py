#!/usr/bin/env python3
"""Poses of a tracker or controller of SteamVR as lines for `asperity record --poses` (docs/trackers.md). Needs the
Python package openvr; without SERIAL it lists the devices.

    openvr_poses.py LHR-1A2B3C4D --y-up --udp 127.0.0.1:9001
    asperity record --poses udp:9001 --world z_up …"""
import argparse
import math
import time

import pose_lines


def quaternion(m):
    """x, y, z, w of the rotation in the first three columns of a matrix (Shepperd's method)."""
    trace = m[0][0] + m[1][1] + m[2][2]
    largest = max(range(4), key=lambda i: trace if i == 3 else m[i][i])
    if largest == 3:
        q = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 1.0 + trace]
    else:
        i, j, k = largest, (largest + 1) % 3, (largest + 2) % 3
        q = [0.0] * 4
        q[i] = 1.0 + m[i][i] - m[j][j] - m[k][k]
        q[j] = m[j][i] + m[i][j]
        q[k] = m[k][i] + m[i][k]
        q[3] = m[k][j] - m[j][k]
    norm = math.sqrt(sum(value * value for value in q))
    return [value / norm for value in q]


def serials(openvr, system):
    """{serial: index} of the devices that are connected."""
    return {system.getStringTrackedDeviceProperty(i, openvr.Prop_SerialNumber_String): i
            for i in range(openvr.k_unMaxTrackedDeviceCount) if system.isTrackedDeviceConnected(i)}


def send_poses(openvr, system, index, rate_hz, output, count=None):
    """Asks for the pose at a rate; a pose that is the last one again is not a new one, and is left out."""
    poses = (openvr.TrackedDevicePose_t * openvr.k_unMaxTrackedDeviceCount)()
    last, due = None, time.monotonic()
    while count is None or output.sent < count:
        system.getDeviceToAbsoluteTrackingPose(openvr.TrackingUniverseStanding, 0.0, poses)
        t_ns = time.monotonic_ns()
        pose = poses[index]
        m = [list(row) for row in pose.mDeviceToAbsoluteTracking.m]
        if pose.bPoseIsValid and pose.eTrackingResult == openvr.TrackingResult_Running_OK and m != last:
            last = m
            output.write(t_ns, [row[3] for row in m], quaternion(m))
        due = max(due + 1.0 / rate_hz, time.monotonic())
        time.sleep(max(0.0, due - time.monotonic()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("serial", nargs="?", help="serial number of the device")
    parser.add_argument("--rate", type=float, default=250.0, metavar="HZ", help="how often SteamVR is asked (250)")
    pose_lines.add_options(parser)
    options = parser.parse_args()
    if not options.rate > 0:
        parser.error("--rate must be above 0")
    try:
        import openvr
    except ImportError:
        raise SystemExit("the Python package openvr is missing: pip install openvr") from None
    openvr.init(openvr.VRApplication_Other)
    try:
        system = openvr.VRSystem()
        devices = serials(openvr, system)
        if options.serial not in devices:
            wrong = f"no device has the serial '{options.serial}'; " if options.serial else ""
            raise SystemExit(wrong + "connected: " + (", ".join(sorted(devices)) or "none"))
        pose_lines.run(options, lambda output: send_poses(openvr, system, devices[options.serial], options.rate, output))
    finally:
        openvr.shutdown()


if __name__ == "__main__":
    main()
