"""`roboss run --orders BAG`: the commands of a bag that others wrote (rosbags) are orders like those of an orders file."""
import json
import subprocess

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

import roboss
from conftest import ROBOSS
from roboss import analysis

STORE = get_typestore(Stores.ROS2_JAZZY)
BEGIN = 1_700_000_000_000_000_000  #: log time of the first message, ns
#: Time in s, robot, m/s, rad/s.
COMMANDS = [(0, "turtle_3", 0.3, 0.5), (0.5, "turtle_4", 0.2, 0), (0.5, "turtle_5", 0.1, -1), (1.25, "turtle_3", 0, 2)]


def twist(forward, turn):
    vector, message = STORE.types["geometry_msgs/msg/Vector3"], STORE.types["geometry_msgs/msg/Twist"]
    return message(linear=vector(x=forward, y=0.0, z=0.0), angular=vector(x=0.0, y=0.0, z=turn))


def stamped(forward, turn):
    types = STORE.types
    header = types["std_msgs/msg/Header"](stamp=types["builtin_interfaces/msg/Time"](sec=0, nanosec=0), frame_id="")
    return types["geometry_msgs/msg/TwistStamped"](header=header, twist=twist(forward, turn))


def write_bag(path, storage, commands=COMMANDS, make=twist, clock=False):
    """A bag with these commands and another topic; with a clock it runs at half the speed of real time, from 0.1 s on."""
    with Writer(path, version=9, storage_plugin=storage) as writer:
        topics = {}

        def write(topic, time, message):
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, message.__msgtype__, typestore=STORE)
            writer.write(topics[topic], BEGIN + round(time * 1e9), STORE.serialize_cdr(message, message.__msgtype__))
        write("/chatter", 0, STORE.types["std_msgs/msg/String"](data="hello"))
        for number in range(16 if clock else 0):
            stamp = STORE.types["builtin_interfaces/msg/Time"](sec=number // 10, nanosec=number % 10 * 10**8)
            write("/clock", 5 + 0.2 * number, STORE.types["rosgraph_msgs/msg/Clock"](clock=stamp))
        for time, robot, forward, turn in commands:
            write(f"/{robot}/cmd_vel", 5 + 2 * time if clock else time, make(float(forward), float(turn)))
    return path


def run(folder, orders, *words):
    """The process of a run of two seconds, and what it says about itself."""
    summary = folder / "summary.json"
    done = subprocess.run([ROBOSS, "run", "example:fleet", "--headless", "--speed", "max", "--until", "2", "--orders", orders,
                           "--json", summary, *words], capture_output=True, text=True)
    return done, json.loads(summary.read_text()) if done.returncode == 0 else {}


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """The state hash of the run that has the commands from an orders file."""
    folder = tmp_path_factory.mktemp("orders")
    lines = [json.dumps({"t": time, "robot": robot, "command": {"name": "cmd_vel", "linear_x": forward, "angular_z": turn}})
             for time, robot, forward, turn in COMMANDS]
    (folder / "orders.jsonl").write_text("\n".join(lines) + "\n")
    done, summary = run(folder, folder / "orders.jsonl")
    assert done.returncode == 0, done.stderr
    return summary["state_hash"]


@pytest.mark.parametrize("storage", list(StoragePlugin))
@pytest.mark.parametrize("make", [twist, stamped])
def test_a_bag_gives_the_run_of_the_same_orders(tmp_path, expected, storage, make):
    bag = write_bag(tmp_path / "bag", storage, make=make)
    done, summary = run(tmp_path, bag)
    assert done.returncode == 0 and summary["state_hash"] == expected, done.stderr
    assert "4 commands on 3 topics" in done.stderr and "1 other topic drives no robot" in done.stderr
    file, = (path for path in bag.iterdir() if path.suffix in (".mcap", ".db3"))
    assert run(tmp_path, file)[1]["state_hash"] == expected


def test_the_clock_of_a_bag_sets_the_times(tmp_path, expected):
    done, summary = run(tmp_path, write_bag(tmp_path / "bag", StoragePlugin.MCAP, clock=True))
    assert done.returncode == 0 and summary["state_hash"] == expected, done.stderr


def test_a_run_from_a_bag_is_replayed_without_it(tmp_path, expected):
    bag = write_bag(tmp_path / "bag", StoragePlugin.MCAP)
    done, summary = run(tmp_path, bag, "--journal", tmp_path / "run.journal")
    assert summary["state_hash"] == expected, done.stderr
    exported = subprocess.run([ROBOSS, "journal", "export", tmp_path / "run.journal", "--orders"], capture_output=True, text=True,
                              check=True).stdout
    assert [json.loads(line)["robot"] for line in exported.splitlines()] == [robot for _, robot, _, _ in COMMANDS]
    (tmp_path / "exported.jsonl").write_text(exported)
    assert run(tmp_path, tmp_path / "exported.jsonl")[1]["state_hash"] == expected


def test_a_recording_has_no_commands_and_says_so(tmp_path):
    analysis.record_ros2(roboss.example("fleet.sdf"), tmp_path / "run.mcap", ["/clock", "/turtle_3/joint_states"], until=0.1)
    done, _ = run(tmp_path, tmp_path / "run.mcap")
    assert done.returncode == 0 and "[no-commands]" in done.stderr


def test_bags_that_are_wrong_are_refused(tmp_path):
    bag = write_bag(tmp_path / "bag", StoragePlugin.MCAP)
    file, = bag.glob("*.mcap")
    whole = file.read_bytes()
    file.write_bytes(whole[:-8])  # a file that its writer did not finish
    done, _ = run(tmp_path, bag)
    assert done.returncode == 0 and "[truncated]" in done.stderr
    file.write_bytes(whole)
    (bag / "bag_1.mcap.zstd").write_bytes(b"")
    other = write_bag(tmp_path / "other", StoragePlugin.SQLITE3, make=lambda *_: STORE.types["std_msgs/msg/String"](data="go"))
    for path, code in ((bag, "[compressed-file]"), (other, "[wrong-type]"), (tmp_path / "none.mcap", "[no-file]")):
        done, _ = run(tmp_path, path)
        assert done.returncode == 1 and code in done.stderr and "nothing was run" in done.stderr, done.stderr
