#!/usr/bin/env python3
"""The law of prices: with every core kept busy by other work, what `scanout explain` says that effects take can be believed.
Twelve scenes, --runs times each. The truth about a row is the median over all runs, as a share of the frame's time. Of a hundred rows that
take nothing (less than a fiftieth of the frame), five at most may show an interval that does not hold it; and two rows of a scene whose
truths differ by over 20 % (the greater one being at least a twentieth of the frame) stand in the right order in 95 of 100 runs: by CPU
time, and where the machine counts instructions, these say what is the truth. Rows whose plan is the same are equal by construction and
not timed; an effect that is off shows 0, and what is timed is what it would take if it were on. Rows that take much are printed and not
judged: what else runs beside them makes them dearer in one run than in the next, which no interval within a run can see.
--keep FILE adds what each run says to FILE, a line each; --from FILE judges such a file without a run.
"""
import collections
import itertools
import json
import multiprocessing
import pathlib
import statistics
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


def said_of(program, scene):
    """What a run says: the frame's CPU ms, and of each row (effect, on, price)."""
    command = [program, "explain", *SCENES[scene].split(), "--size", "320x180", "--quiet", "--json=-"]
    report = json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
    rows = [(row["effect"], row["on"], row["time"]) for row in report["effects"] if row.get("time")]
    return {"scene": scene, "cpu_ms": report["cpu_ms"], "rows": rows}


def measured(program, runs, keep):
    busy = [multiprocessing.Process(target=spin, daemon=True) for _ in range(multiprocessing.cpu_count())]
    for process in busy:
        process.start()
    for run in range(runs):
        for scene in SCENES:
            said = said_of(program, scene)
            if keep:
                with open(keep, "a") as file:
                    print(json.dumps(said), file=file)
            yield said
        print(f"run {run + 1} of {runs}", file=sys.stderr, flush=True)
    for process in busy:
        process.terminate()


def judged(all_said):
    """Prints what holds; true where the law does."""
    shares = collections.defaultdict(list)  # (scene, effect): (low, median, high) of each run, in shares of the frame
    counts = collections.defaultdict(list)  # the same: instructions
    same = 0
    for said in all_said:
        for effect, _, price in said["rows"]:
            if price["same_plan"]:
                same += 1
                continue
            shares[said["scene"], effect].append([price["cpu_ms"][k] / said["cpu_ms"] for k in ("low", "median", "high")])
            if price["instructions"]:
                counts[said["scene"], effect].append(price["instructions"]["median"])
    truth = {row: statistics.median(median for _, median, _ in runs) for row, runs in shares.items()}
    wrong = {row: sum(not low <= truth[row] <= high for low, _, high in runs) for row, runs in shares.items()}
    free = [row for row in truth if abs(truth[row]) < 0.02]
    dear = [row for row in truth if row not in free]
    print(f"{same} rows equal by construction")
    beyond = {}
    for name, rows in {"take nothing": free, "take much": dear}.items():
        timed = sum(len(shares[row]) for row in rows)
        beyond[name] = sum(wrong[row] for row in rows) / max(timed, 1)
        print(f"{timed} rows that {name}: {sum(wrong[row] for row in rows)} ({100 * beyond[name]:.1f} %) do not hold the median of all runs")
    for row in sorted(free, key=lambda row: -wrong[row])[:5]:
        print(f"  {' '.join(row)}: {wrong[row]} of {len(shares[row])}, truth {100 * truth[row]:.1f} % of the frame")
    rank = {row: statistics.median(counts[row]) for row in counts} or truth
    right = pairs = 0
    for a, b in itertools.combinations(sorted(rank), 2):
        if a[0] != b[0]:
            continue
        small, great = sorted((a, b), key=rank.get)
        if rank[great] < 1.2 * rank[small] or truth[great] < 0.05:
            continue
        for (_, less, _), (_, more, _) in zip(shares[small], shares[great]):
            pairs += 1
            right += less < more
    print(f"{pairs} pairs of rows whose {'instructions' if counts else 'truths'} differ by over 20 %: {right} in the right order "
          f"({100 * right / max(pairs, 1):.1f} %)")
    return beyond["take nothing"] <= 0.05 and right * 100 >= 95 * pairs


def main():
    parser = arguments.parser(__doc__)
    parser.add_argument("program", type=arguments.program, nargs="?", help="scanout")
    parser.add_argument("--runs", type=arguments.above_zero(int), default=100)
    parser.add_argument("--keep", metavar="FILE")
    parser.add_argument("--from", dest="kept", metavar="FILE")
    options = parser.parse_args()
    if options.kept:
        all_said = [json.loads(line) for line in open(options.kept)]
    elif options.program:
        all_said = list(measured(options.program, options.runs, options.keep))
    else:
        parser.error("name the program, or --from FILE")
    sys.exit(not judged(all_said))


if __name__ == "__main__":
    main()
