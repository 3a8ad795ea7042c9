#!/usr/bin/env python3
"""What part of a frame's time each stage takes, for the loads of the table beside llvmpipe. Samples BUILD's bench_frame by the
clock (linux-perf) for SECONDS (4) a load and writes the table between the shares marks of bench/README.md. A benchmark makes
its mesh before it runs: the first seconds, which it runs longer, are not sampled, and what is left of that on a slow machine is
known by its functions and left out.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import arguments
import page

FRAMES = "bench/bench_frame"
LOADS = ("bunny/depth", "dragon/depth", "building/depth", "teapot/blinn_phong", "bunny/blinn_phong", "dragon/blinn_phong",
         "building/blinn_phong", "bunny/textured", "dragon/shadow_map", "bunny/4_samples")
AFTER = 5 # s
MAKING = r"geom::|bench::|frame::.*(facts|sides)|angle|sincos|scanout::(sqrt|normalized)|malloc|free"
# The first that fits a function's name.
STAGES = {
    "vertices, clusters": r"transform_|ClusterCull|find_visible_clusters|VertexStage",
    "culling": r"cull_all",
    "to the tiles": r"Geometry::(bin_|tile_area|is_empty)|WorkerBins|TileBin|::bin_all|rank_all|sort_front_to_back|__introsort",
    "coverage, depth": r"raster::(?!.*copy_(depths|lines))",
    "set-up for shading": r"set_up|assign_triangles|PrimitiveCache::",
    "interpolation": r"shade::interpolate",
    "texture": r"shade::texture",
    "light": r"shade::(reflection|shadow|light)|::cast$|light_lanes",
    "codes and pixels": r"shade::encode|::put$|mem(move|set|cpy)|copy_(depths|lines)|Ours::draw_depth",
    "pixels to lanes": r"shade::",
    "other": r"",
}


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"bench/shares.py: {' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def shares(program, load, seconds):
    """Of the stages: their parts of the samples."""
    with tempfile.TemporaryDirectory() as folder:
        data = str(pathlib.Path(folder) / "samples")
        run("perf", "record", "-q", "-o", data, "-e", "cpu-clock", "-D", str(1000 * AFTER), program, f"--benchmark_filter=^{load}$",
            f"--benchmark_min_time={AFTER + seconds}")
        report = run("perf", "report", "-i", data, "--no-children", "--stdio", "-F", "overhead,sym")
    found = dict.fromkeys(STAGES, 0.0)
    for percent, name in re.findall(r"^ *([\d.]+)% +\[\.\] (.*?) *$", report, re.MULTILINE):
        stage = next(stage for stage, names in STAGES.items() if re.search(names, name))
        if stage != "other" or not re.search(MAKING, name):
            found[stage] += float(percent)
    whole = sum(found.values())
    if whole == 0:
        sys.exit(f"bench/shares.py: no samples of {load}: does {program} know it, and may perf sample?")
    return {stage: part / whole for stage, part in found.items()}


def main():
    parser = arguments.parser(__doc__)
    parser.add_argument("build", type=arguments.build_with(FRAMES))
    parser.add_argument("seconds", nargs="?", type=arguments.above_zero(float), default=4.0)
    asked = parser.parse_args()
    if shutil.which("perf") is None:
        sys.exit("bench/shares.py: perf is not there; the Debian package linux-perf holds it")
    machine = page.machine()
    rows = ["| % | " + " | ".join(STAGES) + " |", "|---|" + "--:|" * len(STAGES)]
    for number, load in enumerate(LOADS, 1):
        print(f"[{number}/{len(LOADS)}] {load}", flush=True)
        parts = [f"{100 * part:.0f}" for part in shares(asked.build / FRAMES, load, asked.seconds).values()]
        rows.append(f"| {load} | " + " | ".join("-" if part == "0" else part for part in parts) + " |")
    page.remake("shares", "\n".join([f"{machine}; one thread.", "", *rows]))
    print("wrote bench/README.md")


if __name__ == "__main__":
    main()
