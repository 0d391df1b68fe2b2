#!/usr/bin/env python3
"""A team of the Small Size League as a program of its own: it reads ssl-vision's packets and sends commands of the
league's simulation protocol over UDP. It knows nothing of RoBOSS, and plays in grSim as well.

    python examples/soccer/ssl_team.py blue --referee &  python examples/soccer/ssl_team.py yellow &

Needs protoc (Debian: protobuf-compiler) and the Python package protobuf. Blue plays towards +x.
"""
import argparse
import importlib
import math
import socket
import struct
import subprocess
import sys
import tempfile
from pathlib import Path


def load_messages():
    """The classes that protoc makes of messages/ssl.proto."""
    folder = tempfile.mkdtemp()
    source = Path(__file__).resolve().parent / "messages"
    subprocess.run(["protoc", f"--proto_path={source}", f"--python_out={folder}", "ssl.proto"], check=True)
    sys.path.insert(0, folder)
    return importlib.import_module("ssl_pb2")


def vision_socket(address, port, interface):
    """Receives what is sent to the address, which may be one of this computer instead of a multicast group."""
    result = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    result.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    result.bind((address, port))
    if 224 <= int(address.split(".")[0]) < 240:
        member = struct.pack("4s4s", socket.inet_aton(address), socket.inet_aton(interface))
        result.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    return result


def newest(sock):
    """The last datagram that has arrived; waits for one."""
    data = sock.recv(65536)
    sock.setblocking(False)
    try:
        while True:
            data = sock.recv(65536)
    except BlockingIOError:
        return data
    finally:
        sock.setblocking(True)


