"""What a run leaves behind: trace, summary, picture, saved state; and its end by Ctrl-C."""
import csv
import json
import shlex
import signal
import subprocess
import time
import unittest
from pathlib import Path

from running import DRIVER, FOLDER, ROBOSS, WORLDS, roboss, summary

HEADER = "time_s,robot,link,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz"
KEYS = {"world", "robots", "ticks", "dt_s", "sim_time_s", "wall_time_s", "real_time_factor", "step_cpu_s", "windows",
        "windows_repeated", "islands_mean", "contacts_mean", "model_hash", "state_hash"}


class Outputs(unittest.TestCase):
    def test_the_trace_has_all_links_at_the_times_asked_for_and_shows_the_orders(self):
        trace, orders = FOLDER / "trace.csv", FOLDER / "orders.jsonl"
        orders.write_text('{"t":0.1,"robot":"car_3","set_pose":{"position":[8,9,3],"orientation":[1,0,0,0]}}\n'
                          '{"t":0.1,"robot":"car_3","set_velocity":{"linear":[1,0,0],"angular":[0,0,2]}}\n')
        summary(WORLDS / "crossroads.sdf", "--duration", 0.3, "--orders", orders, "--trace", trace, "--trace-every", 0.1)
        lines = trace.read_text().splitlines()
        self.assertEqual(lines[0], HEADER)
        rows = list(csv.DictReader(lines))
        self.assertEqual(len(rows), 4 * 16 * 5, "4 times, 16 cars of 5 links")
        flying = [r for r in rows if r["robot"] == "car_3" and r["link"] == "chassis" and abs(float(r["time_s"]) - 0.2) < 1e-9]
        self.assertEqual(len(flying), 1)
        row = {k: float(v) for k, v in flying[0].items() if k not in ("robot", "link")}
        self.assertAlmostEqual(row["z"], 3.08 - 0.5 * 9.8 * 0.01, delta=2e-3, msg="0.1 s of free fall from 3 m (chassis .08 higher)")
        self.assertAlmostEqual(row["wz"], 2.0, delta=1e-3)

    def test_a_table_on_standard_output_is_all_that_is_there(self):
        for option, first in (("--trace", HEADER), ("--json", "{"), ("--contacts", "time_s,robot_a,")):
            with self.subTest(option=option):
                done = roboss("run", WORLDS / "pile.sdf", "--duration", 0.004, "--headless", "--quiet", option, "-")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(done.stdout.startswith(first), done.stdout[:200])
                self.assertIn("state hash", done.stderr)
                self.assertNotIn("state hash", done.stdout)
        self.assertEqual(json.loads(roboss("run", WORLDS / "pile.sdf", "--duration", 0.004, "--headless", "--json", "-").stdout)["ticks"], 2)

    def test_the_contacts_bear_the_weight_of_what_rests(self):
        world, file = FOLDER / "rest.sdf", FOLDER / "contacts.csv"
        world.write_text("""<sdf version="1.9"><world name="w"><gravity>0 0 -10</gravity>
<physics type="ode"><max_step_size>0.002</max_step_size></physics>
<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision></link></model>
<model name="box"><pose>0 0 0.1 0 0 0</pose><link name="body"><inertial><mass>3</mass>
<inertia><ixx>.02</ixx><iyy>.02</iyy><izz>.02</izz></inertia></inertial>
<collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry></collision></link></model></world></sdf>""")
        summary(world, "--duration", 1, "--contacts", file, "--contacts-every", 0.5)
        rows = [r for r in csv.DictReader(file.read_text().splitlines()) if float(r["time_s"]) > 0.4]
        self.assertEqual(len(rows), 2 * 4, "2 times, 4 corners")
        self.assertEqual({(r["robot_a"], r["link_a"], r["robot_b"], r["link_b"]) for r in rows},
                         {("box", "body", "", "ground::l::c")})
        self.assertAlmostEqual(sum(float(r["impulse"]) for r in rows), 2 * 3 * 10 * 0.002, delta=1e-7)

    def test_new_client_lists_the_files_that_it_wrote(self):
        done = roboss("new-client", "driver", "--folder", FOLDER, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual(sorted(told["files"]), sorted(path.name for path in Path(told["folder"]).iterdir()))
        self.assertIn("driver.cpp", told["files"])

    def test_the_summary_has_its_keys_and_the_terminal_the_same_hash(self):
        file = FOLDER / "s.json"
        done = roboss("run", WORLDS / "pile.sdf", "--duration", 0.2, "--json", file)
        data = json.loads(file.read_text())
        self.assertLessEqual(KEYS, set(data))
        self.assertEqual(data["ticks"], 100)
        self.assertRegex(data["state_hash"], "^[0-9a-f]{16}$")
        self.assertIn(data["state_hash"], done.stdout)

    def test_stage_times_are_measured_on_all_threads_and_change_no_bit(self):
        world, run = WORLDS / "pile.sdf", ["--duration", 0.6, "--simulators", 2, "--threads", 2]
        measured = summary(world, *run, "--stage-times")
        plain = summary(world, *run)
        self.assertEqual(measured["state_hash"], plain["state_hash"])
        self.assertNotIn("stage_times_s", plain)
        times = measured["stage_times_s"]
        for stage in ("orders", "forward kinematics", "narrow phase", "constraint rows", "solve velocities", "integrate"):
            self.assertGreater(times[stage], 0, stage)
        self.assertLess(sum(times.values()), 2 * measured["wall_time_s"], "no more than two threads have")
        solver = measured["solver"]
        self.assertGreaterEqual(solver["largest_island_robots"], solver["largest_part_robots"])
        self.assertGreater(solver["largest_part_robots"], 1)
        self.assertGreater(solver["iterations_per_island_most"], solver["iterations_per_island_mean"])
        self.assertGreater(solver["iterations_per_tick_mean"], 0)
        self.assertLess(solver["residual_worst"], 1e-3)
        self.assertGreater(solver["friction_solves"], 0)
        self.assertNotIn("solver", plain)
        text = roboss("run", world, *run, "--stage-times").stdout
        self.assertRegex(text, r"largest contact island [0-9]+ robots")
        self.assertRegex(text, r"solve velocities +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+\n")

    def test_stage_times_of_other_processes_are_summed(self):
        run = [WORLDS / "pile.sdf", "--duration", 1]
        apart = summary(*run, "--processes", 2, "--profile-steps")
        here = summary(*run, "--profile-steps")
        self.assertEqual(apart["state_hash"], here["state_hash"])
        for stage in ("narrow phase", "constraint rows", "solve velocities"):
            self.assertGreater(apart["stage_times_s"][stage], 0, stage)
        self.assertEqual(apart["solver"]["largest_island_robots"], here["solver"]["largest_island_robots"])
        self.assertEqual(apart["solver"]["most_contacts"], here["solver"]["most_contacts"])

    def test_accuracy_and_profile_of_the_command_line_are_part_of_the_model(self):
        world = FOLDER / "profiles.sdf"
        world.write_text("""<sdf version="1.9"><world name="w">
<physics name="coarse" default="true" type="ode"><max_step_size>0.004</max_step_size></physics>
<physics name="fine" type="ode"><max_step_size>0.001</max_step_size></physics>
<model name="box"><pose>0 0 1 0 0 0</pose><link name="body"><inertial><mass>3</mass></inertial></link></model></world></sdf>""")
        ways = [[], ["--accuracy", "fast"], ["--accuracy", "high"], ["--tolerance", "3e-11"], ["--friction-tolerance", "3e-5"],
                ["--newton-max", "77"], ["--friction-max", "17"], ["--compliance", "1e-7"], ["--contact-compliance", "1e-4"],
                ["--impact-compliance", "1e-5"],
                ["--friction-compliance", "1e-3"]]
        models = [summary(world, "--duration", 0.1, *way)["model_hash"] for way in ways]
        self.assertEqual(len(set(models)), len(ways), "each number tells")
        self.assertEqual(summary(world, "--duration", 0.1, "--accuracy", "standard")["model_hash"], models[0])
        self.assertEqual(summary(world, "--duration", 0.1)["dt_s"], 0.004)
        self.assertEqual(summary(world, "--duration", 0.1, "--profile", "fine")["dt_s"], 0.001)
        for way in (["--tolerance", "0.7"], ["--accuracy", "exact"], ["--profile", "finer"]):
            done = roboss("run", world, "--duration", 0.1, *way)
            self.assertNotEqual(done.returncode, 0, way)
            self.assertIn(way[1], done.stderr + done.stdout)

    def test_the_log_has_events_and_the_state_of_run_and_simulators(self):
        file = FOLDER / "run.log"
        before = "2026-01-01T00:00:00.000Z level=info event=end"
        file.write_text(before + "\n")
        summary(WORLDS / "pile.sdf", "--duration", 0.4, "--simulators", 3, "--log", file, "--log-every", 0.001)
        first, *lines = file.read_text().splitlines()
        self.assertEqual(first, before, "it is added to")
        events = [dict(p.split("=", 1) for p in shlex.split(line)[1:]) for line in lines]
        self.assertEqual({e["level"] for e in events}, {"info"})
        states = [e for e in events if e["event"] == "state"]
        self.assertGreater(len(states), 1)
        self.assertEqual(states[-1]["simulators"], "3")
        self.assertLessEqual({"tick", "time_s", "islands", "window", "windows", "repeated", "efficiency"}, set(states[-1]))
        at_end = [e for e in events if e["event"] == "load" and e["tick"] == "200"]
        self.assertEqual({e["simulator"] for e in at_end}, {"0", "1", "2"})
        self.assertEqual(sum(int(e["robots"]) for e in at_end), int(states[-1]["robots"]))
        self.assertEqual([e["code"] for e in events if e["event"] == "end"], ["done"])

    def test_a_log_that_cannot_be_written_is_refused(self):
        done = roboss("run", WORLDS / "pile.sdf", "--duration", 0.1, "--log", FOLDER)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("[not-writable]", done.stderr)

    def test_the_picture_is_an_svg_with_a_path_for_each_car(self):
        picture = FOLDER / "city.svg"
        summary(WORLDS / "city.sdf", "--client", DRIVER, "--duration", 1, "--picture", picture)
        text = picture.read_text()
        self.assertTrue(text.startswith("<svg") or text.startswith("<?xml"))
        self.assertGreaterEqual(text.count("<poly") + text.count("<path"), 50)

    def test_ctrl_c_ends_a_run_with_its_summary_and_its_state(self):
        saved = FOLDER / "interrupted.roboss"
        run = subprocess.Popen([ROBOSS, "run", WORLDS / "pile.sdf", "--speed", "1", "--save", saved],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        run.stderr.readline()  # its Simulator has joined
        time.sleep(1)
        run.send_signal(signal.SIGINT)
        output, _ = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130)
        self.assertRegex(output, "[0-9a-f]{16}", "the summary with its hashes")
        self.assertGreater(summary(WORLDS / "pile.sdf", "--from", saved, "--duration", 0)["sim_time_s"], 0.1)

    def test_sigterm_ends_a_run_within_a_window_and_its_journal_is_intact(self):
        one_second = summary(WORLDS / "pile.sdf", "--headless", "--no-sleep", "--duration", 1)["state_hash"]
        for members in ((), ("--processes", 2)):
            with self.subTest(members=members):
                journal, file = FOLDER / f"cut{len(members)}.journal", FOLDER / "cut.json"
                # One window, of minutes of stepping.
                run = subprocess.Popen([ROBOSS, "run", WORLDS / "pile.sdf", "--headless", "--quiet", "--no-sleep", "--window", "1000000",
                                        "--journal", journal, "--journal-every", "10000", "--json", file, *map(str, members)],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                time.sleep(2)
                run.send_signal(signal.SIGTERM)
                _, said = run.communicate(timeout=20)
                self.assertEqual(run.returncode, 130, said)
                self.assertEqual(json.loads(file.read_text())["ticks"], 0, "the window is not committed")
                again = summary(WORLDS / "pile.sdf", "--headless", "--no-sleep", "--from", f"{journal}@0", "--until", 1)
                self.assertEqual(again["state_hash"], one_second)

    def test_a_closed_terminal_ends_a_run_with_its_state(self):
        saved = FOLDER / "hung_up.roboss"
        run = subprocess.Popen([ROBOSS, "run", str(WORLDS / "pile.sdf"), "--headless", "--speed", "1", "--save", str(saved)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        run.stderr.readline()  # its Simulator has joined
        time.sleep(0.5)
        run.send_signal(signal.SIGHUP)
        run.communicate(timeout=30)
        self.assertEqual(run.returncode, 130)
        self.assertTrue(saved.exists())

    def test_speed_follows_the_clock(self):
        data = summary(WORLDS / "crossroads.sdf", "--duration", 1.0, "--speed", 2)
        self.assertGreater(data["wall_time_s"], 0.49, "never faster than asked for")


if __name__ == "__main__":
    unittest.main()
