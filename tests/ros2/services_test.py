"""Services of roboss run --ros2 as a client of Cyclone DDS with types of its own calls them: right and wrong arguments, resets,
Gazebo's services. with_run.py says how it is started.
"""
from with_run import WithRun, main

UNSUPPORTED, OK, NOT_FOUND, INCORRECT_STATE, FAILED = range(5)
STOPPED, PLAYING, PAUSED = range(3)
CODES = {
    "GetSimulationState": OK, "GetEntities": OK, "bad filter": FAILED, "entities in a box": OK, "entities in a hull": UNSUPPORTED,
    "entities in a point": FAILED, "GetEntitiesStates": OK, "GetEntityState": OK, "GetEntityState of nobody": NOT_FOUND,
    "GetEntityBounds": OK, "GetEntityBounds of nobody": NOT_FOUND, "GetEntityInfo": OK, "GetEntityInfo of nobody": NOT_FOUND,
    "GetNamedPoses": UNSUPPORTED, "GetNamedPoseBounds": UNSUPPORTED, "GetSpawnables": OK, "GetCurrentWorld": OK,
    "GetAvailableWorlds": OK, "UnloadWorld": UNSUPPORTED, "no world": 102, "another world": UNSUPPORTED,
    "SetEntityInfo": OK, "SetEntityInfo of nobody": NOT_FOUND, "bad category": FAILED, "info that was set": OK,
    "pause": OK, "pause again": 101, "no such state": 103, "SetEntityState": OK, "bad quaternion": 101, "bad number": 101,
    "bad frame": 101, "SetEntityState of nobody": NOT_FOUND, "StepSimulation": OK, "state that was set": OK, "no steps": OK,
    "too many steps": FAILED, "SpawnEntity": OK, "name taken": 101, "renamed": OK, "bad name": 102, "bad namespace": 105,
    "in a namespace": OK, "no resource": 104, "no model": 106, "broken model": 106, "no file": 106, "bad pose": 109,
    "SpawnEntities": 150, "DeleteEntity": OK, "DeleteEntity of nobody": NOT_FOUND, "delete scenery": NOT_FOUND,
    "LoadWorld": OK, "state after a load": OK, "play": OK, "step while it plays": FAILED, "stop": OK, "last state": OK}
START = -5.2  # m, x of turtle_0


