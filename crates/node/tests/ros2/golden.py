#!/usr/bin/env python3
"""Writes the messages of the test in `src/ros/seen.rs` with rosbags, and prints length and digest of their bytes.

    pip install rosbags==0.11.9 && python crates/node/tests/ros2/golden.py
"""
import hashlib

import numpy as np
from rosbags.typesys import Stores, get_typestore

store = get_typestore(Stores.ROS2_JAZZY)
T = store.types


def of(name, *fields):
    return T[name](*fields)


def header(sec, nanosec, frame):
    return of("std_msgs/msg/Header", of("builtin_interfaces/msg/Time", sec, nanosec), frame)


def digest(name, message):
    raw = bytes(store.serialize_cdr(message, name))
    print(name, len(raw), hashlib.sha256(raw).hexdigest()[:16], store.hash_rihs01(name))


values = [of("diagnostic_msgs/msg/KeyValue", *pair) for pair in [("degree", "3"), ("blocked for s", "1.5")]]
status = of("diagnostic_msgs/msg/DiagnosticStatus", 1, "closeranks: robot_1", "degree", "robot_1", values)
digest("diagnostic_msgs/msg/DiagnosticArray", of("diagnostic_msgs/msg/DiagnosticArray", header(5, 7, ""), [status]))


def marker(group, kind, at, scale, color, points, text):
    return of(
        "visualization_msgs/msg/Marker",
        header(5, 7, "map"), group, 0, kind, 0,
        of("geometry_msgs/msg/Pose", of("geometry_msgs/msg/Point", *at), of("geometry_msgs/msg/Quaternion", 0.0, 0.0, 0.0, 1.0)),
        of("geometry_msgs/msg/Vector3", *scale), of("std_msgs/msg/ColorRGBA", *color),
        of("builtin_interfaces/msg/Duration", 1, 0), False,
        [of("geometry_msgs/msg/Point", *point) for point in points], [], "",
        of("sensor_msgs/msg/CompressedImage", header(0, 0, ""), "", np.zeros(0, np.uint8)), [], text, "",
        of("visualization_msgs/msg/MeshFile", "", np.zeros(0, np.uint8)), False,
    )


lines = marker("links", 5, (0.0,) * 3, (0.02, 0.0, 0.0), (0.0, 1.0, 0.0, 1.0), [(0.0,) * 3, (1.0, 2.0, 0.5)], "")
text = marker("mode", 9, (0.0, 0.0, 0.3), (0.0, 0.0, 0.15), (1.0,) * 4, [], "HOLD 3")
digest("visualization_msgs/msg/MarkerArray", of("visualization_msgs/msg/MarkerArray", [lines, text]))
