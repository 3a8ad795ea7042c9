#!/usr/bin/env python3
"""replay.py SCANOUT SOURCE: the viewer from start to end without a display, on a recording: the stages with sanitizers run it.

models/spot/turn.actions with one thread and with two: exit code 0, nothing on stderr, and the same picture.
"""
import os
import subprocess
import sys
import tempfile

SCANOUT, MODEL = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "models/spot")


def replayed(threads):
    """(stdout, the bytes of the picture) of a replay."""
    command = [SCANOUT, "view", MODEL + "/spot.obj", "--backend", "headless", "--size", "640x480",
               "--threads", str(threads), "--replay", MODEL + "/turn.actions"]
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)
        if process.returncode != 0 or process.stderr:
            sys.exit(f"{threads} threads: exit code {process.returncode}\n{process.stderr}")
        with open(os.path.join(folder, "spot-turned.png"), "rb") as picture:
            return process.stdout, picture.read()


def main():
    one, two = replayed(1), replayed(2)
    print(one[0], end="")
    if one != two:
        sys.exit(f"two threads draw another picture: {two[0]}")


if __name__ == "__main__":
    main()
