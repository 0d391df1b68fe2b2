"""The viewer of real runs: what it prints and serves, in the run's process and beside a cluster, and that a run with viewers ends
with the hash of one without."""
import base64
import json
import os
import re
import socket
import struct
import time
import unittest
import urllib.error
import urllib.request

from members import DRIVER, FOLDER, WORLDS, Cluster, embedded

GUEST = """<sdf version="1.9"><model name="ball"><link name="body">
<inertial><mass>1</mass><inertia><ixx>.01</ixx><iyy>.01</iyy><izz>.01</izz></inertia></inertial>
<collision name="c"><geometry><sphere><radius>.2</radius></sphere></geometry></collision>
<visual name="v"><geometry><cylinder><radius>.2</radius><length>.4</length></cylinder></geometry>
<material><diffuse>0 .5 0 1</diffuse></material></visual></link></model></sdf>"""
CITY = [WORLDS / "city.sdf", "--client", DRIVER]


class Browser:
    """Just enough of a WebSocket."""

    def __init__(self, url, timeout_s=20):
        host, port = re.match(r"http://([^:/]+):(\d+)/", url).groups()
        self.socket = socket.create_connection((host, int(port)), timeout=timeout_s)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\nOrigin: http://{host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Protocol: roboss.1\r\n\r\n".encode())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            self.bytes += self.socket.recv(4096)
        head, self.bytes = self.bytes.split(b"\r\n\r\n", 1)
        if b" 101 " not in head.split(b"\r\n")[0] + b" ":
            raise AssertionError(head.decode())
        self.states, self.tick = 0, -1

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def need(self, count):
        while len(self.bytes) < count:
            more = self.socket.recv(1 << 16)
            if not more:
                raise EOFError
            self.bytes += more

    def receive(self):
        """The next JSON message, or None for a State."""
        while True:
            self.need(2)
            kind, size, at = self.bytes[0] & 15, self.bytes[1] & 127, 2
            if size > 125:
                at = 4 if size == 126 else 10
                self.need(at)
                size = int.from_bytes(self.bytes[2:at], "big")
            self.need(at + size)
            payload, self.bytes = self.bytes[at:at + size], self.bytes[at + size:]
            if kind == 1:
                return json.loads(payload)
            if kind == 2:
                self.states += 1
                self.tick = struct.unpack_from("<d", payload, 8)[0]
                return None

    def hears(self, done, timeout_s=20):
        """Receives until done(message)."""
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            message = self.receive()
            if done(message):
                return message
        raise AssertionError("it did not come")

    def say(self, message):
        text, mask = json.dumps(message).encode(), os.urandom(4)
        size = bytes([0x80 | len(text)]) if len(text) < 126 else bytes([0x80 | 126]) + struct.pack(">H", len(text))
        self.socket.sendall(b"\x81" + size + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(text)))

    def asks(self, message):
        self.say(message)
        answer = self.hears(lambda said: said is not None and said["type"] == "answer" and said["id"] == message["id"])
        return answer["done"], answer["text"]


def url_of(member):
    member.hears("viewer at http")
    return re.search(r"viewer at (http\S+)", member.said()).group(1)


def get(url, path):
    with urllib.request.urlopen(url.rstrip("/") + path, timeout=20) as answer:
        return answer.read()


