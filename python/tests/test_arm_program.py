"""examples/arm_program: programs for an arm that somebody else made, here a URDF with six axes."""
import json
import subprocess
import sys

import numpy as np
import pytest

import roboss
from conftest import REPOSITORY

FOLDER = REPOSITORY / "examples" / "arm_program"
sys.path.insert(0, str(FOLDER))
import arm_program  # noqa: E402

AXES = {"yaw": ("0 0 0.3", "0 0 1"), "shoulder": ("0 0 0.1", "0 1 0"), "elbow": ("0 0 0.45", "0 1 0"),
        "roll": ("0 0 0.15", "0 0 1"), "bend": ("0 0 0.25", "0 1 0"), "flange": ("0 0 0.08", "0 0 1")}
PROGRAM = "move 0.4 -0.2 0.4\nline 0.4 -0.2 0.25\nwait 0.5 # grip\nline 0.4 -0.2 0.4\nmove 0.4 0.2 0.4 90\nmove 0.4 -0.2 0.4\n"


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """A URDF of an arm; all joints turn at 2 rad/s at most."""
    inertial = '<inertial><origin xyz="0 0 0.1"/><mass value="2"/><inertia ixx=".02" iyy=".02" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial>'
    text, parent = f'<robot name="six"><link name="foot">{inertial}</link>', "foot"
    for name, (place, axis) in AXES.items():
        text += f'<link name="{name}_link">{inertial}</link><joint name="{name}" type="revolute"><parent link="{parent}"/>' \
                f'<child link="{name}_link"/><origin xyz="{place}"/><axis xyz="{axis}"/>' \
                '<limit lower="-6" upper="6" velocity="2" effort="200"/></joint>'
        parent = f"{name}_link"
    file = tmp_path_factory.mktemp("arm") / "six.urdf"
    file.write_text(text + "</robot>")
    return file


def planner(arm):
    return arm_program.Planner(roboss.load(arm, fixed_base=["six"]))


def test_a_program_is_planned_and_performed(arm):
    plan = planner(arm)
    steps = plan.best(arm_program.read_program(PROGRAM))
    assert all(step.reached for step in steps) and [step.number for step in steps] == [1, 2, 3, 4, 5, 6]
    assert steps[0].time_s < 1e-3 and steps[2].time_s == 0.5   # the cycle begins at its first pose
    for step, (x, y, z) in zip(steps, [(0.4, -0.2, 0.4), (0.4, -0.2, 0.25)]):
        pose = plan.arm.link_pose(step.q[-1], plan.link)
        assert pose == pytest.approx([x, y, z, 1, 0, 0, 0], abs=1e-7) or pose == pytest.approx([x, y, z, -1, 0, 0, 0], abs=1e-7)
    done = arm_program.simulate(roboss.load(arm, fixed_base=["six"]), plan, steps)
    assert done["off_on_the_way_m"] < 1e-6
    assert done["simulated_s"] == pytest.approx(sum(step.time_s for step in steps), abs=0.02)


def test_a_turn_of_one_joint_takes_the_time_of_its_polynomial(arm):
    plan = planner(arm)
    steps = plan.best(arm_program.read_program("move 0.4 0 0.4\nspeed 0.5\nmove 0 0.4 0.4 90"))
    turned = np.abs(steps[1].q[-1] - steps[1].q[0])
    assert turned == pytest.approx([np.pi / 2, 0, 0, 0, 0, 0], abs=1e-6)
    at_full_speed = max(15 / 8 * np.pi / 2 / 2, np.sqrt(10 / np.sqrt(3) * np.pi / 2 / (2 / 0.3)))
    assert steps[1].time_s == pytest.approx(at_full_speed / 0.5, rel=0.01)


def test_a_pose_that_is_out_of_reach_is_named(arm, tmp_path):
    program = tmp_path / "far.txt"
    program.write_text("move 0.4 0 0.4\nmove 2 0 0.4\nline 0.4 0 0.3\n")
    done = subprocess.run([sys.executable, "-P", FOLDER / "arm_program.py", arm, program, "--json"], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 1, done.stderr
    facts = json.loads(done.stdout)
    assert (facts["reached"], facts["poses"]) == (2, 3)
    assert [step["reached"] for step in facts["steps"]] == [True, False, True] and facts["steps"][1]["error_m"] > 0.5


@pytest.mark.parametrize("text", ["", "wait 1", "grip", "move 1 2", "move 1 2 x", "move 1 2 nan", "speed 0", "speed 1.5",
                                  "move 0 0 0\nwait -1"])
def test_programs_that_cannot_be_understood_are_refused(text):
    with pytest.raises(arm_program.ProgramError):
        arm_program.read_program(text)


def test_files_that_do_not_exist_end_with_2(tmp_path):
    assert arm_program.main([str(tmp_path / "none.urdf"), str(FOLDER / "pick_and_place.txt")]) == 2
    assert arm_program.main([roboss.example("arm.sdf"), str(tmp_path / "none.txt")]) == 2
