"""A participant of Cyclone DDS that reads frames and where robots really are. Prints what it saw as JSON.

Usage: tf_watcher.py TF TF_STATIC CMD_VEL TRUTH [TRUTH ...]     its topics; it drives by the third, and waits until the first
truth moves. Prints all frames, fixed ones and moving ones of one time, and the truths of that time
"""
import json
import sys

from cyclone_client import LATCHED, Peer, stamp_ns, until
from interfaces import message, value


def numbers(*parts):
    return [getattr(part, name) for part, names in zip(parts, ("xyz", "xyzw")) for name in names]


class Watcher:
    def __init__(self, tf, tf_static, cmd_vel, truths):
        self.peer = Peer()
        self.tf = self.peer.reader(tf, "tf2_msgs/TFMessage")
        self.tf_static = self.peer.reader(tf_static, "tf2_msgs/TFMessage", LATCHED)
        self.truths = {name: self.peer.reader(name, "nav_msgs/Odometry") for name in truths}
        self.first = truths[0]
        self.drive = self.peer.writer(cmd_vel, "geometry_msgs/Twist")
        self.frames, self.poses = {}, {name: {} for name in truths}  # by stamp

    def look(self):
        """The last time of which there is all, once the first robot moves."""
        for one in self.tf.take(N=1000):
            stamps = {stamp_ns(frame.header.stamp) for frame in one.transforms}
            assert len(stamps) == 1, stamps
            self.frames[stamps.pop()] = one
        for name, reader in self.truths.items():
            self.poses[name].update((stamp_ns(one.header.stamp), one) for one in reader.take(N=1000))
        common = set(self.frames).intersection(*self.poses.values())
        last = max(common, default=None)
        return last if last is not None and self.poses[self.first][last].twist.twist.linear.x > 0.1 else None

    def report(self):
        until(lambda: self.drive.get_matched_subscriptions() and self.tf.get_matched_publications())
        speed = message("geometry_msgs/Vector3")(0.2, 0.0, 0.0)
        self.drive.write(value(message("geometry_msgs/Twist"), linear=speed))
        fixed = until(lambda: self.tf_static.take(N=1000))
        stamp = until(self.look)

        def rows(frames):
            return [[frame.header.frame_id, frame.child_frame_id, *numbers(frame.transform.translation, frame.transform.rotation)]
                    for frame in frames]
        return {"fixed": rows(frame for one in fixed for frame in one.transforms),
                "moving": rows(self.frames[stamp].transforms) if stamp is not None else [],
                "stamps": len(self.frames),
                "truths": {} if stamp is None else {
                    name: [poses[stamp].header.frame_id, poses[stamp].child_frame_id,
                           *numbers(poses[stamp].pose.pose.position, poses[stamp].pose.pose.orientation)]
                    for name, poses in self.poses.items()}}


print(json.dumps(Watcher(*sys.argv[1:4], sys.argv[4:]).report()), flush=True)
