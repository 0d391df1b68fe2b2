"""A participant of Cyclone DDS beside transport_probe, for transport_test.py: what rmw_cyclonedds says, in its dialect.

cyclone_peer.py talk      uses what the probe offers and prints what it saw as one line of JSON
cyclone_peer.py join N    joins and leaves N times; prints how often it met the probe in between. Most leave during discovery,
                          each eighth stays until it has met the probe
"""
import json
import sys
import time
from dataclasses import dataclass

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import float64, int64, uint8, uint64
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

PATIENCE = 15  # s
WRONG_HASH = b"typehash=RIHS01_" + b"0" * 64 + b";"


@dataclass
class Text(IdlStruct, typename="std_msgs::msg::dds_::String_"):
    data: str


@dataclass
class Vector(IdlStruct, typename="geometry_msgs::msg::dds_::Vector3_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Twist(IdlStruct, typename="geometry_msgs::msg::dds_::Twist_"):
    linear: Vector
    angular: Vector


@dataclass
class Request(IdlStruct, typename="std_srvs::srv::dds_::Trigger_Request_"):
    client: uint64
    number: int64
    unused: uint8


@dataclass
class Short(IdlStruct, typename="std_srvs::srv::dds_::Trigger_Request_"):
    unused: uint8


@dataclass
class Reply(IdlStruct, typename="std_srvs::srv::dds_::Trigger_Response_"):
    client: uint64
    number: int64
    success: bool
    message: str


def until(condition):
    end = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)


def join(times):
    met = 0
    for number in range(times):
        participant = DomainParticipant()
        reader = DataReader(participant, Topic(participant, "rt/chatter", Text), qos=Qos(Policy.Reliability.Reliable(duration(seconds=1))))
        end = time.monotonic() + (0.1 if number % 8 else PATIENCE)
        while not reader.get_matched_publications() and time.monotonic() < end:
            time.sleep(0.01)
        met += bool(reader.get_matched_publications())
        for entity in (reader, participant):
            entity.__del__()
    print(met)


def talk():
    participant = DomainParticipant()
    reliable = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10))
    latched = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.TransientLocal)
    of_service = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10), Policy.Userdata(b"clientid=1;"))
    of_other_version = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.Userdata(WRONG_HASH))
    chatter = DataReader(participant, Topic(participant, "rt/chatter", Text), qos=reliable)
    description = DataReader(participant, Topic(participant, "rt/car_3/robot_description", Text), qos=latched)
    echo = DataReader(participant, Topic(participant, "rt/car_3/echo", Twist), qos=reliable)
    orders = DataWriter(participant, Topic(participant, "rt/car_3/cmd_vel", Twist), qos=of_other_version)
    requests = DataWriter(participant, Topic(participant, "rq/car_3/resetRequest", Request), qos=of_service)
    replies = DataReader(participant, Topic(participant, "rr/car_3/resetReply", Reply), qos=of_service)
    until(lambda: requests.get_matched_subscriptions() and replies.get_matched_publications() and orders.get_matched_subscriptions())
    seen = {"chatter": [], "latched": [], "echo": [], "replies": []}
    for number in range(1, 6):
        requests.write(Request(77, number, 0))
        until(lambda: seen["replies"].extend(replies.take()) or len(seen["replies"]) >= number)
    orders.write(Twist(Vector(1, 0, 0), Vector(0, 0, 2)))

    def have_all():
        seen["echo"].extend(echo.take())
        seen["chatter"].extend(chatter.take())
        seen["latched"].extend(description.take())
        return all(seen.values())

    until(have_all)
    # A request that is shorter than its header and fields.
    other = DomainParticipant()
    short = DataWriter(other, Topic(other, "rq/car_3/resetRequest", Short), qos=of_service)
    until(short.get_matched_subscriptions)
    short.write(Short(1))
    requests.write(Request(77, 6, 0))
    until(lambda: seen["replies"].extend(replies.take()) or len(seen["replies"]) >= 6)
    print(json.dumps({"chatter": [message.data for message in seen["chatter"]],
                      "latched": [message.data for message in seen["latched"]],
                      "echo": [[message.linear.x, message.angular.z] for message in seen["echo"]],
                      "replies": [[reply.client, reply.number, reply.success, reply.message] for reply in seen["replies"]]}))


if __name__ == "__main__":
    talk() if sys.argv[1] == "talk" else join(int(sys.argv[2]))
