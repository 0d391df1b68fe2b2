"""Bad input: an error with its code and the name of the file, the documented exit code, and nothing lost."""
import json
import re
import unittest

from running import DRIVER, FOLDER, WORLDS, RobossTest, roboss, summary

PILE = WORLDS / "pile.sdf"
FRAGILE = """<sdf version="1.9"><world name="fragile"><physics name="p" type="ode"><max_step_size>0.001</max_step_size></physics>
<model name="dust"><pose>0 0 9 0 0 0</pose><link name="body"><inertial><mass>1e-300</mass>
<inertia><ixx>1e-100</ixx><iyy>1e-100</iyy><izz>1e-100</izz></inertia></inertial>
<collision name="c"><geometry><sphere><radius>.1</radius></sphere></geometry></collision></link></model></world></sdf>"""


def written(name, text):
    file = FOLDER / name
    file.write_text(text)
    return file


class BadInput(RobossTest):
    def test_a_world_that_is_not_there_or_no_xml(self):
        self.refused(["run", "no/such.sdf", "--duration", "1"], 1, "no/such.sdf")
        broken = written("broken.sdf", "<sdf version='1.9'>\n<world name='w'>\n<model name='m'>\n</wrong></world></sdf>")
        self.refused(["run", broken, "--duration", "1"], 1, "broken.sdf:4")
        self.refused(["check", FOLDER / "brokn.sdf"], 1, "[cannot-read]", "broken.sdf'?")
        self.refused(["check", "no/such.sdf"], 1, "[cannot-read]", "There is no folder 'no'")

    def test_all_errors_of_a_world_are_reported_at_once_with_their_lines(self):
        text = PILE.read_text().replace("<mass>2</mass>", "<mass>-1</mass>").replace("<child>upper</child>", "<child>uper</child>")
        bad = written("bad.sdf", text)
        done = self.refused(["run", bad, "--duration", "1", "--strict"], 1, "bad.sdf:", "uper", "mass")
        self.assertGreaterEqual(done.stderr.count("error:"), 2)

    def test_a_model_with_errors_is_left_out_unless_strict(self):
        bad = written("one_bad.sdf", PILE.read_text().replace("<child>upper</child>", "<child>uper</child>"))
        done = roboss("run", bad, "--duration", "0.1", "--headless", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("[left-out]", done.stderr)
        self.refused(["run", bad, "--duration", "0.1", "--headless", "--strict"], 1, "uper")
        self.refused(["check", bad], 1, "left-out", "--strict")

    def test_nan_in_a_world(self):
        bad = written("nan.sdf", PILE.read_text().replace("<radius>0.09</radius>", "<radius>nan</radius>"))
        self.refused(["run", bad, "--duration", "1", "--strict"], 1, "nan.sdf:")

    def test_wrong_usage(self):
        self.refused(["run"], 2, "world")
        self.refused(["run", PILE, "--speed", "fast"], 2, "--speed")
        self.refused(["run", PILE, "--no-such-option"], 2, "--no-such-option")
        self.refused(["fly"], 2, "'fly'")
        self.refused([], 2, "Simulate a world", "run")
        self.refused(["rn"], 2, "did you mean 'run'?")
        self.refused(["run", PILE, "--durration", "1"], 2, "'--durration'", "did you mean '--duration'?")
        self.refused(["control", "pasue"], 2, "did you mean 'pause'?")
        self.refused(["run", PILE, "--duration", "abc"], 2, "--duration: 'abc' is not a number")
        self.refused(["run", PILE, "--duration=-1"], 2, "--duration: '-1' is not 0 or above")
        self.refused(["run", PILE, "--threads", "1.5"], 2, "--threads: '1.5' is not a whole number")
        self.refused(["run", PILE, "--speed", "1e-9"], 2, "--speed: '1e-9' is not from 0.001")

    def test_a_bare_robot_gets_ground_or_a_fixed_base(self):
        urdf = written("pole.urdf", """<robot name="pole"><link name="base"><inertial><origin xyz="0 0 0.5"/><mass value="2"/>
<inertia ixx="0.2" iyy="0.2" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 0.5"/><geometry><box size="0.1 0.1 1"/></geometry></collision></link></robot>""")
        heights = {}
        for option in ([], ["--ground"], ["--fixed-base", "pole"]):
            trace = FOLDER / "pole.csv"
            summary(urdf, "--duration", 1, *option, "--trace", trace, "--trace-every", 1)
            heights[tuple(option)] = float(trace.read_text().splitlines()[-1].split(",")[5])
        self.assertAlmostEqual(heights[()], -4.9, delta=0.1, msg="it falls")
        self.assertAlmostEqual(heights["--ground",], 0, delta=1e-3)
        self.assertEqual(heights["--fixed-base", "pole"], 0)
        self.refused(["run", urdf, "--duration", 1, "--fixed-base", "poll"], 1, "[no-model]", "did you mean 'pole'?")

    def test_a_picture_of_what_is_not_there(self):
        picture = ["snapshot", PILE, "-o", FOLDER / "none.png"]
        self.refused([*picture, "--camera", "nowhere"], 2, "--camera: 'nowhere'")
        self.refused([*picture, "--camera", "1,2,3,4,5,0"], 2, "distance")
        self.refused([*picture, "--show", "rays,nothing"], 2, "--show: 'nothing'")
        self.refused([*picture, "--select", "amr"], 1, "[no-robot]", "did you mean 'arm'?")
        self.refused([*picture, "--camera", "follow:amr"], 1, "[no-robot]", "did you mean 'arm'?")
        self.assertFalse((FOLDER / "none.png").exists())
        self.refused(["snapshot", PILE, "-o", FOLDER / "nowhere" / "none.png"], 1, "[not-writable]", "nowhere")

    def test_help_and_several_files_to_check(self):
        self.assertEqual(roboss("help", "journal", "info").stdout, roboss("journal", "info", "--help").stdout)
        self.assertEqual(roboss("help").stdout, roboss("--help").stdout)
        bad = written("worse.sdf", PILE.read_text().replace("<child>upper</child>", "<child>uper</child>"))
        done = roboss("check", PILE, bad)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"== {PILE}", done.stdout)
        self.assertIn("2 errors, 0 warnings", done.stdout)
        reports = json.loads(roboss("check", PILE, bad, "--json").stdout)
        self.assertEqual([report["errors"] for report in reports], [0, 2])

    def test_states_of_joints_that_follow_from_others_or_do_not_exist_are_refused(self):
        world = PILE.parent / "four_bar.sdf"
        for joint, words in (({"name": "closing", "position": 1}, ["closing", "loop"]), ({"name": "hinge", "position": 1}, ["hinge", "drive"]),
                             ({"name": "elbow", "position": [1, 2]}, ["elbow", "2 values"]), ({"name": "elbow", "velocity": 1e9}, ["elbow", "limit"])):
            orders = written("states.jsonl", json.dumps({"t": 0, "robot": "linkage_0", "joint_state": joint}) + "\n")
            self.refused(["run", world, "--duration", "0.1", "--orders", orders], 1, "states.jsonl:1", "[bad-order]", *words)

    def test_an_order_to_an_unknown_robot_stops_before_the_start(self):
        orders = written("orders.jsonl", '{"t":0,"robot":"arm","joint":{"name":"shoulder","effort":1}}\n{"t":0,"robot":"nobody","joint":{}}\n')
        self.refused(["run", PILE, "--duration", "1", "--orders", orders], 1, "orders.jsonl:2", "[bad-order]", "nobody")

    def test_a_control_program_that_is_none(self):
        self.refused(["run", PILE, "--duration", "1", "--client", "no/such.so"], 1, "no/such.so", "[no-file]")
        self.refused(["run", PILE, "--duration", "1", "--client", written("text.so", "not a library")], 1, "text.so", "[not-loadable]")

    def test_a_saved_state_of_another_world_or_damaged(self):
        saved = FOLDER / "pile.roboss"
        summary(PILE, "--duration", 0.1, "--save", saved)
        self.refused(["run", WORLDS / "crossroads.sdf", "--duration", "1", "--from", saved], 1, "pile.roboss", "[another-world]")
        whole = saved.read_bytes()
        damaged = FOLDER / "damaged.roboss"
        damaged.write_bytes(whole[: len(whole) // 2])
        self.refused(["run", PILE, "--duration", "1", "--from", damaged], 1, "damaged.roboss")

    def test_a_folder_that_cannot_be_written(self):
        done = self.refused(["run", PILE, "--duration", "0.1", "--quiet", "--save", "no/such/folder/x.roboss"], 3, "no/such/folder")
        self.assertRegex(done.stdout, "[0-9a-f]{16}", "the summary with its hashes is still printed")

    def test_an_order_beyond_the_limits_is_refused_by_name(self):
        orders = written("boom.jsonl", '{"t":0.05,"robot":"arm","wrench":{"link":"lower","force":[1e308,0,0],"duration":0.1}}\n')
        self.refused(["run", PILE, "--duration", "1", "--orders", orders], 1, "boom.jsonl:1", "[bad-order]", "arm", "force")

    def test_a_run_that_diverges_names_robot_and_tick_and_keeps_the_state_before(self):
        world = written("fragile.sdf", FRAGILE)
        orders = written("push.jsonl", '{"t":0.05,"robot":"dust","wrench":{"link":"body","force":[1e9,0,0],"duration":0.1}}\n')
        printed, saved = set(), FOLDER / "before.roboss"
        for window in ("1", "7", "auto"):
            saved.unlink(missing_ok=True)
            done = self.refused(["run", world, "--duration", "1", "--quiet", "--orders", orders, "--save", saved, "--window", window],
                                3, "[not-finite]", "'dust'", " 50 ")
            printed.add((done.stderr, re.search("[0-9a-f]{16}", done.stdout).group(0)))
            self.assertAlmostEqual(summary(world, "--duration", 0.0, "--from", saved)["sim_time_s"], 0.05)
        self.assertEqual(len(printed), 1, "whatever the window")

    def test_check_prints_the_same_as_json(self):
        done = roboss("check", WORLDS / "city.sdf", "--json")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(json.loads(done.stdout)["robots"], 50)

    def test_the_control_program_is_a_good_one_after_all(self):
        self.assertEqual(summary(WORLDS / "city.sdf", "--client", DRIVER, "--duration", 0.2)["robots"], 50)


if __name__ == "__main__":
    unittest.main()