class Viewer(unittest.TestCase):
    def test_a_run_shows_itself_and_ends_with_the_same_hash(self):
        with Cluster() as cluster:
            run = cluster.start_plain("run", *CITY, "--until", 3, "--speed", 1, "--view", 0, "--json", cluster.json)
            url = url_of(run)
            scene = json.loads(get(url, "/scene"))
            self.assertEqual(scene["world"], "city")
            self.assertEqual(len(scene["robots"]), 50)
            self.assertTrue(any(visual["rgb"] != [0.7, 0.7, 0.7] for visual in scene["statics"]))
            self.assertIn(b"<!doctype html>", get(url, "/").lower())
            with Browser(url) as page:
                page.say({"type": "watch", "robots": [7], "overlays": ["groups", "bounds", "contacts"], "rate": 60})
                for kind in ("hello", "status", "robot", "groups", "overlay"):
                    told = page.hears(lambda said, kind=kind: said is not None and said["type"] == kind)
                    if kind == "groups":
                        self.assertEqual(len(told["simulator"]), 50)
                bounds = page.hears(lambda said: said is not None and "bounds" in said)
                self.assertEqual(len(bounds["bounds"][0]["box"]), 6)
                self.assertTrue(page.asks({"type": "control", "id": 1, "words": ["pause"]})[0])
                self.assertTrue(page.asks({"type": "control", "id": 2, "words": ["resume"]})[0])
            summary = cluster.summary(run)
            self.assertGreater(page.states, 5)
        self.assertEqual(summary["state_hash"], embedded(*CITY, "--until", 3, "--headless")["state_hash"])

    def test_a_run_with_an_open_page_stays_after_its_duration(self):
        with Cluster() as cluster:
            run = cluster.start_plain("run", *CITY, "--until", 0.5, "--view", 0)
            with Browser(url_of(run)) as page:
                page.hears(lambda said: said is not None and said["type"] == "status" and said["over"] and said["paused"])
                self.assertTrue(page.asks({"type": "control", "id": 1, "words": ["step", "10"]})[0])
                page.hears(lambda said: said is not None and said["type"] == "status" and said["tick"] > 250)
            self.assertEqual(run.end(30), 0)

    def test_a_run_that_must_not_stay_ends_while_its_page_is_open(self):
        with Cluster() as cluster:
            run = cluster.start_plain("run", *CITY, "--until", 1, "--no-stay", "--view", 0)
            with Browser(url_of(run)) as page:
                page.hears(lambda _: page.states > 0)
                self.assertEqual(run.end(30), 0)

    def test_headless_serves_nothing(self):
        with Cluster() as cluster:
            run = cluster.start_plain("run", *CITY, "--until", 0.2, "--headless")
            self.assertEqual(run.end(), 0)
            self.assertNotIn("viewer at", run.said())

    def test_beside_a_cluster(self):
        with Cluster() as cluster:
            controller = cluster.controller(WORLDS / "city.sdf", "--simulators", 2, "--until", 4, "--speed", 1, "--headless")
            viewer = cluster.start("view", "--view", 0, "--patience", 30)
            for _ in range(2):
                cluster.simulator()
            url = url_of(viewer)
            with Browser(url) as page:
                scene = json.loads(get(url, "/scene"))
                self.assertEqual(len(scene["robots"]), 50)
                self.assertGreater(len(scene["types"][0]["links"][0]["visuals"]), 0)
                page.hears(lambda _: page.states > 5)
                status = page.hears(lambda said: said is not None and said["type"] == "status")
                self.assertEqual(status["simulators"], 2)
                counted = page.hears(lambda said: said is not None and said["type"] == "status" and said["messages"]["in"] > 0)
                for way in ("in", "out", "bytes_in", "bytes_out"):
                    self.assertTrue(all(member["messages"][way] > 0 for member in counted["members"]), counted)
                    self.assertGreaterEqual(counted["messages"][way], sum(member["messages"][way] for member in counted["members"]) - 2)
                page.hears(lambda _: page.tick == round(4 / scene["dt"]) or page.tick > 1500)
            summary = cluster.summary(controller)
        self.assertEqual(summary["state_hash"], embedded(WORLDS / "city.sdf", "--until", 4, "--headless")["state_hash"])

    def test_pictures_of_a_world_reach_a_viewer_beside_the_cluster(self):
        with Cluster() as cluster:
            cluster.controller(WORLDS / "yard.sdf", "--simulators", 1, "--speed", 1, "--headless")
            viewer = cluster.start("view", "--view", 0, "--patience", 30)
            cluster.simulator()
            url = url_of(viewer)
            with Browser(url) as page:
                page.hears(lambda _: page.states > 0)
                scene = json.loads(get(url, "/scene"))
                ground = next(visual for visual in scene["statics"] if visual["shape"] == "plane")
                picture = get(url, "/texture/" + ground["finish"]["colour"])
                self.assertEqual(picture, (WORLDS / "models/yard/paving.png").read_bytes())

    def added_robots_look_as_their_file_says(self, url):
        with Browser(url) as page:
            page.hears(lambda _: page.states > 0)
            before = json.loads(get(url, "/scene"))
            words = ["add", "guest.sdf", GUEST, "0 0 2 0 0 0", "guest"]
            done, text = page.asks({"type": "control", "id": 1, "words": words})
            self.assertTrue(done, text)
            number = page.hears(lambda said: said is not None and said["type"] == "scene")["scene"]
            after = json.loads(get(url, "/scene"))
        self.assertEqual(after["scene"], number)
        link = after["types"][next(robot for robot in after["robots"] if robot["name"] == "guest")["type"]]["links"][0]
        self.assertEqual([shape["shape"] for shape in link["collisions"]], ["sphere"])
        self.assertEqual([(shape["shape"], shape["rgb"]) for shape in link["visuals"]], [("cylinder", [0, 0.5, 0])])
        self.assertEqual(after["robots"][:-1], before["robots"])
        self.assertEqual(after["types"][:len(before["types"])], before["types"])

    def test_robots_added_at_run_time_look_as_their_file_says(self):
        with Cluster() as cluster:
            self.added_robots_look_as_their_file_says(
                url_of(cluster.start_plain("run", WORLDS / "pile.sdf", "--speed", 1, "--view", 0)))

    def test_robots_added_to_a_cluster_look_as_their_file_says(self):
        with Cluster() as cluster:
            cluster.controller(WORLDS / "pile.sdf", "--simulators", 2, "--speed", 1, "--headless")
            viewer = cluster.start("view", "--view", 0, "--patience", 30)
            for _ in range(2):
                cluster.simulator()
            self.added_robots_look_as_their_file_says(url_of(viewer))

    def test_a_run_that_a_page_gave_orders_is_resumed_without_the_page(self):
        journal = FOLDER / "viewed.journal"
        with Cluster() as cluster:
            run = cluster.start_plain("run", WORLDS / "city.sdf", "--journal", journal, "--speed", 2, "--view", 0)
            with Browser(url_of(run)) as page:
                page.hears(lambda _: page.states > 3)
                order = {"type": "order", "id": 1, "robot": 3, "action": "velocity", "linear": [0, 0, 4], "angular": [0, 0, 0]}
                self.assertTrue(page.asks(order)[0])
                tick = page.tick
                page.hears(lambda _: page.tick > tick + 1200)
            run.kill()
            again = cluster.start_plain("run", WORLDS / "city.sdf", "--journal", journal, "--until", 8, "--speed", 2, "--json", cluster.json, "--view", 0)
            with Browser(url_of(again)) as page:
                page.hears(lambda _: page.states > 0)
            cluster.summary(again)
            verified = cluster.start_plain("journal", "verify", journal)
            self.assertEqual(verified.end(), 0, verified.said())

    def test_bad_addresses_are_refused(self):
        with Cluster() as cluster:
            for address in ("nonsense", "1.2.3.4:8090"):
                run = cluster.start_plain("run", *CITY, "--until", 0.1, "--view", address)
                self.assertEqual(run.end(), 1, run.said())
                self.assertIn("address", run.said())

    def test_another_host_is_refused_with_a_line(self):
        with Cluster() as cluster:
            run = cluster.start_plain("run", *CITY, "--until", 1, "--speed", 1, "--view", 0)
            request = urllib.request.Request(url_of(run), headers={"Host": "evil.example"})
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(request, timeout=20)
            self.assertEqual(refused.exception.code, 403)
            run.hears("'evil.example' [wrong-host]")


if __name__ == "__main__":
    unittest.main()
