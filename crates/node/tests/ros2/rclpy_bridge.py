"""A bridge between DDS and Zenoh in the form of zenoh-plugin-ros2dds, for machines on which that plugin (bridge/) is not built: a key of Zenoh is the
topic, a payload is the CDR of the message, nothing is attached. rclpy hands over bytes and looks into none of them."""

import os
import sys

import rclpy
import rclpy.executors
import zenoh
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from visualization_msgs.msg import MarkerArray

TO_ZENOH = {"robot_1/odom": Odometry, "robot_2/odom": Odometry, "robot_1/cmd_vel_in": TwistStamped}
FROM_ZENOH = {
    "robot_1/cmd_vel": TwistStamped,
    "diagnostics": DiagnosticArray,
    "robot_1/closeranks_markers": MarkerArray,
}

config = zenoh.Config()
config.insert_json5("mode", '"client"')
config.insert_json5("connect/endpoints", f'["tcp/127.0.0.1:{sys.argv[1]}"]')
config.insert_json5("scouting/multicast/enabled", "false")
session = zenoh.open(config)
rclpy.init()
node = rclpy.create_node("bridge")
held = []
for topic, kind in TO_ZENOH.items():
    out = session.declare_publisher(topic)
    held.append(node.create_subscription(kind, f"/{topic}", lambda raw, out=out: out.put(bytes(raw)), 10, raw=True))
for topic, kind in FROM_ZENOH.items():
    into = node.create_publisher(kind, f"/{topic}", 10)
    held.append(session.declare_subscriber(topic, lambda sample, into=into: into.publish(bytes(sample.payload))))
try:
    rclpy.spin(node)
except rclpy.executors.ExternalShutdownException:
    pass  # the script asked it to stop
# The session of Zenoh leaves threads behind, which would keep the process.
os._exit(0)
