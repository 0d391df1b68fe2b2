"""A participant of Cyclone DDS that operates a run by simulation_interfaces, as rmw_cyclonedds would. Prints JSON.

Usage: run_operator.py      on a run of example:fleet
"""
import json

from cyclone_client import BOX, Peer
from interfaces import message, value

PAUSED, PLAYING = 2, 1


def main():
    peer = Peer()
    get_state, set_state, step, spawn, delete = (
        peer.service(name, f"simulation_interfaces/{kind}") for name, kind in (
            ("/get_simulation_state", "GetSimulationState"), ("/set_simulation_state", "SetSimulationState"),
            ("/step_simulation", "StepSimulation"), ("/spawn_entity", "SpawnEntity"), ("/delete_entity", "DeleteEntity")))
    state = message("simulation_interfaces/SimulationState")

    def code(reply):
        return None if reply is None else [reply.result.result, reply.result.error_message]

    def spawn_at(height):
        point, pose = message("geometry_msgs/Point"), message("geometry_msgs/Pose")
        place = value(pose, position=point(0.0, 0.0, height), orientation=message("geometry_msgs/Quaternion")(0.0, 0.0, 0.0, 1.0))
        return spawn(name="box_1", resource_string=BOX, initial_pose=value(message("geometry_msgs/PoseStamped"), pose=place))

    seen = {"first": get_state().state.state, "step while it plays": code(step(steps=5)), "pause": code(set_state(state=state(PAUSED))),
            "paused": get_state().state.state, "step": code(step(steps=50)), "spawn": code(spawn_at(1.0)), "again": code(spawn_at(2.0)),
            "delete": code(delete(entity="box_1")), "unknown": code(delete(entity="box_1")),
            "play": code(set_state(state=state(PLAYING))), "last": get_state().state.state}
    print(json.dumps(seen), flush=True)


main()
