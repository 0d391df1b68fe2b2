"""roboss.connect(): a program at a run of `roboss controller`, against the same program at a Simulation."""
import contextlib
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import roboss

WORLD = roboss.example("crossroads.sdf")


@contextlib.contextmanager
def controller(name, *options, world=WORLD):
    """A run on two Simulators, one of them a process of its own, that waits for the Client "python"."""
    command = [sys.executable, "-P", "-m", "roboss"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    run = subprocess.Popen([*command, "controller", world, "--local", "1", "--simulators", "1", "--simulation", name,
                            "--await-client", "python", "--quiet", *options], **quiet)
    helper = subprocess.Popen([*command, "simulator", "--simulation", name, "--quiet"], **quiet)
    try:
        yield run
    finally:
        for process in (run, helper):
            process.send_signal(signal.SIGINT)
            process.wait(timeout=30)


@pytest.fixture
def name():
    return f"test_{os.getpid()}_{time.monotonic_ns()}"


def drive(sim, steps):
    """Wheels by what lasers and contacts say, pushes, a pose; gives the hash after each step."""
    cars = sim.robots("car_*")
    hashes = []
    for step in range(steps):
        cars.set_joint_targets(4.0 + cars["laser"].read().clip(0, 3).min(axis=1)[:, None] + 0.01 * len(sim.contacts))
        if step % 3 == 1:
            cars[step].apply_wrench([0, 0, 100, 0, 0, 5], ticks=15)
        sim.step(10)
        hashes.append(sim.state_hash)
    return hashes


def test_a_program_has_on_a_cluster_what_it_has_in_its_process(name):
    local = roboss.Simulation(WORLD)
    with controller(name), roboss.connect(name) as remote:
        assert remote.world.hash == local.world.hash and remote.tick == 0
        assert drive(remote, 12) == drive(local, 12)
        there, here = remote.robots("car_*"), local.robots("car_*")
        for value in ("pose", "twist", "joint_position", "joint_velocity", "touching"):
            np.testing.assert_array_equal(getattr(there, value), getattr(here, value))
        np.testing.assert_array_equal(there.link_pose("chassis"), here.link_pose("chassis"))
        assert remote.contacts.tobytes() == local.contacts.tobytes()
        assert remote.seed == local.seed
        assert remote.status()["tick"] == remote.tick == 120 and len(remote.status()["members"]) == 2


def test_radios_hear_what_they_hear_in_one_process(name):
    def relay(sim):
        """Each rover passes on what it hears from the one before; what all heard, and the hash."""
        rovers = sim.robots("rover_*")
        told = []
        for step in range(12):
            if step % 4 == 0:
                rovers[:1]["radio"].send(f"beacon {step}")
            heard = rovers["radio"].receive()
            told.append(heard)
            for k, row in enumerate(heard):
                if row and row[0].sender == f"rover_{k - 1}":
                    rovers[k]["radio"].send(row[0].payload)
            sim.step(10)
        return told, sim.state_hash

    world = roboss.example("radio.sdf")
    with controller(name, "--seed", "3", world=world), roboss.connect(name) as remote:
        there = relay(remote)
    here = relay(roboss.Simulation(world, seed=3))
    assert there == here
    assert any(message.sender == "rover_1" for told in here[0] for message in told[2]), "passed on"


def test_poses_are_orders_and_bonds_hold(name):
    with controller(name, world=roboss.example("bonds.sdf")), roboss.connect(name, period=5) as remote:
        first = remote.world.robots[0]
        robot = remote.robots([first])
        before = robot.pose.copy()
        robot.pose = before + [0, 0, 1.5, 0, 0, 0, 0]
        np.testing.assert_array_equal(robot.pose, before)
        remote.step()
        assert robot.pose[0, 2] == pytest.approx(before[0, 2] + 1.5, abs=0.05) and remote.tick == 5


def test_joint_states_are_orders_with_the_bits_of_a_simulation(name):
    def swing(sim):
        arm = sim.robots("arm")
        goal = np.linspace(0.1, 0.6, arm.joint_position.shape[1])
        hashes = []
        for step in range(6):
            if step % 2 == 0:
                arm.joint_position = goal + 0.1 * step
                arm.joint_velocity = -goal
            sim.step(10)
            hashes.append(sim.state_hash)
        return hashes

    world = roboss.example("arm.sdf")
    local = roboss.Simulation(world)
    with controller(name, world=world), roboss.connect(name, period=10) as remote:
        arm = remote.robots("arm")
        before = arm.joint_position.copy()
        assert swing(remote) == swing(local)
        assert not np.array_equal(arm.joint_position, before)
        with pytest.raises(roboss.OrderError) as refused:
            arm.joint_position = np.full(arm.joint_position.shape, np.nan)
        assert refused.value.code == "not-finite"
        with pytest.raises(roboss.OrderError) as refused:
            arm.joint_velocity = np.full(arm.joint_position.shape, 1e7)
        assert refused.value.code == "beyond-limit"
        with pytest.raises(roboss.ArgumentError):
            arm.joint_position = np.zeros(arm.joint_position.shape[1] + 1)


def test_a_reset_begins_again_with_the_same_bits(name):
    with controller(name), roboss.connect(name) as remote:
        cars = remote.robots("car_*")
        start, pose = remote.state_hash, cars.pose
        first = drive(remote, 5)
        cars.set_joint_targets(9.0)          # dropped by the reset
        remote.reset()
        assert remote.tick == 0 and remote.state_hash == start
        assert np.array_equal(pose, cars.pose) and np.array_equal(pose, remote.robots("car_*").pose)   # a live view
        assert drive(remote, 5) == first
        remote.reset()
        remote.reset()                       # at the start already
        assert remote.tick == 0 and remote.state_hash == start


def test_restores_the_last_save(name, tmp_path):
    with controller(name, "--save-folder", str(tmp_path)), roboss.connect(name) as remote:
        drive(remote, 3)
        at = remote.state_hash
        assert "tick 30" in remote.save("a.state")
        with pytest.raises(roboss.ClusterError) as refused:
            remote.save("a.state")
        assert refused.value.code == "file-exists"
        remote.save("a.state", overwrite=True)
        later = drive(remote, 4)
        remote.restore()
        assert remote.tick == 30 and remote.state_hash == at
        assert drive(remote, 4) == later
    assert (tmp_path / "a.state").is_file()


def test_robots_come_and_go_with_the_bits_of_a_simulation(name):
    local = roboss.Simulation(WORLD)
    ball = """<robot name="ball"><link name="b"><inertial><mass value="1"/>
      <inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><geometry><sphere radius="0.2"/></geometry></collision></link></robot>"""
    with controller(name), roboss.connect(name) as remote:
        old = remote.robots("car_*")
        for sim in (local, remote):
            drive(sim, 2)
            balls = sim.spawn(ball, ["ball_0", "ball_1"], [[0, 0, 2, 0, 0, 0, 1], [0, 0, 3, 0, 0, 0, 1]])
            assert balls.names == ("ball_0", "ball_1") and sim.tick == 20
            drive(sim, 2)
            sim.remove(["car_3", "ball_0"])
            drive(sim, 2)
        assert remote.world.robots == local.world.robots and "car_3" not in remote.world.robots
        np.testing.assert_array_equal(remote.robots("ball_1").pose, local.robots("ball_1").pose)
        assert remote.state_hash == local.state_hash and remote.tick == local.tick == 60
        with pytest.raises(roboss.StateError):
            old.pose
        remote.reset()
        assert remote.world.robots == roboss.Simulation(WORLD).world.robots and remote.tick == 0


_EYES = "".join(f"""<sensor name="{kind}" type="{kind}"><pose>0.3 0 0.1 0 0.2 0</pose><camera>
  <horizontal_fov>1.2</horizontal_fov><image><width>40</width><height>30</height></image><clip><near>0.05</near><far>20</far></clip></camera></sensor>"""
    for kind in ("camera", "depth_camera", "rgbd_camera", "segmentation_camera", "thermal_camera"))


def _rover(name, y, rgb):
    return f"""<model name="{name}"><pose>0 {y} 1 0 0 0.1</pose><link name="body">
  <inertial><mass>1</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>.4 .4 .4</size></box></geometry></collision>
  <visual name="v"><geometry><sphere><radius>.3</radius></sphere></geometry>
  <material><diffuse>{rgb} 1</diffuse></material></visual>{_EYES}</link>
  <plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>5</label></plugin></model>"""


def test_cameras_see_over_the_network_what_they_see_in_one_process(name, tmp_path):
    world = tmp_path / "eyes.sdf"
    world.write_text(f"""<sdf version="1.9"><world name="eyes"><gravity>0 0 0</gravity>
      <light name="sun" type="directional"><direction>.4 .3 -.9</direction><cast_shadows>true</cast_shadows></light>
      <model name="wall"><static>true</static><pose>4 0 1 0 0 0</pose><link name="l"><visual name="v"><geometry>
      <box><size>1 9 2</size></box></geometry><material><diffuse>.9 .6 .2 1</diffuse></material></visual></link></model>
      {_rover("rover_0", -1, ".2 .8 .3")}{_rover("rover_1", 1, ".2 .3 .8")}</world></sdf>""")

    local = roboss.Simulation(str(world))
    with controller(name, world=str(world)), roboss.connect(name) as remote:
        for sim in (local, remote):
            sim.step(10)
        here, there = (sim.robots("rover_*")["camera"].read() for sim in (local, remote))
        np.testing.assert_array_equal(there, here)
        assert len(np.unique(here)) > 10, "not a blank image"
        for kind in ("depth_camera", "segmentation_camera", "thermal_camera"):
            images = [sim.robots("rover_*")[kind].read() for sim in (local, remote)]
            np.testing.assert_array_equal(images[1], images[0])
        for sim in (local, remote):
            added = f'<sdf version="1.9">{_rover("rover_2", 0, ".8 .2 .2")}</sdf>'
            sim.spawn(added, ["rover_2"], [[2.2, -0.6, 0, 0, 0, 0, 1]])
        for robots in ("rover_[01]", "rover_2"):
            here, again = (sim.robots(robots)["camera"].read() for sim in (local, remote))
            np.testing.assert_array_equal(again, here)
        assert not np.array_equal(remote.robots("rover_0")["camera"].read(), there[:1]), "the new robot is seen"


def test_waits_as_long_as_the_program_thinks(name):
    with controller(name), roboss.connect(name) as remote:
        remote.step(20)
        before = remote.state_hash
        time.sleep(3)
        assert remote.state_hash == before
        remote.step(20)
        assert remote.tick == 40


def test_the_run_goes_on_without_a_program_that_leaves(name):
    with controller(name, "--duration", "0.4") as run:
        with roboss.connect(name) as remote:
            remote.step(20)
        assert "closed" in repr(remote)
        with pytest.raises(roboss.StateError):
            remote.step(10)
        assert run.wait(timeout=60) == 0


def test_says_that_the_run_is_over(name):
    with controller(name, "--duration", "0.1"), roboss.connect(name) as remote:
        with pytest.raises(roboss.ClusterError) as over:
            for _ in range(10):
                remote.step(10)
        assert over.value.code == "run-over"


def test_what_a_cluster_cannot_do_is_said(name):
    with controller(name), roboss.connect(name) as remote:
        with pytest.raises(roboss.ArgumentError, match="multiple"):
            remote.step(7)
        with pytest.raises(roboss.StateError, match="view"):
            remote.view
        with pytest.raises(roboss.ClusterError) as refused:
            remote.restore()
        assert refused.value.code == "no-save"
        with pytest.raises(roboss.ClusterError) as refused:
            remote.spawn("<robot name='car_1'/>")
        assert refused.value.remedy
        with pytest.raises(roboss.ArgumentError):
            remote.spawn(remote.world)
        with pytest.raises(roboss.UnknownNameError):
            remote.remove("bus_*")
        assert remote.tick == 0
        with pytest.raises(AttributeError):
            remote.no_such_thing
        with pytest.raises(roboss.ArgumentError):
            remote.control("fly")
        with pytest.raises(roboss.UnknownNameError):
            remote.robots("bus_*")
        with pytest.raises(roboss.OrderError):
            remote.robots("car_*").set_joint_targets(np.nan)
        remote.step(10)


def test_nobody_there():
    start = time.monotonic()
    with pytest.raises(roboss.ClusterError) as missing:
        roboss.connect("nobody", patience=1)
    assert missing.value.code == "no-controller" and "roboss controller" in missing.value.remedy
    assert time.monotonic() - start < 10
    with pytest.raises(roboss.ArgumentError):
        roboss.connect("nobody", period=0)


def test_ctrl_c_ends_waiting():
    timer = threading.Timer(1, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        roboss.connect("nobody", patience=60)
