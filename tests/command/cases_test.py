"""Small files from other people's reports (tests/cases), each with the value that is right for it."""
import csv
import json
import math
import sys
import unittest
from pathlib import Path

CASES = Path(sys.argv.pop(4))

from running import FOLDER, RobossTest, roboss, summary  # noqa: E402


def trace(file, *options, seconds=1.0):
    """{(robot, link): rows by time} of a run."""
    path = FOLDER / "trace.csv"
    summary(file, "--headless", "--duration", seconds, "--trace", path, *options)
    rows = {}
    with open(path, newline="") as lines:
        for row in csv.DictReader(lines):
            rows.setdefault((row["robot"], row["link"]), []).append(
                {key: value if key in ("robot", "link") else float(value) for key, value in row.items()})
    return rows


def orders(*lines):
    path = FOLDER / "orders.jsonl"
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return ["--orders", path]


def yaw(row):
    return math.atan2(2 * (row["qw"] * row["qz"] + row["qx"] * row["qy"]), 1 - 2 * (row["qy"]**2 + row["qz"]**2))


def pitch(row):
    return math.asin(max(-1, min(1, 2 * (row["qw"] * row["qy"] - row["qz"] * row["qx"]))))


def checked(file, *options):
    """What `roboss check --json` says."""
    return json.loads(roboss("check", "--json", "--names", file, *options).stdout)


def codes(report, severity):
    return [finding["code"] for finding in report["diagnostics"] if finding["severity"] == severity]


class Sleep(RobossTest):
    def ends(self, name, link, *options, seconds):
        """Where a link comes to rest, with and without sleep."""
        return [trace(CASES / name, *options, *sleep, seconds=seconds)[link][-1] for sleep in ([], ["--no-sleep"])]

    def test_a_box_that_starts_in_the_ground_comes_out(self):
        for row in self.ends("box_in_ground.sdf", ("box", "l"), seconds=3):
            self.assertAlmostEqual(row["z"], 0.5, delta=2e-4)

    def test_a_slow_recovery_is_not_rest(self):
        asleep, awake = self.ends("sleeps_in_ground_max_vel.sdf", ("box", "l"), seconds=6)
        self.assertAlmostEqual(asleep["z"], awake["z"], delta=2e-4)
        self.assertAlmostEqual(asleep["z"], 0.5, delta=2e-3)

    def test_a_leaning_pole_falls_while_its_base_comes_out(self):
        for name, link, options in (("sleeps_while_pushed_out.urdf", ("r", "pole"), ["--ground"]),
                                    ("sleeps_in_ground.xml", ("base", "pole"), [])):
            asleep, awake = self.ends(name, link, *options, seconds=6)
            self.assertAlmostEqual(pitch(asleep), pitch(awake), delta=2e-3)
            self.assertGreater(abs(pitch(asleep)), 0.6, name)  # it leant by 0.3


class Starts(RobossTest):
    def test_a_soft_contact_pushes_out_at_max_vel(self):
        rows = trace(CASES / "soft_contact_ignores_max_vel.sdf")[("box", "l")]
        self.assertLess(max(row["vz"] for row in rows), 0.101)
        self.assertAlmostEqual(rows[-1]["z"], 0.05, delta=1.5e-3)

    def test_a_leader_with_a_follower_at_an_offset_stays(self):
        rows = trace(CASES / "mimic_offset.urdf", seconds=0.05)
        self.assertAlmostEqual(yaw(rows[("hand", "a")][0]), 0, delta=1e-6)
        self.assertAlmostEqual(yaw(rows[("hand", "b")][0]), 0.4, delta=1e-6)

    def test_followers_keep_to_their_leader(self):
        rows = trace(CASES / "mimic_gripper.urdf", *orders(
            {"t": 0.1, "robot": "gripper", "joint": {"name": "jl", "velocity": 0.1}}), "--dt", 0.001, seconds=0.5)
        left, right, dial, knob = (rows[("gripper", link)] for link in ("left", "right", "dial", "knob"))
        for at in range(2, len(left)):
            q = 0.06 - left[at]["x"]
            turn = [math.atan2(2 * (r["qw"] * r["qy"] + r["qx"] * r["qz"]), 1 - 2 * (r["qx"]**2 + r["qy"]**2))
                    for r in (dial[at], knob[at])]
            self.assertAlmostEqual(right[at]["x"] + 0.06, q, delta=1e-6)
            self.assertAlmostEqual(math.remainder(turn[0] - (20 * q + 0.3), 2 * math.pi), 0, delta=1e-6)
            self.assertAlmostEqual(math.remainder(turn[1] - (-0.5 * (20 * q + 0.3) + 0.1), 2 * math.pi), 0, delta=1e-6)
        self.assertAlmostEqual(0.06 - left[-1]["x"], 0.04, delta=1e-3)

    def test_a_quadruped_in_the_ground_is_not_thrown(self):
        quadruped = CASES / "quadruped.urdf"
        rows = trace(quadruped, "--ground", seconds=3)
        self.assertLess(max(row["z"] for row in rows[("quad", "base")]), 0.45)
        report = checked(quadruped, "--ground")
        self.assertIn("start-overlap", codes(report, "warning"))
        self.assertIn("start-moved", codes(report, "note"))
        rows = trace(quadruped, "--ground", "--on-ground", seconds=0.01)
        self.assertGreater(min(row["z"] for row in (rows[("quad", f"{leg}_foot")][0] for leg in ("FL", "FR", "RL", "RR"))),
                           0.0219)


