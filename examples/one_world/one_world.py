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
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/bin/roboss-world"
CELLS_AT, SPIDERS_AT = (-4.8, 3.0), (0.0, -7.0)            # m: of the first arm; of the middle of the first row


def generated(program, kind, *options):
    """The <world> that `roboss-world KIND` writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "world.sdf"
        subprocess.run([program, kind, *options, "-o", path], check=True, stdout=subprocess.DEVNULL)
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
    for model in walk.findall("model"):
        if model.get("name") != "ground":
            world.append(moved(model, SPIDERS_AT))
    return sdf


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=12)
    parser.add_argument("--spiders", type=int, default=100)
    parser.add_argument("--roboss-world", default=PROGRAM, metavar="PATH", help=f"the program (default: {PROGRAM})")
    parser.add_argument("-o", "--output", default="one_world.sdf", metavar="FILE")
    arguments = parser.parse_args()
    xml.ElementTree(join(arguments.roboss_world, arguments.cells, arguments.spiders)).write(arguments.output, encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