def wrapped(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


class Team:
    """Positions in m, as a team sees them that plays towards +x."""

    def __init__(self, messages, yellow):
        self.messages, self.yellow = messages, yellow
        self.side = -1 if yellow else 1
        self.half_length = 4.5

    def look(self, packet):
        if packet.HasField("geometry"):
            self.half_length = packet.geometry.field.field_length / 2000
        frame, s = packet.detection, self.side / 1000
        own, others = frame.robots_blue, frame.robots_yellow
        if self.yellow:
            own, others = others, own
        turn = math.pi if self.yellow else 0
        self.own = {r.robot_id: (s * r.x, s * r.y, wrapped(r.orientation + turn)) for r in own}
        self.others = [(s * r.x, s * r.y) for r in others]
        self.ball = (s * frame.balls[0].x, s * frame.balls[0].y) if frame.balls else (0, 0)

    def drive(self, command, robot, x, y, heading, speed=1.5):
        """Towards the point and the heading, with velocities in the axes of the field, past robots in the way."""
        me_x, me_y, yaw = robot
        dx, dy = x - me_x, y - me_y
        far = max(math.hypot(dx, dy), 1e-6)
        v = min(speed, math.sqrt(2 * 2.0 * far), 4 * far)
        vx, vy = v * dx / far, v * dy / far
        for ox, oy in self.others + [r[:2] for r in self.own.values() if r is not robot]:
            away_x, away_y = me_x - ox, me_y - oy
            gap = max(math.hypot(away_x, away_y), 1e-6)
            if gap < 0.35 and far > 0.15:
                push = 1.2 * (0.35 - gap) / 0.35 / gap
                vx, vy = vx + push * (away_x - away_y), vy + push * (away_y + away_x)
        move = command.move_command.global_velocity
        move.x, move.y = self.side * vx, self.side * vy
        move.angular = max(-6.0, min(6.0, 5 * wrapped(heading - yaw)))

    def attack(self, command, robot):
        """Behind the ball, to it with a turning dribbler, with it towards the goal, and a kick where the goal is free."""
        bx, by = self.ball
        keeper = min(self.others, key=lambda r: math.hypot(r[0] - self.half_length, r[1]), default=(0, 0))
        aim = -0.3 if keeper[1] > 0 else 0.3
        heading = math.atan2(aim - by, self.half_length - bx)
        ux, uy = math.cos(heading), math.sin(heading)
        along = (bx - robot[0]) * ux + (by - robot[1]) * uy
        aside = (robot[0] - bx) * uy - (robot[1] - by) * ux
        command.dribbler_speed = 3000
        if along > 0.02 and abs(aside) < 0.04 and abs(wrapped(heading - robot[2])) < 0.15:
            self.drive(command, robot, bx + 0.2 * ux, by + 0.2 * uy, heading, 0.8)
            if math.hypot(self.half_length - bx, by) < 4.5:
                command.kick_speed, command.kick_angle = 5.5, 0
        else:
            round_it = 0.25 * math.copysign(1, -aside) if along < 0.1 else 0
            self.drive(command, robot, bx - 0.22 * ux - round_it * uy, by - 0.22 * uy + round_it * ux, heading)

    def commands(self):
        control = self.messages.RobotControl()
        bx, by = self.ball
        field = [i for i in self.own if i != 0]
        attacker = min(field, key=lambda i: math.hypot(self.own[i][0] - bx + 0.2, self.own[i][1] - by), default=None)
        for number, robot in sorted(self.own.items()):
            command = control.robot_commands.add(id=number, dribbler_speed=0)
            if number == 0 and bx < 0.8 - self.half_length and abs(by) < 1:  # the goalkeeper clears the ball
                self.attack(command, robot)
            elif number == 0:  # and stands between ball and goal otherwise
                y = max(-0.4, min(0.4, by * 0.6 / max(bx + self.half_length, 0.6)))
                self.drive(command, robot, -self.half_length + 0.15, y, 0, 2)
            elif number == attacker:
                self.attack(command, robot)
            else:  # the others fall back in a line between ball and own goal
                place = sorted(i for i in field if i != attacker).index(number)
                x = max(-self.half_length + 1.3, min(bx - 1.2 - 0.5 * (place % 2), self.half_length - 2))
                self.drive(command, robot, x, 1.1 * (place - (len(field) - 2) / 2), math.atan2(by - robot[1], bx - robot[0]))
        return control


class Referee:
    """Counts goals, and puts a ball that left the field for half a second, or rests for five, on the centre mark."""

    def __init__(self, messages, address):
        self.messages, self.address, self.goals = messages, address, {"blue": 0, "yellow": 0}
        self.inside = self.moved = self.placed = 0.0
        self.rest = (0, 0)

    def look(self, team, time, sock):
        x, y = team.side * team.ball[0], team.side * team.ball[1]
        if math.hypot(x - self.rest[0], y - self.rest[1]) > 0.05:
            self.rest, self.moved = (x, y), time
        in_goal = abs(x) > team.half_length + 0.03 and abs(y) < 0.5
        if abs(x) < team.half_length + 0.03 and abs(y) < 3.03:
            self.inside = time
        if time < self.placed + 1 or not (in_goal or time > self.inside + 0.5 or time > self.moved + 5):
            return
        if in_goal:
            self.goals["blue" if x > 0 else "yellow"] += 1
            print(f"{time:.2f} s: goal, {self.goals}", flush=True)
        command = self.messages.SimulatorCommand()
        ball = command.control.teleport_ball
        ball.x, ball.y, ball.z = 0, 0, 0
        sock.sendto(command.SerializeToString(), self.address)
        self.placed = self.inside = self.moved = time


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("team", choices=["blue", "yellow"])
    parser.add_argument("--simulator", default="127.0.0.1", help="address of the simulator (default %(default)s)")
    parser.add_argument("--port", type=int, help="of the team's commands (default: 10301 blue, 10302 yellow)")
    parser.add_argument("--vision", default="224.5.23.2:10020", help="where ssl-vision sends to (default %(default)s)")
    parser.add_argument("--interface", default="127.0.0.1", help="that vision comes in at (default %(default)s)")
    parser.add_argument("--referee", action="store_true", help="count goals and put the ball back on the field")
    args = parser.parse_args()
    messages = load_messages()
    group, port = args.vision.rsplit(":", 1)
    eyes = vision_socket(group, int(port), args.interface)
    mouth = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    to = (args.simulator, args.port or (10302 if args.team == "yellow" else 10301))
    team = Team(messages, args.team == "yellow")
    referee = Referee(messages, (args.simulator, 10300)) if args.referee else None
    while True:
        packet = messages.SSL_WrapperPacket.FromString(newest(eyes))
        if packet.HasField("detection"):
            team.look(packet)
            if referee:
                referee.look(team, packet.detection.t_capture, mouth)
            mouth.sendto(team.commands().SerializeToString(), to)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
