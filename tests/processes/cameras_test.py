"""Cameras of Clients in processes of their own: images from visuals that came over the network are those of one process, bit for
bit; robots that are added are seen."""
import os
import struct
import subprocess
import time
import unittest
import zlib

from members import DRIVER as EYES
from members import FOLDER, ROBOSS, Cluster, embedded

ROBOTS = 100
PERIOD = 50  # ticks between two observations of the program, and until its orders have effect
CAMERA = """<sensor name="{name}" type="{type}"><pose>.12 0 .1 0 .1 0</pose><camera><horizontal_fov>1.3</horizontal_fov>
<image><width>{size}</width><height>{size}</height></image><clip><near>.01</near><far>60</far></clip></camera></sensor>"""
ROOF = '<visual name="roof"><pose>0 0 .1 0 0 0</pose><geometry><mesh><uri>roof.obj</uri></mesh></geometry></visual>'
LABEL = '<plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>{}</label></plugin>'


def write_picture(path):
    """A PNG of 4 x 4 pixels in many colours."""
    rows = b"".join(b"\0" + bytes((40 * x, 60 * y, 255 - 15 * x * y)[c] for x in range(4) for c in range(3)) for y in range(4))
    chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def rover(name, x, y, yaw, sensors):
    return f"""<model name="{name}"><pose>{x} {y} .11 0 0 {yaw}</pose><link name="body">
<inertial><mass>1</mass><inertia><ixx>.01</ixx><iyy>.01</iyy><izz>.01</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
<collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry></collision>
<visual name="shell"><geometry><box><size>.2 .2 .2</size></box></geometry>
<material><diffuse>.2 {.1 + .8 * abs(y) / 12} .7 1</diffuse></material></visual>
{ROOF}{sensors}</link>{LABEL.format(3)}</model>"""


