#!/usr/bin/env python3
"""Poses of a rigid body of OptiTrack's Motive (NatNet 3.0 to 4.2) as lines for `asperity record --poses`
(docs/trackers.md). Needs Python 3 alone.

    natnet_poses.py 192.168.1.5 --id 1 --y-up --udp 127.0.0.1:9001
    asperity record --poses udp:9001 --world z_up …"""
import argparse
import select
import socket
import struct
import time

import pose_lines

COMMAND_PORT, DATA_PORT, GROUP = 1510, 1511, "239.255.42.99"
CONNECT, SERVER, FRAME, KEEP_ALIVE = 0, 1, 7, 10
BODY = struct.Struct("<i3f4ffh")  # id, position in m, quaternion x y z w, mean error of the markers, bit 0: tracked


class Packet:
    """The bytes of a message, read from its beginning; struct.error where they end too early."""

    def __init__(self, data):
        self._data, self._at = data, 0

    def read(self, layout):
        values = layout.unpack_from(self._data, self._at)
        self._at += layout.size
        return values

    def number(self):
        return self.read(struct.Struct("<i"))[0]

    def count(self):
        count = self.number()
        if count < 0:
            raise struct.error(f"a count of {count}")
        return count

    def skip(self, size):
        if self._at + size > len(self._data):
            raise struct.error("the message ends too early")
        self._at += size

    def skip_name(self):
        end = self._data.find(b"\0", self._at)
        if end < 0:
            raise struct.error("a name does not end")
        self._at = end + 1


def message(data):
    """Number of a message and its content."""
    kind, size = struct.unpack_from("<HH", data)
    if len(data) < 4 + size:
        raise struct.error("the message ends too early")
    return kind, data[4:4 + size]


def version_of(server):
    """NatNet's version in a server's answer: behind 256 bytes of its name and the program's own version."""
    return struct.unpack_from("<2B", server, 260)


def skip_channels(packet):
    """Force plates or other devices: channels of values."""
    packet.skip(4)
    for _ in range(packet.count()):
        packet.skip(4 * packet.count())


def frame(data, version):
    """Seconds of Motive's clock, and {id: (position, quaternion)} of the rigid bodies that are tracked."""
    packet = Packet(data)
    sized = version >= (4, 1)  # each section then has its length in bytes behind its count

    def section(skip_one):
        count = packet.count()
        if sized:
            packet.skip(packet.count())
        else:
            for _ in range(count):
                skip_one()

    def skip_marker_set():
        packet.skip_name()
        packet.skip(12 * packet.count())

    def skip_skeleton():
        packet.skip(4)
        packet.skip(BODY.size * packet.count())

    packet.skip(4)                        # the frame's number
    section(skip_marker_set)
    section(lambda: packet.skip(12))      # markers without a name
    bodies = {}
    count = packet.count()
    if sized:
        packet.skip(4)
    for _ in range(count):
        body = packet.read(BODY)
        if body[9] & 1:
            bodies[body[0]] = body[1:4], body[4:8]
    section(skip_skeleton)
    if sized:
        section(None)                     # assets
    section(lambda: packet.skip(26))      # markers: id, position, size, parameters, residual
    section(lambda: skip_channels(packet))
    section(lambda: skip_channels(packet))
    packet.skip(8)                        # timecode
    return packet.read(struct.Struct("<d"))[0], bodies


def request(kind):
    text = b"Ping\0" if kind == CONNECT else b"\0"
    return struct.pack("<HH", kind, len(text)) + text


def open_sockets(multicast, local):
    """The socket of the commands, to which a unicast server also sends its frames; and that of a multicast group."""
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM)]
    sockets[0].bind((local, 0))
    if multicast:
        group = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        group.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        group.bind(("", DATA_PORT))
        group.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(GROUP) + socket.inet_aton(local))
        sockets.append(group)
    return sockets


def frames(sockets, server, answer_s=5.0):
    """(seconds, bodies) of each frame that arrives; asks the server for its version and that it goes on sending."""
    version, begin, asked = None, time.monotonic(), 0.0
    while True:
        now = time.monotonic()
        if now - asked > 1.0:
            sockets[0].sendto(request(KEEP_ALIVE if version else CONNECT), server)
            asked = now
        if version is None and now - begin > answer_s:
            raise SystemExit(f"no answer from {server[0]}:{server[1]} within {answer_s:.0f} s")
        for ready in select.select(sockets, [], [], 0.2)[0]:
            data = ready.recv(65536)
            try:
                kind, content = message(data)
                if kind == SERVER:
                    version = version_of(content)
                    if version < (3, 0):
                        raise SystemExit(f"the server has NatNet {version[0]}.{version[1]}; 3.0 or later is needed")
                elif kind == FRAME and version:
                    yield frame(content, version)
            except struct.error as error:
                raise SystemExit(f"a message that is not NatNet {version}: {error}") from None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("server", metavar="HOST[:PORT]", help="where Motive runs; the port of its commands is 1510 unless given")
    parser.add_argument("--id", type=int, required=True, help="streaming ID of the rigid body in Motive")
    parser.add_argument("--multicast", action="store_true", help="Motive sends to the group 239.255.42.99; else unicast")
    parser.add_argument("--local", default="0.0.0.0", metavar="ADDRESS", help="address of this machine's network card, if it has several")
    pose_lines.add_options(parser)
    options = parser.parse_args()
    server = pose_lines.host_port(options.server, COMMAND_PORT)

    def send(output):
        for seconds, bodies in frames(open_sockets(options.multicast, options.local), server):
            if options.id in bodies:
                output.write(round(seconds * 1e9), *bodies[options.id])

    pose_lines.run(options, send)


if __name__ == "__main__":
    main()
