#include "bench/meshes/shapes.h"

#include <array>

namespace scanout::bench {
namespace {

using Point = std::array<double, 2>;  // distance from the axis, or x; height
using Row = std::array<DVec3, 4>;     // across
using Patch = std::array<Row, 4>;     // along
using Profile = std::array<Point, 4>; // of a surface of revolution
constexpr double kQuarter = 0.56;     // Newell's handle of a quarter circle of radius 1
constexpr std::size_t kSquares = 10;  // a side of a patch

constexpr std::array<Profile, 6> kProfiles = {{
    {{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}}, // rim
    {{{1.5, 2.4}, {1.75, 1.875}, {2, 1.35}, {2, 0.9}}},               // body
    {{{2, 0.9}, {2, 0.45}, {1.5, 0.225}, {1.5, 0.15}}},
    {{{0, 3.15}, {0.8, 3.15}, {0, 2.7}, {0.2, 2.55}}}, // lid
    {{{0.2, 2.55}, {0.4, 2.4}, {1.3, 2.4}, {1.3, 2.4}}},
    {{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0}, {0, 0}}}, // bottom
}};

// Half of a tube: the curves along its inner and outer side, and half its width there.
struct HalfTube {
    Profile inner, outer;
    std::array<double, 4> width;
};
constexpr std::array<HalfTube, 4> kTubes = {{
    {{{{-1.6, 2.025}, {-2.3, 2.025}, {-2.7, 2.025}, {-2.7, 1.8}}}, // handle
     {{{-1.5, 2.25}, {-2.5, 2.25}, {-3, 2.25}, {-3, 1.8}}},
     {0.3, 0.3, 0.3, 0.3}},
    {{{{-2.7, 1.8}, {-2.7, 1.575}, {-2.5, 1.125}, {-2, 0.9}}},
     {{{-3, 1.8}, {-3, 1.35}, {-2.65, 0.9375}, {-1.9, 0.6}}},
     {0.3, 0.3, 0.3, 0.3}},
    {{{{1.7, 1.425}, {2.6, 1.425}, {2.3, 2.1}, {2.7, 2.4}}}, // spout
     {{{1.7, 0.6}, {3.1, 0.825}, {2.4, 2.025}, {3.3, 2.4}}},
     {0.66, 0.66, 0.25, 0.25}},
    {{{{2.7, 2.4}, {2.8, 2.475}, {2.9, 2.475}, {2.8, 2.4}}},
     {{{3.3, 2.4}, {3.525, 2.49375}, {3.45, 2.5125}, {3.2, 2.4}}},
     {0.25, 0.25, 0.15, 0.15}},
}};

std::array<double, 4> bernstein(double t) {
    const double s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

// u runs across, v along.
void add_patch(geom::PolygonMesh& mesh, const Patch& patch) {
    add_grid(mesh, {kSquares, kSquares}, [&](double u, double v) {
        const auto across = bernstein(u), along = bernstein(v);
        DVec3 sum(0);
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t i = 0; i < 4; ++i)
                sum = sum + patch[j][i] * (across[i] * along[j]);
        return sum;
    });
}

void add_revolved(geom::PolygonMesh& mesh, const Profile& profile) {
    for (int quarter = 0; quarter < 4; ++quarter) {
        // Of the quarter: from one axis to the next, clockwise seen from above.
        const double x = quarter == 0 ? 1 : quarter == 2 ? -1 : 0;
        const double z = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
        const DVec3 from(x, 0, z), to(-z, 0, x);
        Patch patch;
        for (std::size_t j = 0; j < 4; ++j) {
            const double r = profile[j][0];
            const DVec3 up(0, profile[j][1], 0);
            patch[j] = {up + from * r, up + (from + to * kQuarter) * r,
                        up + (to + from * kQuarter) * r, up + to * r};
        }
        add_patch(mesh, patch);
    }
}

void add_half_tube(geom::PolygonMesh& mesh, const HalfTube& tube, double side) {
    Patch patch;
    for (std::size_t j = 0; j < 4; ++j) {
        const auto place = [&](const Point& p, double width) {
            return DVec3(p[0], p[1], side * width);
        };
        patch[j] = {place(tube.inner[j], 0), place(tube.inner[j], tube.width[j]),
                    place(tube.outer[j], tube.width[j]), place(tube.outer[j], 0)};
        // The other half is its mirror image: seen from outside it must wind the same way.
        if (side < 0) std::swap(patch[j][0], patch[j][3]);
        if (side < 0) std::swap(patch[j][1], patch[j][2]);
    }
    add_patch(mesh, patch);
}

} // namespace

geom::PolygonMesh teapot() {
    geom::PolygonMesh mesh;
    for (const Profile& profile : kProfiles)
        add_revolved(mesh, profile);
    for (const HalfTube& tube : kTubes)
        for (const double side : {1.0, -1.0})
            add_half_tube(mesh, tube, side);
    return mesh;
}

} // namespace scanout::bench
