// Meshes of snapped vertices that cover a square without gap or overlap: what exactly-once tests
// draw (HARD-CASES P1). Coordinates are 1/256 pixel.
#pragma once

#include "raster/exact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scanout::raster::test {

struct SnappedMesh {
    std::vector<Corner> vertex;
    std::vector<std::array<std::size_t, 3>> triangle;

    Corners corners(std::size_t t) const {
        return {vertex[triangle[t][0]], vertex[triangle[t][1]], vertex[triangle[t][2]]};
    }
    void move(int x, int y) { // pixels
        for (Corner& v : vertex)
            v = {v.x + x * oracle::kUnitsPerPixel, v.y + y * oracle::kUnitsPerPixel};
    }
};

// A square that reaches `margin` pixels beyond a picture of size x size.
struct Square {
    std::int32_t low, high;
    std::int32_t side() const { return high - low; }
};
inline Square around(int size, int margin = 16) {
    return {-margin * oracle::kUnitsPerPixel, (size + margin) * oracle::kUnitsPerPixel};
}

// `place` maps the grid's nodes to where the vertex stands; diagonals alternate.
template <class F>
SnappedMesh grid(int cells, F&& place) {
    SnappedMesh mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            mesh.vertex.push_back(place(i, j));
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const std::size_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                              d = at(i, j + 1);
            if ((i + j) % 2 == 0)
                mesh.triangle.insert(mesh.triangle.end(), {{a, b, c}, {c, d, a}});
            else
                mesh.triangle.insert(mesh.triangle.end(), {{a, d, b}, {b, d, c}});
        }
    }
    return mesh;
}

// Eight pixels a cell, every vertex moved by up to 1.2 pixels.
inline SnappedMesh jittered_grid(Random& random, int size = 64) {
    return grid((size + 32 + 7) / 8, [&](int i, int j) {
        return Corner{(i * 8 - 16) * oracle::kUnitsPerPixel + random.whole(-300, 300),
                      (j * 8 - 16) * oracle::kUnitsPerPixel + random.whole(-300, 300)};
    });
}

// Quads of eight pixels, turned about the middle of the picture.
inline SnappedMesh turned_grid(double degrees, int size = 64) {
    const double s = std::sin(degrees * std::numbers::pi / 180),
                 c = std::cos(degrees * std::numbers::pi / 180);
    const int half = size * 3 / 32 + 1; // cells from the middle: the diagonal, and one more
    return grid(2 * half, [&](int i, int j) {
        const double x = (i - half) * 8, y = (j - half) * 8;
        const auto snapped = [&](double v) {
            return static_cast<std::int32_t>(
                std::lround((v + size / 2.0) * oracle::kUnitsPerPixel));
        };
        return Corner{snapped(x * c - y * s), snapped(x * s + y * c)};
    });
}

// n triangles from a hub to the rim of the square; n is a multiple of 4, so that the square's
// corners are among the rim's vertices.
inline SnappedMesh fan(const Corner& hub, int n, const Square& square) {
    SnappedMesh mesh;
    mesh.vertex.push_back(hub);
    const std::int64_t side = square.side();
    for (int i = 0; i < n; ++i) {
        const std::int64_t along = 4 * side * i / n;
        const auto on = static_cast<std::int32_t>(along % side);
        const Corner rim[] = {{square.low + on, square.low},
                              {square.high, square.low + on},
                              {square.high - on, square.high},
                              {square.low, square.high - on}};
        mesh.vertex.push_back(rim[along / side]);
    }
    for (int i = 0; i < n; ++i)
        mesh.triangle.push_back(
            {0, static_cast<std::size_t>(1 + i), static_cast<std::size_t>(1 + (i + 1) % n)});
    return mesh;
}

// n triangles about a hub, any n from 3 up, rim on a circle around the whole tile; every other rim
// vertex on a pixel centre.
inline SnappedMesh centre_fan(const Corner& hub, int n, int radius) {
    SnappedMesh mesh;
    mesh.vertex.push_back(hub);
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.125) / n;
        Corner v{hub.x + static_cast<std::int32_t>(std::lround(std::cos(angle) * radius * 256)),
                 hub.y + static_cast<std::int32_t>(std::lround(std::sin(angle) * radius * 256))};
        if (i % 2 == 0 && n < 64) v = {(v.x & ~0xff) + 128, (v.y & ~0xff) + 128};
        mesh.vertex.push_back(v);
        mesh.triangle.push_back(
            {0, static_cast<std::size_t>(1 + i), static_cast<std::size_t>(1 + (i + 1) % n)});
    }
    return mesh;
}

// A square into which points are put one by one, each splitting the triangle that holds it; many
// slivers, and triangles of area 0 where a point falls on an edge.
inline SnappedMesh split_at_random(Random& random, int points, int grid_step,
                                   const Square& square) {
    SnappedMesh mesh;
    const std::int32_t lo = square.low, hi = square.high;
    mesh.vertex = {{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}};
    mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
    for (; points > 0; --points) {
        const auto anywhere = [&] { return random.whole(lo / grid_step, hi / grid_step); };
        const Corner p{anywhere() * grid_step, anywhere() * grid_step};
        for (auto& t : mesh.triangle) {
            const auto [a, b, c] = t;
            const auto left = [&](std::size_t i, std::size_t j) {
                return oracle::cross(mesh.vertex[i], mesh.vertex[j], p.x, p.y) >= 0;
            };
            if (!left(a, b) || !left(b, c) || !left(c, a)) continue;
            const std::size_t n = mesh.vertex.size();
            t = {a, b, n};
            mesh.triangle.push_back({b, c, n});
            mesh.triangle.push_back({c, a, n});
            mesh.vertex.push_back(p);
            break;
        }
    }
    return mesh;
}

// Is p strictly inside the circle through the corners (clockwise on the screen: area > 0)? Exact:
// the products stay below 2^102 for coordinates below 2^24.
inline bool in_circle(const Corners& t, const Corner& p) {
    Int128 d[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
        const Int128 x = Int128{t[i].x} - p.x, y = Int128{t[i].y} - p.y;
        d[i][0] = x;
        d[i][1] = y;
        d[i][2] = x * x + y * y;
    }
    return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
               d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
               d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]) >
           0;
}

// The Delaunay triangulation of random points and the square's corners (Bowyer 1981, Watson 1981).
inline SnappedMesh delaunay(Random& random, int points, const Square& square) {
    SnappedMesh mesh;
    const std::int32_t lo = square.low, hi = square.high;
    mesh.vertex = {{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}};
    mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
    std::vector<std::array<std::size_t, 2>> rim; // of the hole that a new point makes
    for (; points > 0; --points) {
        const Corner p{random.whole(lo + 1, hi - 1), random.whole(lo + 1, hi - 1)};
        rim.clear();
        const auto dies = [&](const std::array<std::size_t, 3>& t) {
            if (!in_circle({mesh.vertex[t[0]], mesh.vertex[t[1]], mesh.vertex[t[2]]}, p))
                return false;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::array edge{t[i], t[(i + 1) % 3]}, back{edge[1], edge[0]};
                const auto twin = std::find(rim.begin(), rim.end(), back);
                if (twin != rim.end())
                    rim.erase(twin);
                else
                    rim.push_back(edge);
            }
            return true;
        };
        std::erase_if(mesh.triangle, dies);
        for (const auto& [a, b] : rim)
            mesh.triangle.push_back({a, b, mesh.vertex.size()});
        mesh.vertex.push_back(p);
    }
    return mesh;
}

} // namespace scanout::raster::test
