"""Errors are exceptions that name the thing, list what exists, and leave the world as it was."""
import numpy as np
import pytest

import roboss

BALL = """<sdf version="1.9"><world name="w">
<model name="ball"><link name="body"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz>
</inertia></inertial>{}
</link></model></world></sdf>"""


def refused(error, code, *words):
    assert error.value.code == code, str(error.value)
    for word in words:
        assert word in str(error.value)


def test_names_that_do_not_exist(crossroads):
    cars = crossroads.robots("car_*")
    with pytest.raises(roboss.UnknownNameError) as error:
        crossroads.robots(["car_1", "cat_2"])
    refused(error, "unknown-name", "cat_2", "did you mean 'car_2'", "car_0")
    with pytest.raises(roboss.UnknownNameError) as error:
        crossroads.robots("truck*")
    refused(error, "unknown-name", "truck*", "car_0")
    with pytest.raises(roboss.UnknownNameError) as error:
        cars.set_joint_targets(1, ["front_lefd"])
    refused(error, "unknown-name", "front_lefd", "front_left", "rear_right")
    with pytest.raises(roboss.UnknownNameError) as error:
        cars["scan"]
    refused(error, "unknown-name", "scan", "laser", "odometer")
    with pytest.raises(roboss.UnknownNameError) as error:
        cars.apply_wrench(0, "wing")
    refused(error, "unknown-name", "wing", "chassis")
    with pytest.raises(roboss.UnknownNameError):
        cars.command("cmd_vel", 1)
    with pytest.raises(roboss.UnknownNameError):
        cars.set_joint_targets(1, mode="torque")
    with pytest.raises(roboss.UnknownNameError):
        roboss.example("town.sdf")


@pytest.mark.parametrize("threads", [-1, 0, 1025, 10**9])
def test_numbers_of_threads_that_cannot_be(threads):
    ball = BALL.format("")
    for make in (lambda: roboss.Simulation(ball, threads=threads), lambda: roboss.Batch(ball, 1, threads=threads)):
        with pytest.raises(roboss.ArgumentError) as error:
            make()
        refused(error, "bad-threads", str(threads), "1024")


def test_arrays_that_do_not_fit(crossroads):
    cars = crossroads.robots("car_*")
    for wrong in (np.zeros((15, 7)), np.zeros(16), "far away", [[1, 2], [3]]):
        with pytest.raises(roboss.ArgumentError):
            cars.pose = wrong
    with pytest.raises(roboss.ArgumentError) as error:
        cars.set_joint_targets(np.zeros((16, 3)))
    refused(error, "bad-shape", "(16, 3)", "(16, 4)")
    with pytest.raises(roboss.ArgumentError):
        crossroads.step(-1)
    for wrong in (1.5, "10", None, True, 2**70):
        with pytest.raises(roboss.ArgumentError) as error:
            crossroads.step(wrong)
        refused(error, "bad-value" if wrong == 2**70 else "bad-type", "ticks")


def test_what_a_robot_refuses_changes_nothing(crossroads):
    cars = crossroads.robots("car_*")
    before = crossroads.state_hash
    poses = cars.pose.copy()
    poses[0, 0] += 1
    poses[5, 1] = np.nan
    with pytest.raises(roboss.OrderError) as error:
        cars.pose = poses
    refused(error, "not-finite", "car_5")
    with pytest.raises(roboss.OrderError) as error:
        cars.twist = [1e9, 0, 0, 0, 0, 0]
    refused(error, "beyond-limit", "car_0")
    with pytest.raises(roboss.OrderError) as error:
        cars.joint_velocity = np.inf
    refused(error, "not-finite", "front_left", "car_0")
    with pytest.raises(roboss.OrderError):
        cars.set_joint_targets(np.nan)
    with pytest.raises(roboss.OrderError):
        cars.apply_wrench(1, ticks=0)
    assert crossroads.state_hash == before
    crossroads.step(10)
    fresh = roboss.Simulation(crossroads.world)
    fresh.step(10)
    assert crossroads.state_hash == fresh.state_hash  # no order of the refused calls was left


def test_a_state_that_is_not_finite_stops_at_its_tick():
    text = BALL.format("").replace("<iyy>1", "<iyy>2").replace("<mass>1", "<mass>1e-3")
    sim = roboss.Simulation(roboss.load(text.replace(">1<", ">1e-6<").replace(">2<", ">2e-6<"), dt=0.1))
    ball = sim.robots("ball")
    ball.apply_wrench([0, 0, 0, 1e9, 1e9, 1e9], ticks=100)
    with pytest.raises(roboss.StateError) as error:
        sim.step(100)
    refused(error, "not-finite", "ball")
    assert sim.tick < 100 and np.isfinite(ball.pose).all() and np.isfinite(ball.twist).all()
    sim.reset()
    sim.step(10)
    assert sim.tick == 10


