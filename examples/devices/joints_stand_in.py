#!/usr/bin/env python3
"""Plays robots and an overhead camera that speak the UDP protocol `joints` (docs/devices.md).

    python3 joints_stand_in.py ../../worlds/soccer.sdf --robot blue_0:2008 --camera 2009 --loss 0.1 --late 0.1 --double 0.1

It steps a world of its own by its own clock. Packets are lost, come late or twice, in both directions; a robot that
hears nothing for the time of the watchdog stops. Port 0 takes a free one; the ports are printed. Needs the Python
package roboss.
"""
import argparse
import heapq
import itertools
import json
import random
import select
import socket

from stand_in import Diary, Hardware, guarded, say, share

VERSION = 1


class Port:
    """A UDP socket whose packets suffer."""

    order = itertools.count()

    def __init__(self, number, hardware, options):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", number))
        self.socket.setblocking(False)
        self.number, self.hardware, self.options = self.socket.getsockname()[1], hardware, options
        self.peer, self.waiting, self.session = None, [], 0
        self.boot, self.sequence, self.heard = random.getrandbits(32), 0, 0

    def fates(self, packet):
        """When the packet arrives, once or twice; never, if it is lost."""
        options, now = self.options, self.hardware.clock()
        if self.hardware.happens(options.loss):
            return
        for _ in range(1 + self.hardware.happens(options.double)):
            late = self.hardware.random.uniform(0.02, 0.08) if self.hardware.happens(options.late) else 0.0
            yield now + late, next(self.order), packet

    def take(self):
        """Commands that arrived, the newest only; None: none."""
        newest = None
        for _ in range(200):
            try:
                text, peer = self.socket.recvfrom(65536)
            except BlockingIOError:
                break
            for fate in self.fates(("in", text, peer)):
                heapq.heappush(self.waiting, fate)
        while self.waiting and self.waiting[0][0] <= self.hardware.clock():
            way, text, peer = heapq.heappop(self.waiting)[2]
            if way == "out":
                self.socket.sendto(text, peer)
                continue
            packet = json.loads(text)
            if packet["roboss"] != VERSION:
                continue
            if packet["session"] != self.session:   # another RoBOSS
                self.peer, self.session, self.heard = peer, packet["session"], 0
            if packet["seq"] > self.heard:          # late and doubled ones are older
                self.heard, newest = packet["seq"], packet
        return newest

    def send(self, **values):
        if self.peer is None:
            return
        self.sequence += 1
        packet = {"roboss": VERSION, "type": "readings", "boot": self.boot, "seq": self.sequence,
                  "stamp_s": self.hardware.clock(), "session": self.session, "ack": self.heard, **values}
        for fate in self.fates(("out", json.dumps(packet).encode(), self.peer)):
            heapq.heappush(self.waiting, fate)

    def reboot(self):
        self.boot, self.sequence, self.heard, self.waiting = random.getrandbits(32), 0, 0, []
        self.session, self.peer = 0, None


class Robot:
    def __init__(self, name, port):
        self.port, self.name = port, name
        self.robot = port.hardware.simulation.robots(name)
        self.diary = Diary(self.robot)
        self.watchdog_s, self.command_s, self.stopped = 0.5, 0.0, True
        self.dead_until = 0.0
        self.stop()

    def stop(self):
        """Wheels stop; an arm holds where it is."""
        self.stopped = True
        limits = self.robot.joint_limits
        for number, joint in enumerate(self.robot.joints):
            if abs(limits[number, 0]) < 1e6:
                self.robot.set_joint_targets(self.robot.joint_position[:, number], joint, mode="position")
            else:
                self.robot.set_joint_targets(0.0, joint)

    def obey(self, packet, now):
        if packet["type"] == "stop":
            if not self.stopped:
                self.stop()
                self.diary.count("stops")
        else:
            self.watchdog_s, self.command_s, self.stopped = packet["watchdog_s"], now, False
            for joint, order in packet["joints"].items():
                self.robot.set_joint_targets(order.get("target", 0.0), joint, mode=order["mode"],
                                             max_effort=order.get("max_effort"))

    def readings(self):
        robot, rng = self.robot, self.port.hardware.random
        noise = self.port.options.noise
        joints = {name: {"position": float(robot.joint_position[0, i]) + rng.gauss(0, noise),
                         "velocity": float(robot.joint_velocity[0, i]) + rng.gauss(0, noise)}
                  for i, name in enumerate(robot.joints)}
        return {"robot": self.name, "joints": joints}

    def turn(self, now, due):
        if now < self.dead_until:
            self.port.take()
            return
        packet = self.port.take()
        if packet is not None:
            self.obey(packet, now)
        if not self.stopped and now - self.command_s > self.watchdog_s:
            self.stop()
            self.diary.count("watchdog")
        if due:
            self.diary.note()
            self.port.send(**self.readings())

    def reboot(self, now):
        self.port.reboot()
        self.stop()
        self.dead_until = now + 0.3
        self.diary.count("reboots")


