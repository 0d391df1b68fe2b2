"""A Controller killed with -9 in the middle of a run of many processes resumes from its journal; a running simulation is
controlled from the command line; and all of it can be stepped again to the same hash."""
import json
import random
import subprocess
import time
import unittest

from members import DRIVER, FOLDER, ROBOSS, WORLDS, Cluster, embedded

CITY = [WORLDS / "city.sdf", "--until", 1.2, "--seed", 7]
PILE = [WORLDS / "pile.sdf", "--until", 2.0]
BALL = """<sdf version="1.9"><model name="ball"><link name="ball"><inertial><mass>1</mass><inertia><ixx>.004</ixx><iyy>.004</iyy>
<izz>.004</izz></inertia></inertial><collision name="c"><geometry><sphere><radius>.1</radius></sphere></geometry></collision></link></model></sdf>"""


def journal(*arguments):
    done = subprocess.run([ROBOSS, "journal", *map(str, arguments), "--json"], capture_output=True, text=True, timeout=120)
    return json.loads(done.stdout) if done.returncode == 0 else None


class Control(unittest.TestCase):
    def ask(self, cluster, *words, code=0):
        done = subprocess.run([ROBOSS, "control", "--simulation", cluster.name, *cluster.place, "--quiet", *map(str, words)],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, f"{words}: {done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def status(self, cluster):
        return json.loads(self.ask(cluster, "status"))

    def test_a_killed_controller_goes_on_from_its_journal_with_its_simulators_and_clients(self):
        expected = embedded(*CITY, "--client", DRIVER)
        for seed in (1, 2):
            with self.subTest(seed=seed), Cluster() as cluster:
                chance = random.Random(seed)
                file = FOLDER / f"killed-{seed}.journal"
                arguments = [*CITY, "--simulators", 2, "--await-client", "driver", "--journal", file, "--journal-every", 0.2]
                controller = cluster.controller(*arguments, "--speed", 0.5)
                members = [cluster.simulator(), cluster.start("client", DRIVER, "--name", "driver"), cluster.simulator()]
                controller.hears("client 'driver' joined")
                reached = []
                for _ in range(2):
                    time.sleep(chance.uniform(0.3, 0.9))
                    controller.kill()
                    reached.append(journal("info", file)["branches"][0]["end_tick"])
                    controller = cluster.controller(*arguments, "--speed", 0.5)
                    controller.hears("[resumed]")
                self.assertEqual(cluster.summary(controller)["state_hash"], expected["state_hash"], (reached, controller.said()))
                self.assertGreater(reached[0], 0)
                for member in members:
                    self.assertEqual(member.end(10), 0, member.said())
                self.assertTrue(journal("verify", file)["good"])

    def test_a_running_simulation_obeys_and_its_result_does_not_depend_on_pace(self):
        expected = embedded(*PILE)
        with Cluster() as cluster:
            file = FOLDER / "controlled.journal"
            controller = cluster.controller(*PILE, "--local", 1, "--simulators", 1, "--paused", "--journal", file, "--save-folder", FOLDER)
            other = cluster.simulator()
            controller.hears("joined", 2)
            self.assertEqual(self.status(cluster)["tick"], 0)
            self.ask(cluster, "step", 100)
            while not self.status(cluster)["paused"]:
                time.sleep(0.02)
            self.assertEqual(self.status(cluster)["tick"], 100)
            members = self.status(cluster)["members"]
            self.assertEqual([member["state"] for member in members], ["active", "active"])
            self.assertTrue(members[1]["name"].endswith(f"/{other.process.pid}") or members[0]["name"].endswith(f"/{other.process.pid}"))
            robots = len(self.status(cluster)["robots"])
            self.assertEqual(sum(member["robots"] for member in members), robots)
            self.assertEqual(max(member["load"] for member in members), 1)
            groups = json.loads(self.ask(cluster, "groups"))
            self.assertEqual([groups["simulator"].count(member["id"]) for member in members], [member["robots"] for member in members])
            self.assertTrue(all(groups["island"][island] == island for island in groups["island"]), "an island is called by its first robot")
            self.assertEqual(len(json.loads(self.ask(cluster, "bounds"))["boxes"]), robots)
            self.assertIn("[not-own-process]", self.ask(cluster, "simulators", "kill", 0, code=3))
            self.assertIn("[no-simulator]", self.ask(cluster, "simulators", "kill", 7, code=3))
            self.ask(cluster, "window", 3)
            self.ask(cluster, "speed", 0.3)  # slow enough for all that follows
            self.ask(cluster, "simulators", "add")
            controller.hears("joined", 3)
            self.ask(cluster, "resume")
            time.sleep(0.3)
            self.ask(cluster, "simulators", "remove")
            self.ask(cluster, "pause")
            self.assertTrue(self.status(cluster)["paused"])
            saved = FOLDER / "controlled.roboss"
            self.ask(cluster, "save", saved)
            self.assertIn("[file-exists]", self.ask(cluster, "save", saved, code=3))
            self.assertIn("[outside-folder]", self.ask(cluster, "save", "/tmp/controlled.roboss", code=3))
            self.assertIn("[file-in-use]", self.ask(cluster, "save", file, "--overwrite", code=3))
            self.ask(cluster, "save", saved, "--overwrite", "--yes")
            self.ask(cluster, "speed", "max")
            self.ask(cluster, "fly", code=2)
            self.ask(cluster, "rewind", 99, code=3)
            self.ask(cluster, "rewind", 0.15)
            status = self.status(cluster)
            self.assertEqual(status["tick"], 75)
            self.assertEqual({member["state"] for member in status["members"]}, {"active"}, "members from before the rewind are no more")
            self.ask(cluster, "resume")
            self.assertEqual(cluster.summary(controller)["state_hash"], expected["state_hash"], controller.said())
            self.assertEqual(other.end(10), 0)
            self.assertEqual(embedded(*PILE, "--from", saved)["state_hash"], expected["state_hash"])
            self.assertTrue(journal("verify", file)["good"])

    def step(self, cluster, ticks):
        """The status after so many ticks."""
        self.ask(cluster, "step", ticks)
        while not (status := self.status(cluster))["paused"]:
            time.sleep(0.02)
        return status

    def test_many_robots_come_and_go_and_a_reset_returns_to_the_start_with_a_simulator_killed_meanwhile(self):
        ball, places = FOLDER / "ball.sdf", FOLDER / "places.txt"
        ball.write_text(BALL)
        places.write_text("left -3 0 1 0 0 0\nright 3 0 1 0 0 0  # two more\n")
        hashes = []
        for way in (["--local", 1, "--simulators", 0], ["--simulators", 2]):
            with self.subTest(way=way), Cluster() as cluster:
                file = FOLDER / f"reset-{len(hashes)}.journal"
                controller = cluster.controller(*PILE, *way, "--paused", "--journal", file)
                members = [cluster.simulator() for _ in range(2 if way[1] == 2 else 0)]
                start = self.status(cluster)
                first = self.step(cluster, 100)
                self.ask(cluster, "add", ball, "--count", 200, "--grid", "0.5 0.5 20", "--pose", "-5 4 0.3 0 0 0", "--name", "crowd")
                self.assertIn("[name-taken]", self.ask(cluster, "add", ball, "--count", 3, "--name", "crowd", code=3))
                self.ask(cluster, "add", ball, "--poses", places)
                self.assertEqual(self.status(cluster)["robots"], start["robots"] + [f"crowd_{i}" for i in range(200)] + ["left", "right"])
                for member in members[:1]:
                    member.kill()
                crowded = self.step(cluster, 50)
                self.ask(cluster, "remove", "crowd_*", start["robots"][0])
                removed = self.step(cluster, 50)
                self.assertEqual(removed["robots"], start["robots"][1:] + ["left", "right"])
                self.ask(cluster, "reset")
                again = self.status(cluster)
                for key in ("tick", "robots", "model_hash", "state_hash"):
                    self.assertEqual(again[key], start[key], key)
                self.assertEqual(self.step(cluster, 100)["state_hash"], first["state_hash"])
                self.ask(cluster, "reset")
                controller.kill()
                self.assertTrue(journal("verify", file)["good"])
                finished = cluster.summary(cluster.controller(*PILE, *(["--simulators", 1] if members else way), "--journal", file))
                self.assertEqual(finished["state_hash"], embedded(*PILE)["state_hash"])
                hashes.append([crowded["state_hash"], removed["state_hash"]])
        self.assertEqual(hashes[0], hashes[1])

    def test_copies_and_robots_that_return_give_the_same_bits_on_any_number_of_simulators(self):
        hashes = []
        for simulators in (1, 2):
            with Cluster() as cluster:
                file = FOLDER / f"copied-{simulators}.journal"
                controller = cluster.controller(*PILE, "--local", 1, "--simulators", simulators - 1, "--paused", "--journal", file)
                others = [cluster.simulator() for _ in range(simulators - 1)]
                start = self.step(cluster, 50)
                name = start["robots"][2]
                self.ask(cluster, "remove", name)
                removed = self.step(cluster, 20)
                self.assertNotIn(name, removed["robots"])
                self.assertIn("1 robot restored", self.ask(cluster, "restore", name))
                restored = self.step(cluster, 20)
                self.assertEqual(restored["robots"][-1], name)
                self.ask(cluster, "restore", name, code=3)
                self.ask(cluster, "copy", name, "twin", "--pose", "3 3 1 0 0 0.5")
                self.ask(cluster, "copy", name, "twin", "--pose", "4 3 1 0 0 0.5", code=3)
                self.ask(cluster, "copy", "nobody", "other", "--pose", "4 3 1 0 0 0.5", code=3)
                copied = self.step(cluster, 20)
                self.assertEqual(copied["robots"][-2:], [name, "twin"])
                hashes.append([s["state_hash"] for s in (start, removed, restored, copied)])
                self.ask(cluster, "quit", "--yes")
                self.assertEqual(controller.end(30), 0, controller.said())
                for other in others:
                    self.assertEqual(other.end(10), 0, other.said())
                self.assertTrue(journal("verify", file)["good"])
        self.assertEqual(hashes[0], hashes[1])

    def test_the_reply_holds_the_findings_about_robots_that_are_added(self):
        ball, broken = FOLDER / "ball.sdf", FOLDER / "broken.sdf"
        ball.write_text(BALL)
        broken.write_text(BALL.replace("<mass>1<", "<mass>heavy<"))
        with Cluster() as cluster:
            cluster.controller(*PILE, "--local", 1, "--simulators", 0, "--paused")
            reply = self.ask(cluster, "add", ball, "--name", "sunk", "--pose", "9 9 -0.05 0 0 0")
            self.assertTrue(reply.startswith(f"1 robot of {ball} added"), reply)
            self.assertIn("'sunk' starts in", reply)
            self.assertIn("[start-overlap]", reply)
            stands = self.ask(cluster, "add", ball, "--name", "high", "--pose", "9 -9 3 0 0 0", "--on-ground")
            self.assertIn("[start-on-ground]", stands)
            refused = self.ask(cluster, "add", broken, code=3)
            self.assertIn(f"{broken}:1: error", refused)
            for text in (reply, stands, refused):
                self.assertNotIn("roboss-add", text)

    def test_robots_and_accuracy_change_at_a_tick_and_the_journal_keeps_it(self):
        ball = FOLDER / "ball.sdf"
        ball.write_text(BALL)
        hashes = []
        for way in (["--local", 1, "--simulators", 0], ["--simulators", 2]):
            with self.subTest(way=way), Cluster() as cluster:
                file = FOLDER / f"changed-{len(hashes)}.journal"
                controller = cluster.controller(*PILE, *way, "--paused", "--journal", file)
                for _ in range(2 if way[1] == 2 else 0):
                    cluster.simulator()
                self.ask(cluster, "step", 200)
                while not self.status(cluster)["paused"]:
                    time.sleep(0.02)
                before = self.status(cluster)["robots"]
                self.ask(cluster, "add", ball, "--pose", "0 0 1.5 0 0 0", "--name", "guest")
                self.assertEqual(self.status(cluster)["robots"], [*before, "guest"], "who comes is the last")
                self.ask(cluster, "add", ball, "--name", "guest", code=3)
                self.ask(cluster, "step", 200)
                while not self.status(cluster)["paused"]:
                    time.sleep(0.02)
                self.ask(cluster, "accuracy", "high", "tolerance=1e-11")
                self.ask(cluster, "accuracy", "tolerance=7", code=3)
                self.ask(cluster, "remove", before[3])
                self.assertEqual(self.status(cluster)["robots"], [*before[:3], *before[4:], "guest"])
                self.ask(cluster, "remove", "nobody", code=3)
                controller.kill()
                again = cluster.controller(*PILE, *way, "--journal", file)
                hashes.append(cluster.summary(again)["state_hash"])
                self.assertTrue(journal("verify", file)["good"])
                self.assertEqual(len(journal("info", file)["branches"]), 4)
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], embedded(*PILE)["state_hash"])


if __name__ == "__main__":
    unittest.main()
