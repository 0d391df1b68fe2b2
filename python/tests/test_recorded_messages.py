"""What `roboss record` writes as messages: contact points, images, what radios heard; and that memory stays bounded."""
import base64
import json

import numpy as np
import pyarrow.parquet
import pytest

import roboss
from roboss import analysis

CROSSROADS, CAMERAS, RADIO = (roboss.example(f"{name}.sdf") for name in ("crossroads", "cameras", "radio"))


def rows_of(path):
    """The samples of a Parquet file, as plain data."""
    return pyarrow.parquet.read_table(path).to_pylist()


def messages_of(path):
    """(schema name, messages with their times) of each topic of an MCAP file."""
    from mcap.reader import make_reader
    found = {}
    with open(path, "rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            found.setdefault(channel.topic, (schema.name, []))[1].append((message.log_time / 1e9, json.loads(message.data)))
    return found


def test_contact_points_are_those_of_the_simulation(tmp_path):
    done = analysis.record_file(CROSSROADS, tmp_path / "run.parquet", ["contact_points", "car_3.contact_points", "car_3.contacts"],
                                until=0.1)
    assert done.samples == 11 and done.last == pytest.approx(0.1)
    last = rows_of(tmp_path / "run.parquet")[-1]
    sim = roboss.Simulation(CROSSROADS)
    sim.step(50)
    assert len(last["contact_points"]) == len(sim.contacts) > 0
    for got, point in zip(last["contact_points"], sim.contacts):
        assert got["robot_a"] == sim.world.robots[point["robot_a"]] and (got["robot_b"], got["link_b"]) == ("", "")
        assert got["link_a"] == sim.robots(got["robot_a"]).links[point["link_a"]]
        assert [list(got[name].values()) for name in ("position", "normal", "force", "torque")] == \
            [point[name].tolist() for name in ("position", "normal", "force", "torque")]
    of_car = [point for point in last["contact_points"] if point["robot_a"] == "car_3"]
    assert last["car_3.contact_points"] == of_car and len(of_car) == last["car_3.contacts"]


def test_contacts_between_robots_belong_to_both(tmp_path):
    analysis.record_file(roboss.example("pile.sdf"), tmp_path / "run.mcap", ["**.contact_points", "contact_points"], until=1, every=1)
    topics = messages_of(tmp_path / "run.mcap")
    points = topics["/contact_points"][1][-1][1]["contacts"]
    pairs = [point for point in points if point["robot_b"]]
    assert pairs and topics["/contact_points"][0] == "roboss.Contacts"
    for robot in (pairs[0]["robot_a"], pairs[0]["robot_b"]):
        assert pairs[0] in topics[f"/{robot}/contact_points"][1][-1][1]["contacts"]


@pytest.mark.parametrize("suffix", ["mcap", "parquet"])
def test_images_are_those_of_the_cameras(tmp_path, suffix):
    path = tmp_path / f"run.{suffix}"
    analysis.record_file(CAMERAS, path, ["rover.eye.color", "rover.depth.depth", "rover.labels.*", "rover.x"], until=0.05, every=0.05)
    sim = roboss.Simulation(CAMERAS)
    sim.step(round(0.05 / sim.dt))
    rover = sim.robots("rover")
    wanted = {"rover.eye.color": ("rgb8", rover["eye"].read_all()["color"][0]),
              "rover.depth.depth": ("32FC1", rover["depth"].read_all()["depth"][0]),
              "rover.labels.instances": ("mono16", rover["labels"].read_all()["instances"][0])}
    for name, (encoding, image) in wanted.items():
        if suffix == "mcap":
            schema, messages = messages_of(path)["/" + name.replace(".", "/")]
            assert schema == "foxglove.RawImage" and [time for time, _ in messages] == [0, pytest.approx(0.05)]
            assert messages[1][1]["frame_id"] == name.rsplit(".", 1)[0]
            got = {**messages[1][1], "data": base64.b64decode(messages[1][1]["data"])}
        else:
            got = rows_of(path)[1][name]
        assert (got["encoding"], got["height"], got["width"]) == (encoding, *image.shape[:2])
        assert got["step"] * got["height"] == len(got["data"]) and got["data"] == image.tobytes()
    again = analysis.read(path)  # the numbers beside them
    assert again.variables == ("rover.x",) and len(again.time) == 2


def test_each_radio_message_is_recorded_once(tmp_path):
    sim = roboss.Simulation(RADIO)
    rovers = sim.robots("rover_*")
    rovers[:1]["radio"].send(b"\x00hello")
    analysis.record_file(sim, tmp_path / "run.parquet", "rover_*.radio.messages", until=0.5, every=0.01)
    heard = [(row["time"], message) for row in rows_of(tmp_path / "run.parquet") for message in row["rover_1.radio.messages"]]
    (time, message), = heard
    assert message["sender"] == "rover_0" and message["payload"] == b"\x00hello"
    assert message["sent"] < message["arrived"] <= time < message["arrived"] + 0.011
    assert [len(messages) for messages in rovers["radio"].receive()] == [0, 1, 1, 0]  # the program still gets its own


def test_a_radio_is_not_sampled_too_seldom(tmp_path):
    with pytest.raises(roboss.ArgumentError) as caught:
        analysis.record_file(RADIO, tmp_path / "run.mcap", "**.messages", until=4, every=2)
    assert caught.value.code == "bad-value"


def test_wildcards_leave_out_radios_that_are_sampled_too_seldom(tmp_path):
    done = analysis.record_file(RADIO, tmp_path / "run.parquet", ["rover_1.**", "rover_0.pose"], until=4, every=2)
    assert done.left_out == ("rover_1.radio.messages",) and done.samples == 3
    assert "rover_1.x" in done.variables and "rover_1.contact_points" in done.variables
    assert not any(name.endswith("radio.messages") for name in done.variables)
    assert not analysis.record_file(RADIO, tmp_path / "run.parquet", "rover_1.**", until=2, every=1).left_out


def test_a_refused_recording_leaves_the_older_file(tmp_path):
    path = tmp_path / "run.parquet"
    path.write_bytes(b"PAR1 older")
    for pattern in ("rover_1.radio.messages", "**.messages"):
        with pytest.raises(roboss.ArgumentError, match=r"rover_\d\.radio\.messages") as caught:
            analysis.record_file(RADIO, path, ["rover_1.**", pattern], until=4, every=2)
        assert caught.value.code == "bad-value" and path.read_bytes() == b"PAR1 older"


def test_readings_of_changing_length_are_messages(tmp_path):
    world = """<sdf version="1.11"><world name="w"><model name="box"><pose>0 0 0.6 0 0 0</pose><link name="l">
        <inertial><mass>2</mass><inertia><ixx>0.3</ixx><iyy>0.3</iyy><izz>0.3</izz></inertia></inertial>
        <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
        <sensor name="skin" type="contact"><contact><collision>c</collision></contact></sensor></link></model>
        <model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision></link></model>
        </world></sdf>"""
    analysis.record_file(roboss.Simulation(roboss.load(world)), tmp_path / "run.parquet", "box.skin.*", until=1, every=0.5)
    first, _, last = [row["box.skin.reading"] for row in rows_of(tmp_path / "run.parquet")]
    assert first["positions"] == [] and len(last["positions"]) >= 3
    assert sum(force[2] for force in last["forces"]) == pytest.approx(2 * 9.8, rel=1e-3)


def test_messages_are_not_taken_for_numbers():
    with pytest.raises(roboss.ArgumentError) as caught:
        analysis.record(CAMERAS, "rover.eye.color", until=0)
    assert caught.value.code == "no-numbers"


@pytest.mark.parametrize("suffix", ["mcap", "parquet"])
@pytest.mark.parametrize("numbers", [["car_3.x"], []])
def test_messages_of_a_file_are_told_from_names_that_it_does_not_have(tmp_path, suffix, numbers):
    path = tmp_path / f"run.{suffix}"
    analysis.record_file(CROSSROADS, path, ["car_3.contact_points", *numbers], until=0.02)
    with pytest.raises(roboss.ArgumentError, match="car_3.contact_points") as caught:
        analysis.read(path).select("car_3.contact_points")
    assert caught.value.code == "no-numbers"
    if numbers:
        with pytest.raises(roboss.UnknownNameError):
            analysis.read(path).select("car_3.contact_poin")


@pytest.mark.parametrize("suffix", ["mcap", "parquet"])
def test_a_run_that_fails_leaves_what_was_sampled(tmp_path, suffix):
    def stop(time, _):
        if time >= 0.05:
            raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt):
        analysis.record_file(CROSSROADS, tmp_path / f"run.{suffix}", "car_*.pose", until=10, progress=stop)
    assert analysis.read(tmp_path / f"run.{suffix}").time == pytest.approx(np.arange(6) * 0.01)


