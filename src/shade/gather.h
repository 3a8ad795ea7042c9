// From a tile's visibility buffer to blocks of lanes and back to colours: visible pixels are
// collected across triangles, 128 a block, one material a block; each triangle is shaded once a
// pixel, at the centre if it covers it, else at its first visible sample.
#pragma once

#include "geom/mesh.h"
#include "raster/geometry.h"
#include "raster/tile.h"
#include "shade/stage.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace scanout::shade {

// What shading a tile needs to know of the frame.
struct GatherInput {
    const geom::Mesh* mesh = nullptr;
    const raster::Geometry* geometry = nullptr;
    const raster::ScreenTransform* transform = nullptr;
    std::span<const scene::Material> materials;
    std::span<const scene::Texture> textures;
    std::span<const Stage* const> stages;
    const FrameState* frame = nullptr;
    bool mirrored = false;
    // Ray of a sample at (x, y) pixels: (x * ray_scale_x + ray_offset_x, y * ... , -1).
    float ray_scale_x = 0, ray_offset_x = 0, ray_scale_y = 0, ray_offset_y = 0;
};

// Linear light of a tile's pixels, row by row from the tile's corner (kTileSize pixels a row).
struct TileColour {
    std::vector<float> red, green, blue;
    std::vector<std::uint8_t> covered; // how many of the pixel's samples show a primitive
};

// One a worker: the block and the lists live from tile to tile.
class Gatherer {
public:
    Gatherer();
    ~Gatherer();
    // Fills `out` for every pixel of the tile; returns how many lanes were shaded. Uncovered
    // samples add nothing: the resolve puts the background there.
    std::uint64_t shade(const raster::VisibilityTile& tile, const GatherInput& input,
                        TileColour& out);

private:
    struct Fragment;
    struct PrimitiveSetup;
    void collect(const raster::VisibilityTile& tile, const GatherInput& input);
    const PrimitiveSetup& setup(const GatherInput& input, std::uint32_t id);
    void fill_lane(const raster::VisibilityTile& tile, const GatherInput& input,
                   const Fragment& fragment, int lane);
    void flush(const raster::VisibilityTile& tile, const GatherInput& input, std::size_t first,
               std::size_t last, TileColour& out);

    std::vector<Fragment> fragments_;
    std::vector<PrimitiveSetup> cache_; // direct-mapped by id
    std::unique_ptr<Block> block_;
};

} // namespace scanout::shade
