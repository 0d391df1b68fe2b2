"""A participant of Cyclone DDS that gives trajectories to an arm: to the end, cancelled, replaced, refused. Prints JSON.

Usage: arm_commander.py ACTION JOINT_STATES JOINT JOINT [...]      of joints that start at 0; the first two move
"""
import json
import sys
import time

from cyclone_client import Peer, until
from interfaces import message, value

POINT = message("trajectory_msgs/JointTrajectoryPoint")
TRAJECTORY = message("trajectory_msgs/JointTrajectory")
TOLERANCE = message("control_msgs/JointTolerance")
DURATION = message("builtin_interfaces/Duration")


class Commander:
    def __init__(self, action, joint_states, joints):
        peer = Peer()
        self.joints = joints
        self.action = peer.action(action, "control_msgs/FollowJointTrajectory")
        self.states = peer.reader(joint_states, "sensor_msgs/JointState")
        self.positions = {}

    def look(self):
        for state in self.states.take(N=1000):
            self.positions = dict(zip(state.name, state.position))
        return self.positions

    def trajectory(self, *points, joints=None):
        """Points: seconds and the positions of the first two joints; the others stay."""
        names = joints or self.joints
        rows = [value(POINT, positions=[*map(float, first), *[0.0] * (len(names) - 2)],
                      time_from_start=DURATION(int(seconds), int(seconds % 1 * 1e9))) for seconds, *first in points]
        return {"trajectory": value(TRAJECTORY, joint_names=list(names), points=rows),
                "goal_tolerance": [value(TOLERANCE, name=name, position=0.05) for name in names]}

    def seen_of(self, goal, sent, result):
        self.look()
        feedback = self.action.feedback_of(goal)
        return {"accepted": sent.accepted, "status": result.status, "code": result.result.error_code, "text": result.result.error_string,
                "feedback": len(feedback), "joints": feedback[-1].joint_names if feedback else [],
                "desired": [list(one.desired.positions[:2]) for one in feedback[-1:]],
                "errors": [[d - a - e for d, a, e in zip(one.desired.positions, one.actual.positions, one.error.positions)]
                           for one in feedback[-1:]],
                "statuses": sorted(set(self.action.statuses_of(goal))),
                "positions": [self.positions.get(name) for name in self.joints[:2]]}

    def follow(self):
        """Waits for the end of a goal, and for its statuses."""
        goal, sent = self.action.give(**self.trajectory((0.5, 0.2, 0.1), (1.0, 0.4, -0.2)))
        until(lambda: self.action.look() or 2 in self.action.statuses_of(goal))
        result = self.action.await_result(goal)
        until(lambda: self.action.look() or 4 in self.action.statuses_of(goal), 5)
        return self.seen_of(goal, sent, result)

    def cancel(self):
        """Half way; where it is then, and a while later."""
        goal, sent = self.action.give(**self.trajectory((4.0, 1.4, -0.2)))
        until(lambda: self.look().get(self.joints[0], 0) > 0.7)
        cancelled = self.action.cancel(goal)
        result = self.action.await_result(goal)
        held = self.seen_of(goal, sent, result)
        end = time.monotonic() + 1
        until(lambda: self.look() and time.monotonic() > end)
        return {**held, "return_code": cancelled.return_code, "cancelling": len(cancelled.goals_canceling),
                "later": self.positions[self.joints[0]], "again": self.action.cancel(goal).return_code}

    def replace(self):
        first, sent = self.action.give(**self.trajectory((5.0, 0.0, 0.0)))
        second, other = self.action.give(**self.trajectory((1.0, 0.5, 0.0)))
        return {"first": self.seen_of(first, sent, self.action.await_result(first)),
                "second": self.seen_of(second, other, self.action.await_result(second))}

    def refused(self):
        """By name of a wrong goal: true if it is accepted."""
        wrong = {"unknown joint": self.trajectory((1.0, 0.1, 0.1), joints=["no_such_joint", *self.joints[1:]]),
                 "time that falls": self.trajectory((1.0, 0.1, 0.1), (0.5, 0.2, 0.2)),
                 "no number": self.trajectory((1.0, float("nan"), 0.1)),
                 "joint twice": self.trajectory((1.0, 0.1, 0.1), joints=[self.joints[0], *self.joints[:-1]])}
        return {name: self.action.give(**fields)[1].accepted for name, fields in wrong.items()}

    def report(self):
        until(lambda: self.action.is_there() and self.look())
        return {"followed": self.follow(), "cancelled": self.cancel(), "replaced": self.replace(), "refused": self.refused()}


print(json.dumps(Commander(sys.argv[1], sys.argv[2], sys.argv[3:]).report()), flush=True)