def test_row_groups_bound_what_parquet_holds(tmp_path, monkeypatch):
    from roboss.analysis import parquet_file
    monkeypatch.setattr(parquet_file, "_GROUP_BYTES", 16 * 7 * 8 * 10)  # ten samples of 16 poses
    analysis.record_file(CROSSROADS, tmp_path / "run.parquet", "car_*.pose", until=0.5)
    assert pyarrow.parquet.ParquetFile(tmp_path / "run.parquet").num_row_groups == 6
    straight = analysis.record(CROSSROADS, "car_*.pose", until=0.5)
    assert analysis.read(tmp_path / "run.parquet").values.tobytes() == straight.values.tobytes()


TWO_EYES = """<sdf version="1.9"><world name="two_eyes"><model name="post"><link name="low">
  <sensor name="eye" type="lidar"><lidar><scan><horizontal><samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle>
    </horizontal></scan><range><min>0.1</min><max>20</max></range></lidar></sensor>
  <sensor name="touch" type="contact"><contact><collision>body</collision></contact></sensor>
  <collision name="body"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision></link>
  <link name="high"><pose>0 0 2 0 0 3.14159265</pose>
  <sensor name="eye" type="lidar"><lidar><scan><horizontal><samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle>
    </horizontal></scan><range><min>0.1</min><max>20</max></range></lidar></sensor>
  <sensor name="touch" type="contact"><contact><collision>body</collision></contact></sensor>
  <collision name="body"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision></link>
  <joint name="rod" type="fixed"><parent>low</parent><child>high</child></joint></model>
  <model name="wall"><static>true</static><pose>-3 0 2 0 0 0</pose><link name="link"><collision name="c"><geometry><box>
    <size>1 9 1</size></box></geometry></collision></link></model></world></sdf>"""


