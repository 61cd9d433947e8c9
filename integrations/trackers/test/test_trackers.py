"""The converters of poses, against packets written here from the public descriptions of the protocols, and the recorder."""
import csv
import io
import math
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import types

import pytest

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER = os.path.dirname(HERE)
sys.path.insert(0, FOLDER)
import natnet_poses  # noqa: E402
import openvr_poses  # noqa: E402
import pose_lines  # noqa: E402
import vrpn_poses  # noqa: E402

TURN = (0.1, -0.2, 0.3, math.sqrt(1.0 - 0.14))  # x, y, z, w


def udp_socket():
    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    out.bind(("127.0.0.1", 0))
    out.settimeout(20.0)
    return out


def converter(name, *arguments):
    return subprocess.Popen([sys.executable, os.path.join(FOLDER, name), *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def cells(line):
    return [float(cell) if cell else None for cell in line.strip().split(",")]


# --- VRPN: every message is a header of 24 bytes, big-endian, and a body filled up to 8 ---

def vrpn_message(kind, sender, body, seconds=7, microseconds=250000):
    header = struct.pack(">IIIiiI", 24 + len(body), seconds, microseconds, sender, kind, 0)
    return header + body + bytes(-len(body) % 8)


def vrpn_name(text):
    return struct.pack(">I", len(text) + 1) + text.encode() + b"\0"


def vrpn_pose(position_m, xyzw, sensor=0):
    return struct.pack(">ii3d4d", sensor, sensor, *position_m, *xyzw)


def vrpn_stream():
    """Names of two senders and types, velocities, another sensor and another tracker among the poses."""
    out = b"vrpn: ver. 07.36  0".ljust(24, b"\0")
    out += vrpn_message(-1, 3, vrpn_name("Wand")) + vrpn_message(-1, 4, vrpn_name("Probe"))
    out += vrpn_message(-2, 11, vrpn_name("vrpn_Tracker Velocity")) + vrpn_message(-2, 12, vrpn_name("vrpn_Tracker Pos_Quat"))
    out += vrpn_message(12, 3, vrpn_pose((9, 9, 9), TURN)) + vrpn_message(11, 4, bytes(72)) + vrpn_message(12, 4, vrpn_pose((8, 8, 8), TURN, 1))
    out += vrpn_message(-3, 5, b"odd")  # no multiple of 8
    return out + vrpn_message(12, 4, vrpn_pose((1.0, 2.0, 3.0), TURN))


def test_vrpn_gives_the_named_sensor():
    stream = io.BytesIO(vrpn_stream())

    def read(count):
        data = stream.read(count)
        if len(data) < count:
            raise EOFError
        return data
    found = []
    with pytest.raises(EOFError):
        for pose in vrpn_poses.poses(read, "Probe", 0):
            found.append(pose)
    assert found == [(7_250_000_000, (1.0, 2.0, 3.0), TURN)]


@pytest.mark.parametrize("data", [b"HTTP/1.1 400 Bad Request", b"vrpn: ver. 07.35  0".ljust(24, b"\0") + struct.pack(">IIIiiI", 5, 0, 0, 0, 0, 0)])
def test_what_is_not_vrpn_is_an_error(data):
    with pytest.raises(SystemExit):
        next(vrpn_poses.poses(io.BytesIO(data).read, "Probe", 0))


def serve_vrpn(more=()):
    """A server for one client; its port, and what the client sent first."""
    listener, heard = socket.create_server(("127.0.0.1", 0)), []

    def serve():
        connection = listener.accept()[0]
        with connection:
            heard.append(connection.recv(24, socket.MSG_WAITALL))
            try:
                connection.sendall(vrpn_stream())
                for message in more:
                    connection.sendall(message)
            except OSError:
                pass
    threading.Thread(target=serve, daemon=True).start()
    return listener.getsockname()[1], heard


def test_vrpn_over_tcp_to_udp():
    port, heard = serve_vrpn()
    ours = udp_socket()
    done = converter("vrpn_poses.py", f"Probe@127.0.0.1:{port}", "--udp", f"127.0.0.1:{ours.getsockname()[1]}", "--body", "object")
    line = ours.recv(2000).decode()
    said = done.communicate(timeout=20)[1]
    assert heard[0] == b"vrpn: ver. 07.35  0\0\0\0\0\0"
    body, rest = line.split(",", 1)
    assert body == "object" and cells(rest) == pytest.approx([7.25e9, 1, 2, 3, TURN[3], *TURN[:3]])
    assert done.returncode == 1 and "closed the connection" in said and "1 poses" in said


# --- NatNet: little-endian; from 4.1 on each section has its length in bytes behind its count ---

def natnet_frame(version, bodies, seconds):
    sized = version >= (4, 1)

    def section(items):
        content = b"".join(items)
        return struct.pack("<i", len(items)) + (struct.pack("<i", len(content)) if sized else b"") + content

    def body(number, position, xyzw, tracked):
        return struct.pack("<i3f4ffh", number, *position, *xyzw, 1e-4, tracked)
    channels = struct.pack("<ii", 1, 2) + struct.pack("<i2f", 2, 0.5, 0.6) + struct.pack("<if", 1, 0.7)
    out = struct.pack("<i", 4711)
    out += section([b"all\0" + struct.pack("<i6f", 2, *range(6))]) + section([struct.pack("<3f", 1, 2, 3)] * 3)
    out += section([body(*each) for each in bodies])
    out += section([struct.pack("<ii", 5, 2) + body(1, (7, 7, 7), TURN, 1) + body(2, (7, 7, 7), TURN, 1)])  # a skeleton
    if sized:
        out += section([struct.pack("<ii", 6, 1) + body(1, (6, 6, 6), TURN, 1) + struct.pack("<i", 0)])     # an asset
    out += section([struct.pack("<i3ffhf", 1, 1, 2, 3, 0.01, 2, 1e-4)] * 2) + section([channels]) + section([channels])
    return out + struct.pack("<iid3Qh", 0, 0, seconds, 1, 2, 3, 0)


def natnet_message(kind, content):
    return struct.pack("<HH", kind, len(content)) + content


BODIES = [(1, (9, 9, 9), TURN, 0), (2, (0.5, 0.25, -1.0), TURN, 1)]


@pytest.mark.parametrize("version", [(3, 0), (3, 1), (4, 0), (4, 1), (4, 2)])
def test_natnet_gives_the_bodies_that_are_tracked(version):
    seconds, bodies = natnet_poses.frame(natnet_frame(version, BODIES, 12.5), version)
    assert seconds == 12.5 and list(bodies) == [2]
    assert bodies[2][0] == (0.5, 0.25, -1.0) and bodies[2][1] == pytest.approx(TURN, abs=1e-7)


@pytest.mark.parametrize("version", [(3, 0), (4, 1)])
def test_a_natnet_frame_that_is_cut_is_an_error(version):
    whole = natnet_frame(version, BODIES, 12.5)
    for size in range(len(whole) - 26 - 8):  # before the time
        with pytest.raises(struct.error):
            natnet_poses.frame(whole[:size], version)


def serve_natnet(version, server, frames=3):
    data, client = server.recvfrom(2000)
    assert struct.unpack_from("<H", data)[0] == 0  # it connects
    answer = b"Motive".ljust(256, b"\0") + bytes((3, 1, 0, 0)) + bytes((*version, 0, 0))
    server.sendto(natnet_message(1, answer), client)
    for i in range(frames):
        server.sendto(natnet_message(7, natnet_frame(version, BODIES, 12.5 + 0.01 * i)), client)
    return client


def test_natnet_unicast_to_udp():
    server, ours = udp_socket(), udp_socket()
    done = converter("natnet_poses.py", f"127.0.0.1:{server.getsockname()[1]}", "--id", "2", "--y-up", "--udp", f"127.0.0.1:{ours.getsockname()[1]}")
    client = serve_natnet((4, 1), server)
    lines = [cells(ours.recv(2000).decode()) for _ in range(3)]
    assert [line[0] for line in lines] == [12.5e9, 12.51e9, 12.52e9]
    assert lines[0][1:4] == pytest.approx([0.5, 1.0, 0.25])  # y up has become z up
    server.sendto(natnet_message(7, natnet_frame((4, 1), BODIES, 13.0)[:60]), client)
    said = done.communicate(timeout=20)[1]
    assert done.returncode == 1 and "not NatNet" in said and "3 poses" in said


def test_natnet_multicast():
    """The server answers to the client, and sends its frames to the group, here within this machine."""
    server = udp_socket()
    server.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
    done = converter("natnet_poses.py", f"127.0.0.1:{server.getsockname()[1]}", "--id", "2", "--multicast", "--local", "127.0.0.1")
    serve_natnet((3, 1), server, 0)
    for _ in range(100):  # until it reads
        try:
            server.sendto(natnet_message(7, natnet_frame((3, 1), BODIES, 12.5)), ("239.255.42.99", 1511))
        except OSError as error:
            done.kill()
            done.wait()
            pytest.skip(f"no multicast here: {error}")
        time.sleep(0.01)
    done.send_signal(signal.SIGINT)
    out = done.communicate(timeout=20)[0]
    assert cells(out.splitlines()[0])[:4] == [None, 0.5, 0.25, -1.0]


def test_an_old_natnet_is_named():
    server = udp_socket()
    done = converter("natnet_poses.py", f"127.0.0.1:{server.getsockname()[1]}", "--id", "2")
    serve_natnet((2, 9), server, 0)
    assert "NatNet 2.9; 3.0 or later" in done.communicate(timeout=20)[1]


# --- OpenVR: a module with its names ---

class Times:
    """As a type of ctypes: times a number it is the type of an array."""

    def __mul__(self, count):
        return lambda: [None] * count


VR = types.SimpleNamespace(k_unMaxTrackedDeviceCount=4, TrackingUniverseStanding=1, TrackingResult_Running_OK=200, Prop_SerialNumber_String=1002,
                           TrackedDevicePose_t=Times())


class VrSystem:
    """Two devices; of the second the poses that are given: valid, result and x."""

    def __init__(self, poses):
        self._poses = iter(poses)

    def isTrackedDeviceConnected(self, index):
        return index < 2

    def getStringTrackedDeviceProperty(self, index, name):
        assert name == VR.Prop_SerialNumber_String
        return f"LHR-{index}"

    def getDeviceToAbsoluteTrackingPose(self, origin, ahead_s, poses):
        assert (origin, ahead_s, len(poses)) == (1, 0.0, 4)
        valid, result, x = next(self._poses)
        m = types.SimpleNamespace(m=matrix(TURN, (x, 0, 0)))
        poses[1] = types.SimpleNamespace(bPoseIsValid=valid, eTrackingResult=result, mDeviceToAbsoluteTracking=m)


def test_quaternions_of_matrices():
    for xyzw in (TURN, (0, 0, 0, 1), (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0.6, 0, 0.8, 0), (-0.5, 0.5, 0.5, 0.5)):
        assert openvr_poses.quaternion(matrix(xyzw)) == pytest.approx(xyzw) or openvr_poses.quaternion(matrix(xyzw)) == pytest.approx([-v for v in xyzw])


def matrix(xyzw, position=(0, 0, 0)):
    x, y, z, w = xyzw
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), position[0]],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), position[1]],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), position[2]]]


