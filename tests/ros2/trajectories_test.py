"""FollowJointTrajectory of roboss run --ros2 by a client of Cyclone DDS that implements the protocol of actions.

with_run.py says how it is started.
"""
from with_run import WORLD, WithRun, main

ARM = WORLD.parent / "arm.sdf"
JOINTS = ("yaw", "shoulder", "elbow", "roll", "bend", "flange")
EXECUTING, SUCCEEDED, CANCELED, ABORTED = 2, 4, 5, 6
CONTROLLER = """<plugin filename="gz-sim-joint-trajectory-controller-system" name="gz::sim::systems::JointTrajectoryController">
{joints}</plugin>"""
GAIN = "<joint_name>{}</joint_name><position_p_gain>{}</position_p_gain><position_d_gain>{}</position_d_gain>"
GAINS = ((4000, 200), (4000, 200), (2000, 50), (100, 1), (200, 2), (20, 0.2))  # N m/rad and N m s/rad of the joints


CONTROLLERS = """controller_manager: {ros__parameters: {
  manipulator_controller: {type: joint_trajectory_controller/JointTrajectoryController},
  gone_controller: {type: joint_trajectory_controller/JointTrajectoryController}}}
manipulator_controller: {ros__parameters: {joints: [%s], command_interfaces: [position]}}
gone_controller: {ros__parameters: {joints: [elbw]}}
"""


class Trajectories(WithRun):
    def command(self, world, *words, controller="joint_trajectory_controller"):
        self.start(*words, world=world)
        seen = self.report_of("arm_commander.py", f"/arm/{controller}/follow_joint_trajectory", "/arm/joint_states", *JOINTS, seconds=90)
        followed, cancelled, replaced = (seen[name] for name in ("followed", "cancelled", "replaced"))
        self.assertEqual([followed[name] for name in ("accepted", "status", "code")], [True, SUCCEEDED, 0], followed)
        self.assertGreater(followed["feedback"], 5)
        self.assertEqual(followed["joints"], list(JOINTS))
        self.assertTrue({EXECUTING, SUCCEEDED} <= set(followed["statuses"]), followed)
        self.assertLess(max(abs(error) for error in followed["errors"][0]), 1e-12, "desired - actual - error")
        for here, there in zip(followed["positions"], (0.4, -0.2)):
            self.assertAlmostEqual(here, there, delta=0.06)
        self.assertEqual([cancelled[name] for name in ("accepted", "status", "return_code", "cancelling", "again")],
                         [True, CANCELED, 0, 1, 3], cancelled)
        self.assertLess(cancelled["positions"][0], 1.3, "rad; the goal was 1.4")
        self.assertAlmostEqual(cancelled["later"], cancelled["positions"][0], delta=0.1)
        self.assertEqual([replaced[name]["status"] for name in ("first", "second")], [ABORTED, SUCCEEDED], replaced)
        self.assertEqual(seen["refused"], dict.fromkeys(seen["refused"], False))
        self.assertIn("no_such_joint", self.said())

    def test_joints_without_a_controller_follow(self):
        self.command(ARM)

    def test_a_controller_has_the_name_of_its_file(self):
        file = self.folder / "controllers.yaml"
        file.write_text(CONTROLLERS % ", ".join(JOINTS))
        self.command(ARM, "--ros2-controllers", file, controller="manipulator_controller")
        self.assertIn("controllers.yaml:3: the controller 'gone_controller' has no effect", self.said())
        self.assertIn("did you mean 'elbow'?", self.said())

    def test_a_controller_on_board_follows(self):
        text = ARM.read_text()
        at = text.rindex("</model>")
        world = self.folder / "arm.sdf"
        world.write_text(text[:at] + CONTROLLER.format(joints="".join(GAIN.format(n, *g) for n, g in zip(JOINTS, GAINS))) + text[at:])
        self.command(world)


if __name__ == "__main__":
    main(Trajectories)
