#!/usr/bin/env python3
"""growth.py BUILD [SECONDS]: how time and memory grow with triangles, pixels and threads. Draws `knot:N` at each size by
BUILD's bench_draw, writes the tables between the growth marks of bench/README.md and the plots beside them, into
bench/growth/*.svg. SECONDS: of frames for each figure. Times are those that the process ran, because other work on the
machine takes wall time; what grows with threads has both. Meshes that would not fit in memory or on the disk are left out.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent / "growth"))
import plot # noqa: E402: stands beside its plots

ROOT = pathlib.Path(__file__).resolve().parents[1]
README = ROOT / "bench/README.md"
TRIANGLES = (10_000, 30_000, 100_000, 300_000, 1_000_000, 3_000_000, 10_000_000)
PIXELS = {"480p": (854, 480), "720p": (1280, 720), "1080p": (1920, 1080), "1440p": (2560, 1440), "4K": (3840, 2160)}
FULL_HD = PIXELS["1080p"]
OF_PIXELS, OF_THREADS = 100_000, 1_000_000 # triangles where these grow
FACET = 50      # bytes of a binary STL file
MOST_BYTES = 300 # of memory for a triangle: three times what making or drawing it took


def memory_available():
    line = next(line for line in open("/proc/meminfo") if line.startswith("MemAvailable"))
    return int(line.split()[1]) * 1024


def machine(build):
    name = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), os.uname().machine)
    commit = subprocess.run(["git", "describe", "--always", "--dirty", "--exclude=*"], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    return f"{name}, {len(os.sched_getaffinity(0))} cores, commit {commit}"


class Growth:
    def __init__(self, build, seconds, folder):
        self.build, self.seconds, self.folder = build, seconds, pathlib.Path(folder)
        self.loads, self.done = [], 0

    def say(self, what):
        self.done += 1
        print(f"[{self.done}/{len(TRIANGLES) + len(PIXELS) + len(os.sched_getaffinity(0))}] {what}", flush=True)

    def run(self, *command):
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
        return done.stdout

    def draw(self, triangles, size=FULL_HD, threads=1):
        model = self.folder / f"{triangles}.stl"
        if not model.exists():
            self.run(self.build / "bench/meshes/bench_mesh", f"knot:{triangles}", model)
        figures = json.loads(self.run(self.build / "bench/growth/bench_draw", model, f"{size[0]}x{size[1]}", threads, self.seconds))
        self.loads.append(os.getloadavg()[0])
        print(f"    {figures['cpu_ms']:.2f} ms a frame ({figures['frames']} frames), {figures['peak_mb']:.0f} MB", flush=True)
        return figures

    def fits(self, triangles):
        room = shutil.disk_usage(self.folder).free
        return triangles * MOST_BYTES < memory_available() and triangles * FACET * 1.1 < room

    def by_triangles(self):
        rows = []
        for count in TRIANGLES:
            if not self.fits(count):
                self.say(f"{count} triangles: left out, they would not fit")
                continue
            self.say(f"{count} triangles at 1080p")
            rows.append(self.draw(count))
            if count not in (OF_PIXELS, OF_THREADS):
                (self.folder / f"{count}.stl").unlink()
        return rows

    def by_pixels(self):
        rows = []
        for name, size in PIXELS.items():
            self.say(f"{name}: {size[0]}x{size[1]}")
            rows.append((name, size, self.draw(OF_PIXELS, size)))
        return rows

    def by_threads(self):
        rows = []
        for threads in range(1, len(os.sched_getaffinity(0)) + 1):
            self.say(f"{threads} thread{'s' if threads > 1 else ''}")
            rows.append((threads, self.draw(OF_THREADS, threads=threads)))
        return rows


def grouped(number):
    return f"{number:,}".replace(",", " ")


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "--:|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows])


def triangles_table(rows):
    return table(("triangles", "ms a frame", "ns a triangle", "ms to load", "ns a triangle", "MB loaded", "MB at most", "bytes a triangle"),
                 [(grouped(r["triangles"]), f"{r['cpu_ms']:.2f}", f"{r['cpu_ms'] * 1e6 / r['triangles']:.0f}", f"{r['load_cpu_ms']:.0f}",
                   f"{r['load_cpu_ms'] * 1e6 / r['triangles']:.0f}", f"{r['load_mb']:.0f}", f"{r['peak_mb']:.0f}",
                   f"{r['peak_mb'] * 2**20 / r['triangles']:.0f}") for r in rows])


def pixels_table(rows):
    return table(("picture", "pixels", "ms a frame", "ns a pixel", "MB at most"),
                 [(name, grouped(w * h), f"{r['cpu_ms']:.2f}", f"{r['cpu_ms'] * 1e6 / (w * h):.1f}", f"{r['peak_mb']:.0f}")
                  for name, (w, h), r in rows])


def threads_table(rows):
    first = rows[0][1]
    faster = [(first["wall_ms"] / r["wall_ms"], first["sums_ms"] / r["sums_ms"]) for _, r in rows]
    return table(("threads", "wall ms", "times as fast", "sums alone", "of what the machine gives", "ms of all threads", "MB at most"),
                 [(str(n), f"{r['wall_ms']:.2f}", f"{frame:.2f}", f"{sums:.2f}", f"{100 * frame / sums:.0f} %", f"{r['cpu_ms']:.2f}",
                   f"{r['peak_mb']:.0f}") for (n, r), (frame, sums) in zip(rows, faster)])


def starved(rows):
    share = rows[0][1]["cpu_ms"] / rows[0][1]["wall_ms"]
    return f" One thread ran {100 * share:.0f} % of\nthe time: these figures say little, and want a machine with less to do." if share < 0.5 else ""


def page(growth, triangles, pixels, threads):
    left_out = f" Larger ones than {grouped(triangles[-1]['triangles'])} did not fit." if len(triangles) < len(TRIANGLES) else ""
    loads = growth.loads
    return f"""{machine(growth.build)}; target {triangles[0]['target']}; load average {min(loads):.1f} to {max(loads):.1f} while it ran.
