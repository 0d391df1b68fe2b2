"""Which stones, slopes and steps the spider masters with a gait: a table, one row for each terrain.

    python examples/spider/terrain.py examples/spider/gaits/rough.toml

A dozen spiders walk abreast for each height or angle; it is mastered if all are 2.8 m beyond its begin in time and none
fell over. The table has the largest one up to which all master all, and the
largest one that any of them masters.
"""
import argparse
import sys

import numpy as np

from gait import Gaits
from search import world_of
from walking import Walker, upright

BEGIN, BEYOND = 0.6, 2.8  # m: where the terrain begins, and how far a spider has to come
TERRAINS = {"rubble": ("height", np.arange(0.01, 0.101, 0.01)), "slope": ("angle", np.arange(5, 51, 5.0)),
            "steps": ("height", np.arange(0.01, 0.101, 0.01))}


def passed(gaits, gait, terrain, value, options):
    """How many of the spiders master it."""
    asked = argparse.Namespace(terrain=terrain, abreast=options.spiders, seed=options.seed, **{TERRAINS[terrain][0]: float(value)})
    walker = Walker(world_of(options.spiders, asked), gaits, spacing=0)
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
    parser.add_argument("--spiders", type=int, default=12)
    parser.add_argument("--seconds", type=float, default=25.0, help="that they have (default 25)")
    parser.add_argument("--seed", type=int, default=1, help="of the stones")
    options = parser.parse_args()
    gaits = Gaits()
    gait = gaits.load(options.gait)
    for terrain in options.terrain:
        name, values = TERRAINS[terrain]
        through = []
        for value in values:
            through.append(passed(gaits, gait, terrain, value, options))
            print(f"{terrain} {name} {value:g}: {through[-1]} of {options.spiders}", file=sys.stderr)
            if through[-1] == 0:
                break
        every = int(np.cumprod(np.array(through) == options.spiders).sum())
        some = [value for value, count in zip(values, through) if count > 0]
        print(f"{terrain:8} {name}: all up to {values[every - 1] if every else 0:g}, some up to {some[-1] if some else 0:g}")


if __name__ == "__main__":
    main()