def test_openvr_gives_new_valid_poses(capsys):
    system = VrSystem([(True, 200, 0.1), (True, 200, 0.1), (False, 200, 0.2), (True, 201, 0.3), (True, 200, 0.4)])  # twice, invalid, out of range
    assert openvr_poses.serials(VR, system) == {"LHR-0": 0, "LHR-1": 1}
    openvr_poses.send_poses(VR, system, 1, 1000.0, pose_lines.PoseOutput(), count=2)
    lines = [cells(line) for line in capsys.readouterr().out.splitlines()]
    assert [line[:2] for line in lines] == [[None, 0.1], [None, 0.4]] and lines[0][4:] == pytest.approx([TURN[3], *TURN[:3]])


# --- ROS 2 and what is common ---

def test_ros2_lines_to_standard_output():
    stamped = "12,500000000,map,1.0,2.0,3.0,0.0,0.0,0.0,1.0\n"
    transform = "12,600000000,map,probe,1.5,2.0,3.0,0.0,0.0,0.0,1.0\n"
    done = converter("ros2_poses.py")
    out, said = done.communicate(stamped + transform + "A message was lost!!!\n1,2,map,1,2,3,9,9,9,9\n", timeout=20)
    assert out == ",1,2,3,1,0,0,0\n,1.5,2,3,1,0,0,0\n" and "2 poses, 2 refused" in said


