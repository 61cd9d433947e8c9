"""Messages of ROS 2 as the lines that `ros2 topic echo --csv` prints. Needs Python 3 alone."""
import math
from typing import NamedTuple, Optional


class StampedPose(NamedTuple):
    t_ns: Optional[int]  # of the message's header; None where it has none
    frame_id: str
    position_m: tuple
    xyzw: tuple


# Cells of a message: the name of its frame, then where the position begins.
POSE, POSE_STAMPED, TRANSFORM_STAMPED, POSE_WITH_COVARIANCE_STAMPED = 7, 10, 11, 46
FIRST = {POSE: 0, POSE_STAMPED: 3, TRANSFORM_STAMPED: 4, POSE_WITH_COVARIANCE_STAMPED: 3}


def pose_of_line(line):
    """The pose in a line of geometry_msgs Pose, PoseStamped, TransformStamped or PoseWithCovarianceStamped; None for
    any other line."""
    cells = line.strip().split(",")
    first = FIRST.get(len(cells))
    if first is None:
        return None
    try:
        values = [float(cell) for cell in cells[first:first + 7]]
        t_ns = int(cells[0]) * 1_000_000_000 + int(cells[1]) if first else None
    except ValueError:
        return None
    if not all(math.isfinite(value) for value in values) or (t_ns is not None and t_ns < 0):
        return None
    return StampedPose(t_ns, cells[2] if first else "", tuple(values[:3]), tuple(values[3:]))


WRENCH_COLUMNS = ("sec,nanosec,frame_id,force_x,force_y,force_z,torque_x,torque_y,torque_z,"
                  "touching,proxy_x,proxy_y,proxy_z,texture_height_m")


def wrench_line(t_ns, frame_id, touch):
    """A line of geometry_msgs WrenchStamped, and behind it the contact. The torque of a point is zero."""
    sec, nanosec = divmod(t_ns, 1_000_000_000)
    numbers = [*touch.force_N, 0.0, 0.0, 0.0]
    return (f"{sec},{nanosec},{frame_id}," + ",".join(f"{value:.9g}" for value in numbers) +
            f",{int(touch.touching)}," + ",".join(f"{value:.9g}" for value in (*touch.proxy_m, touch.texture_height_m)))


def wrench_yaml(t_ns, frame_id, touch):
    """A document of geometry_msgs WrenchStamped for `ros2 topic pub --yaml-file`."""
    sec, nanosec = divmod(t_ns, 1_000_000_000)
    x, y, z = (f"{value:.12f}" for value in touch.force_N)  # never as a whole number: the fields are floats
    frame = frame_id.replace("'", "''")
    return (f"header: {{stamp: {{sec: {sec}, nanosec: {nanosec}}}, frame_id: '{frame}'}}\n"
            f"wrench: {{force: {{x: {x}, y: {y}, z: {z}}}, torque: {{x: 0.0, y: 0.0, z: 0.0}}}}\n---")
