#!/usr/bin/env python3
"""outcomes.py SCANOUT ROOT [LIMITS]: what becomes of every shipped model, and of one small file a kind of fault, in render,
doctor and explain (tests/assets/outcomes.py, which takes LIMITS), against tests/cli/outcomes.txt: the file, three exit codes,
the line of what failed.

SCANOUT_UPDATE_GOLDEN=1 writes that file anew: read its difference.
"""
import difflib
import gzip
import os
import struct
import subprocess
import sys
import tempfile

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
EXPECTED = os.path.join(ROOT, "tests/cli/outcomes.txt")

PLY = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
FACE = b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
FACET = struct.pack("<12fH", 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
NAN = struct.pack("<12fH", 0, 0, 0, float("nan"), 0, 0, 1, 0, 0, 0, 1, 0, 0)
TEXT_FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
FILES = {
    "comma.stl": ("solid a\n" + TEXT_FACET.replace("1 0 0\n", "1,5 0 0\n") + "endsolid\n").encode(),
    "count_beyond.stl": b"a".ljust(80) + struct.pack("<I", 9) + FACET,
    "empty.obj": b"",
    "empty.ply": b"",
    "faces_beyond.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
    "gltf.glb": b"glTF\2\0\0\0" + bytes(12),
    "html.obj": b"<!DOCTYPE html>\n<html><body>404</body></html>\n",
    "huge.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\nproperty float x\nproperty float y\n"
                b"property float z\nend_header\n" + bytes(24),
    "indices.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\nf 0 1 2\nf 1 2 -7\nf 1 2 4294967297\n",
    "long_line.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#" + b"x" * 100_000 + b"\n",
    "loop.obj": b"mtllib loop.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
    "nan.obj": b"v 0 0 0\nv nan 0 0\nv 0 inf 0\nv 1e400 1 1\nf 1 2 3\nf 1 3 4\n",
    "nan.stl": b"a".ljust(80) + struct.pack("<I", 2) + NAN + FACET,
    "no_end.ply": PLY + b"element face 1\n",
    "no_faces.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\n",
    "no_vertices.obj": b"f 1 2 3\n",
    "not_gzip.obj.gz": b"\x1f\x8b\x08\0\0\0\0\0\0\3" + b"broken",
    "numbers.obj": b"v 0 0 0\nv 1 0 zero\nv 0x1p3 1,5 0\nv 1 0 0\nv 0 1 0\nf 1 4 5\n",
    "picture.obj": b"\x89PNG\r\n\x1a\n" + bytes(range(256)),
    "random.stl": bytes((i * 167 + (i >> 3) * 59) & 255 for i in range(4000)),
    "short.ply": PLY + FACE + b"0 0 0\n1 0 0\n",
    "short.ply.gz": gzip.compress(PLY + FACE + b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", mtime=0)[:-12],
    "step.obj": b"ISO-10303-21;\nHEADER;\n",
    "unknown_type.ply": b"ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n0\n",
    "wrong_name.stl": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "zeros.stl": bytes(5000),
}


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(os.path.join(ROOT, "models"), os.path.join(folder, "models"))
        os.mkdir(os.path.join(folder, "bad"))
        for name, content in FILES.items():
            with open(os.path.join(folder, "bad", name), "wb") as out:
                out.write(content)
        table = os.path.join(folder, "table")
        script = os.path.join(ROOT, "tests/assets/outcomes.py")
        done = subprocess.run([sys.executable, "-B", script, SCANOUT, folder, "--table", table] + sys.argv[3:], check=False)
        with open(table, encoding="utf-8") as lines:
            said = lines.read().expandtabs(1)
    if os.environ.get("SCANOUT_UPDATE_GOLDEN"):
        with open(EXPECTED, "w", encoding="utf-8") as out:
            out.write(said)
    with open(EXPECTED, encoding="utf-8") as lines:
        expected = lines.read()
    if said != expected:
        sys.stdout.writelines(difflib.unified_diff(expected.splitlines(True), said.splitlines(True), "expected", "said"))
        sys.exit("outcomes differ: SCANOUT_UPDATE_GOLDEN=1 writes tests/cli/outcomes.txt anew")
    sys.exit(done.returncode)


if __name__ == "__main__":
    main()
