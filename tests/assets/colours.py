"""Compares the colours of two pictures of the same model under different lights, coarsely.

In every 8x8 block that the model fills at least half of, the chroma is (r - g, g - b) / (r + g + b) of the block's sums: the
brightness of a light cancels. The likeness is the correlation of both pictures' chroma over the blocks, 1 at best; a colour
that the whole model has cancels, so only where the colours stand counts. Brightness itself is not compared: correct pictures
of untextured models correlate with the reference's by no more than 0.07 to 0.86, since its lights stand elsewhere.
"""
import math
import os
import shutil

BLOCK = 8
# The models with colours in both pictures, and whether these come from a texture. Measured: spot_textured 0.999, fuze 0.992,
# hundred_cubes 0.934; with a fault, at most 0.268 (spot_textured, u mirrored). Not here: sterngarten (0.928, but 0.931 with a
# mirrored u: its textures are grey), rabbit_wings3d (one colour), cornell_box (the reference's walls are black).
COLOURED = {"spot_textured": True, "fuze": True, "hundred_cubes": False}
LEAST = 0.85          # a right picture
MOST_OF_FAULTS = 0.45  # a wrong one


def chroma_of(rows, background):
    """{(column, row) of a block: (chroma, chroma)}"""
    sums = {}
    for y, row in enumerate(rows):
        for x in range(len(row) // 3):
            r, g, b = row[3 * x:3 * x + 3]
            if (r, g, b) != background:
                block = sums.setdefault((x // BLOCK, y // BLOCK), [0, 0, 0, 0])
                block[0] += r
                block[1] += g
                block[2] += b
                block[3] += 1
    return {at: ((r - g) / max(r + g + b, 1), (g - b) / max(r + g + b, 1))
            for at, (r, g, b, count) in sums.items() if 2 * count >= BLOCK * BLOCK}


def likeness(ours, theirs):
    """Correlation of two results of chroma_of over the blocks of both; 0 where one of them has no colours."""
    places = sorted(ours.keys() & theirs.keys())
    if not places:
        return 0.0
    sides = []
    for side in (ours, theirs):
        means = [sum(side[at][i] for at in places) / len(places) for i in (0, 1)]
        sides.append([side[at][i] - means[i] for at in places for i in (0, 1)])
    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    length = math.sqrt(dot(sides[0], sides[0]) * dot(sides[1], sides[1]))
    return dot(*sides) / length if length else 0.0


def red_and_blue_swapped(rows):
    swapped = []
    for row in rows:
        other = bytearray(row)
        other[0::3], other[2::3] = row[2::3], row[0::3]
        swapped.append(bytes(other))
    return swapped


def with_texture_turned(path, folder, mirror_u, mirror_v):
    """Copies the OBJ file `path` into `folder` with mirrored texture coordinates, its neighbours as links; returns the copy."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    source = os.path.dirname(os.path.abspath(path))
    for name in os.listdir(source):
        if name != os.path.basename(path):
            os.symlink(os.path.join(source, name), os.path.join(folder, name))
    copy = os.path.join(folder, os.path.basename(path))
    with open(path, errors="surrogateescape") as lines, open(copy, "w", errors="surrogateescape") as out:
        for line in lines:
            if line.startswith("vt "):
                u, v = (float(t) for t in line.split()[1:3])
                line = f"vt {1 - u if mirror_u else u!r} {1 - v if mirror_v else v!r}\n"
            out.write(line)
    return copy
