"""Sets of robots that are alike but for their names, and of robots of different types."""
import numpy as np
import pytest

import roboss
from test_errors import refused


def _rover(name: str, *, mass: float = 4, own_names: bool = False, sensors: str = "", topic: str = "") -> str:
    own = f"{name}_" if own_names else ""
    wheels = "".join(f"""
      <link name="{own}{side}"><pose>0 {y} .1 -1.5708 0 0</pose>
        <inertial><mass>.5</mass><inertia><ixx>.001</ixx><iyy>.001</iyy><izz>.002</izz></inertia></inertial>
        <collision name="c"><geometry><cylinder><radius>.1</radius><length>.05</length></cylinder></geometry></collision>
      </link>
      <joint name="{own}{side}_joint" type="revolute"><parent>{own}base</parent><child>{own}{side}</child>
        <axis><xyz>0 0 1</xyz><limit><effort>5</effort></limit></axis></joint>"""
                     for side, y in (("left", .2), ("right", -.2)))
    return f"""
    <model name="{name}"><pose>{3 * len(name) + ord(name[-1])} 0 0 0 0 0</pose>
      <link name="{own}base"><pose>0 0 .1 0 0 0</pose>
        <inertial><mass>{mass}</mass><inertia><ixx>.05</ixx><iyy>.05</iyy><izz>.05</izz></inertia></inertial>
        <collision name="c"><geometry><box><size>.4 .3 .05</size></box></geometry></collision>{sensors}</link>{wheels}
      <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
        <left_joint>{own}left_joint</left_joint><right_joint>{own}right_joint</right_joint>
        <wheel_separation>.4</wheel_separation><wheel_radius>.1</wheel_radius>
        <topic>{topic or f"/{name}/cmd_vel"}</topic></plugin>
    </model>"""


def _laser(name: str = "laser", samples: int = 8) -> str:
    return f"""<sensor name="{name}" type="gpu_lidar"><update_rate>10</update_rate><lidar><scan><horizontal>
      <samples>{samples}</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
      <range><min>.1</min><max>5</max></range></lidar></sensor>"""


def _camera(columns: int) -> str:
    return f"""<sensor name="eye" type="camera"><camera><image><width>{columns}</width><height>4</height></image>
      </camera></sensor>"""


def _robots(*models: str, wanted: str = "*") -> roboss.Robots:
    world = roboss.load(f"<sdf version='1.9'><world name='w'>{''.join(models)}</world></sdf>", ground=True)
    return roboss.Simulation(world).robots(wanted)


def test_robots_that_differ_in_topics_take_one_command():
    rovers = _robots(*(_rover(f"rover_{n}") for n in range(4)))
    assert list(rovers.commands) == ["cmd_vel", "enable"]
    rovers.command("cmd_vel", linear_x=[0.1, 0.2, 0.3, 0.4])
    rovers.simulation.step(2000)
    np.testing.assert_allclose(rovers.joint_velocity[:, 0], [1, 2, 3, 4], atol=0.05)


def test_the_first_robots_own_name_of_a_command_will_do():
    rovers = _robots(_rover("a"), _rover("b"))
    rovers.command("a/cmd_vel", linear_x=0.2)
    rovers.simulation.step(2000)
    np.testing.assert_allclose(rovers.joint_velocity, 2, atol=0.05)
    with pytest.raises(roboss.UnknownNameError) as error:
        rovers.command("vel", linear_x=1)
    refused(error, "unknown-name", "vel", "cmd_vel")


def test_robots_of_one_type_share_joints_under_any_names():
    rovers = _robots(_rover("a", own_names=True), _rover("b", own_names=True), wanted="?")
    assert rovers.joints == ("a_left_joint", "a_right_joint")
    rovers.joint_position = [[1, 2], [3, 4]]
    assert rovers[1].joint_position.tolist() == [[3, 4]] and rovers[1].joints == ("b_left_joint", "b_right_joint")
    assert rovers.links == ("a_base", "a_left", "a_right") and rovers.link_pose("a_left").shape == (2, 7)
    assert np.isfinite(rovers.joint_limits).any() or rovers.joint_effort_limits.tolist() == [5, 5]
    rovers.qpos = rovers.qpos
    rovers.set_joint_targets(1.0, "a_right_joint")


