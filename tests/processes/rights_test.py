"""A Client whose key permits some robots and kinds of orders drives those and no others; what it may not do is refused by name
on both sides, the run continues, and a journal has only what took effect."""
import json
import os
import re
import subprocess
import unittest

from members import DRIVER, FOLDER, ROBOSS, WORLDS, Cluster, embedded
from viewer_test import Browser, url_of

CITY = [WORLDS / "city.sdf", "--duration", 1.2, "--seed", 7]
BAD_INPUT, RUN_REFUSES = 1, 3


def roboss(*words, code=0):
    done = subprocess.run([ROBOSS, *map(str, words)], capture_output=True, text=True, timeout=120)
    if done.returncode != code:
        raise AssertionError(f"{words} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


class Rights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keys = FOLDER / f"keys-{os.getpid()}"
        for name, *options in (("boss", "--role", "controller"), ("sim", "--role", "simulator"),
                               ("pilot", "--role", "client", "--robots", "car_1,car_2*", "--orders", "actuators"),
                               ("pusher", "--role", "client", "--orders", "force,pose"),
                               ("window", "--role", "client", "--robots", "car_3", "--orders", "velocity"),
                               ("observer", "--role", "client", "--look-only"), ("chief", "--role", "client")):
            roboss("keys", "add", cls.keys, name, *options)

    def start(self, cluster, *options):
        """A run that waits for a Client "driver", and a Simulator of it."""
        controller = cluster.controller(*CITY, "--keys", self.keys / "boss", "--simulators", 1, "--await-client", "driver", *options)
        cluster.simulator("--keys", self.keys / "sim")
        return controller

    def driver(self, cluster, key):
        return cluster.start("client", DRIVER, "--name", "driver", "--keys", self.keys / key)

    def ask(self, cluster, key, *words, code=0):
        return roboss("control", "--simulation", cluster.name, *cluster.place, "--keys", self.keys / key, *words, code=code)

    def test_the_list_shows_them(self):
        rights = {key["name"]: key["rights"] for key in json.loads(roboss("keys", "list", self.keys, "--json"))}
        self.assertEqual(rights, {"boss": "", "sim": "", "chief": "everything", "observer": "look-only",
                                  "window": "robots=car_3;orders=velocity;steer=no",
                                  "pilot": "robots=car_1,car_2*;orders=actuators;steer=no",
                                  "pusher": "robots=*;orders=pose,force;steer=no"})
        self.assertIn("look-only", roboss("keys", "list", self.keys))
        for wrong in (["--role", "simulator", "--look-only"], ["--role", "client", "--orders", "fly"],
                      ["--role", "client", "--robots", "a;b"]):
            self.assertIn("[bad-rights]", roboss("keys", "add", self.keys, "wrong", *wrong, code=BAD_INPUT))
        roboss("keys", "add", self.keys, "wrong", "--role", "client", "--look-only", "--orders", "pose", code=2)

    def test_a_driver_of_all_cars_drives_those_that_its_key_permits(self):
        journal = FOLDER / f"rights-{os.getpid()}.journal"
        with Cluster() as cluster:
            controller = self.start(cluster, "--journal", journal)
            driver = self.driver(cluster, "pilot")
            summary = cluster.summary(controller)
            self.assertEqual(driver.end(10), 0, driver.said())
            said, heard = controller.said(), driver.said()
        for words in (said, heard):
            self.assertIn("the key 'pilot' does not permit orders to robot 'car_0' [not-permitted]", words)
            self.assertNotIn("to robot 'car_1'", words)
        self.assertIn("client 'driver'", said)
        lines = [line for line in said.splitlines() if "[not-permitted]" in line]
        self.assertLessEqual(len(lines), 50, "each robot once, not each of some thousand orders")
        exported = subprocess.run([ROBOSS, "journal", "export", journal, "--orders"], capture_output=True, text=True, timeout=120)
        orders = [json.loads(line) for line in exported.stdout.splitlines()]
        self.assertGreater(len(orders), 20)
        self.assertEqual({order["robot"] for order in orders if not re.fullmatch("car_1|car_2.*", order["robot"])}, set())
        self.assertGreaterEqual(len({order["robot"] for order in orders}), 2)
        file = FOLDER / f"rights-{os.getpid()}.jsonl"
        file.write_text(exported.stdout)
        self.assertEqual(embedded(*CITY, "--orders", file)["state_hash"], summary["state_hash"], "the permitted orders alone")
        self.assertNotEqual(embedded(*CITY, "--client", DRIVER)["state_hash"], summary["state_hash"])
        self.assertTrue(json.loads(roboss("journal", "verify", journal, "--json"))["good"])

    def test_a_kind_of_orders_that_is_not_permitted_leaves_the_run_as_it_was_without(self):
        with Cluster() as cluster:
            controller = self.start(cluster)
            driver = self.driver(cluster, "pusher")
            summary = cluster.summary(controller)
            self.assertEqual(driver.end(10), 0, driver.said())
            self.assertIn("orders of the kind 'actuators' [not-permitted]", driver.said())
            self.assertIn("orders of the kind 'actuators' [not-permitted]", controller.said())
        self.assertEqual(embedded(*CITY)["state_hash"], summary["state_hash"])

    def test_who_may_not_steer_may_ask_and_who_may_look_only_holds_nobody_up(self):
        with Cluster() as cluster:
            controller = self.start(cluster, "--paused")
            observer = self.driver(cluster, "observer")
            self.assertEqual(observer.end(20), BAD_INPUT, observer.said())
            self.assertIn("lets it look only", observer.said())
            self.assertIn("[not-permitted]", observer.said())
            controller.hears("the key 'observer' lets it look only")
            driver = self.driver(cluster, "chief")
            controller.hears("client 'driver' joined")
            for key in ("observer", "pilot"):
                self.assertIn("car_0", json.loads(self.ask(cluster, key, "status"))["robots"])
                for words in (["resume"], ["quit", "--yes"], ["remove", "car_0"], ["speed", 0.1], ["save", "x.roboss"]):
                    self.assertIn("[not-permitted]", self.ask(cluster, key, *words, code=RUN_REFUSES))
                controller.hears(f"requests of '{key}' are refused")
            self.ask(cluster, "chief", "resume")
            self.assertEqual(cluster.summary(controller)["state_hash"], embedded(*CITY, "--client", DRIVER)["state_hash"])
            self.assertEqual(driver.end(10), 0, driver.said())

    def test_a_page_has_the_rights_of_the_key_of_its_viewer(self):
        with Cluster() as cluster:
            controller = cluster.controller(WORLDS / "city.sdf", "--keys", self.keys / "boss", "--simulators", 1, "--speed", 1, "--headless")
            cluster.simulator("--keys", self.keys / "sim")
            viewer = cluster.start("view", "--view", 0, "--patience", 30, "--keys", self.keys / "window")
            with Browser(url_of(viewer)) as page:
                page.hears(lambda _: page.states > 3)
                order = {"type": "order", "action": "velocity", "linear": [0, 0, 1], "angular": [0, 0, 0]}
                self.assertTrue(page.asks({**order, "id": 1, "robot": 3})[0])
                for message in ({**order, "id": 2, "robot": 4}, {"type": "control", "id": 3, "words": ["pause"]}):
                    done, text = page.asks(message)
                    self.assertFalse(done)
                    self.assertIn("the key 'window' does not permit", text)
            controller.hears("orders of client 'viewer' are refused")
            controller.hears("requests of 'window' are refused")


if __name__ == "__main__":
    unittest.main()
