"""Participants of Cyclone DDS that join, subscribe to three topics, hear them and leave, some at once.

Usage: churner.py TIMES AT_ONCE CLOCK TF SCAN      after each turn a line: how many joined, and how many of them heard all three
"""
import sys

from cyclone_client import Peer, until

KINDS = ("rosgraph_msgs/Clock", "tf2_msgs/TFMessage", "sensor_msgs/LaserScan")


def visit(at_once, topics):
    """The number of participants that heard all topics."""
    peers = [Peer() for _ in range(at_once)]
    readers = [[peer.reader(name, kind) for name, kind in zip(topics, KINDS)] for peer in peers]
    done = [False] * at_once

    def all_heard():
        for i, ours in enumerate(readers):
            done[i] = done[i] or all(reader.read(N=1) for reader in ours)
        return all(done)
    until(all_heard)
    for peer, ours in zip(peers, readers):
        for entity in (*ours, peer.participant):
            entity.__del__()
    return sum(done)


def main():
    times, at_once = int(sys.argv[1]), int(sys.argv[2])
    heard = 0
    for number in range(at_once, times + 1, at_once):
        heard += visit(at_once, sys.argv[3:])
        print(f"joined {number} {heard}", flush=True)


main()