class Urdf(RobossTest):
    def test_a_chain_without_mass_moves_as_what_it_carries(self):
        rows = trace(CASES / "massless_sliders.urdf", "--dt", 0.001, *orders(
            {"t": 0, "robot": "mobile", "joint": {"name": "x", "effort": 20}},
            {"t": 0, "robot": "mobile", "joint": {"name": "y", "effort": 5}}))
        self.assertEqual({link for _, link in rows} & {"slide_x", "slide_y", "turn", "platform", "upper"},
                         {"slide_x", "slide_y", "turn", "platform", "upper"})
        end = rows[("mobile", "platform")][-1]
        self.assertAlmostEqual(end["x"], 1.0, delta=2e-3)
        self.assertAlmostEqual(end["y"], 0.25, delta=1e-3)

    def test_links_behind_a_link_without_mass_are_kept(self):
        for name in ("urdf_zero_mass_fixed_link.urdf", "urdf_no_mass_fixed_link.urdf"):
            self.assertGreaterEqual({link for _, link in trace(CASES / name, seconds=0.01)}, {"body", "arm"})

    def test_a_pendulum_on_the_world_swings_as_without_world(self):
        on_world, bare = (trace(CASES / f"urdf_massless_base_{name}.urdf", *orders(
            {"t": 0, "robot": "pendulum", "joint": {"name": "hinge", "effort": 1}}))[("pendulum", "arm")][-1]
                          for name in ("on_world", "no_world"))
        self.assertGreater(abs(pitch(bare)), 0.05)
        self.assertAlmostEqual(pitch(on_world), pitch(bare), delta=1e-9)

    def test_floating_joints_have_six_degrees_of_freedom(self):
        for name, link in (("urdf_floating_base_link.urdf", "trunk"), ("urdf_floating_to_world.urdf", "body")):
            rows = trace(CASES / name, "--dt", 0.001)
            fallen = next(rows[key][-1] for key in rows if key[1] == link)
            self.assertAlmostEqual(fallen["z"], -0.5 * 9.8, delta=0.02)

    def test_a_spherical_joint_is_a_ball_joint(self):
        report = checked(CASES / "urdf_spherical.urdf")
        self.assertEqual(codes(report, "error") + codes(report, "warning"), [])
        self.assertIn("ball", json.dumps(report["names"]))

    def test_a_capsule_stands_on_its_round_end(self):
        rows = trace(CASES / "urdf_capsule.urdf", "--ground", "--on-ground", seconds=0.01)
        self.assertAlmostEqual(rows[("pill", "body")][0]["z"], 0.3, delta=1e-6)

    def test_a_load_cell_feels_what_is_welded_behind_it(self):
        kinds = {"revolute": ('revolute', '<axis xyz="0 0 1"/><limit lower="0" upper="0" effort="1000" velocity="1"/>', ""),
                 "fixed": ("fixed", "", ""), "kept": ("fixed", "", "<preserveFixedJoint>true</preserveFixedJoint>")}
        for kind, (joint, axis, tag) in kinds.items():
            file, reading = FOLDER / f"arm_{kind}.urdf", FOLDER / "reading.csv"
            file.write_text((CASES / "load_cell.urdf.in").read_text().replace("@JOINT@", joint).replace("@AXIS@", axis)
                            .replace("@TAG@", tag))
            done = roboss("sense", file, "--robot", "arm", "--sensor", "ft", "--at", 0.5, "--dt", 0.001, "-o", reading)
            self.assertEqual(done.returncode, 0, done.stderr)
            values = {}
            with open(reading, newline="") as lines:
                for row in csv.DictReader(lines):
                    values.setdefault(row["name"], []).append(float(row["value"]))
            reading.unlink()
            self.assertAlmostEqual(abs(values["force"][2]), 14.7, delta=1e-3, msg=kind)
            self.assertAlmostEqual(abs(values["torque"][1]), 3.528, delta=1e-3, msg=kind)

    def test_a_joint_with_a_limit_of_zero_is_told(self):
        without_effort = (CASES / "zero_effort.urdf").read_text()
        file = FOLDER / "zero.urdf"
        for code, limit, text in (("no-effort", "effort limit is 0", without_effort),
                                  ("no-velocity", "velocity limit is 0", without_effort.replace('effort="0"', 'effort="5"'))):
            file.write_text(text)
            self.assertEqual([code], codes(checked(file), "warning"))
            for mode in ("velocity", "position", "effort"):
                done = roboss("run", file, "--headless", "--duration", 0.1, *orders(
                    {"t": 0, "robot": "arm", "joint": {"name": "j", mode: 1}}))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f"order for joint 'j' of robot 'arm': its {limit}", done.stdout + done.stderr)


