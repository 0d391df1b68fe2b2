"""`roboss record --ros2`: what it writes is read, and written again to the same bytes, by readers of others (rosbags, mcap-ros2-support)."""
import json

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

import roboss
from conftest import REPOSITORY, analysis_command
from roboss import analysis
from roboss.analysis.messages import composed
from roboss.analysis.recorder import opened_world

CROSSROADS, CAMERAS = roboss.example("crossroads.sdf"), roboss.example("cameras.sdf")


def bag_of(path):
    """(type, times in ns, messages, raw bytes) of each topic of a rosbag2."""
    found = {}
    with AnyReader([path]) as reader:
        for connection, time, raw in reader.messages():
            entry = found.setdefault(connection.topic, (connection.msgtype, [], [], []))
            for values, value in zip(entry[1:], (time, reader.deserialize(raw, connection.msgtype), raw)):
                values.append(value)
    return found


def messages_of(path):
    """(time in ns, topic, message) of all messages of an MCAP file."""
    with open(path, "rb") as stream:
        return [(message.log_time, channel.topic, decoded) for _, channel, message, decoded in
                make_reader(stream, decoder_factories=[DecoderFactory()]).iter_decoded_messages()]


@pytest.mark.parametrize("world", [CROSSROADS, CAMERAS])
def test_others_write_the_same_bytes(tmp_path, world):
    analysis.record_ros2(world, tmp_path / "bag", until=0.1)
    store = get_typestore(Stores.ROS2_JAZZY)
    topics = bag_of(tmp_path / "bag")
    assert len(topics) > 9
    for type_name, _, messages, raws in topics.values():
        for message, raw in zip(messages, raws):
            assert bytes(store.serialize_cdr(store.deserialize_cdr(raw, type_name), type_name)) == bytes(raw)
            assert str(message).split("(", 1)[0].endswith(type_name.rsplit("/", 1)[1])
    with open(tmp_path / "bag" / "bag_0.mcap", "rb") as stream:
        for channel in make_reader(stream).get_summary().channels.values():
            assert channel.metadata["topic_type_hash"] == store.hash_rihs01(topics[channel.topic][0]), channel.topic


def test_messages_say_what_the_run_says(tmp_path):
    done = analysis.record_ros2(CROSSROADS, tmp_path / "bag", ["/clock", "/tf*", "/car_3/*"], until=0.1)
    topics = bag_of(tmp_path / "bag")
    assert set(topics) == {"/clock", "/tf", "/tf_static", "/car_3/joint_states", "/car_3/robot_description", "/car_3/scan", "/car_3/gps_pose"}
    assert done.messages == sum(len(times) for _, times, _, _ in topics.values()) and "car_3.odometer" in done.left_out
    sim = roboss.Simulation(CROSSROADS)
    car = sim.robots("car_3")
    for row, (time, clock) in enumerate(zip(*topics["/clock"][1:3])):
        assert clock.clock.sec * 10**9 + clock.clock.nanosec == time == round(sim.time * 1e9)
        frames = {frame.child_frame_id: frame for frame in topics["/tf"][2][row].transforms}
        base = frames["car_3/chassis"]
        at = base.transform
        assert base.header.frame_id == "world"
        assert [at.translation.x, at.translation.y, at.translation.z] == car.link_pose("chassis")[0, :3].tolist()
        assert [at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w] == pytest.approx(car.link_pose("chassis")[0, 3:], abs=1e-15)
        joints = topics["/car_3/joint_states"][2][row]
        assert list(joints.name) == list(car.joints)
        assert joints.position.tolist() == car.joint_position[0].tolist()
        assert joints.velocity.tolist() == car.joint_velocity[0].tolist()
        assert joints.effort.tolist() == car.joint_effort[0].tolist()
        sim.step(5)
    scan = topics["/car_3/scan"][2][0]
    first = roboss.Simulation(CROSSROADS).robots("car_3")["laser"].read_all()
    assert scan.ranges.tolist() == first["ranges"][0].astype(np.float32).tolist()


def test_wheels_stand_where_the_frames_say(tmp_path):
    """The frames lead from the world over the chassis to each wheel, to where the run has it."""
    analysis.record_ros2(CROSSROADS, tmp_path / "run.mcap", ["/tf"], until=0.5, every=0.5)
    _, _, last = messages_of(tmp_path / "run.mcap")[-1]
    frames = {frame.child_frame_id: frame for frame in last.transforms}

    def pose(frame):
        at = frames[frame].transform
        own = np.array([*(getattr(at.translation, axis) for axis in "xyz"), *(getattr(at.rotation, axis) for axis in "xyzw")])
        parent = frames[frame].header.frame_id
        return own if parent == "world" else composed(pose(parent), own)
    sim = roboss.Simulation(CROSSROADS)
    sim.step(250)
    car = sim.robots("car_5")
    assert len(car.links) > 4
    for link in car.links:
        got, expected = pose(f"car_5/{link}"), car.link_pose(link)[0]
        assert got[:3] == pytest.approx(expected[:3], abs=1e-12)
        assert abs(got[3:] @ expected[3:]) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("world", ["crossroads", "arm", "spider", "scouts", "four_bar", "soccer"])
