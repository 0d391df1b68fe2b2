"""Cameras of world files: images against closed forms, labels, boxes, temperatures, noise."""
import numpy as np
import pytest

import roboss

_EYE = """<sensor name="{name}" type="{type}"><pose>0 0 0 0 0 0</pose>{extra}<camera>
  <horizontal_fov>1.2</horizontal_fov><image><width>{width}</width><height>{height}</height></image>
  <clip><near>0.05</near><far>40</far></clip>{more}</camera></sensor>"""


def _eye(name: str, type: str, more: str = "", extra: str = "", width: int = 80, height: int = 60) -> str:
    return _EYE.format(name=name, type=type, more=more, extra=extra, width=width, height=height)


def _thing(name: str, pose: str, geometry: str, plugins: str = "", visual: str = "", rgb: str = "1 0 0 1",
           static: bool = True) -> str:
    return f"""<model name="{name}"><static>{str(static).lower()}</static><pose>{pose}</pose><link name="l">
      <visual name="v"><geometry>{geometry}</geometry><material><diffuse>{rgb}</diffuse></material>{visual}</visual>
      </link>{plugins}</model>"""


_INERTIAL = ("<inertial><mass>1</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz><ixy>0</ixy><ixz>0</ixz>"
             "<iyz>0</iyz></inertia></inertial>")
_LABEL = '<plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>{}</label></plugin>'
_HEAT = ('<plugin filename="gz-sim-thermal-system" name="gz::sim::systems::Thermal"><temperature>{}</temperature>'
         '</plugin>')


def _world(sensors: str, things: str) -> str:
    return f"""<sdf version="1.9"><world name="w"><gravity>0 0 0</gravity>
      <light name="sun" type="directional"><direction>0.5 0.2 -0.9</direction><cast_shadows>true</cast_shadows></light>
      {things}
      <model name="rover"><pose>0 0 1 0 0 0</pose><link name="body">
        {_INERTIAL}
        <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
        <visual name="shell"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual>
        {sensors}</link></model></world></sdf>"""


_BOX = "<box><size>2 2 2</size></box>"
_BALL = "<sphere><radius>0.5</radius></sphere>"


def _rover(sensors: str, things: str, seed: int = 0) -> roboss.Robots:
    return roboss.Simulation(_world(sensors, things), seed=seed).robots("rover")


def test_a_colour_camera_sees_the_colours_of_visuals_from_inside_its_housing():
    image = _rover(_eye("eye", "camera"), _thing("wall", "6 0 1 0 0 0", _BOX))["eye"].read()
    assert image.shape == (1, 60, 80, 3) and image.dtype == np.uint8
    red = image[0, 30, 40].astype(int)
    assert red[0] > 80 and red[1] < 30 and red[2] < 30


def test_depth_is_measured_along_the_axis_and_clipped():
    depth = _rover(_eye("eye", "depth_camera"), _thing("wall", "6 0 1 0 0 0", _BOX))["eye"].read()
    assert depth.shape == (1, 60, 80) and depth.dtype == np.float32
    assert depth[0, 30, 40] == np.float32(5) and depth[0, 27, 45] == np.float32(5)  # a plane: the same depth
    assert np.isinf(depth[0, 0, 0])
    near = _rover(_eye("eye", "depth_camera").replace("0.05", "5.5"), _thing("wall", "6 0 1 0 0 0", _BOX))
    assert near["eye"].read()[0, 30, 40] == -np.inf


def test_points_are_seen_where_the_intrinsics_say():
    sensors = _eye("eye", "rgbd_camera", width=320, height=240)
    reading = _rover(sensors, _thing("ball", "5 1 1.5 0 0 0", "<sphere><radius>0.1</radius></sphere>"))["eye"].read_all()
    fx, fy, cx, cy = reading["intrinsics"][0]
    assert fx == pytest.approx(160 / np.tan(0.6)) and (cx, cy) == (160, 120)
    rows, columns = np.nonzero(np.isfinite(reading["depth"][0]))
    assert columns.mean() + 0.5 == pytest.approx(cx - fx * 1 / 5, abs=0.3)
    assert rows.mean() + 0.5 == pytest.approx(cy - fy * 0.5 / 5, abs=0.3)
    assert reading["color"].shape == (1, 240, 320, 3)


def test_labels_and_instances():
    things = (_thing("a", "6 1.5 1 0 0 0", _BALL, _LABEL.format(7)) + _thing("b", "6 -1.5 1 0 0 0", _BALL, _LABEL.format(7))
              + _thing("c", "6 0 1 0 0 0", _BALL, visual=_LABEL.format(9)) + _thing("d", "9 0 2.5 0 0 0", _BALL))
    reading = _rover(_eye("eye", "segmentation_camera", "<segmentation_type>instance</segmentation_type>"), things)["eye"]
    seen = reading.read_all()
    assert set(np.unique(seen["labels"])) == {0, 7, 9}
    left = seen["instances"][0][:, :40][seen["labels"][0][:, :40] == 7]
    right = seen["instances"][0][:, 40:][seen["labels"][0][:, 40:] == 7]
    assert set(left) == {1} and set(right) == {2}
    assert reading.read().dtype == np.uint8