class Sdf(RobossTest):
    def test_a_saved_scale_counts(self):
        rows = trace(CASES / "state_scale.world", seconds=2)[("box", "l")]
        self.assertAlmostEqual(rows[-1]["z"], 0.1, delta=1e-3)

    def test_what_gazebo_reads_is_read_with_a_warning(self):
        for name in ("decimal_comma.sdf", "duplicate_collision_names.sdf", "zero_axis_of_fixed_joint.sdf"):
            report = checked(CASES / name)
            self.assertEqual(codes(report, "error"), [], name)
            self.assertTrue(codes(report, "warning"), name)

    def test_drones_that_differ_in_names_are_of_one_type(self):
        motor = """<plugin filename="gz-sim-multicopter-motor-model-system" name="gz::sim::systems::MulticopterMotorModel">
          <robotNamespace>{n}</robotNamespace><jointName>spin</jointName><linkName>rotor</linkName>
          <turningDirection>cw</turningDirection><commandSubTopic>motor_speed</commandSubTopic></plugin>"""
        drone = """<model name="{n}"><pose>{x} 0 1 0 0 0</pose><link name="body"><inertial><mass>1</mass></inertial>
          <sensor name="imu" type="imu"><update_rate>250</update_rate></sensor></link>
          <link name="rotor"><inertial><mass>.01</mass></inertial></link><joint name="spin" type="revolute"><parent>body</parent>
          <child>rotor</child><axis><xyz>0 0 1</xyz></axis></joint>{motor}</model>"""
        drones = "".join(drone.format(n=f"X{i}", x=i, motor=motor.format(n=f"X{i}")) for i in range(20))
        file = FOLDER / "swarm.sdf"
        file.write_text(f"<sdf version='1.9'><world name='swarm'>{drones}</world></sdf>")
        report = checked(file)
        self.assertEqual((report["robots"], report["robot_types"]), (20, 1))


class Mjcf(RobossTest):
    def test_a_run_starts_at_a_keyframe_where_one_is_named(self):
        file = FOLDER / "keyed.xml"
        file.write_text("<mujoco><worldbody><body name='b' pos='0 0 1'><freejoint/><geom size='.1'/></body></worldbody>"
                        "<keyframe><key name='up' qpos='0 0 5 1 0 0 0'/></keyframe></mujoco>")
        heights = [trace(file, *options, seconds=0.01)[("b", "b")][0]["z"] for options in ([], ["--keyframe", "up"])]
        self.assertEqual(heights, [1, 5])
        self.refused(["run", file, "--headless", "--keyframe", "down"], 1, "no-keyframe", "up")
        self.assertIn("keyframe", codes(checked(file), "note"))


if __name__ == "__main__":
    unittest.main()
