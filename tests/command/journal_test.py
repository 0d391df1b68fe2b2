"""Journals: recording does not change the result, every point in time can be restored, kill -9 and full disks are survived,
and `diff` finds where two runs diverge. Worlds with collisions, a control program that has memory, bonds and belts."""
import contextlib
import json
import random
import resource
import shutil
import signal
import sqlite3
import subprocess
import time
import unittest

from running import DRIVER, FOLDER, ROBOSS, WORLDS, RobossTest, roboss, summary

RUNS = {
    "city": [WORLDS / "city.sdf", "--client", DRIVER],
    "crossroads": [WORLDS / "crossroads.sdf", "--orders", WORLDS / "crossroads.jsonl"],
    "pile": [WORLDS / "pile.sdf"],
    "bonds": [WORLDS / "bonds.sdf", "--orders", WORLDS / "bonds.jsonl"],
    "conveyor": [WORLDS / "conveyor.sdf", "--orders", WORLDS / "conveyor.jsonl"],
}
# Joints that are put elsewhere while motors hold others.
ARM = FOLDER / "arm.jsonl"
ARM.write_text("".join(json.dumps({"t": t, "robot": "arm", **what}) + "\n" for t, what in (
    (0.1, {"joint": {"name": "elbow", "position": 0.4}}),
    (0.3, {"joint_state": {"name": "shoulder", "position": 0.7, "velocity": -1.5}}),
    (0.3, {"joint_state": {"name": "yaw", "velocity": [2]}}),
    (0.75, {"joint_state": {"name": "elbow", "position": [-0.2]}}),
    (1.1, {"joint_state": {"name": "bend", "position": 0.5}}))))
RUNS["arm"] = [WORLDS / "arm.sdf", "--orders", ARM]
UNTIL = 1.2
expected = {}


def undisturbed(name):
    if name not in expected:
        expected[name] = summary(*RUNS[name], "--until", UNTIL)
    return expected[name]["state_hash"]


def fresh(name):
    file = FOLDER / name
    for part in ("", "-wal", "-shm"):
        file.with_name(file.name + part).unlink(missing_ok=True)
    return file


def kept(name, every=0.25):
    """A finished journal of this world; made once."""
    file = FOLDER / f"kept_{name}.journal"
    if not file.exists():
        found = summary(*RUNS[name], "--until", UNTIL, "--journal", file, "--journal-every", every)
        assert found["state_hash"] == undisturbed(name), f"the journal changed {name}"
        assert found["journal"] == {"file": str(file), "bytes": file.stat().st_size}, (found["journal"], file.stat())
    return file


def as_json(*arguments, code=0):
    done = roboss(*arguments, "--json")
    assert done.returncode == code, f"{arguments} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return json.loads(done.stdout)


def logged_until(file):
    """The tick up to which a journal that is being written, or whose writer was killed, is complete; -1: it has not begun."""
    wal = file.with_name(file.name + "-wal")
    if not wal.exists():  # before the first transaction; a reader could hinder SQLite there
        return -1
    try:
        with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as db:
            rows = db.execute("SELECT max(tick) FROM branches UNION SELECT max(planned) FROM batches UNION SELECT max(committed) FROM batches")
            return max((tick for tick, in rows if tick is not None), default=-1)
    except sqlite3.OperationalError:  # its tables are missing, or its writer has just closed it
        return -1


