"""A participant of Cyclone DDS that operates a run by simulation_interfaces, as rmw_cyclonedds would. Prints JSON.

Usage: run_operator.py      on a run with the robot turtle_0
"""
import json
import time
from dataclasses import dataclass, make_dataclass

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import float64, int32, int64, uint8, uint32, uint64
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

PATIENCE = 20  # s
CLIENT = 4711
BOX = """<sdf version="1.9"><model name="box"><link name="link"><inertial><mass>1</mass></inertial><collision name="c">
<geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model></sdf>"""
QOS = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10), Policy.Userdata(b"clientid=1;"))
PAUSED, PLAYING, OK = 2, 1, 1


@dataclass
class Result(IdlStruct, typename="simulation_interfaces::msg::dds_::Result_"):
    result: uint8
    error_message: str


@dataclass
class Point(IdlStruct, typename="geometry_msgs::msg::dds_::Point_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Quaternion(IdlStruct, typename="geometry_msgs::msg::dds_::Quaternion_"):
    x: float64
    y: float64
    z: float64
    w: float64


@dataclass
class PoseStamped(IdlStruct, typename="geometry_msgs::msg::dds_::PoseStamped_"):
    sec: int32
    nanosec: uint32
    frame_id: str
    position: Point
    orientation: Quaternion


class Service:
    """A client of a service; its types are the header of Cyclone's dialect and these fields."""

    def __init__(self, participant, name, type_name, request, reply):
        def struct(end, fields):
            head = [("client", uint64), ("number", int64)]
            return make_dataclass(f"{type_name}{end}", head + fields, bases=(IdlStruct,), eq=False, namespace={
                "__idl_typename__": f"simulation_interfaces::srv::dds_::{type_name}_{end}_"})

        self.request = struct("Request", request)
        self.writer = DataWriter(participant, Topic(participant, f"rq/{name}Request", self.request), qos=QOS)
        self.reader = DataReader(participant, Topic(participant, f"rr/{name}Reply", struct("Response", reply)), qos=QOS)
        self.calls = 0

    def __call__(self, *values):
        end = time.monotonic() + PATIENCE
        while not (self.writer.get_matched_subscriptions() and self.reader.get_matched_publications()):
            if time.monotonic() > end:
                return None
            time.sleep(0.02)
        self.calls += 1
        self.writer.write(self.request(CLIENT, self.calls, *values))
        while time.monotonic() < end:
            for reply in self.reader.take():
                if (reply.client, reply.number) == (CLIENT, self.calls):
                    return reply
            time.sleep(0.01)
        return None


def main():
    participant = DomainParticipant()

    def service(name, type_name, request, reply):
        return Service(participant, name, type_name, request, reply)

    get_state = service("get_simulation_state", "GetSimulationState", [("unused", uint8)], [("state", uint8), ("result", Result)])
    set_state = service("set_simulation_state", "SetSimulationState", [("state", uint8)], [("result", Result)])
    step = service("step_simulation", "StepSimulation", [("steps", uint64)], [("result", Result)])
    spawn = service("spawn_entity", "SpawnEntity",
                    [("name", str), ("allow_renaming", bool), ("uri", str), ("resource_string", str), ("entity_namespace", str),
                     ("initial_pose", PoseStamped)], [("result", Result), ("entity_name", str)])
    delete = service("delete_entity", "DeleteEntity", [("entity", str)], [("result", Result)])

    def code(reply):
        return None if reply is None else [reply.result.result, reply.result.error_message]

    seen = {"first": get_state(0).state, "step while it plays": code(step(5)), "pause": code(set_state(PAUSED)),
            "paused": get_state(0).state, "step": code(step(50)),
            "spawn": code(spawn("box_1", False, "", BOX, "", PoseStamped(0, 0, "", Point(0, 0, 1), Quaternion(0, 0, 0, 1)))),
            "again": code(spawn("box_1", False, "", BOX, "", PoseStamped(0, 0, "", Point(0, 0, 2), Quaternion(0, 0, 0, 1)))),
            "delete": code(delete("box_1")), "nobody": code(delete("box_1")), "play": code(set_state(PLAYING)),
            "last": get_state(0).state}
    print(json.dumps(seen), flush=True)


main()
