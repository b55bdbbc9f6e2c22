"""A planner, a localisation and a base in the wire form of ROS 2, by programs that are not ours: PyPI `zenoh-ros2-sdk` for keys,
attachments and tokens, `rosbags` for CDR and the hashes of types.

The base is robot_1, which looks north and can move in every direction; robot_2 stands still one metre to its west. The planner wants to
go east for ever. `closeranks-node` must let robot_1 go as far as the link of 3 m to robot_2 allows, and no farther.
"""

import sys
import time

from rosbags.typesys import Stores, get_typestore
from zenoh_ros2_sdk import ROS2Publisher, ROS2Subscriber
from zenoh_ros2_sdk.session import ZenohSession

PORT, SECONDS, STEP_S = int(sys.argv[1]), float(sys.argv[2]), 0.05
STAMPED, ODOMETRY = "geometry_msgs/msg/TwistStamped", "nav_msgs/msg/Odometry"

store = get_typestore(Stores.ROS2_JAZZY)
session = ZenohSession.get_instance("127.0.0.1", PORT)
# The SDK would fetch definitions of messages from elsewhere; rosbags has them.
session.store = store
session._registered_types = {name: name for name in (STAMPED, ODOMETRY)}


def of(name):
    kind = {"msg_type": name, "type_hash": store.hash_rihs01(name), "router_port": PORT}
    return kind


types = store.types
Header, Time = types["std_msgs/msg/Header"], types["builtin_interfaces/msg/Time"]
Vector3, Twist = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Twist"]
Point, Quaternion = types["geometry_msgs/msg/Point"], types["geometry_msgs/msg/Quaternion"]
Pose, PoseCov = types["geometry_msgs/msg/Pose"], types["geometry_msgs/msg/PoseWithCovariance"]
TwistCov = types["geometry_msgs/msg/TwistWithCovariance"]


def header(frame):
    nanos = time.time_ns()
    return Header(stamp=Time(sec=nanos // 10**9, nanosec=nanos % 10**9), frame_id=frame)


def twist(forward, left):
    return Twist(linear=Vector3(x=forward, y=left, z=0.0), angular=Vector3(x=0.0, y=0.0, z=0.0))


def odometry(x, y):
    import numpy as np

    north = Quaternion(x=0.0, y=0.0, z=0.5**0.5, w=0.5**0.5)
    pose = PoseCov(pose=Pose(position=Point(x=x, y=y, z=0.0), orientation=north), covariance=np.zeros(36))
    return {
        "header": header("map"),
        "child_frame_id": "base_link",
        "pose": pose,
        "twist": TwistCov(twist=twist(0.0, 0.0), covariance=np.zeros(36)),
    }


class Base:
    """Moves as it is told; without a command for half a second it stands still."""

    def __init__(self):
        self.x, self.y, self.velocity, self.at, self.count = 0.0, 0.0, (0.0, 0.0), 0.0, 0

    def command(self, message):
        linear = message.twist.linear
        # Forward is north, left is west.
        self.velocity, self.at, self.count = (-linear.y, linear.x), time.monotonic(), self.count + 1

    def step(self):
        if time.monotonic() - self.at < 0.5:
            self.x += STEP_S * self.velocity[0]
            self.y += STEP_S * self.velocity[1]


base = Base()
listens = ROS2Subscriber(topic="/robot_1/cmd_vel", callback=base.command, **of(STAMPED))
odom_1 = ROS2Publisher(topic="/robot_1/odom", **of(ODOMETRY))
odom_2 = ROS2Publisher(topic="/robot_2/odom", **of(ODOMETRY))
wanted = ROS2Publisher(topic="/robot_1/cmd_vel_in", **of(STAMPED))

farthest, end = 0.0, time.monotonic() + SECONDS
while time.monotonic() < end:
    base.step()
    farthest = max(farthest, base.x)
    odom_1.publish(**odometry(base.x, base.y))
    odom_2.publish(**odometry(-1.0, 0.0))
    wanted.publish(header=header("base_link"), twist=twist(0.0, -0.5))
    time.sleep(STEP_S)

tokens = sorted(str(reply.ok.key_expr) for reply in session.liveliness.get("@ros2_lv/**") if reply.ok)
ours = sorted({token for token in tokens if "closeranks_robot_1" in token})
print(f"commands {base.count}, farthest {farthest:.3f} m of at most 2.000, sideways {base.y:.3f} m, tokens of ours {len(ours)}")
for token in ours:
    print(token)
session.session.close()
good = base.count > 10 and 0.3 < farthest <= 2.0 and abs(base.y) < 0.05 and len(ours) == 4
sys.stdout.flush()
# The SDK leaves threads behind.
import os

os._exit(0 if good else 1)
