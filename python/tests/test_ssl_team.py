"""A team of the Small Size League in Python (examples/soccer/ssl_team.py) plays over UDP."""
import importlib.util
import math
import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import REPOSITORY

BUILD = Path(os.environ.get("ROBOSS_BUILD", REPOSITORY / "build" / "release"))


@pytest.fixture(name="ssl_team", scope="module")
def load_ssl_team():
    spec = importlib.util.spec_from_file_location("ssl_team", REPOSITORY / "examples" / "soccer" / "ssl_team.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(name="messages", scope="module")
def load_messages(ssl_team):
    return ssl_team.load_messages()


def sight(messages, ball, blue, yellow):
    """A packet of ssl-vision; positions in mm, heading in rad."""
    packet = messages.SSL_WrapperPacket()
    frame = packet.detection
    frame.frame_number, frame.t_capture, frame.t_sent, frame.camera_id = 0, 0, 0, 0
    frame.balls.add(confidence=1, x=ball[0], y=ball[1], pixel_x=0, pixel_y=0)
    for robots, places in ((frame.robots_blue, blue), (frame.robots_yellow, yellow)):
        for number, (x, y, heading) in enumerate(places):
            robots.add(confidence=1, robot_id=number, x=x, y=y, orientation=heading, pixel_x=0, pixel_y=0)
    return packet


def test_it_kicks_only_where_it_stands_behind_the_ball(ssl_team, messages):
    team = ssl_team.Team(messages, yellow=False)
    keeper, ball = (-4400, 0, 0), (1000, 0)
    aim = math.atan2(0.3, 3.5)
    team.look(sight(messages, ball, [keeper, (880, -10, aim)], [(4400, 0, math.pi)]))
    attacker = team.commands().robot_commands[1]
    assert attacker.kick_speed > 0 and attacker.dribbler_speed > 0
    assert attacker.move_command.global_velocity.x > 0
    team.look(sight(messages, ball, [keeper, (1300, 0, aim)], [(4400, 0, math.pi)]))
    attacker = team.commands().robot_commands[1]
    assert not attacker.HasField("kick_speed"), "it would kick towards its own goal"
    assert attacker.move_command.global_velocity.x < 0


def test_yellow_plays_the_other_way(ssl_team, messages):
    team = ssl_team.Team(messages, yellow=True)
    team.look(sight(messages, (-1000, 0), [(-4400, 0, 0)], [(4400, 0, 0), (-880, 10, math.pi + math.atan2(0.3, 3.5))]))
    attacker = team.commands().robot_commands[1]
    assert attacker.kick_speed > 0
    assert attacker.move_command.global_velocity.x < 0


def division_a(messages, ball, blue):
    """Sight and geometry of a field of division A."""
    packet = sight(messages, ball, blue, [])
    field = packet.geometry.field
    field.field_length, field.field_width, field.boundary_width = 12000, 9000, 300
    field.goal_width, field.goal_depth = 1800, 180
    field.penalty_area_depth, field.penalty_area_width = 1800, 3600
    return packet


class Posts:
    """A socket that counts what is sent."""

    def __init__(self):
        self.count = 0

    def sendto(self, _data, _address):
        self.count += 1


@pytest.mark.parametrize("ball, goals, placed", [
    ((0, 4000), 0, 0), ((0, 4600), 0, 1), ((6100, 800), 1, 1), ((6100, 1000), 0, 1),
])
def test_the_referee_takes_field_and_goal_from_the_geometry(ssl_team, messages, ball, goals, placed):
    team, referee, posts = ssl_team.Team(messages, yellow=False), ssl_team.Referee(messages, ("", 0)), Posts()
    for time, place in ((1.0, (0, 0)), (1.1, ball), (1.7, ball)):
        team.look(division_a(messages, place, []))
        referee.look(team, time, posts)
    assert (referee.goals["blue"], posts.count) == (goals, placed)


def test_the_goalkeeper_takes_goal_and_penalty_area_from_the_geometry(ssl_team, messages):
    team = ssl_team.Team(messages, yellow=False)

    def keeper(ball, at):
        team.look(division_a(messages, ball, [at]))
        return team.commands().robot_commands[0]

    assert keeper((-4500, 1500), (-5000, 0, 0)).dribbler_speed > 0, "the ball is in its area: it clears it"
    assert keeper((-4300, 0), (-5000, 0, 0)).dribbler_speed == 0
    move = keeper((-5000, 4000), (-5850, 600, 0)).move_command.global_velocity
    assert move.y > 0.1, "it goes to the post, 0.9 m from the middle"


def test_damaged_datagrams_are_no_packet(ssl_team, messages):
    good = sight(messages, (0, 0), [(0, 0, 0)], [])
    assert ssl_team.packet_of(messages, good.SerializeToString()) == good
    assert ssl_team.packet_of(messages, b"\xff\xff\xff") is None
    assert ssl_team.packet_of(messages, b"\x0a\x00") is None, "required fields are missing"
    assert ssl_team.packet_of(messages, sight(messages, (0, 0), [(0, 0, math.inf)], []).SerializeToString()) is None


def test_a_damaged_datagram_is_reported_once_and_does_not_end_the_team(messages):
    vision, commands = free_ports(1), socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    with commands, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as camera:
        commands.bind(("127.0.0.1", 0))
        commands.settimeout(0.2)
        team = subprocess.Popen([sys.executable, REPOSITORY / "examples" / "soccer" / "ssl_team.py", "blue", "--vision",
                                 f"127.0.0.1:{vision}", "--port", str(commands.getsockname()[1])],
                                stderr=subprocess.PIPE, text=True)
        answer, good = b"", sight(messages, (0, 0), [(0, 0, 0), (-1000, 0, 0)], []).SerializeToString()
        try:
            for _ in range(150):
                for data in (b"\xff\xff\xff", b"\xff", good):
                    camera.sendto(data, ("127.0.0.1", vision))
                try:
                    answer = commands.recv(65536)
                    break
                except TimeoutError:
                    continue
        finally:
            team.terminate()
            said = team.communicate()[1]
    assert len(messages.RobotControl.FromString(answer).robot_commands) == 2
    assert said == "ssl_team: a datagram of 3 bytes is no packet of ssl-vision: ignored\n"


def test_the_generated_file_is_removed(ssl_team, tmp_path, monkeypatch):
    monkeypatch.setattr(ssl_team.tempfile, "tempdir", str(tmp_path))
    assert ssl_team.load_messages().SSL_WrapperPacket
    assert not list(tmp_path.iterdir())


def free_ports(count):
    """The first of a number of free UDP ports in a row, and one more."""
    while True:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind(("127.0.0.1", 0))
            first = probe.getsockname()[1]
        try:
            for port in range(first, first + count + 1):
                with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
                    probe.bind(("127.0.0.1", port))
            return first
        except OSError:
            continue


def test_it_drives_to_the_ball_and_kicks_it(ssl_team, messages, tmp_path):
    world = tmp_path / "ssl.sdf"
    subprocess.run([BUILD / "bin" / "roboss-world", "soccer", "--league", "ssl-b", "-o", world], check=True)
    control = free_ports(3)
    eyes = ssl_team.vision_socket("127.0.0.1", 0, "127.0.0.1")
    eyes.settimeout(30)
    environment = {**os.environ, "ROBOSS_SOCCER_CONTROL": f"127.0.0.1:{control}",
                   "ROBOSS_SOCCER_COMMANDS": f"127.0.0.1:{control + 3}",
                   "ROBOSS_SOCCER_VISION": f"127.0.0.1:{eyes.getsockname()[1]}"}
    run = subprocess.Popen([BUILD / "bin" / "roboss", "run", world, "--headless", "--speed", "1", "--client",
                            BUILD / "lib" / "roboss_soccer_ssl_bridge.so"], env=environment, stderr=subprocess.DEVNULL)
    team, mouth = ssl_team.Team(messages, yellow=False), socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    team.half_length = 0
    try:
        at, speed, last = 0, 0, None
        while at < 10 and speed < 3:
            packet = messages.SSL_WrapperPacket.FromString(eyes.recv(65536))
            at = packet.detection.t_capture
            team.look(packet)
            mouth.sendto(team.commands().SerializeToString(), ("127.0.0.1", control + 1))
            if last and at > last[0]:
                speed = math.dist(team.ball, last[1]) / (at - last[0])
            last = at, team.ball
    finally:
        run.terminate()
        run.wait()
        eyes.close()
        mouth.close()
    assert speed >= 3
    assert team.half_length == 4.5, "from the geometry"
