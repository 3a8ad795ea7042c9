#!/usr/bin/env python3
"""doctor.py SCANOUT ROOT: what `scanout doctor` says of every shipped model, and its exit code, against tests/cli/doctor.txt.
docs/GUIDE.md has a row for every hazard.

SCANOUT_UPDATE_GOLDEN=1 writes that file anew: read its difference.
"""
import difflib
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
EXPECTED = os.path.join(ROOT, "tests/cli/doctor.txt")


def outcome(model):
    """The command line, what it says, the exit code."""
    words = ["doctor", model, "--size", "640x360", "--strict"]
    done = subprocess.run([SCANOUT, *words], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
    return f"$ scanout {' '.join(words)}\n{done.stdout}exit code {done.returncode}\n\n"


def check_guide():
    """Every hazard that the program knows stands in the guide's table, and no other."""
    with tempfile.TemporaryDirectory() as folder:
        sarif = os.path.join(folder, "spot.sarif")
        subprocess.run([SCANOUT, "doctor", "models/spot/spot.obj", "--quick", "--sarif", sarif], cwd=ROOT, check=True,
                       stdout=subprocess.DEVNULL)
        known = {rule["id"] for rule in json.load(open(sarif))["runs"][0]["tool"]["driver"]["rules"]}
    rows = re.findall(r"^\| (`[a-z-]+`(?:, `[a-z-]+`)*) \|", open(os.path.join(ROOT, "docs/GUIDE.md")).read().split("## What doctor says")[1], re.M)
    told = set(re.findall(r"`([a-z-]+)`", " ".join(rows)))
    if told != known:
        sys.exit(f"docs/GUIDE.md: hazards that are missing or unknown: {sorted(told ^ known)}")


def main():
    check_guide()
    models = sorted(path for ending in ("obj", "stl", "ply", "off", "glb") for path in glob.glob(f"models/*/*.{ending}", root_dir=ROOT))
    said = "".join(map(outcome, models))
    if os.environ.get("SCANOUT_UPDATE_GOLDEN"):
        open(EXPECTED, "w").write(said)
    expected = open(EXPECTED).read()
    if said != expected:
        sys.stdout.writelines(difflib.unified_diff(expected.splitlines(True), said.splitlines(True), "expected", "said"))
        sys.exit("doctor says something else: SCANOUT_UPDATE_GOLDEN=1 writes tests/cli/doctor.txt anew")
    print(f"{len(models)} models: as expected")


if __name__ == "__main__":
    main()
