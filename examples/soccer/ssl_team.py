#!/usr/bin/env python3
"""A team of the Small Size League as a program of its own: it reads ssl-vision's packets and sends commands of the
league's simulation protocol over UDP. It knows nothing of RoBOSS, and plays in grSim as well.

    python examples/soccer/ssl_team.py blue --referee &  python examples/soccer/ssl_team.py yellow &

Needs protoc (Debian: protobuf-compiler) and the Python package protobuf. Blue plays towards +x.
"""
import argparse
import importlib.util
import ipaddress
import math
import socket
import struct
import subprocess
import sys
import tempfile
from pathlib import Path


class SetupError(Exception):
    """Something that the program needs is missing; the text has a remedy."""


def load_messages():
    """The classes that protoc makes of messages/ssl.proto; raises SetupError."""
    source = Path(__file__).resolve().parent / "messages"
    with tempfile.TemporaryDirectory() as folder:
        try:
            subprocess.run(["protoc", f"--proto_path={source}", f"--python_out={folder}", "ssl.proto"], check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            raise SetupError(f"protoc does not run: {error}\n  remedy: install it (Debian: protobuf-compiler)") from None
        spec = importlib.util.spec_from_file_location("ssl_pb2", Path(folder) / "ssl_pb2.py")
        messages = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(messages)
        except Exception as error:  # ImportError, TypeError or protobuf's VersionError: it depends on the two versions
            raise SetupError(f"the Python package protobuf is missing or does not fit protoc: {error}\n"
                             "  remedy: pip install --upgrade protobuf") from None
    return messages


def packet_of(messages, data):
    """The packet of ssl-vision; None if the bytes are none, or the heading of a robot is not finite."""
    from google.protobuf.message import DecodeError  # here, because load_messages reports a missing package
    try:
        packet = messages.SSL_WrapperPacket.FromString(data)
    except DecodeError:
        return None
    robots = [*packet.detection.robots_blue, *packet.detection.robots_yellow]
    return packet if packet.IsInitialized() and all(math.isfinite(r.orientation) for r in robots) else None


def vision_socket(address, port, interface):
    """Receives what is sent to the address, which may be one of this computer instead of a multicast group."""
    result = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    result.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    result.bind((address, port))
    if 224 <= int(address.split(".")[0]) < 240:
        member = struct.pack("4s4s", socket.inet_aton(address), socket.inet_aton(interface))
        result.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    return result


def arrived(sock):
    """The datagrams that have arrived, oldest first; waits for one."""
    data = [sock.recv(65536)]
    sock.setblocking(False)
    try:
        while True:
            data.append(sock.recv(65536))
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
        # Division B, until the geometry comes.
        self.half_length, self.half_width, self.half_goal = 4.5, 3.0, 0.5
        self.area_depth, self.area_half = 1.0, 1.0  # the penalty area: along x, along y

    def measure(self, field):
        """Takes the lengths of the geometry; old ones have no penalty area."""
        self.half_length, self.half_width = field.field_length / 2000, field.field_width / 2000
        self.half_goal = field.goal_width / 2000
        if field.HasField("penalty_area_depth") and field.HasField("penalty_area_width"):
            self.area_depth, self.area_half = field.penalty_area_depth / 1000, field.penalty_area_width / 2000

    def look(self, packet):
        if packet.HasField("geometry"):
            self.measure(packet.geometry.field)
        if not packet.HasField("detection"):
            return
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
        aim = (-0.6 if keeper[1] > 0 else 0.6) * self.half_goal
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
        area_x = self.area_depth - self.half_length  # the line before the own penalty area
        field = [i for i in self.own if i != 0]
        attacker = min(field, key=lambda i: math.hypot(self.own[i][0] - bx + 0.2, self.own[i][1] - by), default=None)
        for number, robot in sorted(self.own.items()):
            command = control.robot_commands.add(id=number, dribbler_speed=0)
            if number == 0 and bx < area_x - 0.2 and abs(by) < self.area_half:  # the goalkeeper clears the ball
                self.attack(command, robot)
            elif number == 0:  # and stands between ball and goal otherwise
                reach = self.half_goal - 0.1
                y = max(-reach, min(reach, by * 0.6 / max(bx + self.half_length, 0.6)))
                self.drive(command, robot, -self.half_length + 0.15, y, 0, 2)
            elif number == attacker:
                self.attack(command, robot)
            else:  # the others fall back in a line between ball and own goal
                place = sorted(i for i in field if i != attacker).index(number)
                x = max(area_x + 0.3, min(bx - 1.2 - 0.5 * (place % 2), self.half_length - 2))
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
        in_goal = abs(x) > team.half_length + 0.03 and abs(y) < team.half_goal
        if abs(x) < team.half_length + 0.03 and abs(y) < team.half_width + 0.03:
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


def ipv4(text):
    try:
        return str(ipaddress.IPv4Address(text))
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no IPv4 address; give, for example, 127.0.0.1") from None


def port(text):
    if not (text.isdecimal() and 1 <= int(text) <= 65535):
        raise argparse.ArgumentTypeError(f"'{text}' is no port; give a number from 1 to 65535")
    return int(text)


def endpoint(text):
    """(address, port) of ADDRESS:PORT."""
    if ":" not in text:
        raise argparse.ArgumentTypeError(f"'{text}' is no ADDRESS:PORT; give, for example, 224.5.23.2:10020")
    address, number = text.rsplit(":", 1)
    return ipv4(address), port(number)


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("team", choices=["blue", "yellow"])
    parser.add_argument("--simulator", type=ipv4, default="127.0.0.1", help="address of the simulator (default %(default)s)")
    parser.add_argument("--port", type=port, help="of the team's commands (default: 10301 blue, 10302 yellow)")
    parser.add_argument("--vision", type=endpoint, default="224.5.23.2:10020",
                        help="where ssl-vision sends to (default %(default)s)")
    parser.add_argument("--interface", type=ipv4, default="127.0.0.1", help="that vision comes in at (default %(default)s)")
    parser.add_argument("--referee", action="store_true", help="count goals and put the ball back on the field")
    return parser.parse_args()


def play(messages, eyes, args):
    """Until it is interrupted."""
    mouth = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    to = (args.simulator, args.port or (10302 if args.team == "yellow" else 10301))
    team = Team(messages, args.team == "yellow")
    referee = Referee(messages, (args.simulator, 10300)) if args.referee else None
    complained = False
    while True:
        frame = None
        for data in arrived(eyes):
            packet = packet_of(messages, data)
            if packet is None:
                if not complained:
                    print(f"ssl_team: a datagram of {len(data)} bytes is no packet of ssl-vision: ignored", file=sys.stderr)
                complained = True
                continue
            team.look(packet)
            frame = packet.detection if packet.HasField("detection") else frame
        if frame:
            if referee:
                referee.look(team, frame.t_capture, mouth)
            mouth.sendto(team.commands().SerializeToString(), to)


def main():
    args = options()
    try:
        messages = load_messages()
        play(messages, vision_socket(*args.vision, args.interface), args)
    except SetupError as error:
        print(f"ssl_team: {error}", file=sys.stderr)
    except OSError as error:
        print(f"ssl_team: the network refuses: {error.strerror}\n"
              "  remedy: check --vision (a multicast group or an address of this computer, a free port), --interface and "
              "--simulator", file=sys.stderr)
    return 2


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
