#!/usr/bin/env python3
"""silhouettes.py SCANOUT ASSETS OUT: renders the OBJ and STL models of ASSETS/reference/COMMANDS.txt with the camera of
each reference picture and compares silhouettes: intersection over union, 98 % or an exception that is explained here; and,
where a model has colours, where they stand (colours.py): a mirrored or turned over texture, or red and blue swapped, must be
seen to fail. Exit 77 (skipped) where the assets are not there.

The reference's camera looks along -z (up +y) or +y (up +z) at the focal point and is turned by azimuth, then elevation.
"""
import gzip
import math
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import colours
from picture import read_png

THRESHOLD = 0.98
BACKGROUND = (1, 2, 254)  # no model has it
# name: (lowest overlap accepted, why)
EXCEPTIONS = {}
# The picture to compare with, where it is not the one of the same name.
REFERENCE = {"suzanne_utm": "suzanne"}


def entries(assets):
    """[(name, model, up axis, azimuth, elevation)] of the reference pictures of OBJ and STL models."""
    found = []
    for line in open(os.path.join(assets, "reference/COMMANDS.txt")):
        command = re.match(r"(\w+)\.png: .*f3d (\S+\.(?:obj|stl)) (.*)", line)
        if command:
            name, model, rest = command.groups()
            number = lambda key: float((re.search(key + r"=(-?[\d.]+)", rest) or [0, 0])[1])
            up = (re.search(r"--up=\+(\w)", rest) or [0, "Y"])[1]
            found.append((name, model, up, number("azimuth-angle"), number("elevation-angle")))
    return found


def box_of(assets, model):
    """The bounding box that MANIFEST.tsv names: (lowest corner, highest corner)."""
    for line in open(os.path.join(assets, "MANIFEST.tsv")):
        cells = line.split("\t")
        if cells[0] in (model, model + ".gz"):
            v = [float(t) for t in cells[6].split()]
            return v[:3], v[3:]
    raise KeyError(model)


def camera_of(assets, entry):
    """The reference's focal point and distance: the middle of the box, its half diagonal fitted into 30 degrees."""
    name, model = entry[:2]
    shift = (0, 0, 0)
    if name == "suzanne_utm":  # the reference of the same head at the origin is the right one, see COMMANDS.txt
        model, shift = "models/suzanne/blender_282_suzanne.obj", (450000, 5400000, 300)
    low, high = box_of(assets, model if model.startswith("models/") else f"models/{name}/{model}")
    focal = [(a + b) / 2 + s for a, b, s in zip(low, high, shift)]
    return focal, math.dist(low, high) / 2 / math.sin(math.radians(15))


def eye_of(up, azimuth, elevation, focal, distance):
    az, el = math.radians(azimuth), math.radians(elevation)
    right, upward, front = math.sin(az) * math.cos(el), math.sin(el), math.cos(az) * math.cos(el)
    offset = (right, upward, front) if up == "Y" else (right, -front, upward)
    return [f + distance * o for f, o in zip(focal, offset)]


def mask(rows, background):
    return [[tuple(row[i:i + 3]) != background for i in range(0, len(row), 3)] for row in rows]


def path_of(assets, out, entry):
    name, model = entry[:2]
    if model.startswith("models/"):
        return os.path.join(assets, model)
    path = os.path.join(out, model)  # kept packed in the assets
    with gzip.open(os.path.join(assets, "models", name, model + ".gz")) as packed, open(path, "wb") as file:
        file.write(packed.read())
    return path


def draw(assets, scanout, out, entry, path):
    """Renders `path` with the camera of the entry's reference picture; returns rows of r, g, b."""
    name, _, up, azimuth, elevation = entry
    focal, distance = camera_of(assets, entry)
    eye = eye_of(up, azimuth, elevation, focal, distance)
    picture = os.path.join(out, name + ".png")
    text = lambda v: ",".join(repr(x) for x in v)
    command = [scanout, "render", path, "-o", picture, "--size", "512x512", "--samples", "1", "--fov", "30", "--up", up.lower(),
               "--eye=" + text(eye), "--look-at=" + text(focal), "--background", "#0102fe"]
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    return read_png(picture)[2]


def overlap_of(got, expected):
    ours, theirs = mask(got, BACKGROUND), mask(expected, background_of(expected))
    both = either = 0
    for a, b in zip(ours, theirs):
        for p, q in zip(a, b):
            both += p and q
            either += p or q
    return both / either if either else 1.0


def background_of(rows):
    return tuple(rows[0][0:3])


def colour_faults(assets, scanout, out, entry, got, expected):
    """Prints the likeness of colours, right and with faults made on purpose; returns what is out of bounds."""
    theirs = colours.chroma_of(expected, background_of(expected))
    ours = lambda rows: colours.likeness(colours.chroma_of(rows, background_of(rows)), theirs)
    right = ours(got)
    wrong = {"red and blue swapped": ours(colours.red_and_blue_swapped(got))}
    if colours.COLOURED[entry[0]]:
        path = path_of(assets, out, entry)
        for fault, u, v in (("u mirrored", True, False), ("v flipped", False, True), ("both", True, True)):
            turned = colours.with_texture_turned(path, os.path.join(out, "turned"), u, v)
            wrong[fault] = ours(draw(assets, scanout, out, (entry[0] + "-fault", *entry[1:]), turned))
    print(f"{entry[0]:24} {right:6.3f}    likeness of colours; " +
          ", ".join(f"{fault} {value:.3f}" for fault, value in wrong.items()))
    found = [] if right >= colours.LEAST else [f"{entry[0]}: colours"]
    return found + [f"{entry[0]}: {fault} is not seen" for fault, value in wrong.items() if value > colours.MOST_OF_FAULTS]


def main():
    scanout, assets, out = sys.argv[1:4]
    only = sys.argv[4:]
    if not os.path.isdir(os.path.join(assets, "reference")):
        print("the asset set is not here")
        sys.exit(77)
    os.makedirs(out, exist_ok=True)
    bad, checked = [], 0
    for entry in entries(assets):
        if only and entry[0] not in only:
            continue
        expected = read_png(os.path.join(assets, "reference", REFERENCE.get(entry[0], entry[0]) + ".png"))[2]
        got = draw(assets, scanout, out, entry, path_of(assets, out, entry))
        overlap = overlap_of(got, expected)
        least, why = EXCEPTIONS.get(entry[0], (THRESHOLD, ""))
        verdict = "ok" if overlap >= least else "TOO LOW"
        print(f"{entry[0]:24} {100 * overlap:6.2f} %  {verdict}  {why}")
        checked += 1
        if overlap < least:
            bad.append(f"{entry[0]}: silhouette")
        if entry[0] in colours.COLOURED:
            bad += colour_faults(assets, scanout, out, entry, got, expected)
    print(f"{checked} silhouettes compared, {len(bad)} out of bounds: {'; '.join(bad) or 'none'}")
    sys.exit(bool(bad) or not checked)


if __name__ == "__main__":
    main()