def world_of(robots, sensors):
    """A world with meshes, a picture and lights, in a folder of its own."""
    folder = FOLDER / f"eyes_{robots}_{time.monotonic_ns()}"
    folder.mkdir()
    write_picture(folder / "paint.png")
    (folder / "roof.mtl").write_text("newmtl paint\nKd 1 1 1\nmap_Kd paint.png\n")
    (folder / "roof.obj").write_text("mtllib roof.mtl\nusemtl paint\nv -.1 -.1 0\nv .1 -.1 0\nv .1 .1 0\nv -.1 .1 0\nv 0 0 .2\n"
                                     "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .5 .5\nf 1/1 2/2 5/5\nf 2/2 3/3 5/5\nf 3/3 4/4 5/5\nf 4/4 1/1 5/5\n")
    placed = "".join(rover(f"rover_{i}", i % 10 - 4.5, i // 10 - 4.5, .6 * i, sensors) for i in range(robots))
    (folder / "world.sdf").write_text(f"""<sdf version="1.9"><world name="eyes">
<physics type="ode"><max_step_size>.002</max_step_size></physics>
<light name="sun" type="directional"><direction>.4 .3 -.9</direction><cast_shadows>true</cast_shadows></light>
<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision>
<visual name="v"><geometry><plane><size>40 40</size></plane></geometry></visual></link></model>{placed}</world></sdf>""")
    return folder / "world.sdf"


def seen(path, end=1 << 62):
    """What a program wrote: {(tick, robot, sensor): hash}. Before `end`, the last tick of the run, the world waits for replies
    that have effect by then: whether a Client elsewhere still observes later ticks is a matter of time."""
    rows = [line.split() for line in path.read_text().splitlines()]
    return {tuple(row[:3]): row[3] for row in rows if int(row[0]) + PERIOD < end}


class Cameras(unittest.TestCase):
    def sees(self, share, name):
        """The settings of a program; where it writes."""
        file = FOLDER / f"{name}_{time.monotonic_ns()}.txt"
        os.environ["ROBOSS_EYES"], os.environ["ROBOSS_EYES_SHARE"] = str(file), share
        return file

    def in_one_process(self, run):
        file = self.sees("0/1", "one")
        expected = embedded(*run, "--headless", "--client", EYES)
        return seen(file, expected["ticks"]), expected["state_hash"]

    def on_a_cluster(self, run, clients):
        names = [f"eyes{k}" for k in range(clients)]
        with Cluster() as cluster:
            controller = cluster.controller(*run, "--simulators", 2, *(word for name in names for word in ("--await-client", name)))
            files, others = [], [cluster.simulator(), cluster.simulator()]
            for k, name in enumerate(names):
                files.append(self.sees(f"{k}/{clients}", name))
                others.append(cluster.start("client", EYES, "--name", name))
            summary = cluster.summary(controller)
            for other in others:
                self.assertEqual(other.end(20), 0, other.said())
        found = {}
        for file in files:
            found.update(seen(file, summary["ticks"]))
        return found, summary["state_hash"]

    def test_four_processes_see_with_a_hundred_robots_what_one_process_sees(self):
        sensors = CAMERA.format(name="eye", type="camera", size=16) + CAMERA.format(name="depth", type="depth_camera", size=12)
        run = [world_of(ROBOTS, sensors), "--duration", .6, "--seed", 3]
        images, state = self.in_one_process(run)
        self.assertEqual(len(images), 5 * ROBOTS * 2)
        self.assertGreater(len(set(images.values())), ROBOTS, "images differ")
        self.assertEqual(self.on_a_cluster(run, 4), (images, state))

    def test_all_kinds_of_cameras_see_the_same_over_the_network(self):
        kinds = ["camera", "wideanglecamera", "depth_camera", "rgbd_camera", "segmentation_camera", "boundingbox_camera", "thermal_camera"]
        run = [world_of(3, "".join(CAMERA.format(name=kind, type=kind, size=24) for kind in kinds)), "--duration", .3]
        images, state = self.in_one_process(run)
        self.assertEqual(len(images), 2 * 3 * len(kinds))
        self.assertEqual(self.on_a_cluster(run, 1), (images, state))

    def test_a_robot_that_is_added_is_seen_and_the_program_begins_again(self):
        world = world_of(2, CAMERA.format(name="eye", type="camera", size=24))
        crate = FOLDER / "crate.sdf"
        crate.write_text(f'<sdf version="1.9">{rover("crate", 0, 0, 0, "").replace(ROOF, "")}</sdf>')
        with Cluster() as cluster:
            controller = cluster.controller(world, "--speed", 1, "--simulators", 1, "--await-client", "eyes")
            cluster.simulator()
            file = self.sees("0/1", "eyes")
            client = cluster.start("client", EYES, "--name", "eyes")
            rests = lambda: file.exists() and len({image for key, image in seen(file).items() if int(key[0]) >= 250 and key[1] == "rover_1"}) == 1
            self.wait(lambda: rests() and len(seen(file)) >= 20)
            before = set(seen(file).values())
            self.ask(cluster, "add", crate, "--pose", "-2.7 -3.95 .11 0 0 0")
            client.hears("the world has changed")
            images = lambda: {image for key, image in seen(file).items() if key[1] == "rover_1"} if file.exists() else set()
            self.wait(lambda: images() and not before & images())
            self.ask(cluster, "quit")
            self.assertEqual(controller.end(20), 0)
            self.assertEqual(client.end(20), 0, client.said())

    def ask(self, cluster, *words):
        done = subprocess.run([ROBOSS, "control", "--simulation", cluster.name, *cluster.place, "--quiet", *map(str, words)],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stdout}{done.stderr}")

    def wait(self, true, timeout_s=30):
        end = time.monotonic() + timeout_s
        while not true():
            self.assertLess(time.monotonic(), end, "it does not happen")
            time.sleep(.05)


if __name__ == "__main__":
    unittest.main()
