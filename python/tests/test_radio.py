"""Radios: messages between robots."""
import numpy as np
import pytest

import roboss


@pytest.fixture
def rovers():
    return roboss.Simulation(roboss.example("radio.sdf"), threads=1, seed=3).robots("rover_*")


def payloads(rovers):
    return [[m.payload for m in heard] for heard in rovers["radio"].receive()]


def test_a_radio_is_a_sensor(rovers):
    radio = rovers["radio"]
    assert isinstance(radio, roboss.Radio) and radio.kind == "radio"
    assert radio.units["strengths"] == "dBm"
    rovers[:1]["radio"].send("hello")
    rovers.simulation.step(20)
    reading = radio.read_all()
    assert reading["senders"][1] == ["rover_0"] and reading["payloads"][1] == [b"hello".hex()]
    assert len(reading["strengths"][0]) == 0 and len(reading["strengths"][2]) == 1


def test_each_message_is_received_once(rovers):
    rovers[:1]["radio"].send(b"\x00\xff")
    assert payloads(rovers) == [[], [], [], []]
    rovers.simulation.step(20)
    (message,) = rovers[1:2]["radio"].receive()[0]
    assert (message.sender, message.to, message.sent, message.payload) == ("rover_0", None, 0.0, b"\x00\xff")
    # two bytes at 100 kbit/s take 0.16 ms: there at the next tick
    assert message.arrived == 0.002 and message.channel == 1
    assert np.isclose(message.strength, 0 - 40 - 25 * np.log10(20))
    assert payloads(rovers) == [[], [], [b"\x00\xff"], []]
    rovers.simulation.step(20)
    assert payloads(rovers) == [[], [], [], []]


def test_addressees_and_lists(rovers):
    rovers[1:3]["radio"].send([b"one", b"two"], to=["rover_0", None])
    rovers.simulation.step(20)
    assert payloads(rovers)[0] == []  # both send at once: they disturb each other
    rovers[1:2]["radio"].send(bytearray(b"three"), to="rover_2")
    rovers.simulation.step(20)
    heard = rovers["radio"].receive()
    assert [len(row) for row in heard] == [0, 0, 1, 0]
    assert heard[2][0].to == "rover_2"


def test_the_parts_of_a_step_do_not_matter():
    seen = []
    for parts in ([40], [13, 13, 14], [1] * 40):
        rovers = roboss.Simulation(roboss.example("radio.sdf"), seed=3).robots("rover_*")
        rovers[:1]["radio"].send(b"x" * 100)
        for ticks in parts:
            rovers.simulation.step(ticks)
        seen.append((rovers["radio"].receive(), rovers.simulation.state_hash))
    assert seen[0] == seen[1] == seen[2]
    assert [len(row) for row in seen[0][0]] == [0, 1, 1, 0]


def test_a_saved_state_has_what_is_on_its_way(rovers):
    sim = rovers.simulation
    rovers[:1]["radio"].send(b"y" * 1000)  # 80 ms
    sim.step(10)
    saved = sim.save()
    sim.step(60)
    heard = rovers["radio"].receive()
    sim.restore(saved)
    assert payloads(rovers) == [[], [], [], []]
    sim.step(60)
    assert rovers["radio"].receive() == heard and len(heard[1]) == 1
    sim.reset()
    sim.step(60)
    assert payloads(rovers) == [[], [], [], []]


def test_a_batch_has_a_radio_world_each():
    batch = roboss.Batch(roboss.example("radio.sdf"), 3, threads=2)
    rovers = batch.robots("rover_*")
    rovers[:1]["radio"].send([b"a", b"b", b"c"])
    batch.step(20)
    heard = [[m.payload for m in row] for row in rovers["radio"].receive()]
    assert heard == [[], [b"a"], [b"a"], [], [], [b"b"], [b"b"], [], [], [b"c"], [b"c"], []]


def test_what_makes_no_sense_is_refused(rovers):
    radio = rovers["radio"]
    before = rovers.simulation.state_hash
    with pytest.raises(roboss.ArgumentError):
        radio.send([b"only one"])
    with pytest.raises(roboss.ArgumentError):
        radio.send(b"x", to="")
    with pytest.raises(roboss.UnknownNameError):
        radio.send(b"x", to="rover_9")
    with pytest.raises(roboss.OrderError):
        radio.send(b"x" * 9000)
    with pytest.raises(roboss.OrderError):  # rover_0 to itself; then none is sent
        radio.send(b"x", to="rover_0")
    assert rovers.simulation.state_hash == before
    rovers.simulation.step(20)
    assert payloads(rovers) == [[], [], [], []]
