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


def test_poses_are_orders_and_bonds_hold(name):
    with controller(name, world=roboss.example("bonds.sdf")), roboss.connect(name, period=5) as remote:
        first = remote.world.robots[0]
        robot = remote.robots([first])
        before = robot.pose.copy()
        robot.pose = before + [0, 0, 1.5, 0, 0, 0, 0]
        np.testing.assert_array_equal(robot.pose, before)
        remote.step()
        assert robot.pose[0, 2] == pytest.approx(before[0, 2] + 1.5, abs=0.05) and remote.tick == 5


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
        with pytest.raises(roboss.OrderError) as refused:
            remote.robots("car_*").joint_position = 0.0
        assert refused.value.code == "remote"
        for call in ("reset", "save", "spawn", "view"):
            with pytest.raises(roboss.StateError, match=call):
                getattr(remote, call)
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
