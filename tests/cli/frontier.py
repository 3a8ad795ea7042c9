#!/usr/bin/env python3
"""frontier.py SCANOUT ROOT [--write]: the frontier of README.md is one that the program makes.

The block that begins with the command's line is its output. Times depend on the machine, errors do not: each row of the ladders
has the errors of a fresh run, in order, and none is missing. --write runs the command and writes the block anew, with its chart.
"""
import os
import re
import subprocess
import sys

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
README = os.path.join(ROOT, "README.md")
CHART = "docs/spot-frontier.png"
COMMAND = "frontier models/spot/spot.obj --camera 150,20 --size 320x180 --axis aa --axis texture --axis shading"
BLOCK = re.compile(r"(```text\n\$ \./run " + re.escape(COMMAND) + r"\n)(.*?)(```\n)", re.S)
# axis, rung, codes RMSE, PSNR, largest, share; times may follow.
ROW = re.compile(r"^ *([a-z_]+) +([a-z_0-9]+) +(\d+\.\d+) +(\d+\.\d+|inf) +(\d+) +(\d+\.\d+)(?: |$)", re.M)


def fail(*lines):
    print(*lines, sep="\n", file=sys.stderr)
    sys.exit(1)


def run(*more):
    return subprocess.run([SCANOUT, *COMMAND.split(), *more], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def write(page):
    text = run("--png", CHART)
    written, count = BLOCK.subn(lambda found: found[1] + text + found[3], page)
    if count != 1:
        fail("README.md: there is no frontier to write")
    open(README, "w").write(written)


def main():
    page = open(README).read()
    if sys.argv[3:] == ["--write"]:
        return write(page)
    block = BLOCK.search(page)
    if block is None:
        fail("README.md has no output of: " + COMMAND)
    shown, fresh = ROW.findall(block[2]), ROW.findall(run("--no-times"))
    if len(fresh) < 15:
        fail("the program's ladders have too few rows; has their form changed?")
    for old, new in zip(shown, fresh):
        if old != new:
            fail("README.md: an error is not what the program measures now: frontier.py SCANOUT ROOT --write",
                 " ".join(old), " ".join(new))
    if len(shown) != len(fresh):
        fail(f"README.md has {len(shown)} rungs, the program {len(fresh)}: frontier.py SCANOUT ROOT --write")
    for sentence in ("Knee: ", "Dearest effect: ", "Free: "):
        if not re.search("^" + sentence, block[2], re.M):
            fail(f"README.md: the frontier lacks its sentence '{sentence}'")
    print(f"{len(fresh)} rungs err what README.md says")


if __name__ == "__main__":
    main()
