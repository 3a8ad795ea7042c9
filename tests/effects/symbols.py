#!/usr/bin/env python3
"""symbols.py BUILD: writes which technique a function belongs to, for the tests of scenes: by the file that defines it.
src/<module>/<axis>/<name>.cpp is the technique <axis>/<name>; its object file lists its functions. One run of nm for all
objects and all scenes: one for each took a third of a scene's time."""
import collections
import glob
import json
import os
import subprocess
import sys


def file_of(build):
    return os.path.join(build, "effects", "owners.json")


def functions(paths):
    """(path, symbol) of those that the object files define for themselves; inline ones (weak) may come from anywhere."""
    lines = subprocess.run(["nm", "--defined-only", "--format=posix", "--print-file-name", *paths], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    for line in lines:
        path, _, rest = line.partition(": ")
        symbol, kind = rest.split()[:2]
        if kind in "tT":
            yield path, symbol


def owners(build):
    """{symbol: "axis/name"}. Names that several files define are nobody's."""
    found, files = {}, collections.defaultdict(set)
    objects = glob.glob(os.path.join(build, "CMakeFiles/scanout_*.dir/src/**/*.cpp.o"), recursive=True)
    for path, symbol in functions(objects):
        files[symbol].add(path)
        parts = os.path.relpath(path, build).split(os.sep)[3:]  # module, [axis,] name.cpp.o
        if len(parts) == 3:
            found[symbol] = f"{parts[1]}/{parts[2][:-len('.cpp.o')]}"
    return {symbol: technique for symbol, technique in found.items() if len(files[symbol]) == 1}


def read(build):
    with open(file_of(build)) as file:
        return json.load(file)


def main():
    build = os.path.abspath(sys.argv[1])
    os.makedirs(os.path.dirname(file_of(build)), exist_ok=True)
    found = owners(build)
    if len(found) < 100:
        sys.exit(f"only {len(found)} functions of techniques in {build}")
    with open(file_of(build), "w") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main()
