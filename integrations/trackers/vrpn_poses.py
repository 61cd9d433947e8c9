#!/usr/bin/env python3
"""Poses of a VRPN server as lines for `asperity record --poses` (docs/trackers.md). Needs Python 3 alone.

    vrpn_poses.py Tracker0@192.168.1.5 --udp 127.0.0.1:9001
    asperity record --poses udp:9001 …"""
import argparse
import socket
import struct

import pose_lines

PORT = 3883
COOKIE = b"vrpn: ver. 07.35  0".ljust(24, b"\0")  # the version, and that nothing be logged
HEADER = struct.Struct(">3I2i4x")                 # length with this header, s, µs, sender, type; the number is not read
POSE = struct.Struct(">2i3d4d")                   # sensor, padding, position in m, quaternion x y z w
SENDER_NAME, TYPE_NAME = -1, -2                   # messages that name a number
LONGEST = 64000                                   # of a message, as VRPN's own


def name_in(payload):
    if len(payload) < 4:
        return ""
    length = struct.unpack(">I", payload[:4])[0]
    return payload[4:4 + length].split(b"\0")[0].decode("utf-8", "replace")


def poses(read, device, sensor):
    """(t_ns, position, quaternion) of one sensor of a device. `read(count)` gives that many bytes, or EOFError."""
    cookie = read(len(COOKIE))
    if not cookie.startswith(b"vrpn: ver. 07."):
        raise SystemExit(f"the server is not VRPN 7: it began with {cookie[:16]!r}")
    senders, types = {}, {}
    while True:
        length, seconds, microseconds, sender, kind = HEADER.unpack(read(HEADER.size))
        if not HEADER.size <= length <= LONGEST:
            raise SystemExit(f"the server sent a message of {length} bytes")
        size = length - HEADER.size
        payload = read(size + -size % 8)[:size]
        if kind == SENDER_NAME:
            senders[sender] = name_in(payload)
        elif kind == TYPE_NAME:
            types[sender] = name_in(payload)
        elif types.get(kind) == "vrpn_Tracker Pos_Quat" and senders.get(sender) == device and size == POSE.size:
            values = POSE.unpack(payload)
            if values[0] == sensor:
                yield (seconds * 1_000_000 + microseconds) * 1000, values[2:5], values[5:9]


def reader(connection):
    stream = connection.makefile("rb")

    def read(count):
        data = stream.read(count)
        if len(data) < count:
            raise EOFError
        return data
    return read


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("device", metavar="DEVICE@HOST[:PORT]", help="name of the tracker at the server; the port is 3883 unless given")
    parser.add_argument("--sensor", type=int, default=0, help="number of the sensor (0)")
    pose_lines.add_options(parser)
    options = parser.parse_args()
    device, at, address = options.device.partition("@")
    if not at or not device:
        parser.error(f"'{options.device}' is not DEVICE@HOST")

    def send(output):
        with socket.create_connection(pose_lines.host_port(address, PORT), timeout=5.0) as connection:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            connection.sendall(COOKIE)
            connection.settimeout(None)
            try:
                for pose in poses(reader(connection), device, options.sensor):
                    output.write(*pose)
            except EOFError:
                raise SystemExit("the server has closed the connection") from None

    pose_lines.run(options, send)


if __name__ == "__main__":
    main()
