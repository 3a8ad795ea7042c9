#!/usr/bin/env python3
"""blank.py SCANOUT ROOT FOLDER: a picture that shows nothing never comes without a line that says why, and no other comes
with one: the shipped models, those that make_models.py and walk have written to FOLDER, and models of its own, each from
all sides, from far away, from inside, with faces left out and with materials that cannot be seen.
"""
import os
import subprocess
import sys
import tempfile

SCANOUT, ROOT, FOLDER = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3]
BACKGROUND = bytes((18, 52, 86))
SIDE = 48
LINE = "the picture is blank: "

WAYS = [[], ["--view", "top"], ["--view", "right"], ["--view", "back", "--cull", "back"], ["--view", "iso", "--cull", "front"],
        ["--projection", "orthographic", "--view", "bottom"], ["--camera", "30,20,4000"], ["--camera", "30,20,0.01"],
        ["--translate", "9,0,0"], ["--depth-test", "never"], ["--aa", "area", "--camera", "0,0"]]

FLAT = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
MODELS = {  # name: (text, options, what its line must say)
    "on_the_ground": (FLAT + "f 1 2 3 4\n", ["--view", "front"], "--view top"),
    "upright": ("v 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\nf 1 2 3 4\n", ["--view", "top"], "--view right"),
    "z_up": ("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n", ["--up", "z", "--view", "front"], "--view top"),
    "no_area": ("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 1 2\n", [], "has an area"),
    "seen_from_behind": (FLAT + "f 1 2 3 4\n", ["--view", "top", "--cull", "back"], "--cull none"),
    "never": (FLAT + "f 1 2 3 4\n", ["--view", "top", "--depth-test", "never"], "--depth-test never"),
    "far_away": (FLAT + "f 1 2 3 4\n", ["--view", "top", "--translate", "30,0,0"], "lies outside"),
    "clear": ("mtllib clear.mtl\n" + FLAT + "vt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3 4/1\n", ["--view", "top"], "clear"),
    "faint": ("mtllib faint.mtl\n" + FLAT + "usemtl m\nf 1 2 3 4\n", ["--view", "top"], "transparent"),
    "black": ("mtllib black.mtl\n" + FLAT + "usemtl m\nf 1 2 3 4\n", ["--view", "top", "--background", "black"], "colour"),
    "small": ("v 0 0 0\nv 1e-5 0 0\nv 0 1e-5 0\nv 1 1 0\nv 1.00001 1 0\nv 1 1.00001 0\nf 1 2 3\nf 4 5 6\n", [], "too small"),
}
FILES = {"clear.mtl": b"newmtl m\nmap_d black.ppm\n", "black.ppm": b"P6\n1 1\n255\n\0\0\0", "faint.mtl": b"newmtl m\nd 0.0001\n",
         "black.mtl": b"newmtl m\nKd 0 0 0\nKs 0 0 0\n"}


def render(path, options):
    """The picture's pixels, its background's bytes and the lines on standard error; None where it is refused."""
    background = ["--background", "#123456"] if "--background" not in options else []
    run = subprocess.run([SCANOUT, "render", path, "-o", "-", "--format", "ppm", "--size", f"{SIDE}x{SIDE}", "--threads", "1",
                          *background, *options], capture_output=True, timeout=60)
    if run.returncode != 0:
        return None
    return run.stdout[-3 * SIDE * SIDE:], BACKGROUND if background else bytes(3), run.stderr.decode(errors="replace")


def fault(path, options, wanted=None):
    drawn = render(path, options)
    if drawn is None:
        return "" if wanted is None else "is refused"
    pixels, background, error = drawn
    lines = [line for line in error.splitlines() if LINE in line]
    blank = pixels == background * (SIDE * SIDE)
    if len(lines) != (1 if blank else 0):
        return f"{'blank' if blank else 'not blank'}, and {len(lines)} lines say so"
    if wanted is not None and (not blank or wanted not in lines[0]):
        return f"{wanted!r} is missing: {error!r}"
    return ""


def main():
    models = [os.path.join(base, name) for root in (os.path.join(ROOT, "models"), FOLDER) for base, _, names in os.walk(root)
              for name in names if name.endswith((".obj", ".stl")) and os.path.getsize(os.path.join(base, name)) < 400_000]
    runs = [(path, way, None) for path in sorted(models) for way in WAYS]
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, data in FILES.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(data)
        for name, (text, options, wanted) in MODELS.items():
            path = os.path.join(folder, name + ".obj")
            with open(path, "w", encoding="ascii") as file:
                file.write(text)
            runs.append((path, options, wanted))
        for path, options, wanted in runs:
            what = fault(path, options, wanted)
            faults += what != ""
            if what:
                print(f"{path} {' '.join(options)}: {what}", file=sys.stderr)
    print(f"{len(runs)} pictures of {len(models) + len(MODELS)} models, {faults} wrong")
    sys.exit(1 if faults or len(models) < 20 else 0)


if __name__ == "__main__":
    main()
