#!/usr/bin/env python3
"""layers.py ROOT NAME:FOLDER:DEP,DEP... - holds every #include against the list of modules in CMakeLists.txt.

A file belongs to the module with the longest folder that contains it. It may include its own module and those
that its module lists. Headers that stand directly in src/ belong to the ground: anybody may include them, and
they include no module; so do headers that CMake makes of cmake/NAME.in. src/main.cpp may include the last module
(app) alone.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
GROUND = "src/"


def resolve(root, includer, name, quoted):
    """The file of this repository that an #include names, relative to the root; None where it names none."""
    places = [includer.parent] if quoted else []
    for place in places + [root / "src", root]:
        target = (place / name).resolve()
        if target.is_file() and target.is_relative_to(root):
            return target.relative_to(root)
    made = root / "cmake" / f"{name}.in"  # by CMake, from this
    return pathlib.Path("src", name) if quoted and made.is_file() else None


def module_of(path, folders):
    inside = [m for m, folder in folders.items() if path.is_relative_to(folder)]
    if inside:
        return max(inside, key=lambda m: len(folders[m].parts))
    return GROUND if path.parent == pathlib.Path("src") else None


def faults(root, modules):
    root = pathlib.Path(root).resolve()
    rows = [m.split(":") for m in modules]
    folders = {name: pathlib.Path(folder) for name, folder, _ in rows}
    allowed = {name: {name, GROUND, *filter(None, deps.split(","))} for name, _, deps in rows}
    allowed[GROUND] = {GROUND}
    for top in ("src", "platform"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in (".h", ".cpp", ".inc"):
                continue
            relative = path.relative_to(root)
            module = module_of(relative, folders)
            if module is None:
                yield f"{relative}: stands in no module of CMakeLists.txt"
                continue
            may = {rows[-1][0]} if relative == pathlib.Path("src/main.cpp") else allowed[module]
            for number, line in enumerate(path.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                target = resolve(root, path, match[1] or match[2], match[1] is not None)
                if target is None:
                    if match[1]:
                        yield f"{relative}:{number}: there is no {match[1]}"
                    continue
                other = module_of(target, folders)
                if other not in may:
                    yield f"{relative}:{number}: {module} may not include {other or target} ({target})"


def main():
    found = list(faults(sys.argv[1], sys.argv[2:]))
    print("\n".join(found) or f"{len(sys.argv) - 2} modules: every include points down")
    sys.exit(bool(found) or len(sys.argv) < 3)


if __name__ == "__main__":
    main()
