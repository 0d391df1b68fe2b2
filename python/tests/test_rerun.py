"""`roboss record -o run.rrd`: recordings for Rerun, read back by its own package."""
import sys
from pathlib import Path

import numpy as np
import pytest

import roboss
from conftest import analysis_command
from roboss import analysis

CROSSROADS, CAMERAS, RADIO, SHAPES = (roboss.example(f"{name}.sdf") for name in ("crossroads", "cameras", "radio", "shapes"))
ROD = """<sdf version="1.9"><world name="w"><physics type="roboss"><max_step_size>{dt}</max_step_size></physics><model name="rod">
  <link name="link"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
  <collision name="core"><geometry><sphere><radius>.1</radius></sphere></geometry></collision>
  <visual name="skin"><geometry><capsule><radius>.1</radius><length>.6</length></capsule></geometry></visual></link>
  </model></world></sdf>"""


def entities_of(path):
    """Rows by entity path and component: (time in s, or None if it holds always; value) each."""
    chunks = pytest.importorskip("rerun.chunk", reason="rerun-sdk (the extra roboss[rerun]) is not installed")
    found = {}
    for chunk in chunks.RrdReader(path).stream().to_chunks():
        for row in chunk.to_record_batch().to_pylist():
            time = row.pop("sim_time", None)
            for name, value in row.items():
                if value is not None and not name.startswith("rerun."):
                    seconds = None if time is None else time.total_seconds()
                    found.setdefault(chunk.entity_path, {}).setdefault(name, []).append((seconds, value))
    for components in found.values():
        for rows in components.values():
            rows.sort(key=lambda row: -1 if row[0] is None else row[0])
    return found


def recorded(source, path, *patterns, **options):
    """The entities of a recording, and what record_file() says of it."""
    pytest.importorskip("rerun", reason="rerun-sdk (the extra roboss[rerun]) is not installed")
    done = analysis.record_file(source, path, patterns or None, **options)
    return entities_of(path), done


def pose_at(entities, path, time):
    """(7,) of the newest transform of an entity at a time, as a viewer shows it."""
    parts = [[value[0] for when, value in entities[path][f"Transform3D:{part}"] if when <= time + 1e-9][-1]
             for part in ("translation", "quaternion")]
    return np.concatenate(parts)


def test_without_the_package_an_error_names_the_extra(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)
    path = tmp_path / "run.rrd"
    with pytest.raises(roboss.RobossError, match=r"rerun-sdk.*\n.*roboss\[rerun\]") as caught:
        analysis.record_file(CROSSROADS, path, until=0)
    assert caught.value.code == "no-package" and not path.exists()
    ended, _, errors = analysis_command("record", CROSSROADS, "--until", "0", "-o", str(path))
    assert ended == 1 and "[no-package]" in errors and "roboss[rerun]" in errors and not path.exists()


@pytest.mark.parametrize("name", ["run.rrd", "run.xyz"])
def test_what_is_not_read_is_told(tmp_path, name):
    (tmp_path / name).write_bytes(b"RRF2")
    with pytest.raises(roboss.ArgumentError) as caught:
        analysis.read(tmp_path / name)
    assert caught.value.code == "unknown-format"


def test_robots_and_links_are_where_the_run_has_them(tmp_path):
    entities, done = recorded(CROSSROADS, tmp_path / "run.rrd", "car_[03].pose", until=0.1, every=0.02)
    assert done.variables == ["car_0.pose", "car_3.pose"] and done.samples == 6
    sim = roboss.Simulation(CROSSROADS)
    cars = {path for path in entities if path.startswith("/world/robots/") and path.count("/") == 3}
    assert cars == {f"/world/robots/{name}" for name in sim.world.robots}  # the whole world is drawn
    car = sim.robots("car_3")
    for step in range(6):
        pose = pose_at(entities, "/world/robots/car_3", 0.02 * step)
        assert pose == pytest.approx(car.pose[0], rel=1e-6, abs=1e-6)
        for link in car.links:
            on_robot = pose_at(entities, f"/world/robots/car_3/{link}", 0.02 * step)
            placed = analysis.messages.composed(pose, on_robot)
            assert placed[:3] == pytest.approx(car.link_pose(link)[0, :3], abs=2e-6)
            assert abs(placed[3:] @ car.link_pose(link)[0, 3:]) == pytest.approx(1, abs=1e-6)
        sim.step(10)
    times = [time for time, _ in entities["/world/robots/car_3"]["Transform3D:translation"]]
    assert times == pytest.approx(np.arange(6) * 0.02)
    assert not any(path.startswith("/numbers") for path in entities)  # a pose is no curve


