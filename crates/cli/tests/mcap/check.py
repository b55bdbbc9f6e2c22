"""What three independent readers find in recordings, held against the Parquet file of the same run."""

import json
import sys
from pathlib import Path

import numpy as np
from readers import by_mcap, by_rerun, by_rosbags, command, numbers
from run import STATE, killed, record

PLANE = """
duration_s = 1.0
[team]
malicious = [1, 2]
[attack]
level = { kind = "bias", bias = 3.0 }
"""
# Robot 5 is down for a while, and robot 3 tells its neighbours different things.
FAULTS = """
duration_s = 1.0
[team]
malicious = [3]
[controller]
kind = "budget"
[attack]
level = { kind = "faces", min = -20.0, max = 20.0 }
[plant]
crash = { robot = 5, from_s = 0.2, to_s = 0.6 }
"""
SPACE = """
duration_s = 0.5
dimension = 3
seed = 4
[team]
robots = 12
[start]
kind = "random"
half_side_m = 0.9
distance_min_m = 0.5
"""
LONG = PLANE.replace("duration_s = 1.0", "duration_s = 10000.0")
TICK_NS = 5_000_000
VIEWERS = Path(__file__).resolve().parents[4] / "scenarios" / "viewers"
# Ten times as much in the file must not need more memory than this.
MEMORY_MORE = 16 << 20
# Markers of one robot, and of the team: lists of links.
PER_ROBOT, LISTS = 3, 2


def vector(point):
    return [point.x, point.y, point.z]


def equal(name, found, wanted):
    assert np.array_equal(np.asarray(found), np.asarray(wanted), equal_nan=wanted.dtype.kind == "f"), name


def check_topics(run, topics, whole=True):
    """Every message of the topics of robots, bit for bit; of a killed run the beginning alone is compared."""
    for index in range(run.robots):
        robot = f"/robot_{index + 1}"
        ticks = len(topics[f"{robot}/state"])
        count = min(ticks, run.ticks)
        assert not whole or ticks == run.ticks, f"{robot}: {ticks} of {run.ticks} ticks"
        times = [time for time, _ in topics[f"{robot}/pose"][:count]]
        equal("times", times, np.arange(count) * run.tick_ns)
        stamps = [message.header.stamp for _, message in topics[f"{robot}/pose"][:count]]
        equal("stamps", [stamp.sec * 10**9 + stamp.nanosec for stamp in stamps], np.arange(count) * run.tick_ns)
        positions, inputs = run.positions[:count, index], run.inputs[:count, index]
        poses = [message.pose for _, message in topics[f"{robot}/pose"][:count]]
        equal("poses", [vector(pose.position) for pose in poses], positions)
        odometry = [message for _, message in topics[f"{robot}/odom"][:count]]
        equal("odometry", [vector(message.pose.pose.position) for message in odometry], positions)
        transforms = [message.transforms[index] for _, message in topics["/tf"][:count]]
        equal("tf", [vector(transform.transform.translation) for transform in transforms], positions)
        assert {(tf.header.frame_id, tf.child_frame_id) for tf in transforms} == {("map", robot[1:])}
        # After the last tick the Parquet file has no inputs.
        held = slice(0, min(count, run.ticks - 1))
        twists = [message.twist for _, message in topics[f"{robot}/cmd_vel"][held]]
        equal("inputs", [vector(twist.linear) for twist in twists], inputs[held])
        equal("odometry", [vector(message.twist.twist.linear) for message in odometry[held]], inputs[held])
        states = [message for _, message in topics[f"{robot}/state"][:count]]
        for column, field in STATE.items():
            equal(column, [getattr(state, field) for state in states], run.columns[column][:count, index])


