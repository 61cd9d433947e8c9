"""The bridge by text lines and the node, without ROS 2: its modules are stand-ins with the names that the node uses."""
import importlib
import os
import subprocess
import sys
import types

import numpy as np
import pytest

asperity = pytest.importorskip("asperity")
FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(FOLDER, "asperity_ros2"))
from asperity_ros2 import csv_messages, feel_stepper  # noqa: E402

PLATE = "v 0 0 0\nv 0.06 0 0\nv 0.06 0.02 0\nv 0 0.02 0\nf 1 2 3 4\n"


@pytest.fixture()
def plate(tmp_path):
    file = tmp_path / "plate.obj"
    file.write_text(PLATE)
    return str(file)


def stamped(t_ns, x, y, z, frame="scene"):
    """A line of `ros2 topic echo --csv` of geometry_msgs/msg/PoseStamped."""
    return f"{t_ns // 10**9},{t_ns % 10**9},{frame},{x},{y},{z},0.0,0.0,0.0,1.0"


def press():
    """Down onto the plate from 1 mm above to 1 mm below, a pose a millisecond; (t_ns, z)."""
    return [(5_000_000_000 + 1_000_000 * i, 1e-3 - 1e-5 * i) for i in range(201)]


def feel_csv(plate, lines, *options):
    done = subprocess.run([sys.executable, os.path.join(FOLDER, "feel_csv.py"), plate, *options], input="\n".join(lines) + "\n", capture_output=True,
                          text=True, timeout=60)
    return done.returncode, done.stdout.splitlines(), done.stderr


@pytest.mark.parametrize("line, t_ns, frame, x", [
    ("1.5,2,3,0,0,0,1", None, "", 1.5),
    ("12,5,map,1.5,2,3,0,0,0,1", 12_000_000_005, "map", 1.5),
    ("12,5,map,probe,1.5,2,3,0,0,0,1", 12_000_000_005, "map", 1.5),
    ("12,5,,1.5,2,3,0,0,0,1," + ",".join(["0.1"] * 36), 12_000_000_005, "", 1.5),
])
def test_poses_of_each_message(line, t_ns, frame, x):
    pose = csv_messages.pose_of_line(line + "\n")
    assert (pose.t_ns, pose.frame_id, pose.position_m, pose.xyzw) == (t_ns, frame, (x, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0))


@pytest.mark.parametrize("line", ["", "---", "1,2,3", "12,5,map,nan,2,3,0,0,0,1", "12,x,map,1,2,3,0,0,0,1", "-1,0,map,1,2,3,0,0,0,1", "a message was lost"])
def test_what_is_not_a_pose(line):
    assert csv_messages.pose_of_line(line) is None


def test_forces_are_those_of_the_renderer(plate):
    lines = [stamped(t_ns, 0.03, 0.01, z) for t_ns, z in press()]
    code, out, said = feel_csv(plate, lines[:100] + ["a message was lost"] + lines[100:], "--header", "--set", "stiffness_N_per_m=2000")
    assert code == 0 and "201 poses, 1 lines that were not poses" in said
    assert out[0] == csv_messages.WRENCH_COLUMNS and len(out) == 202
    rows = [dict(zip(out[0].split(","), line.split(","))) for line in out[1:]]
    assert rows[0]["frame_id"] == "scene" and (rows[7]["sec"], rows[7]["nanosec"]) == ("5", "7000000")
    renderer = asperity.Renderer(asperity.read_scene(plate), 1000.0, {"stiffness_N_per_m": 2000})
    positions = np.array([[0.03, 0.01, z] for _, z in press()])
    expected = renderer.steps(positions, dt_s=1e-3)
    force = np.array([[float(row["force_" + axis]) for axis in "xyz"] for row in rows])
    np.testing.assert_allclose(force, expected["force_N"], atol=1e-8)
    assert force[-1][2] == pytest.approx(2.0, rel=1e-6)
    assert [row["touching"] == "1" for row in rows] == list(expected["touching"])
    np.testing.assert_allclose([float(rows[-1]["proxy_" + axis]) for axis in "xyz"], [0.03, 0.01, 0.0], atol=1e-9)


