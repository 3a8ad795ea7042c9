// How often each sample is covered, for meshes of any size: the mesh is drawn twice, with depths
// that grow with the triangle's number and with depths that fall. A sample that shows the same
// triangle both times is covered once, by that one; two different ones are a double hit, nothing is
// a gap. No rule for ties is needed.
#pragma once

#include "raster/snapped_mesh.h"
#include "raster/tile/tile.h"

namespace scanout::raster::test {

struct Hits {
    std::int64_t none = 0, once = 0, more = 0;
    Hits& operator+=(const Hits& other) {
        none += other.none;
        once += other.once;
        more += other.more;
        return *this;
    }
    std::int64_t faults() const { return none + more; }
};

inline double rising_depth(std::size_t number, std::size_t count, bool falling) {
    const std::size_t rank = falling ? count - 1 - number : number;
    return 0.25 + 0.5 * static_cast<double>(rank) / static_cast<double>(count);
}

inline void count_hits(const VisibilityTile& rising, const VisibilityTile& falling, Hits& hits) {
    const image::Rect& area = rising.area();
    for (int y = area.y0; y < area.y1; ++y) {
        for (int x = area.x0; x < area.x1; ++x) {
            for (int s = 0; s < rising.samples(); ++s) {
                const std::uint32_t a = rising.id(x, y, s), b = falling.id(x, y, s);
                if (a == kNoPrimitive && b == kNoPrimitive)
                    ++hits.none;
                else if (a == b)
                    ++hits.once;
                else
                    ++hits.more;
            }
        }
    }
}

// Of a tile whose corner stands at pixel (x, y), both multiples of 8.
inline Hits hits_in_tile(const SnappedMesh& mesh, int x, int y, int samples, int side = 64) {
    const image::Rect area{x, y, x + side, y + side};
    VisibilityTile tile[2];
    for (VisibilityTile& t : tile)
        t.reset(area, samples);
    for (std::size_t i = 0; i < mesh.triangle.size(); ++i) {
        const Corners v = mesh.corners(i);
        if (!has_area(v)) continue;
        const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
        const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
        if (right < x * 256 || left > (x + side) * 256 || bottom < y * 256 ||
            top > (y + side) * 256)
            continue;
        for (const bool falling : {false, true}) {
            const double depth = rising_depth(i, mesh.triangle.size(), falling);
            tile[falling ? 1 : 0].draw(
                set_up(v, static_cast<std::uint32_t>(i), {depth, depth, depth}));
        }
    }
    Hits hits;
    count_hits(tile[0], tile[1], hits);
    return hits;
}

inline geom::Mesh mesh_of(const SnappedMesh& snapped, int height, bool falling) {
    geom::Mesh mesh;
    for (std::size_t i = 0; i < snapped.triangle.size(); ++i) {
        for (const Corner& v : snapped.corners(i)) {
            mesh.index.push_back(static_cast<std::uint32_t>(mesh.position.size()));
            mesh.position.emplace_back(static_cast<float>(v.x) / 256,
                                       static_cast<float>(height) - static_cast<float>(v.y) / 256,
                                       rising_depth(i, snapped.triangle.size(), falling));
            mesh.normal.emplace_back(0, 0, 1);
        }
        mesh.material.push_back(-1);
    }
    return mesh;
}

// Of a whole picture, by the geometry stage and its tiles; only every `step`-th tile is looked at.
inline Hits hits_in_picture(const SnappedMesh& snapped, int width, int height, int samples,
                            int step = 1) {
    Jobs jobs(1);
    Geometry geometry[2];
    geom::Mesh mesh[2];
    for (const bool falling : {false, true}) {
        const std::size_t i = falling ? 1 : 0;
        mesh[i] = mesh_of(snapped, height, falling);
        GeometryOptions options;
        options.width = width;
        options.height = height;
        options.samples = samples;
        geometry[i].run(jobs, mesh[i], ScreenTransform(pixel_view(width, height), width, height),
                        options);
    }
    Hits hits;
    VisibilityTile tile[2];
    for (int i = 0; i < geometry[0].tiles(); i += step) {
        for (std::size_t k = 0; k < 2; ++k) {
            tile[k].reset(geometry[k].tile_area(i), samples);
            geometry[k].draw(i, tile[k]);
        }
        count_hits(tile[0], tile[1], hits);
    }
    return hits;
}

} // namespace scanout::raster::test
