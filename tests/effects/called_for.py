#!/usr/bin/env python3
"""called_for.py SCANOUT ASSETS: what real models call for, found here from their OBJ, MTL and image files alone, sharing
no code with scanout; the plan that `scanout explain --json` tells must agree, in what runs and in the triangles that it
counts. Skipped (77) where the assets are absent.

What a file calls for (HARD-CASES Z6):
texture   a triangle with coordinates and a material whose map_Kd is there
highlight a material with Ks not black and Ns above 0, or no material: that is a grey with a soft one
cut_out   an alpha of 0 in places, and else 1; blending: an alpha between them. Alpha is d, times that of the texels of
          map_Kd. Tr alone is 1 - d, but Tr 1 alone is what exporters write of opaque materials.
emission  a material with Ke not black
Triangles with two corners at one place are never drawn, and call for nothing.
"""
import json
import os
import re
import struct
import subprocess
import sys
import zlib

SCANOUT, ASSETS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
MODELS = (
    "cornell_box/cornell_box.obj",
    "spot/spot_textured.obj",
    "assimp_spider/spider.obj",
    "rabbit_wings3d/rabbit.obj",
    "fuze/fuze.obj",
    "sterngarten/Sterngarten_Wien_innerArea.obj",
)


def png_alphas(data):
    """The set of alphas of a PNG's pixels; only 8 bits, not interlaced, which all of these are."""
    at, packed, transparent = 8, b"", False
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk, at = data[at + 8:at + 8 + size], at + size + 12
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", chunk)
        elif kind == b"IDAT":
            packed += chunk
        elif kind == b"tRNS":
            transparent = True
    if depth != 8 or interlaced or transparent:
        raise ValueError("a kind of PNG that this test does not read")
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[colour]
    if channels in (1, 3):
        return {255}
    raw, stride, found = zlib.decompress(packed), width * channels, set()
    above = bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            up, corner = above[i], above[i - channels] if i >= channels else 0
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + up) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif kind == 4:
                guess = left + up - corner
                far = [(abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner)]
                row[i] = (row[i] + min(far)[2]) & 255
        found.update(row[channels - 1::channels])
        above = row
    return found


def materials(path):
    """name -> {statement: words}; the last statement of a kind counts."""
    found, current = {}, None
    for line in open(path, encoding="latin-1"):
        words = line.split()
        if words and words[0].lower() == "newmtl":
            current = found.setdefault(" ".join(words[1:]), {})
        elif words and current is not None:
            current[words[0].lower()] = words[1:]
    return found


def numbers(words):
    return [float(w) for w in words or []]


class Material:
    def __init__(self, said, folder):
        self.texture = False
        alphas = {255}
        if "map_kd" in said:
            name = os.path.join(folder, " ".join(said["map_kd"]).replace("\\", "/").removeprefix("./"))
            self.texture = os.path.exists(name)
            if self.texture and name.endswith(".png"):
                alphas = png_alphas(open(name, "rb").read())
        d = numbers(said.get("d"))[:1] or [1 - t if t < 1 else 1 for t in numbers(said.get("tr"))[:1]] or [1]
        alphas = {d[0] * a / 255 for a in alphas}
        self.blended = any(0 < a < 1 for a in alphas)
        self.cut_out = not self.blended and 0 in alphas and 1 in alphas
        self.highlight = any(numbers(said.get("ks"))) and any(n > 0 for n in numbers(said.get("ns")))
        self.emission = any(numbers(said.get("ke")))


def called_for(path):
    """(triangles, effect -> triangles that call for it)"""
    folder = os.path.dirname(path)
    known, used, current, places, total = {}, {}, None, [], 0
    for line in open(path, encoding="latin-1"):
        words = line.split()
        if not words:
            continue
        if words[0] == "mtllib":
            library = os.path.join(folder, " ".join(words[1:]).removeprefix("./"))
            known.update({n: Material(m, folder) for n, m in materials(library).items()})
        elif words[0] == "usemtl":
            current = " ".join(words[1:])
        elif words[0] == "v":
            places.append(struct.pack("3f", *map(float, words[1:4])))
        elif words[0] == "f":
            has_uv = all(len(corner.split("/")) > 1 and corner.split("/")[1] for corner in words[1:])
            total += len(words) - 3
            at = [int(corner.split("/")[0]) for corner in words[1:]]
            drawn = len(words) > 4 or len({places[i - 1 if i > 0 else i] for i in at}) == 3
            used[current, has_uv] = used.get((current, has_uv), 0) + (len(words) - 3 if drawn else 0)
    count = dict.fromkeys(("texture", "highlight", "cut_out", "blending", "emission"), 0)
    for (name, has_uv), triangles in used.items():
        material = known.get(name) or Material({}, folder)
        count["texture"] += triangles if has_uv and material.texture else 0
        count["highlight"] += triangles if material.highlight or name not in known else 0
        count["cut_out"] += triangles if material.cut_out else 0
        count["blending"] += triangles if material.blended else 0
        count["emission"] += triangles if material.emission else 0
    return total, count


def planned(path):
    """effect -> (runs, triangles that its reason counts, or None, and of how many)"""
    done = subprocess.run([SCANOUT, "explain", path, "--no-times", "--t-vertices", "keep", "--size", "64x48", "--json=-"], capture_output=True,
                          text=True)
    if done.returncode != 0:
        sys.exit(f"{path}: explain ended with {done.returncode}\n{done.stderr}")
    found = {}
    for effect in json.loads(done.stdout)["effects"]:
        counted = re.search(r"(\d+) of (\d+) triangles", effect["because"])
        found[effect["effect"]] = (effect["on"], *map(int, counted.groups())) if counted else (effect["on"], None, None)
    return found


def main():
    if not os.path.isdir(ASSETS):
        print(f"{ASSETS} is not there")
        return 77
    wrong = compared = 0
    called = set()
    for model in MODELS:
        path = os.path.join(ASSETS, "models", model)
        total, count = called_for(path)
        plan = planned(path)
        for effect, triangles in count.items():
            if effect not in plan:
                sys.exit(f"explain tells nothing of {effect}")
            runs, counted, of = plan[effect]
            compared += 1
            called |= {effect} if triangles else set()
            if runs != (triangles > 0) or (counted is not None and (counted, of) != (triangles, total)):
                wrong += 1
                print(f"{model}: {triangles} of {total} triangles call for {effect}; the plan: "
                      f"{'on' if runs else 'off'}, {counted} of {of}")
    print(f"{compared} decisions over {len(MODELS)} models compared, {wrong} wrong; some call for {', '.join(sorted(called))}")
    return 1 if wrong or not called >= {"texture", "highlight", "blending"} else 0


if __name__ == "__main__":
    sys.exit(main())
