"""A node that subscribes to poses of a tip and publishes the force on it.

    ros2 run asperity_ros2 feel --ros-args -p scene:=plate/scene.json -r pose:=/stylus/pose -r wrench:=/stylus/force"""
import rclpy
from geometry_msgs.msg import PoseStamped, WrenchStamped
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data

from asperity_ros2.feel_stepper import FeelStepper, settings_of


class FeelNode(Node):
    """Parameters: scene, a scene.json or a mesh; rate_hz, of the poses; settings, NAME=VALUE each. A pose in another
    frame than the parameter `frame` (empty: any) gives no force."""

    def __init__(self):
        super().__init__("asperity_feel")
        scene = self.declare_parameter("scene", "").value
        if not scene:
            raise RuntimeError("the parameter 'scene' is missing: a scene.json or a mesh")
        self._frame = self.declare_parameter("frame", "").value
        rate_hz = self.declare_parameter("rate_hz", 1000.0).value
        settings = self.declare_parameter("settings", ["friction=0.0"]).value
        self._stepper = FeelStepper(scene, rate_hz, settings_of(settings))
        self._publisher = self.create_publisher(WrenchStamped, "wrench", qos_profile_sensor_data)
        self.create_subscription(PoseStamped, "pose", self.on_pose, qos_profile_sensor_data)

    def on_pose(self, pose):
        if self._frame and pose.header.frame_id != self._frame:
            self.get_logger().warning(f"pose in frame '{pose.header.frame_id}', not '{self._frame}'", throttle_duration_sec=5.0)
            return
        stamp, p = pose.header.stamp, pose.pose.position
        touch = self._stepper.step(stamp.sec * 1_000_000_000 + stamp.nanosec, (p.x, p.y, p.z))
        wrench = WrenchStamped()
        wrench.header = pose.header
        force = wrench.wrench.force
        force.x, force.y, force.z = (float(value) for value in touch.force_N)
        self._publisher.publish(wrench)


def main():
    rclpy.init()
    node = FeelNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
