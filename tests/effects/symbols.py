#!/usr/bin/env python3
"""symbols.py ROOT BUILD: writes which technique a function belongs to, for the tests of scenes: by the file that names it.
src/<module>/<axis>/<name>.cpp is the technique <axis>/<name>, in the namespace scanout::<module>::<axis>. One run of nm for
all objects and all scenes: one for each took a third of a scene's time."""
import collections
import glob
import json
import os
import re
import subprocess
import sys

# What follows the namespace of an axis, within a SIMD target's and a file's own.
NAMED = re.compile(r"\bscanout::(\w+)::(\w+)::(?:N_\w+::)?(?:\(anonymous namespace\)::)?(\w+)")


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


def plain_names(symbols):
    text = subprocess.run(["c++filt"], input="\n".join(symbols), check=True, capture_output=True, text=True).stdout
    return text.splitlines()


def techniques_by_word(root):
    """{(module, axis, word): "axis/name"} of the words that stand in this technique's file and in no other of the axis."""
    files = collections.defaultdict(set)
    for path in glob.glob(os.path.join(root, "src/*/*/*.*")):
        module, axis, name = os.path.relpath(path, root).split(os.sep)[1:]
        with open(path) as file:
            code = re.sub(r"//.*", "", file.read())
        for word in set(re.findall(r"\w+", code)):
            files[module, axis, word].add(name)
    def is_technique(module, axis, name):  # what has a header beside it is a helper of the axis
        path = os.path.join(root, "src", module, axis, name)
        return name.endswith(".cpp") and not os.path.isfile(path.removesuffix("cpp") + "h")

    return {key: f"{key[1]}/{name[:-len('.cpp')]}" for key, (name, *others) in files.items()
            if not others and is_technique(*key[:2], name)}


def owner(name, by_word):
    """The one technique whose words a function's plain name has; None: no technique's, or several ones'."""
    words = [(module, axis, word.removesuffix("HighwayDispatchTable")) for module, axis, word in NAMED.findall(name)]
    found = {by_word[key] for key in words if key in by_word}
    return found.pop() if len(found) == 1 else None


def owners(root, build):
    """{symbol: "axis/name"}. Names that several objects define are nobody's."""
    objects = glob.glob(os.path.join(build, "CMakeFiles/scanout_*.dir/**/*.o"), recursive=True)
    times = collections.Counter(symbol for _, symbol in functions(objects))
    own = [symbol for symbol, number in times.items() if number == 1]
    by_word = techniques_by_word(root)
    found = {symbol: owner(name, by_word) for symbol, name in zip(own, plain_names(own))}
    return {symbol: technique for symbol, technique in found.items() if technique is not None}


def read(build):
    with open(file_of(build)) as file:
        return json.load(file)


def main():
    root, build = map(os.path.abspath, sys.argv[1:3])
    os.makedirs(os.path.dirname(file_of(build)), exist_ok=True)
    found = owners(root, build)
    if len(found) < 100:
        sys.exit(f"only {len(found)} functions of techniques in {build}")
    with open(file_of(build), "w") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main()
