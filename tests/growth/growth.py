#!/usr/bin/env python3
"""growth.py SCANOUT [NAME...]: time and memory of `scanout render` are linear in the file, for inputs that make programs
quadratic: one edge of all faces, one face of all vertices, a pixel under all layers, and so on. Prints each input at n, 2 n
and 4 n with its CPU time (the least of three runs, without what an empty model takes) and its peak memory.

Fails where 4 n takes more than 6 times the time of n, or more than 5 times its memory: linear is 4, n log n about 4.4 here,
quadratic 16.
"""
import math
import os
import sys
import tempfile

TIMES, BYTES = 6, 5  # at most, from n to 4 n
LEAST, LEAST_BYTES = 0.05, 4e6  # less is the clock's, and the allocator's


def faces_at_one_edge(n, write):
    """Two normals alternate, so each face asks all others whom it may share a vertex with."""
    write("model.obj", "v 0 0 0\nv 0 1 0\n" + "".join(f"v {1 + i % 97} 0 {i}\n" for i in range(n)) + "vn 0 0 1\nvn 0 1 0\n" +
          "".join(f"f 1//{1 + i % 2} 2//{1 + i % 2} {i + 3}//{1 + i % 2}\n" for i in range(n)))


def smoothed_fan(n, write):
    """Without normals: every face meets every other at one vertex."""
    write("model.obj", "v 0 0 0\ns 1\n" + "".join(f"v {i % 89} {i % 97} {i}\n" for i in range(n + 1)) +
          "".join(f"f 1 {i + 2} {i + 3}\n" for i in range(n)))


def materials(n, write):
    write("many.mtl", "".join(f"newmtl m{i}\nKd 0.{i % 10} 0.5 0.5\n" for i in range(n)))
    write("model.obj", "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + "".join(f"usemtl m{i}\nf 1 2 3\n" for i in range(n)))


def unknown_materials(n, write):
    write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "".join(f"usemtl m{i}\nf 1 2 3\n" for i in range(n)))


def textures_that_are_not_there(n, write):
    write("many.mtl", "".join(f"newmtl m{i}\nmap_Kd t{i}.png\n" for i in range(n)))
    write("model.obj", "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n" +
          "".join(f"usemtl m{i}\nf 1/1 2/1 3/1\n" for i in range(n)))


def bad_lines(n, write):
    write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + "".join(f"f 1 2 {i + 4}\n" for i in range(n)))


def one_face(n, write):
    """A star of rays of two lengths: every second corner is concave."""
    corners = [(2 + i % 2, 2 * math.pi * i / n) for i in range(n)]
    write("model.obj", "".join(f"v {r * math.cos(at):.6f} {r * math.sin(at):.6f} 0\n" for r, at in corners) + "f " +
          " ".join(str(i + 1) for i in range(n)) + "\n")


