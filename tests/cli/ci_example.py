#!/usr/bin/env python3
"""ci_example.py SCANOUT ROOT: the CI job of docs/AUTOMATION.md does what it says, as far as a shell can run it: its steps pass where the
picture is the expected one, and end with 22 and leave what it uploads where a pixel differs."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def main():
    page = open(os.path.join(ROOT, "docs/AUTOMATION.md")).read()
    job = re.search(r"```yaml\n(.*?)```", page, re.S)[1]
    for wanted in (r"^on: ", r"uses: actions/checkout@", r"uses: actions/cache@", r"path: difference\*"):
        if not re.search(wanted, job, re.M):
            sys.exit(f"the job has no line {wanted}")
    if not re.search(r"with: \{repository: \S+, path: scanout\}", job):
        sys.exit("the job does not fetch scanout beside the user's own files")
    steps = re.findall(r"- run: (scanout/run .*)", job)
    if len(steps) != 2:
        sys.exit(f"the job runs scanout {len(steps)} times, not twice")
    with tempfile.TemporaryDirectory() as folder:
        for name in ("models", "expected", "scanout"):
            os.mkdir(os.path.join(folder, name))
        shutil.copy(os.path.join(ROOT, "models/angle_block/angle_block.stl"), os.path.join(folder, "models/part.stl"))
        with open(os.path.join(folder, "scanout/run"), "w") as run:
            run.write(f"#!/bin/sh\nexec '{SCANOUT}' \"$@\"\n")
        os.chmod(run.name, 0o755)

        def codes():
            return [subprocess.run(["bash", "-c", step], cwd=folder, capture_output=True).returncode for step in steps]

        subprocess.run(["bash", "-c", steps[0].replace("got.png", "expected/part.png")], cwd=folder, check=True)
        if codes() != [0, 0] or glob.glob(os.path.join(folder, "difference*")):
            sys.exit(f"where pictures are the same the steps end with {codes()}, not 0 and 0")
        subprocess.run(["bash", "-c", steps[0].replace("got.png", "expected/part.png --exposure 1")], cwd=folder, check=True)
        if codes() != [0, 22] or not glob.glob(os.path.join(folder, "difference*")):
            sys.exit(f"where pictures differ the steps end with {codes()}, not 0 and 22, or leave nothing to upload")
    print("the job's steps do what the page says")


if __name__ == "__main__":
    main()
