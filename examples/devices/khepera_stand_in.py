#!/usr/bin/env python3
"""Plays a Khepera on a serial line, so that `roboss device` can be tried without one.

    python3 khepera_stand_in.py ../../worlds/khepera.sdf --drop 0.001 --drift 0.02 --reboot-at 5

It makes a pseudo terminal and prints its path: connect to it with --connect serial:PATH,38400 --protocol khepera. It
steps a world of its own by its own clock, and answers the commands B, D, E, G, H, N and O of the manual (K-Team, "Khepera
II User Manual" 1.1, appendix A) at the speed of the line. Needs the Python package roboss.
"""
import argparse
import math
import os
import pty
import select
import tty

from stand_in import Diary, Hardware, guarded, say, share

EYES = ["left", "front_left", "ahead_left", "ahead_right", "front_right", "right", "back_right", "back_left"]
PULSE = 2 * math.pi / 600           # rad
SPEED = 100 * PULSE                 # rad/s: a pulse in 10 ms
BITS = 11                           # of a character: start, 8, 2 stop bits
BANNER = "\r\nK-TEAM KHEPERA stand-in\r\nROM of RoBOSS 1.0\r\n"


class Khepera:
    def __init__(self, options):
        self.options = options
        self.hardware = Hardware(options.world, options.drift, options.seed)
        self.robot = self.hardware.simulation.robots(options.robot)
        self.diary = Diary(self.robot)
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.zero, self.dead_until = [0.0, 0.0], 0.0
        self.reboots = sorted(options.reboot_at)
        self.input, self.output, self.credit, self.sent_s = b"", b"", 0.0, 0.0
        self.drive(0, 0)

    def drive(self, left, right):
        self.robot.set_joint_targets([left * SPEED, right * SPEED], ["left", "right"])

    def counts(self):
        """Pulses of the left and the right wheel since the last reboot."""
        columns = [self.robot.joints.index(name) for name in ("left", "right")]
        angles = self.robot.joint_position[0][columns]
        return [round((angle - zero) / PULSE) for angle, zero in zip(angles, self.zero)]

    def answer(self, line):
        """The reply to a command; an unknown one gets none."""
        word, *rest = line.split(",")
        try:
            numbers = [int(number) for number in rest]
        except ValueError:
            return None
        if word == "D" and len(numbers) == 2:
            self.drive(*(max(-127, min(127, number)) for number in numbers))
            self.diary.count("speeds_set")
            return "d"
        if word == "G" and len(numbers) == 2:
            columns = [self.robot.joints.index(name) for name in ("left", "right")]
            angles = self.robot.joint_position[0][columns]
            self.zero = [angle - number * PULSE for angle, number in zip(angles, numbers)]
            return "g"
        if numbers:
            return None
        if word == "H":
            return "h,%d,%d" % tuple(self.counts())
        if word == "E":
            columns = [self.robot.joints.index(name) for name in ("left", "right")]
            return "e,%d,%d" % tuple(round(v / SPEED) for v in self.robot.joint_velocity[0][columns])
        if word == "N":
            return "n," + ",".join("%d" % round(self.robot[eye].read_all()["value"][0]) for eye in EYES)
        if word == "O":
            return "o," + ",".join(["450"] * len(EYES))
        if word == "B":
            return "b,5.01,5.01"
        return None

    def reboot(self):
        """Its wheels stop, it counts from zero, says nothing for a moment, and then its banner."""
        self.drive(0, 0)
        columns = [self.robot.joints.index(name) for name in ("left", "right")]
        self.zero = list(self.robot.joint_position[0][columns])
        self.input = self.output = b""
        self.dead_until = self.hardware.clock() + 0.3
        self.diary.count("reboots")

    def turn(self):
        ready, _, _ = select.select([self.master], [], [], 0.002)
        heard = os.read(self.master, 4096) if ready else b""
        if self.hardware.step():
            self.diary.note()
        now = self.hardware.clock()
        if self.reboots and now > self.reboots[0]:
            self.reboots.pop(0)
            self.reboot()
        if self.dead_until:
            if now < self.dead_until:
                return
            self.dead_until = 0.0
            self.output += BANNER.encode()
        self.input += bytes(c for c in heard if not self.loses())
        while b"\n" in self.input:
            line, self.input = self.input.split(b"\n", 1)
            reply = self.answer(line.decode("latin-1").strip()) if line.strip() else None
            if reply is not None:
                self.output += (reply + "\r\n").encode()
                self.diary.count("answers")
        self.send(now)

    def loses(self):
        lost = self.hardware.happens(self.options.drop)
        self.diary.count("characters_lost", lost)
        return lost

    def send(self, now):
        """As many characters as the line carries since the last call."""
        elapsed, self.sent_s = max(0.0, now - self.sent_s), now     # the clock stands still after a stall
        self.credit = min(self.credit + elapsed * self.options.baud / BITS, 64.0) if self.output else 0.0
        size = int(self.credit)
        piece, self.output = self.output[:size], self.output[size:]
        self.credit -= len(piece)
        kept = bytes(c for c in piece if not self.loses())
        if kept:
            os.write(self.master, kept)

    def run(self):
        say(serial=os.ttyname(self.slave))
        while not self.hardware.over and (not self.options.duration or self.hardware.clock() < self.options.duration):
            self.turn()
        say(**self.diary.summary())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("world", help="world file that plays the real world")
    parser.add_argument("--robot", default="khepera")
    parser.add_argument("--baud", type=int, default=38400)
    parser.add_argument("--drop", type=share, default=0.0, help="share of the characters that are lost, both ways")
    parser.add_argument("--drift", type=float, default=0.0, help="how much too fast its clock is: 0.02 is 2 %%")
    parser.add_argument("--reboot-at", type=float, action="append", default=[], help="s, by its clock (may be repeated)")
    parser.add_argument("--duration", type=float, default=0.0, help="s; 0: until SIGTERM")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if options.baud <= 0:
        parser.error("--baud takes a number above 0")
    Khepera(options).run()


if __name__ == "__main__":
    guarded(main)
