#!/usr/bin/env python3
"""From the start of the program to the first picture of a model of a million triangles, 1920x1080, written and closed: STL,
binary and ASCII, and OBJ, on one thread and on all; and of binary STL whose facets lie in no order, those of a scan and
shuffled ones, which are put in one. Goal: a binary STL in two seconds. Medians of RUNS (7), taken in turns, because other work
on the machine takes wall time; "ran" is what all threads ran. Remakes the table in bench/README.md. With OTHER, another
program: its figures beside BUILD's, and the page stays.
"""
import json
import os
import pathlib
import random
import resource
import statistics
import struct
import subprocess
import sys
import tempfile
import time

import arguments
import page

MAKES_MESHES = "bench/meshes/bench_mesh"
GOAL = 2.0 # seconds


def write_ascii(binary, path):
    data = binary.read_bytes()
    with open(path, "w") as out:
        out.write("solid knot\n")
        for facet in struct.iter_unpack("<12fH", data[84:]):
            out.write("facet normal %g %g %g\n outer loop\n  vertex %.8g %.8g %.8g\n  vertex %.8g %.8g %.8g\n"
                      "  vertex %.8g %.8g %.8g\n endloop\nendfacet\n" % facet[:12])
        out.write("endsolid knot\n")


def write_shuffled(binary, path):
    data, size = binary.read_bytes(), struct.calcsize("<12fH")
    facets = [data[at:at + size] for at in range(84, len(data), size)]
    random.Random(1).shuffle(facets)
    path.write_bytes(data[:84] + b"".join(facets))


def run(program, model, threads, folder):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([program, "render", model, "-o", folder / "picture.ppm", "--size", "1920x1080", "--threads", str(threads),
                           f"--json={folder / 'run.json'}", "--quiet"], stdin=subprocess.DEVNULL)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{program}: exit code {done.returncode}")
    report = json.loads((folder / "run.json").read_text())
    ran = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    ms = report["ms"]
    return {"wall": wall, "ran": ran, "read": ms["parse"], "build": ms["build"], "frame": ms["first"],
            "peak": report["peak_rss_bytes"] / 1e6, "hash": report["frames"][0]["hash"]}


def main():
    parser = arguments.parser(__doc__)
    parser.add_argument("build", type=arguments.build_with("scanout", MAKES_MESHES))
    parser.add_argument("runs", nargs="?", type=arguments.above_zero(int), default=7)
    parser.add_argument("other", nargs="?", type=arguments.program)
    asked = parser.parse_args()
    build, runs = asked.build, asked.runs
    programs = {"": build / "scanout"}
    if asked.other is not None:
        programs = {"this, ": build / "scanout", "other, ": asked.other}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        models = {"binary STL": folder / "knot.stl", "ASCII STL": folder / "ascii.stl", "OBJ": folder / "knot.obj",
                  "binary STL, a scan's": folder / "dragon.stl", "binary STL, shuffled": folder / "shuffled.stl"}
        for path in (models["binary STL"], models["OBJ"]):
            subprocess.run([build / MAKES_MESHES, "knot:1000000", path], check=True)
        subprocess.run([build / MAKES_MESHES, "dragon", models["binary STL, a scan's"]], check=True)
        write_shuffled(models["binary STL"], models["binary STL, shuffled"])
        write_ascii(models["binary STL"], models["ASCII STL"])
        cores = len(os.sched_getaffinity(0))
        taken = {}
        for _ in range(runs):
            for kind, model in models.items():
                for threads in sorted({1, cores}):
                    for label, program in programs.items():
                        taken.setdefault((kind, threads, label), []).append(run(program, model, threads, folder))
    lines = ["| model | threads | s to the picture | s ran | reading ms | building ms | first frame ms | MB at most |", "|---|--:|--:|--:|--:|--:|--:|--:|"]
    for (kind, threads, label), figures in taken.items():
        m = {key: statistics.median(f[key] for f in figures) for key in figures[0] if key != "hash"}
        lines.append(f"| {label}{kind} | {threads} | {m['wall']:.2f} | {m['ran']:.2f} | {m['read']:.0f} | {m['build']:.0f} | {m['frame']:.0f} | {m['peak']:.0f} |")
        if len({f["hash"] for f in figures}) != 1:
            sys.exit(f"{kind}: the pictures differ")
    text = "\n".join(lines)
    print(text)
    worst = max(statistics.median(f["wall"] for f in figures) for (kind, _, label), figures in taken.items()
                if kind.startswith("binary STL") and label != "other, ")
    print(f"a binary STL in {worst:.2f} s: the goal of {GOAL:.0f} s is {'met' if worst <= GOAL else 'MISSED'}")
    if len(programs) == 1:
        page.remake("first frame", f"{page.machine()}, load average {os.getloadavg()[0]:.1f}; {runs} runs each.\n\n{text}")


if __name__ == "__main__":
    main()