def test_boxes_bound_what_is_seen_and_the_projected_corners():
    things = _thing("a", "6 0 1 0 0 0", _BOX, _LABEL.format(3)) + _thing("hides", "3 0.5 1 0 0 0", "<box><size>0.1 1 4</size></box>")
    sensors = (_eye("full", "boundingbox_camera", "<box_type>full_2d</box_type>", width=320, height=240)
               + _eye("visible", "boundingbox_camera", "<box_type>visible_2d</box_type>", width=320, height=240)
               + _eye("solid", "boundingbox_camera", "<box_type>3d</box_type>"))
    rover = _rover(sensors, things)
    f = 160 / np.tan(0.6)
    full = rover["full"].read()
    assert full.shape == (1, 1, 4)
    np.testing.assert_allclose(full[0, 0], [160 - f / 5, 120 - f / 5, 160 + f / 5, 120 + f / 5], atol=1e-9)
    visible = rover["visible"].read()[0, 0]
    assert visible[0] == pytest.approx(160, abs=1.01)  # its left half is hidden
    assert visible[2] == pytest.approx(160 + f / 5, abs=1.01)
    solid = rover["solid"].read_all()
    np.testing.assert_allclose(solid["positions"][0, 0], [6, 0, 0], atol=1e-12)
    np.testing.assert_allclose(solid["sizes"][0, 0], [2, 2, 2], atol=1e-12)
    assert solid["labels"].tolist() == [[3]]
    assert "boxes" not in solid


def test_temperatures():
    things = _thing("hot", "6 0 1 0 0 0", _BOX, visual=_HEAT.format(350.123))
    extra = ('<plugin filename="gz-sim-thermal-sensor-system" name="gz::sim::systems::ThermalSensor">'
             '<min_temp>253.15</min_temp><max_temp>673.15</max_temp><resolution>0.5</resolution></plugin>')
    image = _rover(_eye("eye", "thermal_camera", extra=extra), things)["eye"].read()
    assert image[0, 30, 40] == 350 and image[0, 0, 0] == 288


def test_noise_has_its_mean_and_deviation_and_follows_the_seed():
    noise = "<noise><type>gaussian</type><mean>0.1</mean><stddev>0.05</stddev></noise>"
    things = _thing("wall", "6 0 1 0 0 0", "<box><size>2 40 40</size></box>")
    rover = _rover(_eye("eye", "depth_camera", noise), things, seed=5)
    error = rover["eye"].read()[0].astype(float) - 5
    assert error.mean() == pytest.approx(0.1, abs=4 * 0.05 / np.sqrt(error.size))
    assert error.std() == pytest.approx(0.05, rel=0.05)
    again = _rover(_eye("eye", "depth_camera", noise), things, seed=5)["eye"].read()
    np.testing.assert_array_equal(rover["eye"].read(), again)
    assert (_rover(_eye("eye", "depth_camera", noise), things, seed=6)["eye"].read() != again).any()


def test_images_have_the_same_bits_for_all_threads_and_in_batches():
    source = _world(_eye("eye", "camera"), _thing("wall", "6 0 1 0 0.4 0", _BOX))
    images = [roboss.Simulation(source, threads=n).robots("rover")["eye"].read() for n in (1, 2, 5)]
    np.testing.assert_array_equal(images[0], images[1])
    np.testing.assert_array_equal(images[0], images[2])
    batch = roboss.Batch(source, 3, threads=2).robots("rover")["eye"].read()
    assert batch.shape == (3, 1, 60, 80, 3)
    for one in batch:
        np.testing.assert_array_equal(one, images[0])


def _depth_of_ball(distance: float) -> float:
    """Of _BALL ahead, in pixel (30, 40) of _eye: by the closed form."""
    offset = 0.5 * np.tan(0.6) / 40
    dd = 1 + 2 * offset**2
    return (distance - np.sqrt(distance**2 - dd * (distance**2 - 0.25))) / dd


def test_an_image_follows_what_moves():
    sim = roboss.Simulation(_world(_eye("eye", "depth_camera"), "")
                            .replace("<model name=\"rover\">", _thing("ball", "6 0 1 0 0 0", _BALL, static=False)
                                     .replace("<link name=\"l\">", "<link name='l'>" + _INERTIAL)
                                     + "<model name=\"rover\">"))
    eye, ball = sim.robots("rover")["eye"], sim.robots("ball")
    assert eye.read()[0, 30, 40] == pytest.approx(_depth_of_ball(6), abs=1e-6)
    ball.pose = [[9, 0, 1, 0, 0, 0, 1]]
    assert eye.read()[0, 30, 40] == pytest.approx(_depth_of_ball(9), abs=1e-6)


def test_cameras_that_cannot_see_are_errors_of_the_world():
    with pytest.raises(roboss.WorldError, match="near"):
        roboss.load(_world(_eye("eye", "camera").replace("0.05", "90"), ""))