def test_sensors_of_equal_names_are_all_recorded(tmp_path):
    world = tmp_path / "two_eyes.sdf"
    world.write_text(TWO_EYES)
    done = analysis.record_file(world, tmp_path / "run.parquet", ["post.eye*.ranges", "post.touch*.reading"], until=0.01)
    assert done.variables == ["post.eye.ranges", "post.eye_2.ranges", "post.touch.reading", "post.touch_2.reading"]
    first = rows_of(tmp_path / "run.parquet")[0]
    assert first["post.eye.ranges.1"] == np.inf and first["post.eye_2.ranges.1"] == pytest.approx(2.5, abs=1e-6)


def test_a_scan_of_one_row_is_a_laser_scan_at_its_place_in_the_world(tmp_path):
    world = tmp_path / "two_eyes.sdf"
    world.write_text(TWO_EYES)
    analysis.record_file(world, tmp_path / "run.mcap", "post.eye*.scan", until=0.01)
    topics = messages_of(tmp_path / "run.mcap")
    assert {schema for schema, _ in topics.values()} == {"foxglove.LaserScan"}
    low, high = (topics[f"/post/{name}/scan"][1][0][1] for name in ("eye", "eye_2"))
    assert low["frame_id"] == high["frame_id"] == "world" and low["ranges"] == [None, None, None]
    assert (high["start_angle"], high["end_angle"]) == (-0.5, 0.5) and high["ranges"][1] == pytest.approx(2.5, abs=1e-6)
    assert list(high["pose"]["position"].values()) == pytest.approx([0, 0, 2])
    assert list(high["pose"]["orientation"].values()) == pytest.approx([0, 0, 1, 0], abs=1e-6)  # to the wall behind


@pytest.mark.parametrize("suffix", ["mcap", "parquet"])
def test_a_scan_of_many_rows_is_a_cloud_of_the_points_it_meets(tmp_path, suffix):
    path = tmp_path / f"run.{suffix}"
    analysis.record_file(CAMERAS, path, ["rover.scan.points", "rover.x"], until=0.05, every=0.05)
    sim = roboss.Simulation(CAMERAS)
    sim.step(round(0.05 / sim.dt))
    ranges = sim.robots("rover")["scan"].read_all()["ranges"][0]
    if suffix == "mcap":
        schema, messages = messages_of(path)["/rover/scan/points"]
        cloud = messages[1][1]
        assert schema == "foxglove.PointCloud" and cloud["frame_id"] == "world"
        cloud["data"] = base64.b64decode(cloud["data"])
    else:
        cloud = rows_of(path)[1]["rover.scan.points"]
    names = [field["name"] for field in cloud["fields"]]
    assert names[:3] == ["x", "y", "z"] and [field["offset"] for field in cloud["fields"]] == [4 * n for n in range(len(names))]
    points = np.frombuffer(cloud["data"], dtype="<f4").reshape(-1, cloud["point_stride"] // 4)[:, :3]
    met = np.isfinite(ranges)
    assert np.linalg.norm(points, axis=1) == pytest.approx(ranges[met], rel=1e-5) and met.any()
    where, turn = (np.array(list(cloud["pose"][part].values())) for part in ("position", "orientation"))
    placed = where + points + 2 * np.cross(turn[:3], np.cross(turn[:3], points) + turn[3] * points)
    assert placed[:, 2].min() == pytest.approx(0, abs=0.05)  # the lowest beams meet the ground