class Camera:
    """Sees all robots of the world that move."""

    def __init__(self, port):
        self.port = port
        self.robots = port.hardware.simulation.robots("*")

    def turn(self, now, due):
        self.port.take()
        if not due:
            return
        poses = self.robots.pose
        self.port.send(poses={name: {"position": poses[i, :3].tolist(), "quat_xyzw": poses[i, 3:].tolist()}
                              for i, name in enumerate(self.robots.names)})


class Beat:
    """Every `period` s of the stand-in's clock."""

    def __init__(self, rate):
        self.period, self.next = 1 / rate, 0.0

    def is_due(self, now):
        if now < self.next:
            return False
        self.next = max(self.next + self.period, now)
        return True


def is_port(text):
    return text.isdecimal() and int(text) <= 65535


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("world", help="world file that plays the real world")
    parser.add_argument("--robot", action="append", default=[], metavar="NAME:PORT", help="may be repeated")
    parser.add_argument("--camera", type=int, metavar="PORT")
    parser.add_argument("--rate", type=float, default=100, help="readings a second")
    parser.add_argument("--frames", type=float, default=60, help="images of the camera a second")
    parser.add_argument("--noise", type=float, default=0.0, help="of joints, rad, standard deviation")
    parser.add_argument("--loss", type=share, default=0.0, help="share of the packets that are lost")
    parser.add_argument("--late", type=share, default=0.0, help="share that comes 20 to 80 ms late")
    parser.add_argument("--double", type=share, default=0.0, help="share that comes twice")
    parser.add_argument("--drift", type=float, default=0.0, help="how much too fast its clock is: 0.02 is 2 %%")
    parser.add_argument("--reboot-at", type=float, action="append", default=[], help="s, by its clock (may be repeated)")
    parser.add_argument("--duration", type=float, default=0.0, help="s; 0: until SIGTERM")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if min(options.rate, options.frames) <= 0:
        parser.error("--rate and --frames take numbers above 0")
    if not options.robot and options.camera is None:
        parser.error("nothing to play: give --robot NAME:PORT, --camera PORT or both")
    for each in options.robot:
        if not is_port(each.partition(":")[2]):
            parser.error(f"--robot {each}: write NAME:PORT, for instance blue_0:2008; a port is at most 65535")
    if not is_port(str(options.camera or 0)):
        parser.error(f"--camera {options.camera}: a port is a number from 0 to 65535")
    hardware = Hardware(options.world, options.drift, options.seed)
    robots = []
    for each in options.robot:
        name, _, number = each.partition(":")
        robots.append(Robot(name, Port(int(number or 0), hardware, options)))
    camera = None if options.camera is None else Camera(Port(options.camera, hardware, options))
    members = robots + ([camera] if camera else [])
    say(robots={robot.name: robot.port.number for robot in robots}, camera=camera and camera.port.number)
    readings, frames, reboots = Beat(options.rate), Beat(options.frames), sorted(options.reboot_at)
    while not hardware.over and (not options.duration or hardware.clock() < options.duration):
        select.select([member.port.socket for member in members], [], [], 0.002)
        hardware.step()
        now = hardware.clock()
        if reboots and now > reboots[0]:
            reboots.pop(0)
            for robot in robots:
                robot.reboot(now)
        due = readings.is_due(now)
        for robot in robots:
            robot.turn(now, due)
        if camera:
            camera.turn(now, frames.is_due(now))
    say(**{robot.name: robot.diary.summary() for robot in robots})


if __name__ == "__main__":
    guarded(main)
