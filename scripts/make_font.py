#!/usr/bin/env python3
"""Writes src/app/font_*.cpp from X11's "misc-fixed" bitmap fonts.

    scripts/make_font.py FOLDER     FOLDER holds 9x15.pcf.gz 9x15B.pcf.gz 10x20.pcf.gz
                                    (Debian package xfonts-base: /usr/share/fonts/X11/misc)

Run once; its output is committed, so that neither the build nor the program needs the package. The PCF
tables are read as in https://fontforge.org/docs/techref/pcf-format.html.
"""
import gzip
import pathlib
import struct
import sys

PROPERTIES, METRICS, BITMAPS, ENCODINGS, BDF_ACCELERATORS = 1, 4, 8, 32, 256
FONTS = [("9x15", "font_regular", "regular"), ("9x15B", "font_bold", "bold"), ("10x20", "font_large", "large")]
SYMBOLS = "–—‘’“”•…←↑→↓↔↕−∞≈≠≤≥─│┌┐└┘├┤┬┴┼■□▲▶▼◀●"
CHARACTERS = sorted([*range(0x20, 0x7F), *range(0xA1, 0xAD), *range(0xAE, 0x100), *map(ord, SYMBOLS)])


class Pcf:
    def __init__(self, path):
        self.data = gzip.decompress(path.read_bytes())
        assert self.data[:4] == b"\x01fcp", path
        (count,) = struct.unpack_from("<I", self.data, 4)
        tables = [struct.unpack_from("<IIII", self.data, 8 + 16 * i) for i in range(count)]
        self.offset = {kind: offset for kind, _, _, offset in tables}

    def table(self, kind):
        """The table's place behind its format word, the format, and the byte order for struct."""
        at = self.offset[kind]
        (form,) = struct.unpack_from("<I", self.data, at)
        return at + 4, form, ">" if form & 4 else "<"

    def properties(self):
        at, _, order = self.table(PROPERTIES)
        (count,) = struct.unpack_from(order + "I", self.data, at)
        entries = [struct.unpack_from(order + "IBI", self.data, at + 4 + 9 * i) for i in range(count)]
        strings = at + 4 + 9 * count + (-count & 3) + 4
        text = lambda o: self.data[strings + o:self.data.index(b"\0", strings + o)].decode("latin-1")
        return {text(name): text(value) if is_text else value for name, is_text, value in entries}

    def ascent_descent(self):
        at, _, order = self.table(BDF_ACCELERATORS)
        return struct.unpack_from(order + "2i", self.data, at + 8)

    def glyphs(self):
        at, _, order = self.table(ENCODINGS)
        low0, low1, high0, high1, _ = struct.unpack_from(order + "5h", self.data, at)
        codes = [high << 8 | low for high in range(high0, high1 + 1) for low in range(low0, low1 + 1)]
        indices = struct.unpack_from(f"{order}{len(codes)}H", self.data, at + 10)
        return {code: index for code, index in zip(codes, indices) if index != 0xFFFF}

    def metrics(self, index):
        """Left bearing, right bearing, advance, ascent, descent."""
        at, form, order = self.table(METRICS)
        if form & 0x100:  # compressed: bytes with 128 added
            return [value - 128 for value in self.data[at + 2 + 5 * index:at + 7 + 5 * index]]
        return struct.unpack_from(order + "5h", self.data, at + 4 + 12 * index)

    def rows(self, index):
        """The glyph's inked box as lists of 0 and 1, from the top."""
        left, right, _, ascent, descent = self.metrics(index)
        at, form, order = self.table(BITMAPS)
        (count,) = struct.unpack_from(order + "I", self.data, at)
        (offset,) = struct.unpack_from(order + "I", self.data, at + 4 + 4 * index)
        begin = at + 4 + 4 * count + 16 + offset
        pad, unit = 1 << (form & 3), 1 << (form >> 4 & 3)
        stride = ((right - left + 7) // 8 + pad - 1) // pad * pad
        data = bytearray(self.data[begin:begin + stride * (ascent + descent)])
        if (form & 4 != 0) != (form & 8 != 0):  # bytes and bits run in different directions
            for i in range(0, len(data), unit):
                data[i:i + unit] = data[i:i + unit][::-1]
        bit = (lambda b, x: b >> (7 - x) & 1) if form & 8 else (lambda b, x: b >> x & 1)
        return [[bit(data[y * stride + x // 8], x % 8) for x in range(right - left)]
                for y in range(ascent + descent)]


def cell_bits(pcf, index, width, height, font_ascent):
    """The glyph in its cell, row by row, as one string of 0 and 1."""
    left, _, advance, ascent, _ = pcf.metrics(index)
    assert advance == width
    cell = [["0"] * width for _ in range(height)]
    for y, row in enumerate(pcf.rows(index)):
        for x, on in enumerate(row):
            if on:
                cell[font_ascent - ascent + y][left + x] = "1"
    return "".join("".join(row) for row in cell)


def source(pcf, file_name, variable):
    properties = pcf.properties()
    assert properties["COPYRIGHT"] == "Public domain font.  Share and enjoy."
    font_ascent, font_descent = pcf.ascent_descent()
    height = font_ascent + font_descent
    glyphs = pcf.glyphs()
    width = pcf.metrics(glyphs[ord("A")])[2]
    lines = [
        f"// Made by scripts/make_font.py from {file_name}.pcf of X11's misc-fixed fonts (Debian: xfonts-base):",
        f"// {properties['FONT']}",
        f"// Copyright notice of the font: \"{properties['COPYRIGHT']}\"",
        '#include "app/overlay/font.h"',
        "",
        "#include <array>",
        "",
        "// clang-format off",
        "namespace scanout::app {",
        "",
    ]
    present = [code for code in CHARACTERS if code in glyphs]
    name = f"k{variable.removeprefix('font_').title()}Glyphs"
    lines.append(f"static constexpr std::array<Glyph, {len(present)}> {name}{{{{")
    for code in present:
        bits = cell_bits(pcf, glyphs[code], width, height, font_ascent).ljust(256, "0")
        words = ", ".join(f"0x{int(bits[i:i + 64], 2):016x}" for i in range(0, 256, 64))
        # A backslash at the end of a comment would swallow the next line.
        shown = "backslash" if code == 0x5C else chr(code)
        lines.append(f"    {{0x{code:04x}, {{{words}}}}},  // {shown}".rstrip())
    lines += ["}};", "", f"const Font {variable}{{{width}, {height}, {name}}};", "", "}  // namespace scanout::app", ""]
    return "\n".join(lines)


def main():
    fonts = pathlib.Path(sys.argv[1])
    out = pathlib.Path(__file__).resolve().parent.parent / "src/app"
    for file_name, variable, suffix in FONTS:
        text = source(Pcf(fonts / f"{file_name}.pcf.gz"), file_name, variable)
        (out / f"font_{suffix}.cpp").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main()
