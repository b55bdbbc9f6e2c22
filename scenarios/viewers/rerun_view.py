"""A recording of closeranks in Rerun, with a blueprint: the team, h and values of every robot.

    pip install rerun-sdk mcap mcap-ros2-support
    python rerun_view.py run.mcap                   opens the viewer
    python rerun_view.py run.mcap --save run.rrd    writes what `rerun run.rrd` opens
"""

import argparse
from collections import defaultdict

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

NORMAL, MALICIOUS, LINK = [0, 114, 178], [213, 94, 0], [160, 160, 160]
CUBE = 1  # visualization_msgs/Marker: what liars are drawn as
SERIES = {"h": "h", "value": "values", "degree": "degrees"}


def blueprint():
    plots = [rrb.TimeSeriesView(origin=f"/{name}", name=title) for name, title in SERIES.items()]
    team = rrb.Spatial3DView(origin="/team", name="team")
    return rrb.Blueprint(rrb.Horizontal(team, rrb.Vertical(*plots)), collapse_panels=True)


def at(time_ns):
    rr.set_time("run", duration=time_ns / 1e9)


def markers(message):
    """One picture of the team: bodies and links, as the recording has them."""
    bodies = [marker for marker in message.markers if marker.ns == "robots"]
    points = [[marker.pose.position.x, marker.pose.position.y, marker.pose.position.z] for marker in bodies]
    colors = [MALICIOUS if marker.type == CUBE else NORMAL for marker in bodies]
    radii = [marker.scale.x / 2 for marker in bodies]
    rr.log("team/robots", rr.Points3D(points, colors=colors, radii=radii, labels=[str(marker.id) for marker in bodies]))
    for marker in (marker for marker in message.markers if marker.ns == "links"):
        ends = np.array([[point.x, point.y, point.z] for point in marker.points]).reshape(-1, 2, 3)
        color = LINK if marker.id == 0 else MALICIOUS
        rr.log(f"team/links/{marker.id}", rr.LineStrips3D(ends, colors=[color] * len(ends), radii=0.004))


def show(file):
    columns = defaultdict(list)
    with open(file, "rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        for _, channel, message, decoded in reader.iter_decoded_messages():
            if channel.topic == "/markers":
                at(message.log_time)
                markers(decoded)
            elif channel.topic.endswith("/state"):
                columns[decoded.robot].append((message.log_time, decoded))
    for robot, states in columns.items():
        color = MALICIOUS if states[0][1].malicious else NORMAL
        times = rr.TimeColumn("run", duration=[time / 1e9 for time, _ in states])
        for name in SERIES:
            entity = f"{name}/robot_{robot}"
            rr.log(entity, rr.SeriesLines(colors=color, names=f"robot {robot}"), static=True)
            numbers = [float(getattr(state, name)) for _, state in states]
            rr.send_columns(entity, indexes=[times], columns=rr.Scalars.columns(scalars=numbers))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", help="what `closeranks run FILE --record run.mcap` wrote")
    parser.add_argument("--save", metavar="RRD", help="write a file instead of opening the viewer")
    arguments = parser.parse_args()
    rr.init("closeranks", recording_id="run", spawn=arguments.save is None)
    if arguments.save is not None:
        rr.save(arguments.save, default_blueprint=blueprint())
    else:
        rr.send_blueprint(blueprint())
    show(arguments.file)


if __name__ == "__main__":
    main()
