#!/usr/bin/env python3
"""The instructions inside of render() for six fixed frames, against those that the repository keeps for this compiler in
bench/counts/COMPILER-VERSION.txt. One that is more than 2 % off fails, either way: a gain that is not recorded could be lost
again unseen. SCANOUT_UPDATE_COUNTS=1 writes the file anew, for the commit that says why. Counted by valgrind's callgrind on
AVX2 with one thread: a clock is noisy, a count is the same on every machine. Skipped (77) without valgrind or without a file
for this compiler.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import arguments

ROOT = pathlib.Path(__file__).resolve().parents[1]
FRAMES = { # name: what `scanout render` draws
    "hidden": "{folder}/field.obj --cull back --camera 0,0 --frames 32 --samples 1", # clusters wait from the second frame on
    "textured": "models/spot/spot.obj --camera 150,20 --samples 1",
    "samples": "models/spot/spot.obj --camera 150,20 --samples 8",
    "shadow_map": "models/rabbit/rabbit.obj --camera 30,10 --light directional:-1,2,2 --shadow map_pcf --samples 1", # and highlights
    "shadow_volume": "models/cornell_box/cornell_box.obj --camera 180,0 --light point:278,500,280 --shadow volume --samples 1",
    "layers": "models/knot/knot.obj --view iso --effect blending=on --transparency exact --samples 1",
}
WITHIN = 0.02


def write_field(path):
    """A rough field of 8192 triangles, most of it behind a wall."""
    side = 64
    corners = [(x, y) for y in range(side + 1) for x in range(side + 1)]
    lines = [f"v {x} {y} {-8 - (7 * x + 3 * y) % 5}" for x, y in corners]
    for number, (x, y) in enumerate(corners, 1):
        if x < side and y < side:
            lines += [f"f {number} {number + 1} {number + side + 2}", f"f {number} {number + side + 2} {number + side + 1}"]
    lines += [f"v {x} {y} 0" for x, y in ((0, 0), (56, 0), (56, side), (0, side))]
    path.write_text("\n".join(lines) + "\nf -4 -3 -2 -1\n")


def instructions(scanout, frame):
    with tempfile.TemporaryDirectory() as folder:
        write_field(pathlib.Path(folder) / "field.obj")
        out = os.path.join(folder, "out")
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
                   "--toggle-collect=scanout::frame::Renderer::render*", scanout, "render",
                   *(word.format(folder=folder) for word in frame.split()),
                   "--size", "320x240", "--threads", "1", "--target", "avx2", "-o", os.path.join(folder, "frame.png")]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
        return int(re.search(r"^(?:totals|summary): (\d+)", pathlib.Path(out).read_text(), re.M)[1])


def compiler(build):
    said = next(build.glob("CMakeFiles/*/CMakeCXXCompiler.cmake"), None)
    if said is None:
        sys.exit(f"{build} is no build folder of CMake's")
    what, version = (re.search(rf'CMAKE_CXX_COMPILER_{key} "(.*)"', said.read_text())[1] for key in ("ID", "VERSION"))
    return f"{what.lower()}-{version}"


def read_kept(path):
    """name -> count; and what is wrong: a row that no frame asks about would look as if one did."""
    kept, faults = {}, []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        row = re.fullmatch(r"(\w+) ([1-9]\d*)", line)
        if row is None or row[1] not in FRAMES:
            faults.append(f"line {number}, '{line}': no count of one of these frames")
        elif row[1] in kept:
            faults.append(f"line {number}, '{line}': that frame has a count already")
        else:
            kept[row[1]] = int(row[2])
    return kept, faults


def judged(count, before):
    """What is said of a count, and what fails or nothing."""
    if before is None:
        return "none kept", "no count is kept: record it"
    change = count / before - 1
    fault = "it grew: mend it, or record it and say why" if change > WITHIN else \
        "a gain: record it, or it may be lost again unseen" if change < -WITHIN else None
    return f"{100 * change:+.2f} % against {before}", fault


def main():
    parser = arguments.parser(__doc__)
    parser.add_argument("build", type=arguments.build_with("scanout"), help="build/release, say")
    build = parser.parse_args().build
    kept_in = ROOT / "bench/counts" / f"{compiler(build)}.txt"
    update = os.environ.get("SCANOUT_UPDATE_COUNTS") == "1"
    if shutil.which("valgrind") is None or not (kept_in.exists() or update):
        print(f"valgrind or {kept_in.relative_to(ROOT)} is not there")
        return 77
    kept, faults = read_kept(kept_in) if kept_in.exists() else ({}, [])
    counted = {}
    for name, frame in FRAMES.items():
        counted[name] = instructions(build / "scanout", frame)
        said, fault = judged(counted[name], kept.get(name))
        if fault is not None:
            faults.append(f"{name}: {fault}")
        print(f"{name:13} {counted[name]:11} instructions, {said}", flush=True)
    if update:
        kept_in.write_text("".join(f"{name} {count}\n" for name, count in counted.items()))
        print(f"wrote {kept_in.relative_to(ROOT)}")
        return 0
    for fault in faults:
        print(f"FAILED {fault}")
    if faults:
        print(f"{kept_in.relative_to(ROOT)} is remade by SCANOUT_UPDATE_COUNTS=1 python3 bench/counts.py {sys.argv[1]}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
