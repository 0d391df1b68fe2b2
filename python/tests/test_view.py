"""Simulation.view(): the page, its scene, and when it ends. What pages see and order: tests/gateway/local_view_test.cpp."""
import gc
import hashlib
import json
import os
import socket
import ssl
import subprocess
import sys
import time
import urllib.error
import urllib.request

import numpy as np
import pytest

import roboss

BALL = """<robot name="ball"><link name="body"><inertial><mass value="1"/>
  <inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><sphere radius="0.3"/></geometry><material name="m"><color rgba="0 1 0 1"/></material></visual>
  <collision><geometry><sphere radius="0.3"/></geometry></collision></link></robot>"""


def get(view, path=""):
    with urllib.request.urlopen(view.url + path, timeout=20) as answer:
        return answer.read()


class Page:
    """The connection of a page, as a browser opens it."""

    def __init__(self, view):
        host, port = view.url.split("/")[2].rsplit(":", 1)
        self.socket = socket.create_connection((host, int(port)), timeout=20)
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\nOrigin: http://{host}:{port}\r\nUpgrade: websocket\r\n"
                             "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: roboss.1\r\n"
                             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n").encode())
        self.seen = b""

    def read_until(self, words, patience_s=20):
        end = time.monotonic() + patience_s
        while words not in self.seen and time.monotonic() < end:
            part = self.socket.recv(65536)
            if not part:
                break
            self.seen += part
        return words in self.seen


@pytest.fixture
def open_page():
    """Opens pages; their connections end with the test."""
    pages = []
    yield lambda view: pages.append(Page(view)) or pages[-1]
    for page in pages:
        page.socket.close()


@pytest.fixture
def viewed(crossroads):
    with crossroads.view() as view:
        yield crossroads, view


def test_serves_page_and_scene_while_nothing_is_stepped(viewed):
    sim, view = viewed
    assert b"page.js" in get(view) and len(get(view, "page.js")) > 100_000
    assert [robot["name"] for robot in json.loads(get(view, "scene"))["robots"]] == list(sim.world.robots)


def test_a_page_is_counted_hears_of_steps_and_of_the_end(viewed, open_page):
    sim, view = viewed
    page = open_page(view)
    assert view.wait(1, timeout=20) and view.pages == 1
    assert page.read_until(b'"paused":true') and page.read_until(sim.state_hash.encode())
    sim.step(50)
    assert page.read_until(sim.state_hash.encode())
    view.close()
    assert page.read_until(b"the program has closed the view")
    sim.step(1)


def test_steps_are_shown_in_the_midst_of_one_call(viewed, open_page):
    sim, view = viewed
    page = open_page(view)
    assert page.read_until(b'"tick":0')
    start = time.monotonic()
    while b'"paused":false' not in page.seen and time.monotonic() < start + 60:
        sim.step(5000)
        page.socket.settimeout(0.01)
        try:
            page.seen += page.socket.recv(1 << 20)
        except TimeoutError:
            pass
    assert b'"paused":false' in page.seen


def test_no_bit_depends_on_a_page(viewed, open_page):
    sim, view = viewed
    page = open_page(view)
    assert page.read_until(b"status")
    for target in np.linspace(2, 9, 8):
        sim.robots("car_*").set_joint_targets(target)
        sim.step(100)
    alone = roboss.Simulation(roboss.example("crossroads.sdf"))
    for target in np.linspace(2, 9, 8):
        alone.robots("car_*").set_joint_targets(target)
        alone.step(100)
    assert sim.state_hash == alone.state_hash


def test_robots_that_come_are_shown_with_their_colours(viewed, open_page):
    sim, view = viewed
    before = json.loads(get(view, "scene"))
    page = open_page(view)
    assert page.read_until(b"status")
    sim.spawn(BALL, ["green_0", "green_1"], [[0, 0, 2, 0, 0, 0, 1], [0, 0, 4, 0, 0, 0, 1]])
    sim.remove("car_1*")
    end = time.monotonic() + 20
    while (scene := json.loads(get(view, "scene")))["scene"] == before["scene"] and time.monotonic() < end:
        time.sleep(0.05)
    names = [robot["name"] for robot in scene["robots"]]
    assert names == list(sim.world.robots) and "green_1" in names
    ball = scene["types"][scene["robots"][names.index("green_1")]["type"]]
    assert [visual["rgb"] for link in ball["links"] for visual in link["visuals"]] == [[0, 1, 0]]


def test_one_view_each_on_ports_of_their_own(viewed):
    sim, view = viewed
    assert sim.view() is view
    with roboss.Simulation(roboss.example("pile.sdf")).view() as other:
        assert other.url != view.url
    view.close()
    assert view.closed and view.pages == 0 and "closed" in repr(view)
    with pytest.raises(urllib.error.URLError):
        get(view)
    with sim.view() as again:
        assert again is not view and b"page.js" in get(again)


def test_ends_with_its_simulation(open_page):
    sim = roboss.Simulation(roboss.example("pile.sdf"))
    view = sim.view()
    page = open_page(view)
    assert page.read_until(b"status")
    del sim
    gc.collect()
    assert page.read_until(b"the simulation has ended") and view.closed
    view.close()


def test_ends_with_the_program(open_page):
    script = ("import roboss, sys\nsim = roboss.Simulation(roboss.example('pile.sdf'))\nview = sim.view()\n"
              "print(view.url, flush=True)\nview.wait(timeout=30)\nsim.step(100)\n")
    with subprocess.Popen([sys.executable, "-P", "-c", script], stdout=subprocess.PIPE, text=True,
                          env={**os.environ, "PYTHONWARNINGS": "error"}) as program:
        url = program.stdout.readline().strip()
        page = open_page(type("Of", (), {"url": url}))
        assert page.read_until(b"the program has closed the view")
        assert program.wait(timeout=30) == 0


def test_frames_itself_in_notebooks(viewed):
    _, view = viewed
    assert f'<iframe src="{view.url}?hide=panels"' in view._repr_html_()
    view.close()
    assert "iframe" not in view._repr_html_()


def test_is_encrypted_for_other_computers_unless_insecure(crossroads):
    unchecked = ssl.create_default_context()
    unchecked.check_hostname, unchecked.verify_mode = False, ssl.CERT_NONE
    with crossroads.view(address="0.0.0.0") as view:
        url = view.url.replace("0.0.0.0", "127.0.0.1")
        assert url.startswith("https://") and "token=" in url
        port = int(url.split(":")[2].split("/")[0])
        shown = ssl.PEM_cert_to_DER_cert(ssl.get_server_certificate(("127.0.0.1", port)))
        assert view.fingerprint.replace(":", "").lower() == hashlib.sha256(shown).hexdigest()
        with urllib.request.urlopen(url, timeout=20, context=unchecked) as answer:
            assert answer.status == 200
    with crossroads.view(address="0.0.0.0", insecure=True) as view:
        assert view.url.startswith("http://") and "token=" in view.url and view.fingerprint == ""


def test_says_what_is_wrong(crossroads):
    with pytest.raises(roboss.UnknownNameError, match="steer"):
        crossroads.view(role="administer")
    with pytest.raises(roboss.ArgumentError, match="port"):
        crossroads.view(70000)
    with pytest.raises(roboss.ViewError) as refused:
        crossroads.view(address="192.0.2.1")
    assert refused.value.remedy