def test_y_up_is_a_rotation_about_x():
    position, xyzw = pose_lines.rotated_up((1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0))
    assert position == (1.0, -3.0, 2.0)
    assert matrix(xyzw) == [pytest.approx(row) for row in ([1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0])]
    turned = matrix(pose_lines.rotated_up((0, 0, 0), TURN)[1])
    before = matrix(TURN)
    assert turned == [pytest.approx(row) for row in (before[0], [-v for v in before[2]], before[1])]


@pytest.mark.parametrize("address", ["x", "x:", "x:0", ":5", "x:70000", "x:y"])
def test_addresses(address):
    with pytest.raises(SystemExit):
        pose_lines.host_port(address)
    assert pose_lines.host_port("x:7") == ("x", 7) and pose_lines.host_port("x", 8) == ("x", 8)


@pytest.mark.skipif("ASPERITY_PROGRAM" not in os.environ, reason="no program")
@pytest.mark.parametrize("by", ["udp", "pipe"])
def test_the_recorder_takes_vrpns_poses(tmp_path, by):
    """From a VRPN server into a recording. No probe is there: its rows are missing, the poses are not."""
    ports = [udp_socket() for _ in range(2)]
    probe, poses = (each.getsockname()[1] for each in ports)
    for each in ports:
        each.close()

    def more():
        begin = time.monotonic()
        while time.monotonic() - begin < 30.0:
            time.sleep(0.01)
            now_us = round((1e6 + time.monotonic() - begin) * 1e6)
            yield vrpn_message(12, 4, vrpn_pose((0.001 * (now_us % 1000), 2.0, 3.0), TURN), *divmod(now_us, 1_000_000))
    port, _ = serve_vrpn(more())
    command = f"exec {sys.executable} {FOLDER}/vrpn_poses.py Probe@127.0.0.1:{port} "
    if by == "udp":
        command += f"--udp 127.0.0.1:{poses}"
        address = f"udp:{poses}"
    else:
        os.mkfifo(tmp_path / "poses")
        command += f"> '{tmp_path}/poses'"
        address = f"pipe:{tmp_path}/poses"
    sender = subprocess.Popen(["sh", "-c", command], stderr=subprocess.DEVNULL)
    try:
        done = subprocess.run([os.environ["ASPERITY_PROGRAM"], "record", "--probe", f"udp:{probe}", "--poses", address, "--uncalibrated", "--duration", "2s",
                               "-o", str(tmp_path / "rec")], capture_output=True, text=True, timeout=60)
    finally:
        sender.terminate()
        sender.wait(timeout=20)
    with open(tmp_path / "rec" / "tracker.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) > 20, done.stderr
    assert all(float(row["py_m"]) == 2.0 and float(row["qx"]) == pytest.approx(TURN[0]) for row in rows)
    times = [int(row["t_ns"]) for row in rows]
    assert all(later > earlier for earlier, later in zip(times, times[1:]))
