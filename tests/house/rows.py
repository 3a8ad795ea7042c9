#!/usr/bin/env python3
"""rows.py ROOT - one technique = one file + one name: holds src/<module>/<axis>/<name>.cpp against src/techniques.h.

A row is X(name) or X(name, ...) inside `#define SCANOUT_<AXIS>(X)`; its file is src/*/<axis>/<name>.cpp, or, where it is no more
than a row, the table src/*/<axis>/rows.cpp. A folder is an axis if and only if the table names it; other folders of a module
hold its stages. A file of an axis that no row names is a helper if a header of its name stands beside it.
"""
import pathlib
import re
import sys

AXIS = re.compile(r"^[ \t]*#[ \t]*define[ \t]+SCANOUT_(?!AXES\b)(\w+)\(X\)(.*)$", re.M)
DEFINITION = re.compile(r"^constinit const \w+ (\w+)\{", re.M)
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)


def tables(text):
    """(axis, its rows in one line) of every axis."""
    return [(axis.lower(), body) for axis, body in AXIS.findall(COMMENT.sub("", text).replace("\\\n", " "))]


def rows(text):
    """(axis, name) of every row, in order."""
    return [(axis, name) for axis, body in tables(text) for name in re.findall(r"\bX\(\s*(\w+)", body)]


def names_in(path):
    """The techniques that a file of an axis is."""
    return DEFINITION.findall(path.read_text()) if path.name == "rows.cpp" else [path.stem]


def faults(root):
    src = pathlib.Path(root) / "src"
    table = src / "techniques.h"
    text = table.read_text() if table.is_file() else ""
    named, axes = rows(text), {axis for axis, _ in tables(text)}
    places = [((p.parent.name, name), p.relative_to(root))
              for p in sorted(src.glob("*/*/*.cpp")) if p.parent.name in axes for name in names_in(p)
              if (p.parent.name, name) in named or not p.with_suffix(".h").is_file()]
    files = dict(places)
    if not axes:
        yield "src/techniques.h: names no axis"
    for axis, name in sorted({row for row in named if named.count(row) > 1}):
        yield f"src/techniques.h: {axis}/{name} has more than one row"
    for axis, name in sorted(set(named) - set(files)):
        yield f"src/techniques.h: {axis}/{name} has no file src/*/{axis}/{name}.cpp, nor a row in src/*/{axis}/rows.cpp"
    for key, place in places:
        if files[key] != place:
            yield f"{place}: {key[0]}/{key[1]} stands in {files[key]}, too"
    for key in sorted(set(files) - set(named)):
        yield f"{files[key]}: has no row X({key[1]}) in SCANOUT_{key[0].upper()} of src/techniques.h"


def main():
    found = list(faults(sys.argv[1]))
    print("\n".join(found) or "every technique has its file and its row")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
