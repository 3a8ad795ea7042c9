#!/usr/bin/env python3
"""many_machines.py SCANOUT ROOT: pictures that GNU parallel has two workers draw, as docs/AUTOMATION.md tells, are those of one run,
byte by byte."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def contents(folder, names):
    return [open(os.path.join(folder, name), "rb").read() for name in names]


def main():
    if shutil.which("parallel") is None:
        sys.exit("GNU parallel is missing: ./test installs it")
    page = open(os.path.join(ROOT, "docs/AUTOMATION.md")).read()
    commands = [line for line in re.findall(r"^.*\bparallel .*$", page, re.M) if "./run" in line and "--sshlogin" not in line]
    if len(commands) < 2:
        sys.exit("docs/AUTOMATION.md shows fewer than two commands with parallel on one machine")
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(os.path.join(ROOT, "models"), os.path.join(folder, "models"))
        alone = os.path.join(folder, "alone")
        os.mkdir(alone)
        for command in commands:
            here = command.replace("./run", SCANOUT)
            subprocess.run(["bash", "-c", here], cwd=folder, check=True, env={**os.environ, "PARALLEL_HOME": folder}, capture_output=True)
        drawn = sorted(name for name in os.listdir(folder) if name.endswith(".png"))
        # The same by one process each.
        subprocess.run([SCANOUT, "render", "models/spot/spot.obj", "-o", "alone/turn-{n}.png", "--turntable", "12", "--size", "320x240"],
                       cwd=folder, check=True)
        for name in drawn:
            if not name.startswith("turn-"):
                model = name[:-len(".png")]
                path = [os.path.join(top, file) for top, _, files in os.walk(os.path.join(ROOT, "models")) for file in files
                        if os.path.splitext(file)[0] == model and file.endswith((".obj", ".stl"))]
                subprocess.run([SCANOUT, "render", path[0], "-o", f"alone/{name}", "--size", "320x240", "--quiet"], cwd=folder, check=True)
        expected = sorted(os.listdir(alone))
        if drawn != expected or len([name for name in drawn if name.startswith("turn-")]) != 12 or len(drawn) < 15:
            sys.exit(f"two workers drew {drawn}, one run draws {expected}")
        if contents(folder, drawn) != contents(alone, drawn):
            sys.exit("two workers drew other pictures than one run")
    print(f"{len(drawn)} pictures of two workers are those of one run")


if __name__ == "__main__":
    main()
