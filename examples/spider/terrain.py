"""Which stones, slopes and steps the spider masters with a gait: a table, one row for each terrain.

    python examples/spider/terrain.py examples/spider/gaits/rough.toml

Some spiders walk abreast for each height or angle, each a little behind the one before, so that all tread elsewhere; it is mastered if all are 2.8 m beyond its begin in time and none
fell over. The table has the largest one up to which all, half, and some of
them master each.
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from imports import needed  # noqa: E402

with needed():
    import numpy as np

    import roboss
    from gait import GaitError, Gaits
    from search import world_of
    from walking import Walker, upright

BEGIN, BEYOND = 0.6, 2.8  # m: where the terrain begins, and how far a spider has to come
TERRAINS = {"rubble": ("height", np.arange(0.01, 0.101, 0.01)), "slope": ("angle", np.arange(5, 51, 5.0)),
            "steps": ("height", np.arange(0.01, 0.101, 0.01))}


def passed(gaits, gait, terrain, value, options):
    """How many of the spiders master it."""
    asked = argparse.Namespace(terrain=terrain, abreast=options.spiders, seed=options.seed, **{TERRAINS[terrain][0]: float(value)})
    walker = Walker(world_of(options.spiders, asked), gaits, spacing=None, stagger=0.021)
    arrived, fell = np.zeros((2, options.spiders), bool)
    for _ in walker.steps(gait, options.seconds):
        pose = walker.spiders.pose
        fell |= ~arrived & (upright(pose) < 0.5)
        arrived |= ~fell & (pose[:, 0] > BEGIN + BEYOND)
        if (arrived | fell).all():
            break
    return int(arrived.sum())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gait", help="file of a gait")
    parser.add_argument("--terrain", choices=TERRAINS, nargs="+", default=list(TERRAINS))
    parser.add_argument("--spiders", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=25.0, help="that they have (default 25)")
    parser.add_argument("--seed", type=int, default=1, help="of the stones")
    options = parser.parse_args()
    if options.spiders < 1 or not options.seconds > 0:
        parser.error("give one spider or more, and a time above 0")
    try:
        gaits = Gaits()
        table(gaits, gaits.load(options.gait), options)
    except (GaitError, roboss.RobossError) as error:
        print(f"terrain: {error}", file=sys.stderr)
        return 2
    return 0


def table(gaits, gait, options):
    """Prints a row for each terrain."""
    for terrain in options.terrain:
        name, values = TERRAINS[terrain]
        through = []
        for value in values:
            through.append(passed(gaits, gait, terrain, value, options))
            print(f"{terrain} {name} {value:g}: {through[-1]} of {options.spiders}", file=sys.stderr)
            if through[-1] == 0:
                break
        up_to = lambda count: next((value for value, n in zip(values, through) if n < count), np.inf)
        last = lambda count: max((value for value in values[:len(through)] if value < up_to(count)), default=0)
        print(f"{terrain:8} {name}: all up to {last(options.spiders):g}, half up to {last(options.spiders / 2):g}, "
              f"some up to {last(1):g}")


if __name__ == "__main__":
    sys.exit(main())