def check_shown(run, topics):
    """Markers and diagnostics are there from the first tick to the last and say what the ticks say."""
    degrees, last = run.columns["degree"], (run.ticks - 1) * run.tick_ns
    markers = topics["/markers"]
    assert markers[0][0] == 0 and markers[-1][0] == last
    for time, message in markers:
        tick = time // run.tick_ns
        assert len(message.markers) == PER_ROBOT * run.robots + LISTS
        bodies = [marker for marker in message.markers if marker.ns == "robots"]
        equal("bodies", [vector(marker.pose.position) for marker in bodies], run.positions[tick])
        boxes = [marker.type == 1 for marker in bodies]
        equal("boxes", boxes, run.columns["malicious"][tick])
        ends = sum(len(marker.points) for marker in message.markers if marker.ns == "links")
        assert ends == degrees[tick].sum(), f"tick {tick}: {ends} ends of links"
    for time, message in topics["/diagnostics"]:
        tick = time // run.tick_ns
        for index, status in enumerate(message.status):
            told = {pair.key: pair.value for pair in status.values}
            assert int(told["degree"]) == degrees[tick, index]
            assert abs(float(told["h"]) - run.columns["h"][tick, index]) < 1e-6


def check_rerun(run, rows):
    """Rerun keeps positions of poses as 32-bit numbers. Of our own message its command line prints the beginning."""
    for index in [0, run.robots - 1]:
        printed = rows(f"/robot_{index + 1}/pose")
        found = [numbers(row["InstancePoses3D:translations"]) for row in printed if "InstancePoses3D:translations" in row]
        wanted = run.positions[:, index].astype(np.float32)
        assert np.shape(found) == wanted.shape, f"{np.shape(found)} positions, wanted {wanted.shape}"
        equal("positions", np.array(found, dtype=np.float32), wanted)
        states = [row.get("closeranks_msgs.msg.RobotState:message", "") for row in rows(f"/robot_{index + 1}/state")]
        states = [state for state in states if state]
        assert len(states) == run.ticks, f"{len(states)} states of {run.ticks}"
        for tick, state in enumerate(states):
            assert f"tick: {tick}, robot: {index + 1}, " in state, f"tick {tick}: {state}"


def check_viewers(run, work):
    """The layout for Foxglove names topics and fields that are there, and the script for Rerun writes what Rerun can read."""
    topics = by_mcap(run.mcap)
    layout = json.loads((VIEWERS / "foxglove.json").read_text())
    panels = layout["configById"]
    paths = [path["value"] for panel in panels.values() for path in panel.get("paths", [])]
    assert len(paths) == 2 * run.robots
    for path in paths:
        topic, field = path.split(".")
        assert hasattr(topics[topic][0][1], field), path
    spaces = {marker.ns for marker in topics["/markers"][0][1].markers}
    assert panels["3D!team"]["topics"]["/markers"]["namespaces"].keys() == spaces
    rrd = work / "view.rrd"
    command(sys.executable, VIEWERS / "rerun_view.py", run.mcap, "--save", rrd)
    command("rerun", "rrd", "verify", rrd)
    print("viewers: the layout for Foxglove and the script for Rerun fit")


def main(program, work):
    runs = {"plane": PLANE, "faults": FAULTS, "space": SPACE}
    runs = {name: record(program, work, name, text, TICK_NS) for name, text in runs.items()}
    for name, run in runs.items():
        for reader in (by_mcap, by_rosbags):
            topics = reader(run.mcap)
            assert len(topics) == 3 + 5 * run.robots
            check_topics(run, topics)
            check_shown(run, topics)
            print(f"{name}: {sum(map(len, topics.values()))} messages {reader.__name__}, equal to the Parquet file")
        check_rerun(run, by_rerun(run.mcap, work))
        print(f"{name}: positions by_rerun, equal to the Parquet file")
    check_viewers(runs["plane"], work)
    mcap, least = killed(program, work, LONG, 1 << 20)
    for reader in (by_mcap, by_rosbags):
        topics = reader(mcap)
        check_topics(runs["plane"], topics, whole=False)
        kept = len(topics["/tf"])
        assert kept > runs["plane"].ticks, f"only {kept} ticks"
    by_rerun(mcap, work)
    print(f"killed: {kept} ticks are read, the first {runs['plane'].ticks} are equal to the Parquet file")
    _, most = killed(program, work, LONG, 10 << 20)
    assert most - least < MEMORY_MORE, f"{least >> 20} MiB of memory, and {most >> 20} MiB when the file is ten times as long"
    print(f"memory: {least >> 20} MiB, and {most >> 20} MiB when the file is ten times as long")


main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]))
