"""`roboss examples`, `roboss run example:NAME` and `roboss doctor`."""
import json
import os
import resource
import signal
import subprocess
import unittest

from running import DRIVER, FOLDER, ROBOSS, WORLDS, RobossTest, roboss, summary


class Examples(RobossTest):
    def test_every_example_runs_with_its_programs(self):
        listed = json.loads(roboss("examples", "--json").stdout)
        self.assertGreater(len(listed), 20)
        self.assertEqual(len({example["name"] for example in listed}), len(listed))
        text = roboss("examples").stdout
        for example in listed:
            with self.subTest(example["name"]):
                self.assertIn(example["summary"], text)
                self.assertTrue(os.path.isfile(example["world"]), example["world"])
                done = summary(f"example:{example['name']}", "--headless", "--duration", 0.02)
                self.assertAlmostEqual(done["sim_time_s"], 0.02, delta=0.005)
                self.assertEqual(done["world"], example["world"])

    def test_an_example_is_its_world_with_its_programs_and_orders(self):
        named = summary("example:drives", "--headless", "--duration", 0.5)["state_hash"]
        world = WORLDS / "drives.sdf"
        self.assertEqual(named, summary(world, "--headless", "--duration", 0.5, "--orders", WORLDS / "drives.jsonl")["state_hash"])
        self.assertNotEqual(named, summary(world, "--headless", "--duration", 0.5)["state_hash"])

    def test_its_programs_drive_it(self):
        driven = summary("example:city", "--headless", "--duration", 0.3)["state_hash"]
        self.assertEqual(driven, summary(WORLDS / "city.sdf", "--client", DRIVER, "--headless", "--duration", 0.3)["state_hash"])
        self.assertEqual(driven, summary("example:city", "--client", DRIVER, "--headless", "--duration", 0.3)["state_hash"])
        self.assertNotEqual(driven, summary(WORLDS / "city.sdf", "--headless", "--duration", 0.3)["state_hash"])

    def test_own_orders_take_the_place_of_those_of_the_example(self):
        none = FOLDER / "none.jsonl"
        none.write_text("")
        own = summary("example:drives", "--headless", "--duration", 0.5, "--orders", none)["state_hash"]
        self.assertEqual(own, summary(WORLDS / "drives.sdf", "--headless", "--duration", 0.5)["state_hash"])

    def test_other_commands_take_examples_and_unknown_ones_are_refused(self):
        self.assertEqual(roboss("check", "example:pile").returncode, 0)
        for command in ("run", "check"):
            self.refused([command, "example:citty"], 1, "[unknown-example]", "city")


class Doctor(RobossTest):
    def test_it_names_what_a_report_needs(self):
        items = {item["name"]: item["value"] for item in json.loads(roboss("doctor", "--json").stdout)}
        for name in ("version", "commit", "build", "system", "processor", "lanes", "memory", "open files", "libraries"):
            self.assertTrue(items[name], name)
        self.assertIn("libassimp", items["libraries"])
        self.assertIn(items["version"], roboss("--version").stdout)

    def test_it_says_what_is_wrong(self):
        was = os.environ.get("TMPDIR")
        os.environ["TMPDIR"] = str(FOLDER / "not there")
        try:
            done = roboss("doctor")
        finally:
            if was is None:
                del os.environ["TMPDIR"]
            else:
                os.environ["TMPDIR"] = was
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("WRONG: no file can be written there", done.stdout)
        self.assertIn("remedy:", done.stdout)

    def test_it_finds_a_disk_that_takes_folders_and_no_bytes(self):
        def takes_no_bytes():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writing fails, as on a full disk
            resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

        done = subprocess.run([ROBOSS, "doctor"], preexec_fn=takes_no_bytes, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("WRONG: no file can be written there", done.stdout)


if __name__ == "__main__":
    unittest.main()
