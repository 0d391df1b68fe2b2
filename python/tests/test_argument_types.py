"""Values of a wrong type at every parameter of every public call: none shows what the bindings say of C++ types.

Most raise errors of the package; where Python itself refuses a value (an index, a dictionary's key), that will do."""
import inspect

import numpy as np
import pytest

import roboss
import roboss.analysis

WRONG = ["text", b"bytes", None, object(), 1.5, 3, True, [object()], ["text"], {}, 2**80, float("nan"), np.zeros((2, 2))]
POSE = [0, 0, 1, 0, 0, 0, 1]
#: Values of the parameters that have no default, and of keywords that a signature does not name.
VALID = {
    "source": "pile.sdf", "world": None, "name": "new", "wanted": "car_1", "robots": "car_1", "count": 2, "save": None,
    "position": [9, -9, 5], "target": [0, 0, 0], "holder": "car_0", "held": "car_1", "targets": 1.0, "wrench": [0] * 6,
    "link": None, "payload": b"hello", "q": None, "v": None, "a": None, "forces": None, "q0": [0], "q1": [1], "time": [0, 1],
    "pose0": POSE, "pose1": POSE, "file": None, "size": [1, 1, 1], "radius": 0.2, "length": 0.5, "kind": "revolute",
    "parent": "world", "child": "leaf", "path": None, "times": [0.0], "qpos": None, "qvel": None, "robot": None, "pages": 0,
    "patterns": ["car_1.pose"], "until": 0.01,
}
LOOK = {"color": [1, 0, 0], "friction": 0.5, "restitution": 0.1}
#: Calls that need a run on a cluster, or that only hand over what others made.
ELSEWHERE = {"RemoteSimulation", "Follower", "IKSolution", "JointTrajectory", "CartesianTrajectory", "Message", "Sensor", "View",
             "Camera", "RobotCameras", "Robots", "Radio", "ModelBuilder", "Save", "Diagnostic", "World"}


@pytest.fixture
def own(tmp_path):
    """For each class an object of it, and its values of VALID."""
    sim = roboss.Simulation(roboss.example("crossroads.sdf"), threads=1)
    radios = roboss.Simulation(roboss.example("radio.sdf"), threads=1)
    arms = roboss.Simulation(roboss.example("arm.sdf"), threads=1)
    arm, cars = roboss.RobotModel(arms.world, "arm"), sim.robots("car_*")
    world = roboss.WorldBuilder()
    door = world.model("door")
    door.box("leaf", [1, 1, 1], mass=1)
    yard = {"file": roboss.example("models/car/model.sdf"), "path": str(tmp_path / "yard.sdf"), "kind": "point", "size": [1, 1, 1]}
    row = np.zeros((1, 6))
    return {
        "Simulation": (sim, {"save": sim.save()}), "Batch": (roboss.Batch(sim.world, 2, threads=1), {}),
        "Robots": (cars, {"name": "cmd_vel", "link": "chassis"}), "Radio": (radios.robots("rover_*")["radio"], {}),
        "Sensor": (cars["laser"], {}), "Camera": (sim.camera([9, -9, 5], [0, 0, 0]), {}),
        "RobotCameras": (cars.camera([0, 0, 1], [1, 0, 1]), {}), "World": (sim.world, {}),
        "RobotModel": (arm, {"q": row, "v": row, "a": row, "forces": row, "link": "tool", "target": POSE,
                             "robots": arms.robots("arm")}),
        "MujocoOrder": (roboss.MujocoOrder(arm), {"q": row, "v": row, "qpos": row, "qvel": row}),
        "WorldBuilder": (world, yard), "ModelBuilder": (door, {"name": "hinge"}),
    }


def public_calls(own):
    """(name, callable, values of its parameters) of every function, class and method that is public."""
    for name in roboss.__all__:
        thing = getattr(roboss, name)
        if not callable(thing) or (isinstance(thing, type) and issubclass(thing, (Exception, Warning))):
            continue
        made, values = own.get(name, (None, {}))
        if name not in ELSEWHERE:
            yield name, thing, values
        for member, method in inspect.getmembers(made, callable) if made is not None else []:
            if not member.startswith("_") or member == "__getitem__":
                yield f"{name}.{member}", method, values
    for name in ("read", "record", "record_file", "write"):
        yield f"analysis.{name}", getattr(roboss.analysis, name), {}


def variants(call, values, tmp_path):
    """(parameter, arguments): all right but one; of each parameter every wrong value."""
    usual = {**VALID, "world": roboss.example("arm.sdf"), "robot": "arm", "source": roboss.example("crossroads.sdf"),
             "path": str(tmp_path / "out.csv"), "recording": None, **values}
    parameters = [p for p in inspect.signature(call).parameters.values() if p.kind is not p.VAR_POSITIONAL]
    named = [p.name for p in parameters if p.kind is not p.VAR_KEYWORD]
    right = {p.name: usual[p.name] for p in parameters if p.default is p.empty and p.name in usual}
    if any(p.name == "look" for p in parameters):
        named += list(LOOK)
    for name in named:
        for wrong in WRONG if name != "until" else WRONG[:6]:  # a recording until 2**80 s takes its time
            yield name, {**right, name: wrong}


def test_no_wrong_type_shows_the_text_of_the_bindings(own, tmp_path, monkeypatch, recwarn):
    monkeypatch.chdir(tmp_path)
    tried, poor = 0, []
    for name, call, values in list(public_calls(own)):
        if name in ("Simulation.view", "connect"):
            continue  # they would open ports: see below
        for parameter, arguments in variants(call, values, tmp_path):
            tried += 1
            shown = f"{name}({parameter}={arguments[parameter]!r})"
            try:
                call(**arguments)
            except Exception as error:  # of any type: its text counts
                if any(words in str(error) for words in ("incompatible function arguments", "std::", "nanobind")):
                    poor.append(f"{shown}: {type(error).__name__}: {str(error).splitlines()[0]}")
    assert tried > 1000
    assert not poor, f"{len(poor)} of {tried}:\n" + "\n".join(poor)


@pytest.mark.parametrize("parameter", ["simulation", "name", "period", "latency", "controller", "keys", "insecure",
                                       "patience"])
def test_connect_checks_types_before_it_opens_a_network(parameter):
    for wrong in (None, object(), [3]):
        with pytest.raises(roboss.ArgumentError) as error:
            roboss.connect(**{parameter: wrong})
        assert error.value.code == "bad-type"


def test_view_checks_types_before_it_opens_a_port(crossroads):
    for arguments in ({"port": "8090"}, {"port": 1.5}, {"address": None}, {"address": 3}, {"height": "tall"}):
        with pytest.raises(roboss.ArgumentError) as error:
            crossroads.view(**arguments)
        assert error.value.code == "bad-type", arguments