def test_sets_of_different_types_have_what_all_members_have():
    mixed = _robots(_rover("a", sensors=_laser() + _laser("rear")), _rover("b", mass=7, sensors=_laser()))
    assert mixed.joints == ("left_joint", "right_joint") and mixed.sensors == ("laser", "odometry")
    assert mixed["laser"].read().shape == (2, 8)
    mixed.command("cmd_vel", linear_x=[0.1, 0.3])
    mixed.simulation.step(2000)
    np.testing.assert_allclose(mixed.joint_velocity[:, 1], [1, 3], atol=0.05)
    mixed.apply_wrench([0, 0, 500, 0, 0, 0], ticks=5)
    mixed.set_joint_targets([1, 2])
    assert mixed.energy.shape == (2, 2) and mixed.joint_effort_limits.tolist() == [5, 5]


def test_a_name_that_only_some_have_names_the_others():
    mixed = _robots(_rover("a", sensors=_laser() + _laser("rear")), _rover("b", mass=7, sensors=_laser()), _rover("c"))
    with pytest.raises(roboss.UnknownNameError) as error:
        mixed["rear"]
    refused(error, "not-shared", "2 of these 3", "b, c")
    with pytest.raises(roboss.UnknownNameError) as error:
        mixed["front"]
    refused(error, "unknown-name", "front")


def test_sensors_of_one_name_and_different_kinds_are_not_shared():
    imu = '<sensor name="laser" type="imu"/>'
    with pytest.raises(roboss.ArgumentError) as error:
        _robots(_rover("a", sensors=_laser()), _rover("b", sensors=imu))["laser"]
    refused(error, "mixed-types", "laser")


def test_joints_of_one_name_and_different_kinds_are_not_shared():
    def slider(name: str, joint: str, kind: str) -> str:
        body = "<inertial><mass>1</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>"
        return (f"<model name='{name}'><link name='a'>{body}</link><link name='b'>{body}</link>"
                f"<joint name='{joint}' type='{kind}'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis>"
                "</joint></model>")

    for joint, words in (("left", ("joint 'left' each", "different kinds")), ("right", ("no joint in common",))):
        mixed = _robots(slider("turns", "left", "revolute"), slider("slides", joint, "prismatic"))
        for ask in (lambda: mixed.joints, lambda: mixed.joint_position, lambda: mixed.set_joint_targets(1.0)):
            with pytest.raises(roboss.ArgumentError) as error:
                ask()
            refused(error, "mixed-types", *words)


def test_lasers_of_different_sizes_are_a_list():
    ranges = _robots(_rover("a", sensors=_laser()), _rover("b", sensors=_laser(samples=5)))["laser"].read()
    assert [len(row) for row in ranges] == [8, 5]


def test_images_of_different_sizes_are_refused():
    robots = _robots(_rover("a", sensors=_camera(6)), _rover("b", sensors=_camera(8)))
    assert robots[:1]["eye"].read().shape == (1, 4, 6, 3)
    with pytest.raises(roboss.SensorError) as error:
        robots["eye"].read()
    refused(error, "mixed-shapes")


def test_limits_and_qpos_of_different_types_are_refused():
    arm = _rover("b", mass=7).replace("<effort>5<", "<effort>6<")
    mixed = _robots(_rover("a"), arm)
    for ask in (lambda: mixed.joint_limits, lambda: mixed.qpos):
        with pytest.raises(roboss.ArgumentError) as error:
            ask()
        refused(error, "mixed-types")


def test_a_set_of_no_robots_has_no_types():
    none = _robots(_rover("a"))[:0]
    with pytest.raises(roboss.ArgumentError) as error:
        none.joints
    refused(error, "no-robot")
