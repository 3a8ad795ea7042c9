#!/usr/bin/env python3
"""shares.py BUILD [SECONDS]: what part of a frame's time each stage takes, for the loads of the table beside llvmpipe. Samples
BUILD's bench_frame by the clock (linux-perf) for SECONDS (4) a load and writes the table between the shares marks of
bench/README.md. A benchmark makes its mesh before it runs: the first seconds, which it runs longer, are not sampled, and what is
left of that on a slow machine is known by its functions and left out.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import growth # noqa: E402: says which machine and commit

README = growth.README
BEGIN, END = "<!-- shares -->\n", "<!-- end of shares -->"
LOADS = ("bunny/depth", "dragon/depth", "building/depth", "teapot/blinn_phong", "bunny/blinn_phong", "dragon/blinn_phong",
         "building/blinn_phong", "bunny/textured", "dragon/shadow_map", "bunny/4_samples")
AFTER = 5 # s
MAKING = r"geom::|bench::|frame::.*(facts|sides)|angle|sincos|scanout::(sqrt|normalized)|malloc|free"
# The first that fits a function's name.
STAGES = {
    "vertices, clusters": r"transform_|ClusterCull|::find_needed|::transform_needed",
    "culling": r"cull_all",
    "to the tiles": r"Geometry::(add_|Batch|tile_area|is_empty)|place_all|__introsort",
    "coverage, depth": r"raster::",
    "set-up for shading": r"set_up|Primitives::|Gatherer::primitive",
    "interpolation": r"shade::interpolate",
    "texture": r"shade::texture",
    "light": r"shade::(reflection|shadow|light)|::cast$|light_lanes",
    "codes and pixels": r"shade::encode|::put$|mem(move|set|cpy)|Ours::draw_depth",
    "pixels to lanes": r"shade::",
    "other": r"",
}


def shares(program, load, seconds):
    """Of the stages: their parts of the samples."""
    with tempfile.TemporaryDirectory() as folder:
        data = str(pathlib.Path(folder) / "samples")
        subprocess.run(["perf", "record", "-q", "-o", data, "-e", "cpu-clock", "-D", str(1000 * AFTER), program, f"--benchmark_filter=^{load}$",
                        f"--benchmark_min_time={AFTER + float(seconds)}"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = subprocess.run(["perf", "report", "-i", data, "--no-children", "--stdio", "-F", "overhead,sym"], check=True,
                                capture_output=True, text=True).stdout
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
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1])
    seconds = sys.argv[2] if len(sys.argv) > 2 else "4"
    text = README.read_text()
    head, rest = text.split(BEGIN)
    machine = growth.machine(build)
    table = {}
    for number, load in enumerate(LOADS, 1):
        print(f"[{number}/{len(LOADS)}] {load}", flush=True)
        table[load] = shares(build / "bench/bench_frame", load, seconds)
    rows = ["| % | " + " | ".join(STAGES) + " |", "|---|" + "--:|" * len(STAGES)]
    for load, found in table.items():
        parts = [f"{100 * part:.0f}" for part in found.values()]
        rows.append(f"| {load} | " + " | ".join("-" if part == "0" else part for part in parts) + " |")
    lines = [f"{machine}; one thread.", "", *rows, ""]
    README.write_text(head + BEGIN + "\n".join(lines) + END + rest.split(END)[1])
    print("wrote bench/README.md")


if __name__ == "__main__":
    main()