def test_arguments_of_the_wrong_type_raise_errors_of_the_package(crossroads):
    """None of them shows the text of the binding ("incompatible function arguments")."""
    cars = crossroads.robots("car_*")
    calls = [lambda: roboss.Simulation(crossroads.world, threads="2"), lambda: roboss.Simulation(crossroads.world, seed=0.5),
             lambda: crossroads.restore("save"), lambda: crossroads.reset("a"), lambda: roboss.Batch(crossroads.world, "3"),
             lambda: roboss.Batch(crossroads.world, 1).step([1]), lambda: cars.apply_wrench([0] * 6, ticks=2.5),
             lambda: cars.set_joint_targets(1.0, max_effort="much"), lambda: crossroads.attach("car_0", "car_1", reach="far"),
             lambda: crossroads.view(port="8090"), lambda: roboss.connect(period=1.5), lambda: roboss.connect(patience=None)]
    for number, call in enumerate(calls):
        with pytest.raises(roboss.ArgumentError) as error:
            call()
        assert error.value.code == "bad-type" and error.value.remedy, number
    assert crossroads.step(np.int64(2)) is None and crossroads.tick == 2


def test_robots_of_several_types():
    sim = roboss.Simulation(roboss.example("pile.sdf"))
    everything = sim.robots()
    assert everything.pose.shape == (len(everything), 7)
    with pytest.raises(roboss.ArgumentError) as error:
        everything.joint_position
    refused(error, "mixed-types")


def test_a_save_of_another_world(crossroads):
    with pytest.raises(roboss.SaveError) as error:
        crossroads.restore(roboss.Simulation(roboss.example("pile.sdf")).save())
    refused(error, "other-world")


def test_worlds_that_cannot_be_used():
    with pytest.raises(roboss.WorldError) as error:
        roboss.load("<sdf version='1.9'>\n<world name='w'>\n<oops</world></sdf>")
    assert "<text>:" in str(error.value) and error.value.diagnostics[0].severity == "error"
    with pytest.raises(roboss.WorldError) as error:
        roboss.load("no_such_file.sdf")
    refused(error, "cannot-read", "no_such_file.sdf")
    with pytest.raises(roboss.WorldError) as error:
        roboss.Simulation(roboss.example("errands.sdf"))
    refused(error, "message-board")
    with pytest.raises(roboss.WorldError) as error:
        roboss.load(roboss.example("pile.sdf"), fixed_base=["nobody"])
    refused(error, "no-model", "nobody")
    assert issubclass(roboss.WorldError, ValueError) and issubclass(roboss.StateError, RuntimeError)


def test_warnings_have_file_and_line():
    with pytest.warns(roboss.WorldWarning, match=r"<text>:3: warning: .*oops"):
        world = roboss.load(BALL.format("<oops/>"))
    assert [(found.file, found.line) for found in world.diagnostics if found.severity == "warning"] == [("<text>", 3)]


def test_breadcrumbs_that_are_stored_below_the_world_do_not_overlap():
    found = [finding.code for finding in roboss.load(roboss.example("errands.sdf")).diagnostics]
    assert "start-overlap" not in found


def test_a_model_with_errors_is_left_out_or_refused():
    bad = BALL[BALL.index("<model"):BALL.index("</world>")].format(
        "<collision name='c'><geometry><sphere><radius>-1</radius></sphere></geometry></collision>")
    text = BALL.format("").replace("</world>", bad.replace("ball", "bad") + "</world>")
    with pytest.warns(roboss.WorldWarning, match="bad"):
        assert roboss.load(text).robots == ("ball",)
    with pytest.raises(roboss.WorldError):
        roboss.load(text, strict=True)


CUBE = """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="s">
<float_array id="a" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common>
<accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="vs"><node id="n">{}
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>"""

SCENERY = """<sdf version="1.9"><world name="w"><model name="m"><static>true</static><link name="l">
<collision name="c"><geometry><mesh><uri>cube.dae</uri></mesh></geometry></collision></link></model></world></sdf>"""


def test_a_mesh_that_breaks_an_assertion_of_its_reader(tmp_path):
    """assimp ends the program that it is in, unless its assertions are replaced or it is read apart."""
    world = tmp_path / "world.sdf"
    world.write_text(SCENERY)
    (tmp_path / "cube.dae").write_text(CUBE.format(""))
    roboss.load(world)
    (tmp_path / "cube.dae").write_text(CUBE.format("<skew>1 2 3 4 5 6 7</skew>"))
    with pytest.raises(roboss.WorldError) as error:
        roboss.load(world)
    assert "cube.dae" in str(error.value)
