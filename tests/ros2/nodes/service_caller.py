"""A participant of Cyclone DDS that calls the services of simulation_interfaces and Gazebo. Prints replies as JSON.

Usage: service_caller.py simulation|resets|gazebo      on a run of example:fleet
"""
import json
import sys

from cyclone_client import BOX, Peer, stamp_ns, until
from interfaces import message, value

PAUSED, PLAYING, STOPPED, NO_WORLD = 2, 1, 0, 4
POSE = message("geometry_msgs/Pose")
QUATERNION = message("geometry_msgs/Quaternion")


def plain(reply):
    """A message as lists and dictionaries, without the header of the dialect."""
    if isinstance(reply, list):
        return [plain(one) for one in reply]
    if not hasattr(reply, "__dataclass_fields__"):
        return reply
    return {name: plain(getattr(reply, name)) for name in reply.__dataclass_fields__ if name not in ("client", "number")}


def pose(x, y, z, w=1.0):
    return value(POSE, position=message("geometry_msgs/Point")(x, y, z), orientation=QUATERNION(0.0, 0.0, 0.0, w))


class Caller:
    def __init__(self):
        self.peer = Peer()
        self.services, self.seen = {}, {}

    def call(self, kind, label=None, to=None, **fields):
        """Calls simulation_interfaces/KIND, or another type, and keeps the reply."""
        last = kind.rpartition("/")[2]
        name = to or "/" + "".join("_" + c.lower() if c.isupper() else c for c in last)[1:]
        if name not in self.services:
            self.services[name] = self.peer.service(name, kind if "/" in kind else f"simulation_interfaces/{kind}")
        reply = self.services[name](**fields)
        self.seen[label or last] = None if reply is None else plain(reply)
        return reply

    def set_state(self, state, label):
        self.call("SetSimulationState", label, state=message("simulation_interfaces/SimulationState")(state))

    def queries(self):
        filters, tags = message("simulation_interfaces/EntityFilters"), message("simulation_interfaces/TagsFilter")
        bounds, corner = message("simulation_interfaces/Bounds"), message("geometry_msgs/Vector3")
        self.call("GetSimulatorFeatures")
        self.call("GetSimulationState")
        self.call("GetEntities", filters=value(filters, filter="^turtle_1[0-9]?$"))
        self.call("GetEntities", "bad filter", filters=value(filters, filter="("))
        for label, kind, points in (("entities in a box", 1, [corner(9, 9, 9), corner(-9, -9, -9)]),
                                    ("entities in a hull", 2, [corner(0, 0, 0)] * 4), ("entities in a point", 3, [corner(0, 0, 0)])):
            self.call("GetEntities", label, filters=value(filters, bounds=bounds(kind, points)))
        self.call("GetEntitiesStates", filters=value(filters, filter="turtle_1$"))
        for kind in ("GetEntityState", "GetEntityBounds", "GetEntityInfo"):
            self.call(kind, entity="turtle_1")
            self.call(kind, f"{kind} of nobody", entity="nobody")
        self.call("GetNamedPoses", tags=value(tags))
        self.call("GetNamedPoseBounds", name="home")
        self.call("GetSpawnables", sources=["http://example.org"])
        world = self.call("GetCurrentWorld").world
        self.call("GetAvailableWorlds", filter=value(tags))
        self.call("UnloadWorld")
        self.call("LoadWorld", "no world", uri="")
        self.call("LoadWorld", "another world", uri="other.sdf")
        return world.world_resource.uri

    def changes(self):
        info = message("simulation_interfaces/EntityInfo")
        category = message("simulation_interfaces/EntityCategory")
        given = info(category(4), "the second", ["red", "fast"])
        self.call("SetEntityInfo", entity="turtle_2", info=given)
        self.call("SetEntityInfo", "SetEntityInfo of nobody", entity="nobody", info=given)
        self.call("SetEntityInfo", "bad category", entity="turtle_2", info=info(category(77), "", []))
        self.call("GetEntityInfo", "info that was set", entity="turtle_2")
        self.set_state(PAUSED, "pause")
        self.set_state(PAUSED, "pause again")
        self.set_state(NO_WORLD, "no such state")
        states = message("simulation_interfaces/EntityState")
        self.call("SetEntityState", entity="turtle_2", state=value(states, pose=pose(1.0, 2.0, 0.033)))
        for label, wrong in (("bad quaternion", pose(0.0, 0.0, 0.0, 0.0)), ("bad number", pose(float("nan"), 0.0, 0.0))):
            self.call("SetEntityState", label, entity="turtle_2", state=value(states, pose=wrong))
        self.call("SetEntityState", "bad frame", entity="turtle_2", state=value(
            states, header=value(message("std_msgs/Header"), frame_id="nowhere"), pose=pose(0.0, 0.0, 0.0)))
        self.call("SetEntityState", "SetEntityState of nobody", entity="nobody", state=value(states, pose=pose(0.0, 0.0, 0.0)))
        self.call("StepSimulation", steps=5)
        self.call("GetEntityState", "state that was set", entity="turtle_2")
        self.call("StepSimulation", "no steps", steps=0)
        self.call("StepSimulation", "too many steps", steps=2**63)

    def spawns(self):
        place = value(message("geometry_msgs/PoseStamped"), pose=pose(0.0, 0.0, 1.0))
        astray = value(message("geometry_msgs/PoseStamped"), pose=pose(0.0, 0.0, 1.0, 0.0))
        resource, request = message("simulation_interfaces/Resource"), message("simulation_interfaces/SpawnRequest")
        for label, fields in (
                ("SpawnEntity", {}), ("name taken", {}), ("renamed", {"allow_renaming": True}), ("bad name", {"name": "a*b"}),
                ("bad namespace", {"name": "b", "entity_namespace": "1/b"}), ("in a namespace", {"entity_namespace": "/fleet"}),
                ("no resource", {"name": "c", "resource_string": ""}), ("no model", {"name": "d", "resource_string": "nonsense"}),
                ("broken model", {"name": "e", "resource_string": "<sdf version='1.9'><model name='e'></sdf>"}),
                ("no file", {"name": "f", "uri": "model://nowhere", "resource_string": ""}),
                ("bad pose", {"name": "g", "initial_pose": astray})):
            self.call("SpawnEntity", label, **{"name": "box_1", "resource_string": BOX, "initial_pose": place, **fields})
        one = value(request, name="box_2", entity_resource=resource("", BOX), initial_pose=place)
        self.call("SpawnEntities", spawn_requests=[one, one])
        self.call("DeleteEntity", entity="box_2")
        self.call("DeleteEntity", "DeleteEntity of nobody", entity="box_2")
        self.call("DeleteEntity", "delete scenery", entity="yard")

    def steps(self):
        action = self.peer.action("/simulate_steps", "simulation_interfaces/SimulateSteps")
        goal, sent = action.give(steps=500)
        result = action.await_result(goal)
        self.seen["steps"] = [sent.accepted, result.status, result.result.result.result,
                              [one.completed_steps + one.remaining_steps for one in action.feedback_of(goal)]]
        goal, sent = action.give(steps=10**9)
        _, other = action.give(steps=1)
        until(lambda: action.look() or action.feedback_of(goal))
        cancelled = action.cancel(goal)
        result = action.await_result(goal)
        self.seen["cancelled steps"] = [sent.accepted, other.accepted, cancelled.return_code, len(cancelled.goals_canceling),
                                        result.status]
        self.seen["no such goal"] = action.await_result(message("unique_identifier_msgs/UUID")([7] * 16)).status

    def simulation(self):
        uri = self.queries()
        self.changes()
        self.spawns()
        self.steps()
        self.call("LoadWorld", uri=uri)
        self.call("GetSimulationState", "state after a load")
        self.set_state(PLAYING, "play")
        self.call("StepSimulation", "step while it plays", steps=5)
        self.set_state(STOPPED, "stop")
        self.call("GetSimulationState", "last state")

    def resets(self):
        """Resets of all scopes while it listens: stamps of each topic by the time at which they were sent."""
        box = {"name": "box_1", "resource_string": BOX, "initial_pose": value(message("geometry_msgs/PoseStamped"),
                                                                              pose=pose(0.0, 0.0, 1.0))}
        drive = self.peer.writer("/turtle_0/cmd_vel", "geometry_msgs/Twist")
        topics = {"/clock": ("rosgraph_msgs/Clock", lambda m: m.clock), "/tf": ("tf2_msgs/TFMessage", lambda m: m.transforms[0].header.stamp),
                  "/turtle_0/scan": ("sensor_msgs/LaserScan", lambda m: m.header.stamp)}
        readers = {name: self.peer.reader(name, kind) for name, (kind, _) in topics.items()}
        heard = {name: [] for name in topics}

        def listen():
            for name, reader in readers.items():
                heard[name] += [(one.sample_info.source_timestamp, stamp_ns(topics[name][1](one))) for one in reader.take(N=1000)]

        def last_s(name):
            listen()
            return heard[name][-1][1] * 1e-9 if heard[name] else 0.0
        until(drive.get_matched_subscriptions)
        for label, scope in (("time", 1), ("state", 2), ("spawned", 4), ("state and spawned", 6), ("time and state", 3), ("all bits", 255),
                             ("default", 0)):
            drive.write(value(message("geometry_msgs/Twist"), linear=message("geometry_msgs/Vector3")(0.3, 0.0, 0.0)))
            if label != "time and state":  # which is all, where nothing was spawned
                self.call("SpawnEntity", f"box for {label}", **box)
            begin = last_s("/clock")
            while_s = 0.5 if scope in (1, 2, 4, 6) else 3.0  # so that a time from before is known, however busy the computer is
            until(lambda: min(last_s(name) for name in topics) > begin + while_s)
            self.call("ResetSimulation", label, scope=scope)
            listen()
            self.call("GetEntityState", f"turtle after {label}", entity="turtle_0")
            self.call("GetEntityState", f"box after {label}", entity="box_1")
            self.call("DeleteEntity", f"delete after {label}", entity="box_1")
        end = max(last_s("/clock"), 0.5)
        until(lambda: min(last_s(name) for name in topics) > end)
        self.seen["heard"] = heard

    def gazebo(self):
        factory, entity = message("ros_gz_interfaces/EntityFactory"), message("ros_gz_interfaces/Entity")
        control, reset = message("ros_gz_interfaces/WorldControl"), message("ros_gz_interfaces/WorldReset")
        box = {"name": "box_1", "sdf": BOX, "pose": pose(0.0, 0.0, 1.0), "relative_to": "world"}
        for label, fields in (("create", {}), ("name taken", {}), ("a copy", {"name": "b", "sdf": "", "clone_name": "turtle_1"})):
            self.call("ros_gz_interfaces/SpawnEntity", label, "/world/fleet/create", entity_factory=value(factory, **{**box, **fields}))
        for label, name in (("set_pose", "box_1"), ("set_pose of nobody", "nobody")):
            self.call("ros_gz_interfaces/SetEntityPose", label, "/world/fleet/set_pose", entity=value(entity, name=name, type=2),
                      pose=pose(3.0, 0.0, 0.5))

        def run(label, **fields):
            self.call("ros_gz_interfaces/ControlWorld", label, "/world/fleet/control", world_control=value(control, **fields))
        until(lambda: self.call("GetEntityState", "box", entity="box_1").state.pose.position.x > 2)
        run("pause", pause=True)
        run("seed", pause=True, seed=7)
        run("part", pause=True, reset=reset(False, True, False))
        run("steps", pause=True, multi_step=10)
        for label, name in (("remove", "box_1"), ("remove nobody", "box_1")):
            self.call("ros_gz_interfaces/DeleteEntity", label, "/world/fleet/remove", entity=value(entity, name=name, type=2))
        run("reset", pause=True, reset=reset(True, False, False))
        self.call("GetSimulationState", "state after reset")
        run("play")
        self.call("GetSimulationState", "last state")


caller = Caller()
getattr(caller, sys.argv[1])()
print(json.dumps(caller.seen), flush=True)
