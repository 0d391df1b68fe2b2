"""Searches a gait of the spider robot: CMA-ES over its parameters, with many spiders at once in one world.

    python examples/spider/search.py --motor-speed 2.513 -o slow.toml      # the fastest gait of slow joints
    python examples/spider/search.py --motor-speed 40 --motor-torque 12 --speed 2 -o two_metres.toml

Needs the package `roboss` (docs/python.md), `pip install cma`, and
`tools/build.sh release roboss-world roboss_spider_gait`. docs/spider.md has the results.
"""
import argparse
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from imports import needed  # noqa: E402

with needed():
    import numpy as np

    import roboss
    from gait import GaitError, Gaits
    from walking import Walker

PROGRAMS = Path(__file__).parents[2] / "build/release/bin"
# What is searched, with its range; the phases stay those of alternating tripods.
RANGES = {"period_s": (0.08, 1.2), "duty": (0.35, 0.7), "stride": (0.03, 0.26), "lift": (0.015, 0.07), "ease": (0, 1),
          "height": (0.08, 0.20), "reach": (0.13, 0.31), "splay": (0.0, 1.1), "shift": (-0.04, 0.04), "lead_s": (0.0, 0.05)}
MOST_LEAN, MOST_BOUNCE = 0.10, 0.010  # rad, m: what counts as stable


def world_of(spiders, options, programs=PROGRAMS):
    """Text of a world of `roboss-world spiders` with the options of the command line."""
    command = [programs / "roboss-world", "spiders", "--spiders", spiders]
    for name in ("motor_speed", "motor_torque", "abreast", "terrain", "height", "angle", "seed"):
        if getattr(options, name, None) is not None:
            command += ["--" + name.replace("_", "-"), getattr(options, name)]
    try:
        done = subprocess.run([str(word) for word in command], check=False, capture_output=True, text=True)
    except OSError:
        raise GaitError(f"{command[0]}: there is no such program\n  remedy: tools/build.sh release roboss-world") from None
    if done.returncode != 0:
        raise GaitError(done.stderr.strip())
    return done.stdout


def score(walk, options):
    """What the search maximises, one number a spider: speed, or economy at a speed; less what is not stable."""
    beyond = lambda value, most: np.maximum(value / most - 1, 0)
    unstable = (walk.fell + beyond(walk.lean, MOST_LEAN) + beyond(walk.bounce, MOST_BOUNCE)
                + 3 * beyond(walk.joint_speed, 1.01 * options.motor_speed))
    if options.speed is None:
        return walk.speed - unstable
    # Watts count little until the speed is reached: 100 W as much as a fifth of it.
    return np.minimum(walk.speed / options.speed, 1) - 0.002 * walk.power - unstable


class Search:
    """CMA-ES over the unit cube of RANGES, around a first gait."""

    def __init__(self, options):
        self.options, self.gaits = options, Gaits()
        self.walker = Walker(world_of(options.spiders, options), self.gaits)
        self.columns = [self.gaits.names.index(name) for name in RANGES]
        self.low, self.high = np.array(list(RANGES.values())).T
        self.first = self.gaits.load(options.start) if options.start else self.gaits.default
        self.spider_seconds = 0.0
        with needed():
            import cma
        start = np.clip((self.first[self.columns] - self.low) / (self.high - self.low), 0.02, 0.98)
        self.strategy = cma.CMAEvolutionStrategy(start, 0.2, {"bounds": [0, 1], "popsize": options.spiders,
                                                              "seed": options.seed + 1, "verbose": -9})

    def rows(self, points):
        """Gaits of points of the unit cube."""
        rows = np.tile(self.first, (len(points), 1))
        rows[:, self.columns] = self.low + np.clip(points, 0, 1) * (self.high - self.low)
        return rows

    def run(self):
        options, strategy = self.options, self.strategy
        best, begin = (-np.inf, None), time.perf_counter()
        for generation in range(options.generations):
            points = strategy.ask()
            rows = self.rows(points)
            walk = self.walker.walk(rows, options.seconds, options.seconds / 2)
            self.spider_seconds += options.seconds * len(rows)
            scores = score(walk, options)
            strategy.tell(points, list(-scores))
            top = int(scores.argmax())
            if scores[top] > best[0]:
                best = (scores[top], rows[top])
            if generation % 5 == 0 or generation == options.generations - 1:
                print(f"{generation:4}  score {scores[top]:7.3f}  {walk.speed[top]:.3f} m/s  lean {np.degrees(walk.lean[top]):.1f} deg  "
                      f"joints {walk.joint_speed[top]:.2f} rad/s  {walk.torque[top]:.1f} N m  {walk.power[top]:.1f} W", flush=True)
        return best[1], time.perf_counter() - begin


