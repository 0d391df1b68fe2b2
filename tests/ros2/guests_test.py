"""Guests of roboss run --ros2 that come and go, and slow ones: they leave nothing behind and slow nothing.

with_run.py says how it is started. ROBOSS_GUEST_ROUNDS=13 in the environment: a thousand joins instead of 160. The guests are of
Cyclone DDS and of Kilted.
"""
import json
import os
import time
from pathlib import Path

from with_run import WithRun, main

ROUNDS = int(os.environ.get("ROBOSS_GUEST_ROUNDS", "2"))
JOINS, AT_ONCE = 80, 8  # in a round
LEASE = 11  # s, after which a participant that is gone counts as lost
MOST = 2.0  # MB that a face may grow after the first round: 25 kB for each guest of a second one
MEASURED = 3  # s, of a run beside a slow subscriber
ROBOTS = [f"turtle_{n}" for n in range(20)]


class Guests(WithRun):
    def memory_of_face(self, run):
        """In MB."""
        face, = self.faces_of(run)
        line = next(line for line in Path(f"/proc/{face}/status").read_text().splitlines() if line.startswith("VmRSS"))
        return int(line.split()[1]) / 1000

    def test_those_that_come_and_go_leave_nothing_behind(self):
        run = self.start()
        used = []
        for number in range(ROUNDS):
            churner = self.node("churner.py", str(JOINS), str(AT_ONCE), "/clock", "/tf", "/turtle_3/scan", client="cyclone")
            last = churner.wait_for(f"joined {JOINS}", 120)
            used.append(self.memory_of_face(run))  # as many guests as in the first round are not yet known to be gone
            self.assertEqual(last, str(JOINS), "all heard all topics")
            if number + 1 < ROUNDS:
                time.sleep(LEASE)
        print(f"\n{ROUNDS * JOINS} joins, MB of the face after each {JOINS}: {used}")
        self.assertLess(max(used) - used[0], MOST, "MB")

    def speed(self, name, seconds):
        """The real-time factor of a run beside a node that sleeps so long in each callback."""
        sleeper = self.node("sleeper.py", str(seconds), *ROBOTS, client="kilted")
        self.assertIsNotNone(sleeper.wait_for("subscribed"))
        run = self.start("--speed", "max", name=name)
        self.assertIsNotNone(sleeper.wait_for("heard"), "it heard nothing")
        time.sleep(MEASURED)
        run.terminate()
        run.wait(timeout=30)
        summary = json.loads((self.folder / f"{name}.json").read_text())
        sleeper.process.kill()
        sleeper.process.wait()
        return summary["real_time_factor"]

    def test_a_slow_subscriber_does_not_slow_the_world(self):
        quick, slow = (self.speed(name, seconds) for name, seconds in (("quick", 0), ("slow", 0.2)))
        print(f"\nreal-time factors: {quick:.0f} with a subscriber to 20 scans, {slow:.0f} with one that sleeps")
        self.assertGreater(slow, 0.3 * quick, "on a busy machine; a world that waited for it would not reach 0.1")


if __name__ == "__main__":
    main(Guests)
