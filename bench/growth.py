#!/usr/bin/env python3
"""How time and memory grow with triangles, pixels and threads. Draws `knot:N` at each size, and `large`, by BUILD's bench_draw,
and writes the tables between the growth marks of bench/README.md and the plots beside them, into bench/growth/*.svg. SECONDS
(5): of frames for each figure. Other work on the machine comes and goes, so all are taken in turns, ROUNDS (3) times, and of
each the round stands that took least. Meshes that would not fit in memory or on the disk are left out.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from typing import NamedTuple

import arguments
import page
import plot

MESHES = {"knot:10000": 10_000, "knot:30000": 30_000, "knot:100000": 100_000, "knot:300000": 300_000, "knot:1000000": 1_000_000,
          "knot:3000000": 3_000_000, "large": 5_400_000, "knot:10000000": 10_000_000}
PIXELS = {"480p": (854, 480), "720p": (1280, 720), "1080p": (1920, 1080), "1440p": (2560, 1440), "4K": (3840, 2160)}
OF_PIXELS, OF_THREADS = "knot:100000", "knot:1000000" # where these grow
CORES = len(os.sched_getaffinity(0))
MAKES_MESHES, DRAWS = "bench/meshes/bench_mesh", "bench/growth/bench_draw"
FACET = 50      # bytes of a binary STL file
MOST_BYTES = 300 # of memory for a triangle: three times what making or drawing it took


class Point(NamedTuple):
    """What a figure is of. Tables that share one show the same figure."""
    mesh: str
    size: str = "1080p"
    threads: int = 1


def pixels(point):
    width, height = PIXELS[point.size]
    return width * height


BY_TRIANGLES = [Point(mesh) for mesh in MESHES]
BY_PIXELS = [Point(OF_PIXELS, size) for size in PIXELS]
BY_THREADS = [Point(OF_THREADS, threads=threads) for threads in range(1, CORES + 1)]


def memory_available():
    line = next(line for line in open("/proc/meminfo") if line.startswith("MemAvailable"))
    return int(line.split()[1]) * 1024


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def make_models(build, folder):
    """mesh -> file, of those that fit."""
    models = {}
    for mesh, triangles in MESHES.items():
        if triangles * MOST_BYTES < memory_available() and triangles * FACET * 1.1 < shutil.disk_usage(folder).free:
            print(f"making {mesh}", flush=True)
            models[mesh] = pathlib.Path(folder) / f"{triangles}.stl"
            run(build / MAKES_MESHES, mesh, models[mesh])
        else:
            print(f"{mesh} is left out, it would not fit", flush=True)
    return models


def least(rounds):
    """Of the round whose frames took least, because its figures belong together; loading has its own least."""
    return min(rounds, key=lambda r: r["cpu_ms"]) | {key: min(r[key] for r in rounds) for key in ("load_ms", "load_cpu_ms")}


def measure(build, seconds, rounds):
    """point -> figures; and the machine's load averages."""
    taken, loads = {}, []
    with tempfile.TemporaryDirectory() as folder:
        models = make_models(build, folder)
        if not {OF_PIXELS, OF_THREADS} <= models.keys():
            sys.exit(f"bench/growth.py: {OF_PIXELS} and {OF_THREADS} are needed: this machine has too little memory or disk")
        points = [p for p in dict.fromkeys(BY_TRIANGLES + BY_PIXELS + BY_THREADS) if p.mesh in models]
        for turn in range(1, rounds + 1):
            for number, point in enumerate(points, 1):
                width, height = PIXELS[point.size]
                figures = json.loads(run(build / DRAWS, models[point.mesh], f"{width}x{height}", point.threads, seconds))
                taken.setdefault(point, []).append(figures)
                loads.append(os.getloadavg()[0])
                print(f"[{turn}/{rounds}, {number}/{len(points)}] {point.mesh} {point.size}, {threads_of(point.threads)}: "
                      f"{figures['cpu_ms']:.2f} ms a frame ({figures['frames']} frames), {figures['peak_mb']:.0f} MB", flush=True)
    return {point: least(figures) for point, figures in taken.items()}, loads


def grouped(number):
    return f"{number:,}".replace(",", " ")


def threads_of(count):
    return f"{count} thread{'s' if count > 1 else ''}"


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "--:|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows])


def triangles_table(rows):
    return table(("mesh", "triangles", "ms a frame", "ns a triangle", "ms to load", "ms of all threads", "ns a triangle", "MB loaded", "MB at most",
                  "bytes a triangle"),
                 [(f"`{p.mesh}`", grouped(r["triangles"]), f"{r['cpu_ms']:.2f}", f"{r['cpu_ms'] * 1e6 / r['triangles']:.0f}", f"{r['load_ms']:.0f}",
                   f"{r['load_cpu_ms']:.0f}", f"{r['load_cpu_ms'] * 1e6 / r['triangles']:.0f}", f"{r['load_mb']:.0f}", f"{r['peak_mb']:.0f}",
                   f"{r['peak_mb'] * 2**20 / r['triangles']:.0f}") for p, r in rows])


