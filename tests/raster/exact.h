// What the tests of this module share: snapped triangles from corners, a view without a camera, and
// the oracle's names.
#pragma once

#include "oracle/coverage.h"
#include "raster/stage/geometry.h"
#include "raster/tile/tile.h"
#include "support/pixel_view.h"
#include "support/random.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::raster::test {

using oracle::Corner;
using oracle::Corners;
using oracle::ExactTriangle;
using oracle::Int128;
using scanout::test::Random;

// The triangle that the geometry stage makes of three snapped vertices; area 0 when it drops it.
inline Triangle set_up(const Corners& v, std::uint32_t id,
                       const std::array<double, 3>& depth = {0.5, 0.5, 0.5}) {
    std::array<ScreenVertex, 3> vertex;
    for (std::size_t i = 0; i < 3; ++i) {
        vertex[i].x = v[i].x;
        vertex[i].y = v[i].y;
        vertex[i].depth = depth[i];
    }
    return raster::set_up(vertex, id).value_or(SetUp{}).triangle;
}
inline bool has_area(const Corners& v) {
    return oracle::area(v) != 0;
}

using scanout::test::pixel_view;

// Straight down -z from `distance` before the mesh's origin.
inline scene::View eye_view(double half_width, double half_height, double distance,
                            double near_distance = 0x1p-12) {
    scene::View view;
    view.translation = {0, 0, -distance};
    view.half_width = half_width;
    view.half_height = half_height;
    view.near_distance = near_distance;
    return view;
}

// With vertices of its own.
inline void add_triangle(geom::Mesh& mesh, const std::array<Vec3, 3>& v) {
    for (const Vec3& p : v) {
        mesh.index.push_back(static_cast<std::uint32_t>(mesh.position.size()));
        mesh.position.push_back(p);
        mesh.normal.emplace_back(0, 0, 1);
    }
    mesh.material.push_back(-1);
    mesh.face.push_back(static_cast<std::uint32_t>(mesh.face.size()));
}

// The whole picture by the geometry stage, a copy of its planes.
struct Planes {
    int width = 0, samples = 1;
    std::vector<std::uint32_t> ids;
    std::vector<float> depths;
    friend bool operator==(const Planes&, const Planes&) = default;
    std::size_t at(int x, int y, int sample = 0) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(samples) +
               static_cast<std::size_t>(sample);
    }
    std::uint32_t id(int x, int y, int sample = 0) const { return ids[at(x, y, sample)]; }
};
inline Planes draw_planes(Jobs& jobs, const geom::Mesh& mesh, const scene::View& view, int width,
                          int height, int samples = 1, Facing keep = Facing::any,
                          int tile_size = kTileSize, OcclusionHistory* occlusion = nullptr,
                          std::uint64_t* drawn = nullptr) {
    Geometry geometry;
    GeometryOptions options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    options.keep = keep;
    options.mirrored = view.mirrored;
    options.tile_size = tile_size;
    options.occlusion = occlusion;
    geometry.run(jobs, mesh, ScreenTransform(view, width, height), options);
    Planes out{width, samples, {}, {}};
    const std::size_t size = out.at(0, height);
    out.ids.resize(size);
    out.depths.resize(size);
    VisibilityTile tile;
    DeferredTriangles scratch;
    for (int i = 0; i < geometry.tiles(); ++i) {
        tile.reset(geometry.tile_area(i), samples);
        geometry.draw(i, tile, &scratch);
        // By pointers: without optimisation and with sanitizers this is most of what tests wait
        // for.
        const image::Rect& area = tile.area();
        for (int s = 0; s < samples; ++s)
            for (int y = area.y0; y < area.y1; ++y) {
                const std::ptrdiff_t row = std::ptrdiff_t{y - area.y0} * kTileSize;
                const std::uint32_t* id = tile.ids(s).data() + row;
                const float* depth = tile.depths(s).data() + row;
                std::uint32_t* to_id = out.ids.data() + out.at(area.x0, y, s);
                float* to_depth = out.depths.data() + out.at(area.x0, y, s);
                for (int x = 0; x < area.width(); ++x) {
                    to_id[std::ptrdiff_t{x} * samples] = id[x];
                    to_depth[std::ptrdiff_t{x} * samples] = depth[x];
                }
            }
    }
    if (drawn != nullptr) *drawn = geometry.triangles_drawn();
    return out;
}

// A measured value, in the report of the test (--gtest_output=xml) and on the screen when it fails.
inline void record(const std::string& name, double value) {
    testing::Test::RecordProperty(name, testing::PrintToString(value));
}

} // namespace scanout::raster::test
