"""A planner, a localisation and a base as programs of ROS 2 itself: rclpy over Fast DDS.

The base is robot_1, which looks north and can move in every direction; robot_2 stands still one metre to its west. The planner wants to go
east for ever. `closeranks-node` must let robot_1 go as far as the link of 3 m to robot_2 allows, and no farther.
"""

import sys
import time

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from visualization_msgs.msg import MarkerArray

SECONDS, STEP_S, WATCHDOG_S = float(sys.argv[1]), 0.05, 0.5

rclpy.init()
node = rclpy.create_node("base")
x, y, velocity, at, commands, frames = 0.0, 0.0, (0.0, 0.0), 0.0, 0, set()
said, drawn = [], []


def command(message):
    global velocity, at, commands
    linear = message.twist.linear
    # Forward is north, left is west.
    velocity, at, commands = (-linear.y, linear.x), time.monotonic(), commands + 1
    frames.add(message.header.frame_id)


node.create_subscription(TwistStamped, "/robot_1/cmd_vel", command, 10)
node.create_subscription(DiagnosticArray, "/diagnostics", lambda message: said.extend(message.status), 10)
node.create_subscription(MarkerArray, "/robot_1/closeranks_markers", lambda message: drawn.extend(message.markers), 10)
odom = {robot: node.create_publisher(Odometry, f"/{robot}/odom", 10) for robot in ("robot_1", "robot_2")}
wanted = node.create_publisher(TwistStamped, "/robot_1/cmd_vel_in", 10)


def odometry(at_x, at_y):
    message = Odometry()
    message.header.stamp = node.get_clock().now().to_msg()
    message.header.frame_id, message.child_frame_id = "map", "base_link"
    message.pose.pose.position.x, message.pose.pose.position.y = at_x, at_y
    message.pose.pose.orientation.z = message.pose.pose.orientation.w = 0.5**0.5
    return message


want = TwistStamped()
want.header.frame_id = "base_link"
want.twist.linear.y = -0.5
farthest, end, due = 0.0, time.monotonic() + SECONDS, time.monotonic()
while time.monotonic() < end:
    rclpy.spin_once(node, timeout_sec=max(0.0, due - time.monotonic()))
    if time.monotonic() < due:
        continue
    due += STEP_S
    if time.monotonic() - at < WATCHDOG_S:
        x, y = x + STEP_S * velocity[0], y + STEP_S * velocity[1]
    farthest = max(farthest, x)
    odom["robot_1"].publish(odometry(x, y))
    odom["robot_2"].publish(odometry(-1.0, 0.0))
    want.header.stamp = node.get_clock().now().to_msg()
    wanted.publish(want)

print(f"commands {commands} in {frames}, farthest {farthest:.3f} m of at most 2.000, sideways {y:.3f} m")
print(f"diagnoses {len(said)}, the last: {said[-1].name}, {said[-1].message}" if said else "no diagnoses")
print(f"markers {len(drawn)} of {sorted({marker.ns for marker in drawn})}")
good = commands > 10 and frames == {"base_link"} and 0.3 < farthest <= 2.0 and abs(y) < 0.05 and said and drawn
sys.exit(0 if good else 1)