def test_descriptions_move_as_the_robots_do(tmp_path, world):
    """A robot made of the text has its links where the original has them, and the same inertia, whatever its joints do."""
    source, urdf = REPOSITORY / "worlds" / f"{world}.sdf", tmp_path / "robot.urdf"
    done = analysis.record_ros2(source, tmp_path / "run.mcap", ["/*/robot_description"], until=0)
    original = opened_world(source)
    seen = set()
    for robot, (_, topic, message) in zip(original.robots, messages_of(tmp_path / "run.mcap")):
        name = topic.split("/")[1]
        here = roboss.RobotModel(original, robot, cut_loops=True)
        if str(here) in seen or not here.joints:
            continue
        seen.add(str(here))
        urdf.write_text(message.data)
        copy = opened_world(urdf)
        q, base = here.start.copy(), len(here.start) - len(here.joints)
        q[base:] = np.random.default_rng(1).uniform(-1, 1, len(here.joints))
        angles = dict(zip(here.joints, q[base:]))
        parts = [(model, configuration(model, angles)) for model in (roboss.RobotModel(copy, part) for part in copy.robots)]

        def pose_there(link):
            model, r = next(part for part in parts if f"{name}/{link}" in part[0].links)
            return model.link_pose(r, f"{name}/{link}")
        root = inverted(pose_there(here.links[0])), inverted(here.link_pose(q, here.links[0]))
        for link in here.links:
            got, expected = composed(root[0], pose_there(link)), composed(root[1], here.link_pose(q, link))
            assert got[:3] == pytest.approx(expected[:3], abs=1e-9) and abs(got[3:] @ expected[3:]) == pytest.approx(1, abs=1e-9)
        if len(parts) == 1:  # else several hang on the world
            (there, r), = parts
            joints, order = 6 if here.free_base else 0, [there.joints.index(joint) for joint in here.joints]
            rotors = here.mass_matrix(q)[joints:, joints:] - there.mass_matrix(r)[joints:, joints:][np.ix_(order, order)]
            assert rotors == pytest.approx(np.diag(np.diag(rotors)), abs=1e-9) and np.diag(rotors).min() > -1e-9  # URDF has none
    assert seen and len(done.variables) == len(original.robots)


def configuration(model, angles):
    """The start of a model with these positions of its joints, by name."""
    q = model.start.copy()
    q[len(q) - len(model.joints):] = [angles[joint] for joint in model.joints]
    return q


def inverted(pose):
    """The pose of the outer frame in the inner one."""
    turned_back = np.array([0, 0, 0, *-pose[3:6], pose[6]])
    return composed(turned_back, np.array([*-pose[:3], 0, 0, 0, 1]))


def test_images_are_those_of_the_cameras(tmp_path):
    analysis.record_ros2(CAMERAS, tmp_path / "bag", ["/rover/eye/*"], until=0)
    topics = bag_of(tmp_path / "bag")
    image, info = topics["/rover/eye/image_raw"][2][0], topics["/rover/eye/camera_info"][2][0]
    color = roboss.Simulation(CAMERAS).robots("rover")["eye"].read_all()["color"][0]
    assert (image.height, image.width, image.encoding) == (*color.shape[:2], "rgb8")
    assert image.data.tobytes() == color.tobytes()
    assert image.header.frame_id == info.header.frame_id and info.header.frame_id.endswith("/eye_optical_frame")
    assert info.k[2] == pytest.approx(color.shape[1] / 2)


def test_a_journal_gives_what_its_run_gave_and_its_robots_come_and_go(branched, tmp_path):
    """A car goes at 0.4 s, the run is taken back from 0.7 to 0.5 s: the way through the branches is followed."""
    analysis.record_ros2(branched, tmp_path / "replayed.mcap", ["/clock", "/car_*/joint_states"], every=0.1)
    replayed = messages_of(tmp_path / "replayed.mcap")
    assert [time for time, topic, _ in replayed if topic == "/clock"] == [n * 10**8 for n in range(11)]
    assert [sum(topic == f"/car_{car}/joint_states" for _, topic, _ in replayed) for car in (3, 4)] == [4, 11]
    analysis.record_ros2(CROSSROADS, tmp_path / "live.mcap", ["/clock", "/car_*/joint_states"], until=0.3, every=0.1)
    assert [str(row) for row in messages_of(tmp_path / "live.mcap")] == [str(row) for row in replayed if row[0] < 4e8]


def test_the_command(tmp_path):
    def record(*words):
        return analysis_command("record", *map(str, words))
    code, listed, _ = record(CROSSROADS, "--ros2", "--list", "--json")
    scan = next(row for row in json.loads(listed) if row["topic"] == "/car_3/scan")
    assert code == 0 and scan["type"] == "sensor_msgs/msg/LaserScan"
    code, done, errors = record(CROSSROADS, "--ros2", "--until", 0.1, "-o", tmp_path / "bag", "/car_3/scan", "--json")
    assert code == 0 and json.loads(done)["topics"] == ["/car_3/scan"], errors
    for words, name in ((("-o", tmp_path / "bag"), "output-exists"), (("-o", tmp_path / "run.csv"), "unknown-format"),
                        (("/car_3/scam", "-o", tmp_path / "other"), "unknown-name"), (("-o", tmp_path / "no" / "bag"), "no-file")):
        code, _, errors = record(CROSSROADS, "--ros2", "--until", 0.1, *words)
        assert code == 1 and f"[{name}]" in errors and "remedy" in errors, errors
    assert not (tmp_path / "other").exists()
