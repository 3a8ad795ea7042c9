"""Pictures as the tests of the guests need them: PPM, the hash of a frame, what 16 bits make of a colour."""
import struct
from typing import NamedTuple


class Picture(NamedTuple):
    width: int
    height: int
    rgb: bytes  # rows from the top, three bytes a pixel


def read_ppm(path):
    """A binary PPM (P6) of 8 bits."""
    data = open(path, "rb").read()
    fields, position = [], 0
    while len(fields) < 4:
        end = position
        while not data[end:end + 1].isspace():
            end += 1
        if end > position:
            fields.append(data[position:end])
        position = end + 1
    if fields[0] != b"P6" or fields[3] != b"255":
        raise ValueError(f"{path}: not a binary PPM of 8 bits")
    width, height = int(fields[1]), int(fields[2])
    rgb = data[position:]
    if len(rgb) != 3 * width * height:
        raise ValueError(f"{path}: {len(rgb)} bytes for {width}x{height}")
    return Picture(width, height, rgb)


def write_ppm(path, picture):
    with open(path, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % picture[:2] + picture.rgb)


def xxh64(data):
    """XXH64 with seed 0 (github.com/Cyan4973/xxHash, doc/xxhash_spec.md)."""
    mask = (1 << 64) - 1
    p1, p2, p3, p4, p5 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63,
                          0x27D4EB2F165667C5)

    def rotate(x, n):
        return (x << n | x >> (64 - n)) & mask

    def round_(lane, value):
        return rotate((lane + value * p2) & mask, 31) * p1 & mask

    whole = len(data) // 32 * 32
    if whole:
        lanes = [(p1 + p2) & mask, p2, 0, -p1 & mask]
        for stripe in struct.iter_unpack("<4Q", data[:whole]):
            lanes = [round_(lane, value) for lane, value in zip(lanes, stripe)]
        h = sum(rotate(lane, n) for lane, n in zip(lanes, (1, 7, 12, 18))) & mask
        for lane in lanes:
            h = ((h ^ round_(0, lane)) * p1 + p4) & mask
    else:
        h = p5
    h = (h + len(data)) & mask
    rest = data[whole:]
    while len(rest) >= 8:
        h = (rotate(h ^ round_(0, struct.unpack_from("<Q", rest)[0]), 27) * p1 + p4) & mask
        rest = rest[8:]
    if len(rest) >= 4:
        h = (rotate(h ^ struct.unpack_from("<I", rest)[0] * p1 & mask, 23) * p2 + p3) & mask
        rest = rest[4:]
    for byte in rest:
        h = rotate(h ^ byte * p5 & mask, 11) * p1 & mask
    for shift, prime in ((33, p2), (29, p3), (32, 1)):
        h = (h ^ h >> shift) * prime & mask
    return h


def frame_hash(picture):
    """A frame's hash as scanout prints it: width, height and the RGBA8 rows, opaque."""
    rgba = bytearray(b"\xff" * (4 * picture.width * picture.height))
    for channel in range(3):
        rgba[channel::4] = picture.rgb[channel::3]
    return f"{xxh64(struct.pack('<II', picture.width, picture.height) + rgba):016x}"


def differences(a, b):
    """A line on where two pictures differ; empty where they do not."""
    if a[:2] != b[:2]:
        return f"{a.width}x{a.height} against {b.width}x{b.height}"
    wrong = [i for i in range(0, len(a.rgb), 3) if a.rgb[i:i + 3] != b.rgb[i:i + 3]] if a.rgb != b.rgb else []
    if not wrong:
        return ""
    y, x = divmod(wrong[0] // 3, a.width)
    return (f"{len(wrong)} of {a.width * a.height} pixels differ, the first at {x},{y}: "
            f"{tuple(a.rgb[wrong[0]:][:3])} against {tuple(b.rgb[wrong[0]:][:3])}")
