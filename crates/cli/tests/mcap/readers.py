"""The same recording through three libraries: every topic as arrays."""

import re
import subprocess
from collections import defaultdict

import numpy as np
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

# Distributions of ROS 2 whose messages ours must be.
STORES = [Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY]


def by_mcap(path):
    """Messages of each topic with their times, in the order of the file's index; checksums are compared."""
    topics = defaultdict(list)
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, message, decoded in reader.iter_decoded_messages():
            topics[channel.topic].append((message.log_time, decoded))
    return topics


def by_rosbags(path):
    """The same; types are those of the file, and those that ROS has must be the same there, hash for hash."""
    topics = defaultdict(list)
    with Reader(path) as reader:
        store = get_typestore(Stores.EMPTY)
        for connection in reader.connections:
            store.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
        compare_types(store, {connection.msgtype for connection in reader.connections})
        for connection, time, raw in reader.messages():
            topics[connection.topic].append((time, store.deserialize_cdr(raw, connection.msgtype)))
    return topics


def compare_types(store, names):
    for known in map(get_typestore, STORES):
        for name in sorted(names):
            if not name.startswith("closeranks_msgs/"):
                assert store.hash_rihs01(name) == known.hash_rihs01(name), f"{name} is not that of ROS 2"


def by_rerun(path, work):
    """Positions of robots and their states, printed by the command line of Rerun."""
    rrd = work / f"{path.stem}.rrd"
    command("rerun", "mcap", "check", path)
    command("rerun", "mcap", "convert", path, "-o", rrd)
    command("rerun", "rrd", "verify", rrd)
    return lambda entity: rows(command("rerun", "rrd", "print", "-vvv", "--entity", entity, rrd))


def command(*words):
    done = subprocess.run([str(word) for word in words], check=False, capture_output=True, text=True)
    assert done.returncode == 0, f"{words}: {done.stderr[-2000:]}"
    return done.stdout


def rows(printed):
    """Rows of the printed tables: cells by the name of their column."""
    found, names = [], []
    for line in printed.splitlines():
        cells = [cell.strip() for cell in line.strip("│ ").split("┆")]
        if cells[0].startswith("│ RowId") or cells[0] == "RowId":
            names = cells
        elif "row_" in cells[0] and len(cells) == len(names):
            found.append(dict(zip(names, cells, strict=True)))
    return found


def numbers(cell):
    return np.array([float(word) for word in re.findall(r"-?(?:\d+\.?\d*(?:e-?\d+)?|inf|NaN)", cell)])