def speed_bound(gaits, joint_speed, height):
    """Largest speed of a trunk that moves along x while a foot stands and no joint turns faster than `joint_speed`: over
    all postures of one leg with its foot on the ground, joint_speed / max |J^-1 e_x|."""
    best, step = 0.0, 1e-5
    for azimuth in np.linspace(0, 1.2, 25):
        for femur in np.linspace(-1.6, 0.9, 101):
            for tibia in np.linspace(-0.9, 1.8, 109):
                angles = np.array([azimuth, femur, tibia])
                here = gaits.foot(3, angles)
                if abs(here[2] - (0.012 - height)) > 0.004:
                    continue
                jacobian = np.array([(gaits.foot(3, angles + step * unit) - here) / step for unit in np.eye(3)]).T
                if abs(np.linalg.det(jacobian)) > 1e-6:
                    best = max(best, joint_speed / np.abs(np.linalg.solve(jacobian, [1.0, 0, 0])).max())
    return best


def options_of(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--motor-speed", type=float, default=8.0, help="bound of every motor, rad/s (default 8)")
    parser.add_argument("--motor-torque", type=float, default=4.0, help="bound of every motor, N m (default 4)")
    parser.add_argument("--speed", type=float, help="search the gait of least power at this speed, m/s, instead of the fastest")
    parser.add_argument("--start", help="a file of a gait to begin with")
    parser.add_argument("--spiders", type=int, default=32, help="that walk at once, a generation (default 32)")
    parser.add_argument("--generations", type=int, default=60, help="(default 60)")
    parser.add_argument("--seconds", type=float, default=3.0, help="of each walk; its second half counts (default 3)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("-o", "--output", required=True, help="file for the best gait (TOML), for ROBOSS_SPIDER_GAIT and --start")
    options = parser.parse_args(arguments)
    if options.spiders < 2 or options.generations < 1 or not options.seconds >= 0.1:
        parser.error("give two spiders or more, one generation or more, and 0.1 s or more")
    return options


def main(arguments=None):
    options = options_of(arguments)
    try:
        search = Search(options)
        with open(options.output, "a"):
            pass
    except OSError as error:
        print(f"search: cannot write {options.output}: {error.strerror}\n  remedy: give a file in a writable folder", file=sys.stderr)
        return 2
    except (GaitError, roboss.RobossError) as error:
        print(f"search: {error}", file=sys.stderr)
        return 2
    gait, wall = search.run()
    # Its figures come from a longer walk than those of the search.
    walk = search.walker.walk(gait, 10.0, 4.0)
    figures = (f"{walk.speed[0]:.3f} m/s; lean at most {np.degrees(walk.lean[0]):.1f} degrees, height +- "
               f"{1000 * walk.bounce[0]:.1f} mm; 99 % of the time joints below {walk.joint_speed[0]:.2f} rad/s and "
               f"{walk.torque[0]:.1f} N m; {walk.power[0]:.1f} W")
    print(figures)
    print(f"{search.spider_seconds:.0f} s of walking in {wall:.0f} s, {search.spider_seconds / wall:.0f} x real time")
    bound = speed_bound(search.gaits, options.motor_speed, dict(zip(search.gaits.names, gait))["height"])
    print(f"no posture of a leg carries a trunk at this height faster than {bound:.3f} m/s with joints of {options.motor_speed:g} rad/s")
    Path(options.output).write_text(search.gaits.text(gait, f"Found by search.py {' '.join(arguments or sys.argv[1:])}\n{figures}"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
