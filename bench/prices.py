#!/usr/bin/env python3
"""The law of prices: with every core kept busy by other work, `scanout explain` shows no time for an effect that is off.
Twelve scenes, --runs times each; of a hundred rows that were timed and whose effect is off, five at most may show a
difference whose 95 % interval does not hold 0. Rows whose plan is the same are equal by construction and not timed.
"""
import json
import multiprocessing
import pathlib
import subprocess
import sys

import arguments

ROOT = pathlib.Path(__file__).resolve().parents[1]
SCENES = { # name: what `scanout explain` is asked
    "spot": "models/spot/spot.obj --camera 150,20",
    "spot_no_light": "models/spot/spot.obj --camera 150,20 --light none",
    "suzanne": "models/suzanne/suzanne.obj --camera 0,-40",
    "suzanne_flat": "models/suzanne/suzanne.obj --shading flat",
    "cornell_box": "models/cornell_box/cornell_box.obj --camera 180,0",
    "spider": "models/spider/spider.obj --camera 30,35",
    "spider_exposed": "models/spider/spider.obj --exposure 1",
    "rabbit": "models/rabbit/rabbit.obj --camera 30,10",
    "rabbit_light": "models/rabbit/rabbit.obj --camera 30,10 --light directional:-1,2,2",
    "knot": "models/knot/knot.obj --view iso",
    "knot_samples": "models/knot/knot.obj --view iso --samples 4",
    "angle_block": "models/angle_block/angle_block.stl --up z",
}


def spin():
    while True:
        pass


def rows_of(program, scene):
    """The rows of effects that are off: (name, price)."""
    command = [program, "explain", *scene.split(), "--size", "320x180", "--quiet", "--json=-"]
    report = json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
    return [(row["effect"], row["time"]) for row in report["effects"] if not row["on"] and "time" in row]


def main():
    parser = arguments.parser(__doc__)
    parser.add_argument("program", type=arguments.program, help="scanout")
    parser.add_argument("--runs", type=arguments.above_zero(int), default=100)
    options = parser.parse_args()
    busy = [multiprocessing.Process(target=spin, daemon=True) for _ in range(multiprocessing.cpu_count())]
    for process in busy:
        process.start()
    same = timed = 0
    wrong = {}
    for run in range(options.runs):
        for name, scene in SCENES.items():
            for effect, price in rows_of(options.program, scene):
                if price["same_plan"]:
                    same += 1
                    continue
                timed += 1
                if not price["cpu_ms"]["zero"]:
                    wrong.setdefault(f"{name} {effect}", []).append(price["cpu_ms"]["median"])
        print(f"run {run + 1}: {same} rows equal by construction, {timed} timed, "
              f"{sum(map(len, wrong.values()))} of these not 0", flush=True)
    for process in busy:
        process.terminate()
    for row, medians in sorted(wrong.items()):
        print(f"{row}: {len(medians)} times, median of {sorted(medians)[len(medians) // 2]:.2f} ms")
    sys.exit(sum(map(len, wrong.values())) * 100 > 5 * (same + timed))


if __name__ == "__main__":
    main()
