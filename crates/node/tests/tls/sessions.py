"""A router with access control, and sessions with certificates that put on keys of a team: who is heard, and who is not."""

import socket
import sys
import time

import zenoh

with socket.socket() as probe:
    probe.bind(("127.0.0.1", 0))
    port = probe.getsockname()[1]


def session(name, mode, listen=(), connect=()):
    config = zenoh.Config.from_file(f"{name}.json5")
    config.insert_json5("mode", f'"{mode}"')
    config.insert_json5("listen/endpoints", str(list(listen)).replace("'", '"'))
    config.insert_json5("connect/endpoints", str(list(connect)).replace("'", '"'))
    config.insert_json5("connect/timeout_ms", "4000")
    config.insert_json5("connect/exit_on_failure", "true")
    config.insert_json5("scouting/multicast/enabled", "false")
    return zenoh.open(config)


router = session("router", "router", listen=[f"tls/localhost:{port}"])
here = [f"tls/localhost:{port}"]
heard = set()
ear = session("robot_2", "client", connect=here)
held = ear.declare_subscriber("closeranks/**", lambda sample: heard.add((str(sample.key_expr), bytes(sample.payload))))


def puts(name, key):
    """Whether robot_2 hears what is put with the certificate of `name`; None if it is not let in."""
    try:
        own = session(name, "client", connect=here)
    except zenoh.ZError:
        return None
    out = own.declare_publisher(key)
    said = f"{name} {key}".encode()
    for _ in range(20):
        out.put(said)
        time.sleep(0.1)
    own.close()
    return (key, said) in heard


expected = [
    ("robot_1", "closeranks/say/1", True),
    ("robot_1", "closeranks/say/2", False),
    ("robot_1", "closeranks/sensed/2", False),
    ("plant", "closeranks/sensed/2", True),
    ("plant", "closeranks/say/1", False),
    ("stranger", "closeranks/say/1", None),
]
good = True
for name, key, wanted in expected:
    found = puts(name, key)
    good &= found == wanted
    words = {True: "is heard", False: "is not heard", None: "is not let in"}
    print(f"{'ok   ' if found == wanted else 'WRONG'} {name} on {key} {words[found]}")
ear.close()
router.close()
sys.exit(0 if good else 1)