def test_numbers_are_curves_with_their_names_and_units(tmp_path):
    patterns = ["car_3.speed", "car_3.twist", "car_3.laser.ranges"]
    entities, _ = recorded(CROSSROADS, tmp_path / "run.rrd", *patterns, until=0.1)
    straight = analysis.record(CROSSROADS, patterns, until=0.1)
    for name in ("speed", "twist"):
        rows = entities[f"/numbers/car_3/{name}"]["Scalars:scalars"]
        assert [time for time, _ in rows] == pytest.approx(straight.time)
        assert np.array([value for _, value in rows]).squeeze().tolist() == straight[f"car_3.{name}"].tolist()  # every bit
    (_, names), = entities["/numbers/car_3/twist"]["SeriesLines:names"]
    assert names[0] == "car_3.twist.vx (m/s)" and len(names) == 6
    bars = entities["/numbers/car_3/laser/ranges"]["BarChart:values"]
    assert len(bars) == 11 and "/world/robots/car_3" in entities


def test_shapes_of_robots_and_scenery_are_drawn_once(tmp_path):
    entities, _ = recorded(SHAPES, tmp_path / "run.rrd", "*.pose", until=0.1)
    drawn = {}
    for path, components in entities.items():
        for name, rows in components.items():
            if path.startswith("/world") and name.split(":")[0] not in ("Transform3D", "ViewCoordinates"):
                assert len(rows) == 1, (path, name)
                drawn.setdefault(name.split(":")[0], set()).add(path)
    assert {"Boxes3D", "Cylinders3D", "Capsules3D", "Ellipsoids3D", "Mesh3D"} <= drawn.keys()
    scenery = [path for path in entities if path.startswith("/world/scenery/")]
    assert scenery and all(time is None for path in scenery for rows in entities[path].values() for time, _ in rows)


def test_a_capsule_has_its_origin_in_its_middle(tmp_path):
    entities, _ = recorded(roboss.load(ROD.format(dt=0.001)), tmp_path / "run.rrd", until=0)
    capsule = entities["/world/robots/rod/link/visuals/skin"]
    assert capsule["Capsules3D:translations"][0][1][0] == pytest.approx([0, 0, -0.3])
    assert capsule["Capsules3D:lengths"][0][1] == pytest.approx([0.6])


def test_images_stand_below_their_cameras(tmp_path):
    entities, done = recorded(CAMERAS, tmp_path / "run.rrd", "rover.eye.color", "rover.depth.depth", "rover.labels.*",
                              until=0.1, every=0.05)
    sim = roboss.Simulation(CAMERAS)
    sim.step(round(0.1 / sim.dt))
    rover = sim.robots("rover")
    wanted = {"eye/color": ("Image", rover["eye"].read_all()["color"][0]),
              "depth/depth": ("DepthImage", rover["depth"].read_all()["depth"][0]),
              "labels/labels": ("SegmentationImage", rover["labels"].read_all()["labels"][0])}
    for name, (kind, image) in wanted.items():
        rows = entities[f"/world/robots/rover/chassis/{name}"][f"{kind}:buffer"]
        assert len(rows) == done.samples == 3
        assert np.array(rows[-1][1]).astype("u1").tobytes() == image.tobytes()
    lens = entities["/world/robots/rover/chassis/eye"]
    read = rover["eye"].read_all()
    fx, fy, cx, cy = read["intrinsics"][0]
    assert lens["Pinhole:image_from_camera"][0][1][0] == pytest.approx([fx, 0, 0, 0, fy, 0, cx, cy, 1])
    assert lens["Pinhole:resolution"][0][1][0] == pytest.approx(read["color"].shape[2:0:-1])


@pytest.mark.parametrize("source, name, link", [(CROSSROADS, "car_3.laser.scan", "chassis"), (CAMERAS, "rover.scan.points", "chassis")])
def test_scans_are_points_in_the_frame_of_the_laser(tmp_path, source, name, link):
    entities, done = recorded(source, tmp_path / "run.rrd", name, until=0.1, every=0.05)
    robot, sensor, value = name.split(".")
    sim = roboss.Simulation(source)
    sim.step(round(0.1 / sim.dt))
    ranges = sim.robots(robot)[sensor].read_all()["ranges"][0]
    rows = entities[f"/world/robots/{robot}/{link}/{sensor}/{value}"]["Points3D:positions"]
    assert len(rows) == done.samples == 3
    met = ranges[np.isfinite(ranges)]
    assert np.linalg.norm(np.array(rows[-1][1]).reshape(-1, 3), axis=1) == pytest.approx(met, rel=1e-5)
    place = entities[f"/world/robots/{robot}/{link}/{sensor}"]["Transform3D:translation"]
    assert place[0][1][0] == pytest.approx(sim.robots(robot)[sensor]._beams()[1][:3])


def test_contacts_are_arrows_and_radio_messages_are_texts(tmp_path):
    sim = roboss.Simulation(RADIO)
    sim.robots("rover_0")["radio"].send(b"hello")
    entities, _ = recorded(sim, tmp_path / "run.rrd", "rover_1.radio.messages", "contact_points", until=0.5)
    (time, text), = entities["/texts/rover_1/radio/messages"]["TextLog:text"]
    assert 0 < time < 0.5 and "rover_0" in text[0] and text[0].endswith(": hello")
    last = entities["/world/contact_points"]["Arrows3D:origins"][-1]
    assert last[0] == pytest.approx(0.5)
    assert np.array(last[1]) == pytest.approx(sim.contacts["position"], rel=1e-6, abs=1e-6) and len(last[1]) > 0


