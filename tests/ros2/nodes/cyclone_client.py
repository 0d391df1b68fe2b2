"""A participant of Cyclone DDS with topics, services and actions, as rmw_cyclonedds makes them."""
import time
import uuid

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from interfaces import fields_of, message, parts, struct, types, value

PATIENCE = 20  # s
BOX = """<sdf version="1.9"><model name="box"><link name="link"><inertial><mass>1</mass></inertial><collision name="c">
<geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model></sdf>"""
CLIENT = 4711
RELIABLE = Policy.Reliability.Reliable(duration(seconds=1))
VOLATILE = Qos(RELIABLE, Policy.History.KeepLast(100))
LATCHED = Qos(RELIABLE, Policy.Durability.TransientLocal, Policy.History.KeepLast(1))
OF_SERVICE = Qos(RELIABLE, Policy.History.KeepLast(10), Policy.Userdata(b"clientid=1;"))
HEADER = [("client", types.uint64), ("number", types.int64)]


def until(condition, seconds=PATIENCE):
    """The first value of the condition that is true, or its last one."""
    end = time.monotonic() + seconds
    while not (holds := condition()) and time.monotonic() < end:
        time.sleep(0.01)
    return holds


def stamp_ns(time_message):
    return time_message.sec * 10**9 + time_message.nanosec


class Peer:
    """See the top of the file."""

    def __init__(self):
        self.participant = DomainParticipant()

    def topic(self, name, kind):
        return Topic(self.participant, name, kind)

    def reader(self, name, kind, qos=VOLATILE):
        return DataReader(self.participant, self.topic("rt" + name, message(kind) if isinstance(kind, str) else kind), qos=qos)

    def writer(self, name, kind):
        return DataWriter(self.participant, self.topic("rt" + name, message(kind)), qos=VOLATILE)

    def service(self, name, kind):
        """A client of /NAME of the type "package/Name"."""
        package, last = kind.split("/")
        request, reply = parts(kind)
        return Service(self, name, f"{package}/srv/{last}", request, reply)

    def action(self, name, kind):
        return Action(self, name, kind)


class Service:
    """A client of a service; its types have the header of Cyclone's dialect in front."""

    def __init__(self, peer, name, kind, request, reply):
        self.request = struct(kind + "_Request", HEADER + request)
        self.writer = DataWriter(peer.participant, peer.topic(f"rq{name}Request", self.request), qos=OF_SERVICE)
        self.reader = DataReader(peer.participant, peer.topic(f"rr{name}Reply", struct(kind + "_Response", HEADER + reply)),
                                 qos=OF_SERVICE)
        self.calls = 0
        self.replies = {}

    def is_there(self):
        return bool(self.writer.get_matched_subscriptions() and self.reader.get_matched_publications())

    def send(self, **fields):
        """Sends a request; its number."""
        until(self.is_there)
        self.calls += 1
        self.writer.write(value(self.request, client=CLIENT, number=self.calls, **fields))
        return self.calls

    def reply(self, number):
        """The reply to a request, if it has come."""
        for reply in self.reader.take(N=1000):
            if reply.client == CLIENT:
                self.replies[reply.number] = reply
        return self.replies.get(number)

    def __call__(self, **fields):
        number = self.send(**fields)
        return until(lambda: self.reply(number))


class Action:
    """A client of an action."""

    def __init__(self, peer, name, kind):
        package, last = kind.split("/")
        goal, result, feedback = parts(kind)
        base = f"{package}/action/{last}"
        self.goal = struct(base + "_Goal", goal)
        identity = [("goal_id", message("unique_identifier_msgs/UUID"))]
        self.send_goal = Service(peer, f"{name}/_action/send_goal", base + "_SendGoal", identity + [("goal", self.goal)],
                            fields_of("bool accepted, builtin_interfaces/Time stamp"))
        self.result = Service(peer, f"{name}/_action/get_result", base + "_GetResult", identity,
                              [("status", types.int8), ("result", struct(base + "_Result", result))])
        self.cancel_goal = Service(peer, f"{name}/_action/cancel_goal", "action_msgs/srv/CancelGoal", *parts("action_msgs/CancelGoal"))
        self.feedback = peer.reader(f"{name}/_action/feedback", struct(
            base + "_FeedbackMessage", identity + [("feedback", struct(base + "_Feedback", feedback))]))
        self.status = peer.reader(f"{name}/_action/status", "action_msgs/GoalStatusArray", LATCHED)
        self.seen, self.statuses = [], []

    def is_there(self):
        return (all(service.is_there() for service in (self.send_goal, self.result, self.cancel_goal)) and
                self.feedback.get_matched_publications() and self.status.get_matched_publications())

    def give(self, **fields):
        """The id of a goal, and the reply to it."""
        until(self.is_there)
        goal_id = message("unique_identifier_msgs/UUID")(list(uuid.uuid4().bytes))
        return goal_id, self.send_goal(goal_id=goal_id, goal=value(self.goal, **fields))

    def look(self):
        """Takes feedback and status messages that have come."""
        self.seen += self.feedback.take(N=1000)
        for array in self.status.take(N=1000):
            self.statuses += [(bytes(one.goal_info.goal_id.uuid), one.status) for one in array.status_list]

    def cancel(self, goal_id):
        return self.cancel_goal(goal_info=value(message("action_msgs/GoalInfo"), goal_id=goal_id))

    def await_result(self, goal_id, seconds=PATIENCE):
        number = self.result.send(goal_id=goal_id)

        def has_come():
            self.look()
            return self.result.reply(number)
        result = until(has_come, seconds)
        self.look()
        return result

    def feedback_of(self, goal_id):
        return [one.feedback for one in self.seen if bytes(one.goal_id.uuid) == bytes(goal_id.uuid)]

    def statuses_of(self, goal_id):
        return [status for one, status in self.statuses if one == bytes(goal_id.uuid)]
