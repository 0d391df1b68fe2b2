"""Sensors of many robots in one call."""
import numpy as np
import pytest

import roboss

WORLD = """<sdf version="1.9"><world name="w">
<physics name="p" type="ode"><max_step_size>0.001</max_step_size></physics>
<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision>
</link></model>
<model name="box_0"><pose>0 0 0.1 0 0 0</pose>{link}</model>
<model name="box_1"><pose>2 0 0.15 0 0 1.5707963267948966</pose>{link}</model>
</world></sdf>"""
LINK = """<link name="body"><inertial><mass>2</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>
<collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry></collision>
<sensor name="imu" type="imu"/>
<sensor name="touch" type="contact"><contact><collision>c</collision></contact></sensor>
<sensor name="beam" type="lidar"><lidar><scan><horizontal><samples>1</samples><min_angle>0</min_angle>
<max_angle>0</max_angle></horizontal></scan><range><min>.01</min><max>5</max></range></lidar></sensor>
<sensor name="eye" type="logical_camera"><logical_camera><near>.1</near><far>5</far><aspect_ratio>1</aspect_ratio>
<horizontal_fov>1</horizontal_fov></logical_camera></sensor></link>"""


@pytest.fixture
def boxes():
    """A box that stands, and one that falls and looks along y."""
    sim = roboss.Simulation(roboss.load(WORLD.format(link=LINK)), threads=1)
    sim.step(20)
    return sim.robots("box_*")


def test_lists_its_sensors(boxes):
    assert boxes.sensors == ("imu", "touch", "beam", "eye")
    assert boxes["beam"].kind == "laser" and boxes["beam"].units["ranges"] == "m"


def test_a_beam_sees_the_other_box(boxes):
    assert boxes["beam"].read().shape == (2, 1)
    assert np.allclose(boxes["beam"].read(), [[1.9], [np.inf]], atol=1e-2)


def test_an_imu_feels_the_ground(boxes):
    reading = boxes["imu"].read_all()
    assert reading["specific_force"].shape == (2, 3)
    assert np.allclose(reading["specific_force"], [[0, 0, 9.8], [0, 0, 0]], atol=0.02)
    assert np.array_equal(boxes["imu"].read(), reading["specific_force"])


def test_values_whose_number_differs_are_lists(boxes):
    reading = boxes["touch"].read_all()
    standing, falling = reading["forces"]
    assert standing.shape[1] == 3 and falling.shape == (0, 3)
    assert np.isclose(standing[:, 2].sum(), 2 * 9.8, rtol=1e-2)


def test_texts_and_quaternions(boxes):
    reading = boxes["eye"].read_all()
    assert "box_1" in reading["names"][0] and reading["names"][1] == []
    seen = reading["names"][0].index("box_1")
    assert np.allclose(np.abs(reading["orientations_quat_xyzw"][0][seen]), [0, 0, 0.5**0.5, 0.5**0.5], atol=1e-6)
    assert reading["positions"][0][seen].shape == (3,)


def test_reads_the_same_as_one_by_one():
    cars = roboss.Simulation(roboss.example("city.sdf"), seed=3).robots("car_*")
    cars.simulation.step(5)
    for name in cars.sensors:
        together = cars[name].read()
        alone = np.concatenate([cars[number][name].read() for number in (0, 7, 49)])
        assert np.array_equal(together[[0, 7, 49]], alone)


def test_an_arm_with_infrared_effort_and_stereo_cameras():
    world = """<sdf version="1.9" xmlns:roboss="urn:roboss:1"><world name="w">
    <model name="wall"><static>true</static><pose>1.5 0 1 0 0 0</pose><link name="l"><collision name="c">
    <laser_retro>40</laser_retro><geometry><box><size>1 9 9</size></box></geometry></collision></link></model>
    <model name="arm"><link name="base"><inertial><mass>1</mass>
    <inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
    <roboss:sensor name="ir" type="infrared"><pose>0 0 0.5 0 0 0</pose><max>2</max></roboss:sensor>
    <roboss:sensor name="effort" type="joint_effort"><joint>hinge</joint></roboss:sensor>
    <sensor name="imu" type="imu"><imu><orientation_reference_frame><localization>NED</localization>
    </orientation_reference_frame></imu></sensor>
    <sensor name="scan" type="lidar"><lidar><scan><horizontal><roboss:angles>-0.5 0 0.3</roboss:angles></horizontal></scan>
    <range><min>.01</min><max>5</max></range></lidar></sensor></link>
    <link name="rod"><pose>0 0 2 0 0 0</pose><inertial><pose>0.5 0 0 0 0 0</pose><mass>2</mass>
    <inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>
    <joint name="weld" type="fixed"><parent>world</parent><child>base</child></joint>
    <joint name="hinge" type="revolute"><parent>base</parent><child>rod</child><axis><xyz>0 1 0</xyz>
    <limit><lower>0</lower><upper>1</upper></limit></axis></joint></model></world></sdf>"""
    sim = roboss.Simulation(roboss.load(world), threads=1)
    arm = sim.robots("arm")
    assert np.isclose(arm["ir"].read()[0], 1.0)
    scan = arm["scan"].read_all()
    assert np.allclose(scan["ranges"], [1 / np.cos([-0.5, 0, 0.3])])
    assert np.array_equal(scan["intensities"], [[40, 40, 40]])
    # north is y, down is -z: x of the base, which looks east, has the coordinates (0, 1, 0)
    quat = arm["imu"].read_all()["orientation_quat_xyzw"][0]
    assert np.allclose(np.abs(quat), [0.5**0.5, 0.5**0.5, 0, 0], atol=1e-9)
    sim.robots("arm").set_joint_targets(0.2, mode="position")
    sim.step(1000)
    angle = sim.robots("arm").joint_position[0, 0]
    assert np.isclose(arm["effort"].read()[0, 0], -2 * 9.8 * 0.5 * np.cos(angle), rtol=1e-3)