def test_robots_that_go_are_cleared(branched, tmp_path):
    entities, _ = recorded(roboss.Journal(branched), tmp_path / "run.rrd", until=1.0)
    (time, _), = entities["/world/robots/car_3"]["Clear:is_recursive"]
    assert time == pytest.approx(0.4)
    gone, stays = ([when for when, _ in entities[f"/world/robots/{car}"]["Transform3D:translation"]] for car in ("car_3", "car_2"))
    assert max(gone) < 0.4 and max(stays) == pytest.approx(1.0)
    assert sum(path.endswith("/visuals/body") for path in entities) == 16  # each drawn once


def test_a_journal_looks_as_its_world_file_says(tmp_path):
    from roboss.analysis.recorder import journal_of_run
    world = tmp_path / "world.sdf"
    world.write_text(ROD.format(dt=0.001))
    journal = journal_of_run(world, 0.1, tmp_path)
    visuals = "/world/robots/rod/link/visuals/"
    first, _ = recorded(journal, tmp_path / "first.rrd", "rod.x")
    assert visuals + "skin" in first and visuals + "link" not in first
    world.write_text(ROD.format(dt=0.002))  # another world by now
    second, _ = recorded(journal, tmp_path / "second.rrd", "rod.x")
    assert visuals + "skin" not in second and visuals + "link" in second  # what collides


def test_a_run_that_fails_leaves_its_samples(tmp_path):
    def stop(time, _):
        if time >= 0.05:
            raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt):
        recorded(CROSSROADS, tmp_path / "run.rrd", "car_3.speed", until=10, progress=stop)
    entities = entities_of(tmp_path / "run.rrd")
    assert len(entities["/numbers/car_3/speed"]["Scalars:scalars"]) == 6
    assert len(entities["/world/robots/car_3"]["Transform3D:translation"]) == 6


def test_what_is_written_in_parts_is_the_same(tmp_path, monkeypatch):
    at_once, _ = recorded(CROSSROADS, tmp_path / "one.rrd", "car_3.speed", until=0.2)
    from roboss.analysis import rerun_file, rerun_robots
    monkeypatch.setattr(rerun_file, "_HELD_ROWS", 3)
    monkeypatch.setattr(rerun_robots, "_HELD", 7 * 16 * 6 * 5)  # five samples
    in_parts, _ = recorded(CROSSROADS, tmp_path / "two.rrd", "car_3.speed", until=0.2)
    assert in_parts.keys() == at_once.keys()
    assert in_parts["/numbers/car_3/speed"] == at_once["/numbers/car_3/speed"]
    still = in_parts["/world/robots/car_3/chassis"]["Transform3D:translation"]
    assert len(still) < len(at_once["/world/robots/car_3/chassis"]["Transform3D:translation"]) == 21  # it is fixed to its car
    for path in ("/world/robots/car_3", "/world/robots/car_3/chassis", "/world/robots/car_3/front_left_wheel"):
        for time in np.arange(0, 0.2, 0.01):
            assert pose_at(in_parts, path, time) == pytest.approx(pose_at(at_once, path, time), abs=2e-7)


def test_a_recording_becomes_one_for_rerun(tmp_path):
    analysis.record_file(CROSSROADS, tmp_path / "run.parquet", ["car_3.pose", "car_3.speed"], until=0.1)
    entities, done = recorded(tmp_path / "run.parquet", tmp_path / "run.rrd", "**")
    assert done.samples == 11 and len(entities["/numbers/car_3/speed"]["Scalars:scalars"]) == 11
    assert len(entities["/world/poses/car_3"]["Transform3D:translation"]) == 11


def test_the_command_writes_facts_and_a_view(tmp_path):
    chunks = pytest.importorskip("rerun.chunk", reason="rerun-sdk (the extra roboss[rerun]) is not installed")
    path = tmp_path / "run.rrd"
    for _ in range(2):  # an older recording is replaced
        ended, output, errors = analysis_command("record", CROSSROADS, "car_3.speed", "--until", "0.1", "-o", str(path))
        assert ended == 0 and "1 variables, 11 samples" in output, errors
    assert len(chunks.RrdReader(path).recordings()) == len(chunks.RrdReader(path).blueprints()) == 1
    facts = entities_of(path)["/__properties/roboss"]
    assert facts["world"][0][1] == ["crossroads"] and facts["dt"][0][1] == [0.002]
    (tmp_path / "other.rrd").write_text("keep me")
    ended, _, errors = analysis_command("record", CROSSROADS, "--until", "0", "-o", str(tmp_path / "other.rrd"))
    assert ended == 1 and "[other-kind]" in errors and (tmp_path / "other.rrd").read_text() == "keep me"


def test_a_full_disk_is_told(tmp_path):
    pytest.importorskip("rerun", reason="rerun-sdk (the extra roboss[rerun]) is not installed")
    (tmp_path / "run.rrd").symlink_to("/dev/full")
    ended, _, errors = analysis_command("record", CROSSROADS, "**", "--until", "1", "-o", str(tmp_path / "run.rrd"))
    assert ended == 3 and "[cannot-write]" in errors
