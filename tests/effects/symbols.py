"""Which technique a function belongs to: by the file that defines it. src/<module>/<axis>/<name>.cpp is the technique
<axis>/<name>; its object file lists its functions."""
import collections
import glob
import os
import subprocess


def functions(path):
    """Those that the object file defines for itself; inline ones (weak) may come from anywhere."""
    lines = subprocess.run(["nm", "--defined-only", "--format=posix", path], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    return {line.split()[0] for line in lines if line.split()[1] in "tT"}


def owners(root, build):
    """{symbol: "axis/name"}. Names that several files define are nobody's."""
    found, count = {}, collections.Counter()
    for path in glob.glob(os.path.join(build, "CMakeFiles/scanout_*.dir/src/**/*.cpp.o"), recursive=True):
        parts = os.path.relpath(path, build).split(os.sep)[3:]  # module, [axis,] name.cpp.o
        for symbol in functions(path):
            count[symbol] += 1
            if len(parts) == 3:
                found[symbol] = f"{parts[1]}/{parts[2][:-len('.cpp.o')]}"
    return {symbol: technique for symbol, technique in found.items() if count[symbol] == 1}
