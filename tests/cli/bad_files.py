#!/usr/bin/env python3
"""bad_files.py SCANOUT ASSETS: every bad file of the asset set, given to the program as a user would.

Exit code 0 (what can be shown is shown) or 3 (one clear line), never a signal; under 2 seconds of CPU and 500 MB; no picture
is left behind by a run that failed. Exit 77 (skipped) where the assets are not there.
"""
import os
import resource
import subprocess
import sys
import tempfile

SCANOUT, ASSETS = os.path.abspath(sys.argv[1]), sys.argv[2]
SECONDS, BYTES = 2.0, 500 << 20


def limits():
    resource.setrlimit(resource.RLIMIT_CPU, (20, 20))


def faults(path, folder):
    """What is wrong with the program's behaviour on this file: a list of sentences."""
    out = os.path.join(folder, "out.png")
    process = subprocess.Popen([SCANOUT, "render", path, "-o", out, "--size", "64x64", "--threads", "1"],
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limits)
    error = process.communicate(timeout=60)[1].decode(errors="replace")
    found = []
    if process.returncode not in (0, 3):
        found.append(f"exit code {process.returncode}: {error[:4000]}")  # a sanitizer's report, if one runs
    if process.returncode == 3 and (len(error.strip().splitlines()) != 1 or os.path.basename(path) not in error):
        found.append(f"not one line that names the file: {error!r}")
    if process.returncode == 0 and not os.path.exists(out):
        found.append("exit code 0 without a picture")
    if process.returncode != 0 and os.path.exists(out):
        found.append("a picture is left behind")
    left = [name for name in os.listdir(folder) if name != "out.png"]
    if left:
        found.append(f"left behind: {left}")
    if os.path.exists(out):
        os.unlink(out)
    return found


def main():
    root = os.path.join(ASSETS, "bad")
    if not os.path.isdir(root):
        print("the asset set is not here")
        sys.exit(77)
    files = [os.path.join(base, name) for base, _, names in os.walk(root) for name in names if not name.endswith(".md")]
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(files):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            found = faults(path, folder)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            if seconds > SECONDS:
                found.append(f"{seconds:.1f} s of CPU")
            if after.ru_maxrss * 1024 > BYTES:
                found.append(f"a peak of {after.ru_maxrss >> 10} MiB")
            for fault in found:
                print(f"{path}: {fault}", file=sys.stderr)
            wrong += bool(found)
    print(f"{len(files)} bad files, {wrong} handled badly")
    sys.exit(1 if wrong or not files else 0)


if __name__ == "__main__":
    main()
