#!/usr/bin/env python3
"""counts.py BUILD: the instructions inside of render() for six fixed frames, against those that the repository keeps for
this compiler in bench/counts/COMPILER-VERSION.txt. One that grew by more than 2 % fails; SCANOUT_UPDATE_COUNTS=1 writes
the file anew, for the commit that says why. Counted by valgrind's callgrind on AVX2 with one thread: a clock is noisy, a
count is the same on every machine. Skipped (77) without valgrind or without a file for this compiler.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
FRAMES = { # name: what `scanout render` draws
    "plain": "models/suzanne/suzanne.obj --view iso",
    "textured": "models/spot/spot.obj --camera 150,20",
    "samples": "models/spot/spot.obj --camera 150,20 --samples 8",
    "highlights": "models/rabbit/rabbit.obj --camera 30,10",
    "shadows": "models/cornell_box/cornell_box.obj --camera 180,0 --light point:278,500,280 --shadow volume",
    "layers": "models/knot/knot.obj --view iso --effect blending=on --transparency exact",
}
GROWTH = 1.02


def instructions(scanout, frame):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
                   "--toggle-collect=scanout::frame::Renderer::render*", scanout, "render", *frame.split(),
                   "--size", "320x240", "--threads", "1", "--target", "avx2", "-o", os.path.join(folder, "frame.png")]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
        return int(re.search(r"^(?:totals|summary): (\d+)", pathlib.Path(out).read_text(), re.M)[1])


def compiler(build):
    said = next((build / "CMakeFiles").glob("*/CMakeCXXCompiler.cmake")).read_text()
    what, version = (re.search(rf'CMAKE_CXX_COMPILER_{key} "(.*)"', said)[1] for key in ("ID", "VERSION"))
    return f"{what.lower()}-{version}"


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    kept_in = ROOT / "bench/counts" / f"{compiler(build)}.txt"
    update = os.environ.get("SCANOUT_UPDATE_COUNTS") == "1"
    if shutil.which("valgrind") is None or not (kept_in.exists() or update):
        print(f"valgrind or {kept_in.relative_to(ROOT)} is not there")
        return 77
    kept = dict(line.split() for line in kept_in.read_text().splitlines()) if kept_in.exists() else {}
    counted, grown = {}, 0
    for name, frame in FRAMES.items():
        counted[name] = instructions(build / "scanout", frame)
        before = int(kept.get(name, 0))
        ratio = counted[name] / before if before else float("inf")
        failed = ratio > GROWTH and not update
        grown += failed
        print(f"{'FAILED' if failed else 'ok    '} {name:10} {counted[name]:11} instructions, "
              + (f"{100 * (ratio - 1):+.2f} % against {before}" if before else "none kept"))
    if update:
        kept_in.write_text("".join(f"{name} {count}\n" for name, count in counted.items()))
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