Medians of the time that the process ran, one thread but for the last table; the default lights, no texture, all of the model seen.

Triangles, at 1920x1080.{left_out} The peak holds the file's mesh, what loading it took, and the frame's buffers.

{triangles_table(triangles)}

![Time of a frame against triangles](growth/triangles.svg) ![Memory against triangles](growth/memory.svg)

Pixels, {grouped(pixels[0][2]['triangles'])} triangles:

{pixels_table(pixels)}

![Time of a frame against pixels](growth/pixels.svg)

Threads, {grouped(threads[0][1]['triangles'])} triangles at 1920x1080. Other work takes wall time, so after each frame the same threads do sums that take as
long on one: how much faster these get is what the machine had to give.{starved(threads)}

{threads_table(threads)}

![Time of a frame against threads](growth/threads.svg)"""


def write_plots(triangles, pixels, threads):
    def save(name, title, x, y, points, **line):
        (ROOT / "bench/growth" / f"{name}.svg").write_text(plot.svg(title, x, y, points, **line))
    by = [r["triangles"] for r in triangles]
    save("triangles", "Time against triangles, 1920x1080, one thread", "triangles", "ms",
         {"load": list(zip(by, (r["load_cpu_ms"] for r in triangles))), "frame": list(zip(by, (r["cpu_ms"] for r in triangles)))})
    save("memory", "Memory against triangles", "triangles", "MB",
         {"at most": list(zip(by, (r["peak_mb"] for r in triangles))), "loaded": list(zip(by, (r["load_mb"] for r in triangles)))})
    save("pixels", "Time against pixels, one thread", "pixels", "ms", {"frame": [(w * h, r["cpu_ms"]) for _, (w, h), r in pixels]})
    save("threads", "Time against threads, 1920x1080", "threads", "ms",
         {"all threads": [(n, r["cpu_ms"]) for n, r in threads], "wall": [(n, r["wall_ms"]) for n, r in threads]})


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 5.0
    with tempfile.TemporaryDirectory() as folder:
        growth = Growth(build, seconds, folder)
        triangles, pixels, threads = growth.by_triangles(), growth.by_pixels(), growth.by_threads()
    write_plots(triangles, pixels, threads)
    text = README.read_text()
    begin, end = "<!-- growth -->\n", "<!-- end of growth -->"
    before, rest = text.split(begin, 1)
    README.write_text(before + begin + page(growth, triangles, pixels, threads) + "\n" + end + rest.split(end, 1)[1])
    print(f"wrote {README.relative_to(ROOT)} and bench/growth/*.svg")


if __name__ == "__main__":
    main()
