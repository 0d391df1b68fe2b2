"""One world, one hash: for any threads, lanes, Simulators, windows, grouping, after save and load, run after run; and another
hash as soon as one bit of the input is another. Nine worlds: one with a control program in the loop, two of closed linkages,
screws, gearboxes and mimic joints, one of controllers of joints, one of planar joints, one of meshes and other shapes, one
of surfaces, springs and wind; two of them also in floats."""
import functools
import unittest

from running import DRIVER, FOLDER, WORLDS, roboss, summary

RUNS = {
    "city": ([WORLDS / "city.sdf", "--client", DRIVER], 3.0),
    "crossroads": ([WORLDS / "crossroads.sdf", "--orders", WORLDS / "crossroads.jsonl"], 2.3),
    "pile": ([WORLDS / "pile.sdf"], 2.0),
    "four_bar": ([WORLDS / "four_bar.sdf", "--orders", WORLDS / "four_bar.jsonl"], 2.0),
    "parallel": ([WORLDS / "parallel.sdf", "--orders", WORLDS / "parallel.jsonl"], 2.0),
    "joints": ([WORLDS / "joints.sdf", "--orders", WORLDS / "joints.jsonl"], 2.0),
    "pucks": ([WORLDS / "pucks.sdf"], 1.0),
    "shapes": ([WORLDS / "shapes.sdf"], 0.8),
    "materials": ([WORLDS / "materials.sdf"], 3.0),
    "city in floats": ([WORLDS / "city.sdf", "--client", DRIVER, "--precision", "float"], 2.0),
    "crossroads in floats": ([WORLDS / "crossroads.sdf", "--orders", WORLDS / "crossroads.jsonl", "--precision", "float"], 2.3),
}
# Starting a run takes longer than its steps: each world is run in every third way, each way with three or four worlds.
WAYS = [
    ["--lanes", "1"],
    ["--lanes", "4", "--merge-islands"],
    ["--lanes", "8"],
    ["--threads", "1"],
    ["--threads", "2"],
    ["--simulators", "2"],
    ["--simulators", "5", "--threads", "2"],
    ["--window", "1"],
    ["--window", "16"],
    ["--window", "16", "--simulators", "2", "--threads", "2"],
    ["--merge-islands"],
    ["--merge-islands", "--window", "1", "--simulators", "5"],
    ["--hash-every", "0.05"],
]


@functools.cache
def plain_run(name):
    world, duration = RUNS[name]
    return summary(*world, "--duration", duration)


class SameBits(unittest.TestCase):
    def test_every_way_of_running_gives_the_same_hash(self):
        for number, (name, (world, duration)) in enumerate(RUNS.items()):
            plain = plain_run(name)
            if name != "joints":  # arms in the air
                self.assertGreater(plain["contacts_mean"], 1, name)
            for way in WAYS[number % 3::3]:
                with self.subTest(world=name, way=way):
                    other = summary(*world, "--duration", duration, *way)
                    self.assertEqual(other["model_hash"], plain["model_hash"])
                    self.assertEqual(other["state_hash"], plain["state_hash"])
            with self.subTest(world=name, way="again"):
                self.assertEqual(summary(*world, "--duration", duration)["state_hash"], plain["state_hash"])

    def test_a_run_continued_from_a_file_saved_half_way_ends_the_same(self):
        for name, (world, duration) in RUNS.items():
            with self.subTest(world=name):
                whole = plain_run(name)
                half = FOLDER / f"{name.replace(' ', '_')}.roboss"
                summary(*world, "--duration", duration / 2, "--save", half, "--simulators", "2")
                rest = summary(*world, "--duration", duration / 2, "--from", half, "--window", "16")
                self.assertEqual(rest["sim_time_s"], whole["sim_time_s"])
                self.assertEqual(rest["state_hash"], whole["state_hash"])

    def test_hashes_on_the_way_are_the_same_too(self):
        world, duration = RUNS["crossroads"]
        lines = [roboss("run", *world, "--duration", duration, "--quiet", "--hash-every", "0.25", *way).stdout.splitlines()[:8]
                 for way in ([], ["--simulators", "5", "--window", "7"])]
        self.assertEqual(lines[0], lines[1])
        self.assertEqual(len(set(line.split()[-1] for line in lines[0])), 8, "each time has a hash of its own")

    def test_one_changed_bit_of_the_input_changes_the_hash(self):
        text = (WORLDS / "pile.sdf").read_text()
        changed = FOLDER / "pile.sdf"
        changed.write_text(text.replace("<mass>2</mass>", "<mass>2.0000000000000004</mass>", 1))
        self.assertNotEqual(summary(changed, "--duration", 0.5)["state_hash"],
                            summary(WORLDS / "pile.sdf", "--duration", 0.5)["state_hash"])
        world, _ = RUNS["city"]
        self.assertNotEqual(summary(*world, "--duration", 1)["state_hash"],
                            summary(*world, "--duration", 1, "--precision", "float")["state_hash"], "floats")
        self.assertNotEqual(summary(*world, "--duration", 1, "--seed", 1)["state_hash"],
                            summary(*world, "--duration", 1, "--seed", 2)["state_hash"], "the seed of the noise")


if __name__ == "__main__":
    unittest.main()