def pixels_table(rows):
    return table(("picture", "pixels", "ms a frame", "ns a pixel", "MB at most"),
                 [(p.size, grouped(pixels(p)), f"{r['cpu_ms']:.2f}", f"{r['cpu_ms'] * 1e6 / pixels(p):.1f}", f"{r['peak_mb']:.0f}")
                  for p, r in rows])


def threads_table(rows):
    first = rows[0][1]
    faster = [(first["wall_ms"] / r["wall_ms"], first["sums_ms"] / r["sums_ms"]) for _, r in rows]
    return table(("threads", "wall ms", "times as fast", "sums alone", "of what the machine gives", "ms of all threads", "MB at most"),
                 [(str(p.threads), f"{r['wall_ms']:.2f}", f"{frame:.2f}", f"{sums:.2f}", f"{100 * frame / sums:.0f} %", f"{r['cpu_ms']:.2f}",
                   f"{r['peak_mb']:.0f}") for (p, r), (frame, sums) in zip(rows, faster)])


def starved(rows):
    share = rows[0][1]["cpu_ms"] / rows[0][1]["wall_ms"]
    return f" One thread ran {100 * share:.0f} % of\nthe time: these figures say little, and want a machine with less to do." if share < 0.5 else ""


def text_of(figures, loads, rounds):
    by_triangles, by_pixels, by_threads = ([(p, figures[p]) for p in points if p in figures] for points in (BY_TRIANGLES, BY_PIXELS, BY_THREADS))
    any_of = by_threads[0][1]
    left_out = f" Larger ones than {grouped(by_triangles[-1][1]['triangles'])} did not fit." if len(by_triangles) < len(MESHES) else ""
    return f"""{page.machine()}; target {any_of['target']}; load average {min(loads):.1f} to {max(loads):.1f} while it ran.
Each figure is taken {rounds} times, all in turns: the least of these rounds' medians, because other work only adds. Times of frames are those that the process
ran, one thread but for the last table; the default lights, no texture, all of the model seen.

Triangles, at 1920x1080.{left_out} Models are loaded on {threads_of(any_of['load_threads'])}: wall time, then what all of them ran; that is the
reading and building of the first picture's table, which has medians of its own runs. The peak holds the file's mesh, what loading it took, and the frame's
buffers.

{triangles_table(by_triangles)}

![Time of a frame against triangles](growth/triangles.svg) ![Memory against triangles](growth/memory.svg)

Pixels, {grouped(by_pixels[0][1]['triangles'])} triangles:

{pixels_table(by_pixels)}

![Time of a frame against pixels](growth/pixels.svg)

Threads, {grouped(any_of['triangles'])} triangles at 1920x1080. Other work takes wall time, so after each frame the same threads do sums that take as
long on one: how much faster these get is what the machine had to give.{starved(by_threads)}

{threads_table(by_threads)}

![Time of a frame against threads](growth/threads.svg)"""


def write_plots(figures):
    def save(name, title, x, points, x_of, **lines):
        drawn = {line.replace("_", " "): [(x_of(p), figures[p][key]) for p in points if p in figures] for line, key in lines.items()}
        unit = "MB" if name == "memory" else "ms"
        (page.ROOT / "bench/growth" / f"{name}.svg").write_text(plot.svg(title, x, unit, drawn))

    def triangles(point):
        return figures[point]["triangles"]
    save("triangles", "Time against triangles, 1920x1080", "triangles", BY_TRIANGLES, triangles, load="load_ms", frame="cpu_ms")
    save("memory", "Memory against triangles", "triangles", BY_TRIANGLES, triangles, at_most="peak_mb", loaded="load_mb")
    save("pixels", "Time against pixels, one thread", "pixels", BY_PIXELS, pixels, frame="cpu_ms")
    save("threads", "Time against threads, 1920x1080", "threads", BY_THREADS, lambda p: p.threads, all_threads="cpu_ms", wall="wall_ms")


def main():
    parser = arguments.parser(__doc__)
    parser.add_argument("build", type=arguments.build_with(MAKES_MESHES, DRAWS))
    parser.add_argument("seconds", nargs="?", type=arguments.above_zero(float), default=5.0)
    parser.add_argument("rounds", nargs="?", type=arguments.above_zero(int), default=3)
    asked = parser.parse_args()
    figures, loads = measure(asked.build, asked.seconds, asked.rounds)
    write_plots(figures)
    page.remake("growth", text_of(figures, loads, asked.rounds))
    print("wrote bench/README.md and bench/growth/*.svg")


if __name__ == "__main__":
    main()