def comb(n, write):
    """One face again: all teeth stand on one line, which follows no axis."""
    corners = [(0, 0), (n // 2, 0)]
    for i in range(n // 4, 0, -1):
        corners += [(2 * i, 1), (2 * i, 50), (2 * i - 1, 50), (2 * i - 1, 1)]
    corners.append((0, 1))
    write("model.obj", "".join(f"v {4 * x - 3 * y} {3 * x + 4 * y} 0\n" for x, y in corners) + "f " +
          " ".join(str(i + 1) for i in range(len(corners))) + "\n")


def t_vertices(n, write):
    """All lie in one edge of one face, with three decimals."""
    write("model.obj", "v -1 0 0\nv -1 1 0\n" +
          "".join(f"v {i % 3 / 1e4:.4f} {i / n:.9f} 0\nv 1 {i / n:.9f} 0\n" for i in range(n + 1)) +
          f"f 1 3 {3 + 2 * n} 2\n" + "".join(f"f {3 + 2 * i} {4 + 2 * i} {6 + 2 * i} {5 + 2 * i}\n" for i in range(n)))


def one_line(n, write):
    write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# " + "x" * (40 * n) + "\n")


def layers_over_a_pixel(n, write):
    write("model.obj", "".join(f"v 0 0 {i / n}\nv 0.01 0 {i / n}\nv 0 0.01 {i / n}\nf -3 -2 -1\n" for i in range(n)))


def clear_layers_over_a_pixel(n, write):
    write("glass.mtl", "newmtl glass\nKd 0.5 0.7 0.9\nd 0.01\n")
    write("model.obj", "mtllib glass.mtl\nusemtl glass\n" +
          "".join(f"v 0 0 {i / n}\nv 0.01 0 {i / n}\nv 0 0.01 {i / n}\nf -3 -2 -1\n" for i in range(n)))


def clear_layers_over_a_tile(n, write):
    """Each over some 3000 pixels, so that a tile's list of fragments overflows many times."""
    write("glass.mtl", "newmtl glass\nKd 0.5 0.7 0.9\nd 0.01\n")
    write("model.obj", "mtllib glass.mtl\nusemtl glass\nv -1 -1 0\nv 1 1 0\np 1 2\n" +
          "".join(f"v 0 0 {i / n}\nv 0.6 0 {i / n}\nv 0 0.6 {i / n}\nf -3 -2 -1\n" for i in range(n)))


def layers_by_area(n, write):
    """From behind to before, each over half of the picture."""
    write("model.obj", "".join(f"v -1 -1 {i / n}\nv 1 -1 {i / n}\nv 0 1 {i / n}\nf -3 -2 -1\n" for i in range(n)))


def points(n, write):
    write("model.obj", "".join(f"v {i % 1009} {i % 997} {i % 13}\np -1\n" for i in range(n)))


def lines(n, write):
    write("model.obj", "".join(f"v {i % 1009} {i % 997} {i % 13}\n" for i in range(n + 1)) +
          "".join(f"l {i + 1} {i + 2}\n" for i in range(n)))


def one_polyline(n, write):
    write("model.obj", "".join(f"v {i % 1009} {i % 997} {i % 13}\n" for i in range(n)) + "l " +
          " ".join(str(i + 1) for i in range(n)) + "\n")


def ply_facets(n, write):
    write("model.ply", f"ply\nformat ascii 1.0\nelement vertex {n + 2}\nproperty float x\nproperty float y\nproperty float z\n"
          f"element face {n}\nproperty list uchar int vertex_indices\nend_header\n" +
          "".join(f"{i} {i % 2} 0\n" for i in range(n + 2)) + "".join(f"3 {i} {i + 1} {i + 2}\n" for i in range(n)))


def stl_facets_at_one_edge(n, write):
    write("model.stl", "solid a\n" + "".join(
        f"facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex {1 + i % 97} 0 {i}\nendloop\nendfacet\n"
        for i in range(n)) + "endsolid a\n")


INPUTS = {  # maker: n
    faces_at_one_edge: 100_000, smoothed_fan: 100_000, materials: 25_000, unknown_materials: 100_000,
    textures_that_are_not_there: 25_000, bad_lines: 100_000, one_face: 16_384, comb: 65_536,
    t_vertices: 20_000, one_line: 1_000_000,
    layers_over_a_pixel: 100_000, clear_layers_over_a_pixel: 50_000,
    clear_layers_over_a_tile: 2000, layers_by_area: 500, points: 250_000, lines: 250_000, one_polyline: 250_000,
    ply_facets: 250_000, stl_facets_at_one_edge: 100_000}


OPTIONS = {layers_by_area: ["--aa", "area"]}


def run(scanout, model, options):
    """CPU seconds and peak bytes of one process."""
    null = os.open(os.devnull, os.O_WRONLY)
    pid = os.posix_spawn(scanout, [scanout, "render", model, "--size", "320x240", "--quiet", "-o", model + ".ppm", *options], os.environ,
                         file_actions=[(os.POSIX_SPAWN_DUP2, null, 1), (os.POSIX_SPAWN_DUP2, null, 2)])
    os.close(null)
    status, used = os.wait4(pid, 0)[1:]
    if status != 0:
        sys.exit(f"{model}: ended with status {status}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss * 1024


def make(maker, n, folder):
    """The path of the model. In a process of its own: what this one holds, a child begins its peak with."""
    def write(name, text):
        with open(os.path.join(folder, name), "w", encoding="ascii") as file:
            file.write(text)

    pid = os.fork()
    if pid == 0:
        maker(n, write)
        os._exit(0)
    if os.waitpid(pid, 0)[1] != 0:
        sys.exit(f"{maker.__name__}: could not be written")
    return next(os.path.join(folder, name) for name in os.listdir(folder) if name.startswith("model."))


def cost(scanout, maker, n):
    with tempfile.TemporaryDirectory() as folder:
        model = make(maker, n, folder)
        runs = [run(scanout, model, OPTIONS.get(maker, [])) for _ in range(3)]
        return min(time for time, _ in runs), min(peak for _, peak in runs)


def main():
    scanout, names = os.path.abspath(sys.argv[1]), sys.argv[2:]
    none = cost(scanout, points, 1)
    failed = []
    print(f"{'input':28} {'n':>9} {'ms: n':>8} {'2 n':>8} {'4 n':>8} {'MB: n':>8} {'2 n':>8} {'4 n':>8}")
    for maker, n in INPUTS.items():
        if names and maker.__name__ not in names:
            continue
        costs = [cost(scanout, maker, n * factor) for factor in (1, 2, 4)]
        times = [max(time - none[0], 0) for time, _ in costs]
        peaks = [max(peak - none[1], 0) for _, peak in costs]
        print(f"{maker.__name__:28} {n:9}" + "".join(f" {time * 1000:8.0f}" for time in times) +
              "".join(f" {peak / 1e6:8.1f}" for peak in peaks), flush=True)
        if times[2] > TIMES * max(times[0], LEAST):
            failed.append(f"{maker.__name__}: 4 n takes {times[2] / max(times[0], LEAST):.1f} times the time of n")
        if peaks[2] > BYTES * max(peaks[0], LEAST_BYTES):
            failed.append(f"{maker.__name__}: 4 n takes {peaks[2] / max(peaks[0], LEAST_BYTES):.1f} times the memory of n")
    print(*failed, sep="\n", end="\n" if failed else "")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