def test_yaml_is_wrench_stamped(plate):
    yaml = pytest.importorskip("yaml")
    code, out, _ = feel_csv(plate, [stamped(t_ns, 0.03, 0.01, z, "it's") for t_ns, z in press()], "--yaml")
    documents = [document for document in yaml.safe_load_all("\n".join(out)) if document]
    assert code == 0 and len(documents) == 201
    assert documents[-1]["header"] == {"stamp": {"sec": 5, "nanosec": 200000000}, "frame_id": "it's"}
    assert documents[-1]["wrench"]["force"]["z"] == pytest.approx(1.0, rel=1e-6)
    assert all(isinstance(value, float) for document in documents for part in ("force", "torque") for value in document["wrench"][part].values())


def test_a_gap_or_a_time_that_falls_begins_again(plate):
    stepper = feel_stepper.FeelStepper(plate)
    for t_ns, z in press():
        touch = stepper.step(t_ns, (0.03, 0.01, z))
    assert touch.force_N[2] == pytest.approx(1.0)
    for t_ns in (6_000_000_000, 1_000_000_000):  # a second later; before
        assert stepper.step(t_ns, (0.03, 0.01, 1e-3)).force_N[2] == 0.0


@pytest.mark.parametrize("arguments", [["no.obj"], ["PLATE", "--set", "stifness_N_per_m=1"], ["PLATE", "--set", "friction"]])
def test_errors_are_one_line(plate, arguments):
    code, out, said = feel_csv(*[plate if word == "PLATE" else word for word in arguments[:1]], [], *arguments[1:])
    assert code == 1 and not out and len(said.splitlines()) == 1


class Message:
    """Any message: fields appear when they are named."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        self.__dict__[name] = Message()
        return self.__dict__[name]


@pytest.fixture()
def node_module(monkeypatch):
    class Node:
        parameters = {}

        def __init__(self, name):
            self.name, self.published, self.warnings = name, [], 0

        def declare_parameter(self, name, default):
            return types.SimpleNamespace(value=self.parameters.get(name, default))

        def create_publisher(self, _kind, topic, _qos):
            return types.SimpleNamespace(publish=lambda message: self.published.append((topic, message)))

        def create_subscription(self, _kind, topic, callback, _qos):
            self.subscribed = topic, callback

        def get_logger(self):
            def warning(_text, throttle_duration_sec):
                assert throttle_duration_sec > 0
                self.warnings += 1
            return types.SimpleNamespace(warning=warning)
    for name, content in {"rclpy": {}, "rclpy.node": {"Node": Node}, "rclpy.qos": {"qos_profile_sensor_data": 1}, "geometry_msgs": {},
                          "geometry_msgs.msg": {"PoseStamped": Message, "WrenchStamped": Message}}.items():
        module = types.ModuleType(name)
        module.__dict__.update(content)
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.delitem(sys.modules, "asperity_ros2.feel_node", raising=False)
    return importlib.import_module("asperity_ros2.feel_node"), Node


def test_the_node_publishes_the_force_of_each_pose(node_module, plate):
    feel_node, node_class = node_module
    node_class.parameters = {"scene": plate, "frame": "scene", "settings": ["stiffness_N_per_m=500", "friction=0.1"]}
    node = feel_node.FeelNode()
    topic, on_pose = node.subscribed
    for t_ns, z in press():
        pose = Message()
        pose.header.frame_id, pose.header.stamp.sec, pose.header.stamp.nanosec = "scene", t_ns // 10**9, t_ns % 10**9
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = 0.03, 0.01, z
        on_pose(pose)
    pose.header = Message()
    pose.header.frame_id = "map"
    on_pose(pose)
    assert topic == "pose" and len(node.published) == 201 and node.warnings == 1
    name, wrench = node.published[-1]
    assert name == "wrench" and wrench.header.stamp.nanosec == 200000000
    assert wrench.wrench.force.z == pytest.approx(0.5) and type(wrench.wrench.force.z) is float


def test_the_node_needs_a_scene(node_module):
    feel_node, node_class = node_module
    node_class.parameters = {}
    with pytest.raises(RuntimeError, match="scene"):
        feel_node.FeelNode()


def test_versions_are_the_projects():
    with open(os.path.join(FOLDER, "../../CITATION.cff"), encoding="utf-8") as file:
        version = next(line.split(":")[1].strip().strip('"') for line in file if line.startswith("version:"))
    for name in ("package.xml", "setup.py"):
        with open(os.path.join(FOLDER, "asperity_ros2", name), encoding="utf-8") as file:
            assert version in file.read()
