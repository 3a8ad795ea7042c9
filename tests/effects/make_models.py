#!/usr/bin/env python3
"""make_models.py FOLDER: writes the models of scenes.txt that are made: OBJ, MTL and PNG, each with one thing that a
renderer may or may not have to simulate, and next to it what only looks as if: an alpha channel that is full everywhere,
a highlight's exponent without a highlight. The same bytes on every machine."""
import math
import os
import struct
import sys
import zlib


def png(path, width, height, pixel):
    """pixel(x, y) gives 3 or 4 codes: an RGB or an RGBA file."""
    channels = len(pixel(0, 0))
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def checker(size, cells, light=(230, 220, 200), dark=(60, 70, 110)):
    return lambda x, y: light if (x * cells // size + y * cells // size) % 2 == 0 else dark


class Model:
    """An OBJ in the making: faces of one material after the other."""

    def __init__(self, *materials):
        self.materials = materials  # texts of MTL statements, named m0, m1, ...
        self.lines, self.count = [], [0, 0, 0]

    def use(self, material):
        self.lines.append(f"usemtl m{material}")

    def vertex(self, p, colour=None):
        self.lines.append("v " + " ".join(f"{c:.6f}" for c in (*p, *(colour or ()))))
        self.count[0] += 1
        return self.count[0]

    def quad(self, corners, material=None, repeat=1, uv=True, colours=None):
        if material is not None:
            self.use(material)
        ids = [self.vertex(p, colours[i] if colours else None) for i, p in enumerate(corners)]
        if uv:
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                self.lines.append(f"vt {u * repeat} {v * repeat}")
                self.count[1] += 1
            self.lines.append("f " + " ".join(f"{i}/{self.count[1] - 3 + k}" for k, i in enumerate(ids)))
        else:
            self.lines.append("f " + " ".join(map(str, ids)))

    def box(self, centre, half, material=None, open_top=False, **how):
        x, y, z = centre
        c = [[x + sx * half, y + sy * half, z + sz * half] for sz in (-1, 1) for sy in (-1, 1) for sx in (-1, 1)]
        for a, b, d, e in ((4, 5, 7, 6), (1, 0, 2, 3), (5, 1, 3, 7), (0, 4, 6, 2), (0, 1, 5, 4), *(() if open_top else ((6, 7, 3, 2),))):
            self.quad([c[a], c[b], c[d], c[e]], material, **how)

    def sphere(self, centre, radius, material=None, around=24, high=12):
        if material is not None:
            self.use(material)
        first_v, first_t = self.count[0] + 1, self.count[1] + 1
        for j in range(high + 1):
            for i in range(around + 1):
                theta, phi = math.pi * j / high, 2 * math.pi * i / around
                n = (math.sin(theta) * math.sin(phi), -math.cos(theta), math.sin(theta) * math.cos(phi))
                self.vertex([centre[k] + radius * n[k] for k in range(3)])
                self.lines.append(f"vt {i / around:.6f} {j / high:.6f}")
                self.lines.append(f"vn {n[0]:.6f} {n[1]:.6f} {n[2]:.6f}")
                self.count[1] += 1
                self.count[2] += 1
        first_n = self.count[2] - (high + 1) * (around + 1) + 1
        for j in range(high):
            for i in range(around):
                at = [j * (around + 1) + i + k for k in (0, 1, around + 2, around + 1)]
                corners = [f"{first_v + k}/{first_t + k}/{first_n + k}" for k in at]
                if j == 0:
                    del corners[1]  # a pole
                elif j == high - 1:
                    del corners[2]
                self.lines.append("f " + " ".join(corners))

    def write(self, folder, name):
        head = [f"mtllib {name}.mtl"] if self.materials else []
        with open(os.path.join(folder, name + ".obj"), "w") as file:
            file.write("\n".join(head + self.lines) + "\n")
        if self.materials:
            with open(os.path.join(folder, name + ".mtl"), "w") as file:
                for i, text in enumerate(self.materials):
                    file.write(f"newmtl m{i}\n{text}\n")


GREY = "Kd 0.6 0.6 0.6"
FLOOR = [[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]]


def plain(folder):
    model = Model()
    model.box((0, 0, 0), 0.5, uv=False)
    model.write(folder, "plain")


def wires(folder):
    model = Model("Kd 0.9 0.8 0.2")
    model.use(0)
    ids = [model.vertex([x, y, z]) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    for a in range(8):
        for axis in (1, 2, 4):
            if not a & axis:
                model.lines.append(f"l {ids[a]} {ids[a | axis]}")
    model.lines.append(f"p {model.vertex([0, 0, 0])}")
    model.write(folder, "wires")


def vertex_colours(folder):
    model = Model()
    colours = [(1, 0.1, 0.1), (0.1, 1, 0.1), (0.1, 0.1, 1), (1, 1, 0.1)]
    model.box((0, 0, 0), 0.5, uv=False, colours=colours)
    model.write(folder, "vertex_colours")


def checker_board(folder):
    """Seen from so near that each texel is larger than a pixel."""
    png(os.path.join(folder, "checker4.png"), 4, 4, checker(4, 4))
    model = Model("Kd 1 1 1\nmap_Kd checker4.png")
    model.box((0, 0, 0), 0.5, 0)
    model.write(folder, "checker")


def floor(folder):
    """Seen so flatly that many texels share a pixel."""
    png(os.path.join(folder, "checker128.png"), 128, 128, checker(128, 16))
    model = Model("Kd 1 1 1\nmap_Kd checker128.png")
    model.quad(FLOOR, 0, repeat=4)
    model.write(folder, "floor")


def opaque_alpha(folder):
    """An alpha channel, full everywhere; opacity 1, said and left out."""
    colour = checker(16, 4)
    png(os.path.join(folder, "opaque.png"), 16, 16, lambda x, y: (*colour(x, y), 255))
    model = Model("Kd 1 1 1\nd 1\nmap_Kd opaque.png", "Kd 0.2 0.5 0.9\nTr 0")
    model.box((-0.6, 0, 0), 0.5, 0)
    model.box((0.6, 0, 0), 0.5, 1)
    model.write(folder, "opaque_alpha")


def fence(folder):
    """Alpha is nothing or full: cut out, with something behind it."""
    colour = checker(16, 2, (150, 100, 50), (120, 80, 40))
    png(os.path.join(folder, "fence.png"), 16, 16, lambda x, y: (*colour(x, y), 255 if x % 8 < 3 or y % 8 < 3 else 0))
    model = Model("Kd 1 1 1\nmap_Kd fence.png", "Kd 0.8 0.2 0.2")
    model.quad([[-1, -1, 0.5], [1, -1, 0.5], [1, 1, 0.5], [-1, 1, 0.5]], 0)
    model.box((0, 0, -0.4), 0.4, 1)
    model.write(folder, "fence")


def leaves(folder):
    """Alpha in a file of its own (map_d)."""
    png(os.path.join(folder, "disc.png"), 32, 32,
        lambda x, y: (255, 255, 255) if (x - 15.5) ** 2 + (y - 15.5) ** 2 < 200 else (0, 0, 0))
    model = Model("Kd 0.2 0.6 0.2\nmap_d disc.png", "Kd 0.8 0.7 0.5")
    model.quad([[-1, -1, 0.5], [1, -1, 0.5], [1, 1, 0.5], [-1, 1, 0.5]], 0)
    model.box((0, 0, -0.4), 0.4, 1)
    model.write(folder, "leaves")


def glass(folder):
    model = Model("Kd 0.2 0.4 0.9\nd 0.4", "Kd 0.9 0.3 0.1\nd 0.6", GREY)
    model.box((0, 0, 0), 0.3, 2)
    model.quad([[-0.9, -0.7, 0.6], [0.5, -0.7, 0.6], [0.5, 0.7, 0.6], [-0.9, 0.7, 0.6]], 0)
    model.quad([[-0.5, -0.7, 0.9], [0.9, -0.7, 0.9], [0.9, 0.7, 0.9], [-0.5, 0.7, 0.9]], 1)
    model.write(folder, "glass")


def gloss(folder):
    model = Model("Kd 0.5 0.2 0.1\nKs 0.8 0.8 0.8\nNs 40")
    model.sphere((0, 0, 0), 1, 0)
    model.write(folder, "gloss")


def black_ks(folder):
    """An exponent without a highlight, a highlight without an exponent, a black emission, an illum that asks for all."""
    model = Model("Kd 0.5 0.2 0.1\nKs 0 0 0\nNs 100\nKe 0 0 0\nillum 9", "Kd 0.1 0.4 0.2\nKs 0.9 0.9 0.9\nNs 0")
    model.sphere((-0.6, 0, 0), 0.6, 0)
    model.sphere((0.6, 0, 0), 0.6, 1)
    model.write(folder, "black_ks")


def idle_maps(folder):
    """Maps that change nothing: white, under a black colour, or a black one that leaves nothing of what it multiplies."""
    png(os.path.join(folder, "white.png"), 8, 8, lambda x, y: (255, 255, 255))
    png(os.path.join(folder, "black.png"), 8, 8, lambda x, y: (0, 0, 0))
    png(os.path.join(folder, "tiles.png"), 16, 16, checker(16, 4))
    model = Model("Kd 0.5 0.3 0.1\nmap_Kd white.png", "Kd 0 0 0\nnorm tiles.png",
                  "Kd 0.1 0.4 0.2\nKe 1 1 1\nmap_Ke black.png", "Kd 0.2 0.2 0.5\nKs 0.9 0.9 0.9\nNs 40\nmap_Ks black.png",
                  "Kd 0.5 0.2 0.4\nKs 0.9 0.9 0.9\nNs 40\nmap_Ns black.png")
    for i in range(5):
        model.box((0.5 * (i - 2), 0, 0), 0.2, i, colours=[(1, 1, 1)] * 4)
    model.write(folder, "idle_maps")


def dull_maps(folder):
    """Wide highlights of which black maps leave nothing; the third ball's is whole."""
    png(os.path.join(folder, "black.png"), 8, 8, lambda x, y: (0, 0, 0))
    model = Model("Kd 0.5 0.3 0.1\nKs 1 1 1\nNs 10\nmap_Ks black.png",
                  "Kd 0.2 0.3 0.5\nKs 1 1 1\nNs 10\nmap_Ns black.png", "Kd 0.3 0.4 0.2\nKs 0.5 0.5 0.5\nNs 10")
    for i in range(3):
        model.sphere((1.1 * (i - 1), 0, 0), 0.5, i)
    model.write(folder, "dull_maps")


def one_colour(folder):
    """A map of one colour, far more texels than pixels: the same at every size and under every filter."""
    png(os.path.join(folder, "sand.png"), 64, 64, lambda x, y: (200, 170, 90))
    model = Model("Kd 1 1 1\nmap_Kd sand.png")
    model.quad(FLOOR, 0, repeat=16)
    model.write(folder, "one_colour")


def coal(folder):
    """Kd is bright, its map black: there is nothing to light."""
    png(os.path.join(folder, "coal.png"), 8, 8, lambda x, y: (0, 0, 0))
    model = Model("Kd 1 1 1\nmap_Kd coal.png")
    model.box((0, 0, 0), 0.5, 0)
    model.write(folder, "coal")


def block(folder):
    """Convex: it throws no shadow on itself. And a collapsed triangle whose material says everything."""
    model = Model(GREY, "Kd 1 0 0\nKs 1 1 1\nNs 9\nKe 1 1 1\nd 0.5")
    model.box((0, 0, 0), 0.5, 0)
    model.use(1)
    model.lines.append("f 1/1 1/1 2/2")
    model.write(folder, "block")


def bumps(folder):
    png(os.path.join(folder, "waves.png"), 64, 64, lambda x, y: (int(127.5 + 127.5 * math.sin(x * math.pi / 8)),) * 3)
    png(os.path.join(folder, "flat.png"), 8, 8, lambda x, y: (90, 90, 90))
    model = Model(GREY + "\nmap_Bump -bm 2 waves.png", GREY + "\nmap_Bump flat.png")  # the second bends no normal
    model.quad(FLOOR, 0)
    model.box((0, 0.35, 0), 0.3, 1)
    model.write(folder, "bumps")


def normals(folder):
    def tilted(x, y):
        angle = math.sin(x * math.pi / 8) * 0.6
        return tuple(round(127.5 + 127.5 * c) for c in (math.sin(angle), 0, math.cos(angle)))

    png(os.path.join(folder, "tilted.png"), 64, 64, tilted)
    model = Model(GREY + "\nnorm tilted.png")
    model.quad(FLOOR, 0)
    model.write(folder, "normals")


def glow(folder):
    png(os.path.join(folder, "lamp.png"), 16, 16, checker(16, 4, (255, 240, 180), (0, 0, 0)))
    model = Model("Kd 0.1 0.1 0.1\nKe 0.2 0.6 0.3", "Kd 0.2 0.2 0.2\nKe 1 1 1\nmap_Ke lamp.png", GREY)
    model.box((-0.8, 0, 0), 0.35, 0)
    model.box((0, 0, 0), 0.35, 1)
    model.box((0.8, 0, 0), 0.35, 2)
    model.write(folder, "glow")


def gloss_maps(folder):
    png(os.path.join(folder, "stripes.png"), 32, 32, checker(32, 4, (255, 255, 255), (20, 20, 20)))
    model = Model("Kd 0.4 0.2 0.1\nKs 1 1 1\nNs 30\nmap_Ks stripes.png", "Kd 0.1 0.2 0.4\nKs 1 1 1\nNs 60\nmap_Ns stripes.png")
    model.sphere((-0.7, 0, 0), 0.6, 0)
    model.sphere((0.7, 0, 0), 0.6, 1)
    model.write(folder, "gloss_maps")


def metal(folder):
    model = Model("Kd 0.9 0.7 0.3\nPr 0.3\nPm 1", "Kd 0.5 0.1 0.1\nPr 0.6\nPm 0")
    model.sphere((-0.7, 0, 0), 0.6, 0)
    model.sphere((0.7, 0, 0), 0.6, 1)
    model.write(folder, "metal")


def metal_maps(folder):
    png(os.path.join(folder, "worn.png"), 32, 32, checker(32, 4, (255, 255, 255), (60, 60, 60)))
    model = Model("Kd 0.9 0.7 0.3\nPr 0.8\nPm 1\nmap_Pr worn.png", "Kd 0.5 0.1 0.1\nPr 0.4\nmap_Pm worn.png")
    model.sphere((-0.7, 0, 0), 0.6, 0)
    model.sphere((0.7, 0, 0), 0.6, 1)
    model.write(folder, "metal_maps")


def open_box(folder):
    """Its inside shows the backs of its faces."""
    model = Model(GREY)
    model.box((0, 0, 0), 0.6, 0, open_top=True, uv=False)
    model.write(folder, "open_box")


def everything(folder):
    """A thing of each kind in a row before a checkered floor."""
    model = Model("Kd 1 1 1\nmap_Kd checker128.png", "Kd 0.5 0.2 0.1\nKs 0.8 0.8 0.8\nNs 40", "Kd 0.2 0.4 0.9\nd 0.4",
                  "Kd 1 1 1\nmap_Kd fence.png", "Kd 0.1 0.1 0.1\nKe 0.2 0.6 0.3", GREY + "\nnorm tilted.png")
    model.quad(FLOOR, 0, repeat=2)
    model.sphere((-0.6, 0.25, -0.3), 0.25, 1)
    model.quad([[-0.3, 0.02, 0.5], [0.3, 0.02, 0.5], [0.3, 0.6, 0.5], [-0.3, 0.6, 0.5]], 2)
    model.quad([[0.35, 0.02, 0.4], [0.9, 0.02, 0.4], [0.9, 0.57, 0.4], [0.35, 0.57, 0.4]], 3)
    model.box((0.1, 0.2, -0.3), 0.18, 4)
    model.box((0.6, 0.2, -0.3), 0.18, 5)
    model.write(folder, "everything")


def make(folder):
    os.makedirs(folder, exist_ok=True)
    for maker in (plain, wires, vertex_colours, checker_board, floor, opaque_alpha, fence, leaves, glass, gloss, black_ks,
                  idle_maps, dull_maps, one_colour, coal, block,
                  bumps, normals, glow, gloss_maps, metal, metal_maps, open_box, everything):
        maker(folder)


if __name__ == "__main__":
    make(sys.argv[1])