class SimulationInterfaces(WithRun):
    maxDiff = None

    def test_each_service_answers_right_and_wrong_requests(self):
        run = self.start()
        seen = self.report_of("service_caller.py", "simulation", seconds=90)
        self.assertEqual({name: seen[name]["result"]["result"] for name in CODES}, CODES)
        self.assertIn(33, seen["GetSimulatorFeatures"]["features"]["features"], "the action SimulateSteps")
        self.assertEqual(seen["GetSimulatorFeatures"]["features"]["spawn_formats"], ["sdf", "urdf", "mjcf"])
        self.assertEqual(seen["GetEntities"]["entities"], ["turtle_1", *(f"turtle_{n}" for n in range(10, 20))])
        self.assertEqual(len(seen["entities in a box"]["entities"]), 20)
        self.assertEqual(seen["GetEntitiesStates"]["states"][0]["header"]["frame_id"], "world")
        self.assertEqual([seen["GetEntityBounds"]["bounds"]["type"], len(seen["GetEntityBounds"]["bounds"]["points"])], [1, 2])
        self.assertEqual(seen["info that was set"]["info"],
                         {"category": {"category": 4}, "description": "the second", "tags": ["red", "fast"]})
        place = seen["state that was set"]["state"]["pose"]["position"]
        self.assertAlmostEqual(place["x"], 1, 3)
        self.assertAlmostEqual(place["y"], 2, 3)
        self.assertEqual([seen[name]["entity_name"] for name in ("SpawnEntity", "renamed", "in a namespace")],
                         ["box_1", "box_1_2", "fleet::box_1"])
        self.assertEqual([one["result"]["result"] for one in seen["SpawnEntities"]["results"]], [OK, 101])
        self.assertEqual(seen["GetCurrentWorld"]["world"]["name"], "fleet")
        self.assertEqual([seen[name]["state"]["state"] for name in ("GetSimulationState", "state after a load", "last state")],
                         [PLAYING, STOPPED, STOPPED])
        self.assert_steps(seen)
        self.assertIsNone(run.poll())

    def assert_steps(self, seen):
        """The action: accepted, status (4 succeeded, 5 cancelled), result, and the sums of its feedback."""
        accepted, status, result, feedback = seen["steps"]
        self.assertEqual([accepted, status, result], [True, 4, OK])
        self.assertEqual(set(feedback), {500})
        self.assertEqual(seen["cancelled steps"], [True, False, 0, 1, 5], "a second goal is refused meanwhile")
        self.assertEqual(seen["no such goal"], 0)

    def test_resets_of_all_scopes(self):
        run = self.start()
        seen = self.report_of("service_caller.py", "resets", seconds=90)
        whole = ("time and state", "all bits", "default")
        self.assertEqual({name: seen[name]["result"]["result"] for name in ("time", "state", "spawned", "state and spawned", *whole)},
                         {"time": UNSUPPORTED, **dict.fromkeys(("state", "spawned", "state and spawned", *whole), OK)})
        for name in ("time", "state"):
            self.assertEqual(seen[f"box after {name}"]["result"]["result"], OK, f"{name}: {seen}")
        for name in ("spawned", "state and spawned", *whole):
            self.assertEqual(seen[f"box after {name}"]["result"]["result"], NOT_FOUND, name)
        for name in whole:  # the reply comes when it can be seen
            turtle = seen[f"turtle after {name}"]
            self.assertEqual(turtle["result"]["result"], OK, name)
            self.assertEqual(turtle["state"]["header"]["stamp"]["sec"], 0, name)
            self.assertAlmostEqual(turtle["state"]["pose"]["position"]["x"], START, delta=0.05, msg=name)
        self.assert_times(seen["heard"], len(whole))
        self.assertIsNone(run.poll())

    def assert_times(self, heard, resets):
        """Time goes back once with each reset on each topic, and nothing that is sent later has a time from before."""
        for topic, times in heard.items():
            falls = [(a, b) for (_, a), (_, b) in zip(times, times[1:]) if b <= a]
            self.assertEqual(len(falls), resets, f"{topic}: {falls}")
            self.assertTrue(all(a > 3e9 and b < 2e9 for a, b in falls), falls)
        latest, falls = 0, 0  # a message from before, sent after another topic's first one, would be one fall more
        for _, stamp in sorted(message for times in heard.values() for message in times):
            if stamp < latest - 1e9:  # a scan and a clock of one period may be sent in any order
                latest, falls = stamp, falls + 1
            latest = max(latest, stamp)
        self.assertEqual(falls, resets)


class Gazebo(WithRun):
    def test_scripts_of_gazebo_find_its_four_services(self):
        run = self.start()
        seen = self.report_of("service_caller.py", "gazebo")
        done = ("create", "set_pose", "pause", "steps", "remove", "reset", "play")
        refused = ("name taken", "a copy", "set_pose of nobody", "seed", "part", "remove nobody")
        self.assertEqual([name for name in done + refused if seen[name] is None], [], "calls without a reply")
        self.assertEqual({name: seen[name]["success"] for name in done + refused},
                         {**dict.fromkeys(done, True), **dict.fromkeys(refused, False)})
        self.assertAlmostEqual(seen["box"]["state"]["pose"]["position"]["x"], 3, 6)
        self.assertEqual([seen[name]["state"]["state"] for name in ("state after reset", "last state")], [STOPPED, PLAYING])
        self.assertIsNone(run.poll())


if __name__ == "__main__":
    main(SimulationInterfaces, Gazebo)
