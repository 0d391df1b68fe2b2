#!/usr/bin/env python3
"""Puts the paper's three robots into one world: cells with arms, spiders, and a match of soccer.

    python3 examples/one_world/one_world.py -o one_world.sdf
    lib=build/release/lib
    build/release/bin/roboss run one_world.sdf --client $lib/roboss_arm_cell.so --client $lib/roboss_arm_feeder.so \\
        --client $lib/roboss_spider.so --client $lib/roboss_soccer_referee.so --client $lib/roboss_soccer_blue.so \\
        --client $lib/roboss_soccer_yellow.so

The match is at the origin, the cells stand beside it, the spiders walk on the other side. Worlds are made by
`roboss-world` and joined as XML: names of models differ, and the soccer field's plane is the ground of all.
"""
import argparse
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/bin/roboss-world"
CELLS_AT, SPIDERS_BEFORE = (-4.8, 3.0), -2.5              # m: of the first arm; y of the nearest row of spiders


def generated(program, kind, *options):
    """The <world> that `roboss-world KIND` writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "world.sdf"
        try:
            subprocess.run([program, kind, *options, "-o", path], check=True, stdout=subprocess.DEVNULL)
        except OSError as error:
            sys.exit(f"one_world: '{program}' cannot be started: {error.strerror}\n  remedy: tools/build.sh release roboss-world")
        except subprocess.CalledProcessError:              # it said why
            sys.exit(1)
        for _, (prefix, uri) in xml.iterparse(path, events=("start-ns",)):
            xml.register_namespace(prefix, uri)
        return xml.parse(path).getroot()


def moved(model, at):
    """The model, moved along x and y."""
    pose = model.find("pose")
    if pose is None:
        pose = xml.Element("pose")
        pose.text = "0 0 0 0 0 0"
        model.insert(0, pose)
    x, y, *rest = pose.text.split()
    pose.text = " ".join([f"{float(x) + at[0]:.6g}", f"{float(y) + at[1]:.6g}", *rest])
    return model


def join(program, cells, spiders):
    """The joined world, as an <sdf> element."""
    sdf = generated(program, "soccer")
    world = sdf.find("world")
    world.set("name", "one_world")
    hall = generated(program, "cells", "--cells", str(cells)).find("world")
    for model in hall.findall("model"):
        if model.get("name") == "hall":                    # its looks only, a little below the field
            link = model.find("link")
            for collision in link.findall("collision"):
                link.remove(collision)
            xml.SubElement(model, "pose").text = "0 0 -0.002 0 0 0"
            world.append(model)
        else:
            world.append(moved(model, CELLS_AT))
    walk = generated(program, "spiders", "--spiders", str(spiders)).find("world")
    spider_models = [model for model in walk.findall("model") if model.get("name") != "ground"]
    nearest = max(float(model.find("pose").text.split()[1]) for model in spider_models)
    for model in spider_models:
        world.append(moved(model, (0, SPIDERS_BEFORE - nearest)))
    return sdf


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=12, help="default: 12")
    parser.add_argument("--spiders", type=int, default=100, help="default: 100")
    parser.add_argument("--roboss-world", default=PROGRAM, metavar="PATH", help=f"the program (default: {PROGRAM})")
    parser.add_argument("-o", "--output", default="one_world.sdf", metavar="FILE")
    arguments = parser.parse_args()
    try:
        xml.ElementTree(join(arguments.roboss_world, arguments.cells, arguments.spiders)).write(arguments.output, encoding="utf-8")
    except OSError as error:
        sys.exit(f"one_world: '{arguments.output}' cannot be written: {error.strerror}")
    print(arguments.output)


if __name__ == "__main__":
    main()
