#!/usr/bin/env python3
"""Images of a car's view of the city: RoBOSS beside MuJoCo's renderer with Mesa's software OpenGL (OSMesa).

Both draw worlds/city.sdf with its 50 cars from the same place, depth and colours with the shadows of one sun, one ray or
sample for each pixel, without moving anything between two images. Engines take turns; rows are medians of the rounds.
RoBOSS's numbers come from roboss-bench (bench/cameras/cameras.cpp), MuJoCo's from its Renderer in Python: update_scene()
and render(), with the colours or depths copied to a NumPy array. Mesa gets as many threads (LP_NUM_THREADS) as RoBOSS.

Usage: ./bench.sh cameras_beside_mujoco [--rounds 3] [--seconds 2] [--threads 1 2] [--json FILE] [--pictures FOLDER]
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SIZES = ((64, 64), (160, 120), (640, 480))
KINDS = {"depth": "camera_depth", "colours": "camera_colours"}


def mujoco_rate(kind, width, height, seconds, picture):
    """Images a second of this process, which renders with the threads of its environment."""
    import mujoco
    from mujoco_city import mjcf_of
    model = mujoco.MjModel.from_xml_string(mjcf_of(ROOT / "worlds/city.sdf", width, height))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with mujoco.Renderer(model, height, width) as renderer:
        if kind == "depth":
            renderer.enable_depth_rendering()
        renderer.update_scene(data, "eye")
        image = renderer.render()
        if picture and kind == "colours":
            from PIL import Image
            Image.fromarray(image).save(picture)
        begin, count = time.perf_counter(), 0
        while count < 3 or time.perf_counter() - begin < seconds:
            renderer.update_scene(data, "eye")
            renderer.render()
            count += 1
        rate = count / (time.perf_counter() - begin)
    return {"rate": rate, "version": mujoco.__version__}


def run_mujoco(kind, size, threads, seconds, picture):
    environment = {**os.environ, "MUJOCO_GL": "osmesa", "LP_NUM_THREADS": str(threads)}
    arguments = [sys.executable, "-B", __file__, "--one", kind, *map(str, size), "--seconds", str(seconds)]
    if picture:
        arguments += ["--pictures", str(picture)]
    done = subprocess.run(arguments, env=environment, check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def run_roboss(kind, size, threads, seconds):
    name = f"{KINDS[kind]}/{size[0]}/{size[1]}/{threads}/real_time"
    done = subprocess.run([ROOT / "build/release/bin/roboss-bench", f"--benchmark_filter=^{name}$", "--benchmark_format=json",
                           f"--benchmark_min_time={seconds}"], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)["benchmarks"][0]["frames/s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=2)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--json", type=Path)
    parser.add_argument("--pictures", type=Path, help="write what MuJoCo draws into this folder")
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        kind, width, height = options.one
        print(json.dumps(mujoco_rate(kind, int(width), int(height), options.seconds, options.pictures)))
        return
    rows = []
    print("image      kind      threads  RoBOSS, images/s  MuJoCo, images/s  ratio")
    for size in SIZES:
        for kind in KINDS:
            for threads in options.threads:
                ours, theirs, version = [], [], ""
                for _ in range(options.rounds):
                    ours.append(run_roboss(kind, size, threads, options.seconds))
                    picture = options.pictures and options.pictures / f"city_{size[0]}x{size[1]}.png"
                    other = run_mujoco(kind, size, threads, options.seconds, picture)
                    theirs.append(other["rate"])
                    version = other["version"]
                a, b = statistics.median(ours), statistics.median(theirs)
                print(f"{size[0]:3} x {size[1]:3}  {kind:8}  {threads:7}  {a:16.1f}  {b:16.1f}  {a / b:5.1f}", flush=True)
                rows.append({"width": size[0], "height": size[1], "kind": kind, "threads": threads, "roboss_per_s": a,
                             "mujoco_per_s": b, "mujoco": version, "rounds": options.rounds})
    if options.json:
        options.json.write_text(json.dumps({"commit": os.environ.get("ROBOSS_COMMIT", ""), "rows": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
