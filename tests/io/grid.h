// OBJ text of a wavy grid, side x side vertices, two triangles a cell, for tests of size and speed.
// The flat one is rough, so that no triangles lie in one plane and share vertices.
#pragma once

#include <iterator>
#include <string>

#include <fmt/format.h>

namespace scanout::io::test {

enum class GridKind { positions, flat, with_uv_and_normals };

// Calls write(text) for a row at a time, so that the text need not stand in memory.
template <class Write>
void write_grid(int side, GridKind kind, Write&& write) {
    std::string row = kind == GridKind::flat ? "s off\n" : "";
    const auto out = [&] { return std::back_inserter(row); };
    const auto flush = [&] {
        write(row);
        row.clear();
    };
    for (int y = 0; y < side; ++y, flush())
        for (int x = 0; x < side; ++x)
            fmt::format_to(out(), "v {:.6f} {:.6f} {:.6f}\n", x / 100.0, y / 100.0,
                           kind == GridKind::flat
                               ? (x * 7919u ^ y * 104729u) * 2654435761u % 1000 / 1e3
                               : (x * 37 + y * 61) % 1000 / 1e4);
    const bool full = kind == GridKind::with_uv_and_normals;
    for (int y = 0; full && y < side; ++y, flush())
        for (int x = 0; x < side; ++x)
            fmt::format_to(out(), "vt {:.6f} {:.6f}\nvn {:.4f} {:.4f} 0.9950\n", double(x) / side,
                           double(y) / side, x % 10 / 100.0, y % 10 / 100.0);
    for (int y = 0; y + 1 < side; ++y, flush())
        for (int x = 0; x + 1 < side; ++x) {
            const int a = y * side + x + 1, b = a + 1, c = a + side, d = c + 1;
            if (full)
                fmt::format_to(out(),
                               "f {0}/{0}/{0} {1}/{1}/{1} {3}/{3}/{3}\nf {0}/{0}/{0} {3}/{3}/{3} "
                               "{2}/{2}/{2}\n",
                               a, b, c, d);
            else
                fmt::format_to(out(), "f {0} {1} {3}\nf {0} {3} {2}\n", a, b, c, d);
        }
}

} // namespace scanout::io::test