class Journal(RobossTest):
    def test_a_run_with_a_journal_ends_as_without_and_can_be_stepped_again(self):
        for name in RUNS:
            with self.subTest(world=name):
                file = kept(name)
                verified = as_json("journal", "verify", file)
                self.assertTrue(verified["good"])
                self.assertGreaterEqual(len(verified["stretches"]), 2)
                replayed = roboss("replay", file, "--quiet", "--simulators", "3", "--window", "7")
                self.assertEqual(replayed.returncode, 0, replayed.stderr)
                self.assertIn(undisturbed(name), replayed.stdout)
                branch = as_json("journal", "info", file)["branches"][0]
                self.assertEqual((branch["committed_hash"], branch["end_s"]), (undisturbed(name), UNTIL))

    def test_from_any_time_the_run_goes_on_to_the_same_end(self):
        for name, at in (("city", 0.734), ("city", 0.5), ("crossroads", 1.1), ("pile", 0.001),
                         ("bonds", 0.45), ("bonds", 1.05), ("conveyor", 0.6), ("arm", 0.2), ("arm", 0.75)):
            with self.subTest(world=name, at=at):
                self.assertEqual(summary(*RUNS[name], "--until", UNTIL, "--from", f"{kept(name)}@{at}")["state_hash"],
                                 undisturbed(name))

    def test_replay_and_save_serve_no_viewer_unless_asked(self):
        file = kept("city")
        for arguments in (["replay", file, "--until", 0.1], ["replay", file, "--until", 0.1, "--headless"],
                          ["save", FOLDER / "unseen.roboss", "--from", f"{file}@0.1"]):
            done = roboss(*arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("http://", done.stderr + done.stdout)
        self.assertIn("http://127.0.0.1:", roboss("replay", file, "--until", 0.1, "--view", 0, "--no-stay").stderr)

    def test_a_state_saved_out_of_a_journal_goes_on_to_the_same_end(self):
        saved = FOLDER / "out.roboss"
        self.assertEqual(roboss("save", saved, "--from", f"{kept('city')}@0.611").returncode, 0)
        self.assertEqual(summary(*RUNS["city"], "--until", UNTIL, "--from", saved)["state_hash"], undisturbed("city"))

    def test_rewound_runs_are_branches_of_the_same_journal(self):
        file = fresh("branches.journal")
        shutil.copy(kept("pile"), file)
        shove = FOLDER / "shove.jsonl"
        shove.write_text('{"t":0.9,"robot":"arm","wrench":{"link":"lower","force":[30,0,0],"duration":0.05}}\n')
        other = summary(*RUNS["pile"], "--orders", shove, "--until", UNTIL, "--from", f"{file}@0.8", "--journal", file)
        self.assertNotEqual(other["state_hash"], undisturbed("pile"))
        third = summary(*RUNS["pile"], "--until", UNTIL, "--from", f"{file}#2@0.3", "--journal", file)
        self.assertEqual(third["state_hash"], undisturbed("pile"), "0.3 s is before the branch left: the first branch's history")
        branches = as_json("journal", "info", file)["branches"]
        self.assertEqual([(b["parent"], round(b["time_s"], 6)) for b in branches], [(0, 0.0), (1, 0.8), (1, 0.3)])
        self.assertTrue(as_json("journal", "verify", file)["good"])
        apart = as_json("diff", f"{file}#1", f"{file}#2", code=3)
        self.assertEqual((apart["tick"] - 1) * 0.8 / branches[1]["tick"], 0.9, "the step that the order takes effect in")
        self.assertEqual(apart["orders_b_only"], ["wrench of robot 'arm'"])
        self.assertTrue(as_json("diff", f"{file}#1", f"{file}#3")["equal"])

    def test_exported_orders_make_the_same_run_without_its_control_program(self):
        orders = FOLDER / "exported.jsonl"
        orders.write_text(roboss("journal", "export", kept("city"), "--orders").stdout)
        self.assertGreater(len(orders.read_text().splitlines()), 1000)
        self.assertEqual(summary(WORLDS / "city.sdf", "--orders", orders, "--until", UNTIL)["state_hash"], undisturbed("city"))

    def test_exported_commands_and_attachments_make_the_same_run(self):
        for name in ("bonds", "conveyor", "arm"):
            with self.subTest(world=name):
                orders = FOLDER / f"exported_{name}.jsonl"
                orders.write_text(roboss("journal", "export", kept(name), "--orders").stdout)
                self.assertEqual(summary(*RUNS[name][:2], orders, "--until", UNTIL)["state_hash"], undisturbed(name))

    def test_killed_at_random_moments_and_started_again_nothing_is_lost(self):
        for name, seed in (("city", 1), ("city", 2), ("crossroads", 3), ("pile", 4), ("bonds", 5), ("arm", 6)):
            with self.subTest(world=name, seed=seed):
                print(f"    seed {seed}")
                file = FOLDER / f"killed_{name}_{seed}.journal"
                self.killed_often(name, random.Random(seed), file)
                found = summary(*RUNS[name], "--until", UNTIL, "--journal", file)
                self.assertEqual(found["state_hash"], undisturbed(name))
                self.assertTrue(as_json("journal", "verify", file)["good"])
                self.assertTrue(as_json("diff", file, kept(name))["equal"])
                self.assertEqual(len(as_json("journal", "info", file)["branches"]), 1)

    def killed_often(self, name, chance, file):
        """A journal whose run was killed before its end, several times while it went on. On a busy computer this process
        may sleep until the run has ended; then the journal shows nothing, and another is begun."""
        for _ in range(20):
            fresh(file.name)
            stops = [self.run_and_kill(name, chance, file, early=i in (0, 3)) for i in range(6)]
            if None not in stops:
                break
        else:
            self.fail("in 20 tries the run ended before it could be killed six times")
        self.assertEqual(stops, sorted(stops), "what is in the journal stays there")
        self.assertGreaterEqual(len(set(stops) - {-1}), 4, "a run that was not killed early went on")

    def run_and_kill(self, name, chance, file, early):
        """The tick up to which the journal is complete after the kill; -1: it has not begun; None: the run had ended.
        `early`: killed at some moment of its start, else some ticks after it went on."""
        arguments = [ROBOSS, "run", *map(str, RUNS[name]), "--until", str(UNTIL), "--quiet", "--speed", "0.5", "--journal", str(file),
                     "--journal-every", "0.2"]
        before = logged_until(file)
        goal = before + chance.randint(1, 50)  # a run of 1.2 s has at least 600 ticks
        with open(FOLDER / "killed.txt", "w+") as output:
            run = subprocess.Popen(arguments, stdout=output, stderr=output)
            try:
                give_up = time.monotonic() + 300
                while not early and logged_until(file) < goal and run.poll() is None and time.monotonic() < give_up:
                    time.sleep(0.002)
                time.sleep(chance.uniform(0, 0.3 if early else 0.05))
            finally:
                run.kill()
            output.seek(0)
            self.assertIn(run.wait(), (0, -signal.SIGKILL), output.read())
        if run.returncode == 0:
            return None
        self.assertTrue(early or logged_until(file) >= goal, f"{name}: no progress beyond tick {before} in 300 s")
        if logged_until(file) < 0:
            return -1
        return as_json("journal", "info", file)["branches"][-1]["end_tick"]

    def test_diff_finds_the_first_tick_robot_and_field_that_differ(self):
        changed = FOLDER / "changed.jsonl"
        lines = (WORLDS / "crossroads.jsonl").read_text().splitlines()
        changed.write_text("\n".join(lines) + '\n{"t":0.7,"robot":"%s","wrench":{"link":"%s","force":[1e-9,0,0],"duration":0.01}}\n' % (
            self.first_robot()))
        other = fresh("changed.journal")
        summary(WORLDS / "crossroads.sdf", "--orders", changed, "--until", UNTIL, "--journal", other, "--journal-every", 0.33)
        found = as_json("diff", kept("crossroads"), other, code=3)
        self.assertFalse(found["equal"])
        self.assertAlmostEqual(found["time_s"], 0.7, delta=0.0021)
        self.assertEqual(found["robot"], self.first_robot()[0])
        self.assertNotEqual(found["a"], found["b"])
        self.assertEqual(len(found["orders_b_only"]), 1)
        self.assertTrue(as_json("diff", other, other)["equal"])
        self.refused(["diff", other, kept("pile")], 1, "[other-robots]")

    def first_robot(self):
        first = json.loads(next(line for line in (WORLDS / "crossroads.jsonl").read_text().splitlines() if line.startswith("{")))
        return first["robot"], "chassis"

    def test_on_a_full_disk_the_run_continues_and_reports_it(self):
        file = fresh("full.journal")
        arguments = [ROBOSS, "run", *map(str, RUNS["city"]), "--until", str(UNTIL), "--journal", str(file)]
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (400_000, resource.RLIM_INFINITY))
        done = subprocess.run(arguments, capture_output=True, text=True, preexec_fn=limit, timeout=600)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("[journal-waiting]", done.stderr)
        self.assertIn(undisturbed("city"), done.stdout, "the result is what it would have been")
        self.assertTrue(as_json("journal", "verify", file)["good"], "what was written is whole")
        self.assertEqual(summary(*RUNS["city"], "--until", UNTIL, "--journal", file)["state_hash"], undisturbed("city"),
                         "and with room again, it goes on")

    def test_a_journal_whose_first_checkpoint_is_damaged_is_not_continued(self):
        file, other = fresh("damaged.journal"), fresh("other.journal")
        shutil.copy(kept("pile"), file)
        with contextlib.closing(sqlite3.connect(file)) as db, db:
            db.execute("UPDATE checkpoints SET memory = zeroblob(length(memory) + 1) WHERE tick = (SELECT min(tick) FROM checkpoints)")
        before = file.read_bytes()
        done = roboss("run", *RUNS["pile"], "--until", UNTIL + 0.1, "--journal", file)
        self.assertEqual(done.returncode, 1, done.stderr)
        for word in ("[journal-damaged]", "the checkpoint at tick 0", f"--from {file}"):
            self.assertIn(word, done.stderr)
        self.assertEqual(file.read_bytes(), before)
        gone_on = summary(*RUNS["pile"], "--until", UNTIL + 0.1, "--from", file, "--journal", other)
        self.assertEqual(gone_on["state_hash"], summary(*RUNS["pile"], "--until", UNTIL + 0.1)["state_hash"])

    def test_a_journal_that_does_not_fit_is_refused_and_left_alone(self):
        file = kept("pile")
        whole = file.read_bytes()
        cut = FOLDER / "cut.journal"
        cut.write_bytes(whole[: len(whole) * 2 // 3])
        for command in (["journal", "info"], ["journal", "verify"], ["replay"], ["run", WORLDS / "pile.sdf", "--until", 1, "--journal"]):
            self.refused([*command, cut], 1, "cut.journal")
        self.assertEqual(cut.read_bytes(), whole[: len(whole) * 2 // 3])
        self.refused(["run", *RUNS["crossroads"], "--until", 1, "--journal", file], 1, "[another-world]", "pile.sdf")
        self.refused(["run", *RUNS["pile"], "--dt", 0.001, "--until", 1, "--journal", file], 1, "[another-world]")
        self.refused(["run", *RUNS["pile"], "--from", f"{file}@7"], 1, "[no-such-time]")
        self.refused(["run", *RUNS["pile"], "--from", f"{file}#9"], 1, "[no-branch]")
        self.refused(["run", WORLDS / "city.sdf", "--until", 2, "--journal", kept("city")], 1, "[other-clients]")
        text = FOLDER / "text.journal"
        text.write_text("not a journal, but something that somebody needs\n")
        self.refused(["run", *RUNS["pile"], "--until", 1, "--journal", text], 1, "text.journal")
        self.assertIn("somebody needs", text.read_text())
        self.refused(["run", *RUNS["pile"], "--until", 1, "--journal", "no/such/folder.journal"], 1, "no/such/folder.journal")
        self.assertEqual(file.read_bytes(), whole)


if __name__ == "__main__":
    unittest.main()
