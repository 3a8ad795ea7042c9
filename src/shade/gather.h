// From a tile's visibility buffer to blocks of lanes and on to the picture's pixels: visible pixels
// are collected across triangles, 128 a block, one material a block; each triangle is shaded once a
// pixel, at the centre if it covers it, else at its first visible sample.
#pragma once

#include "geom/mesh.h"
#include "image/image.h"
#include "raster/geometry.h"
#include "raster/tile.h"
#include "scene/view.h"
#include "shade/linear_picture.h"
#include "shade/place_lanes.h"
#include "shade/resolve.h"
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
    const scene::View* view = nullptr;
    std::span<const scene::Material> materials;
    std::span<const scene::Texture> textures;
    std::span<const Stage* const> stages;
    const FrameState* frame = nullptr;
    bool mirrored = false;
    Rays rays;
    image::Rgba8 background{};
    LinearPicture* linear = nullptr; // also kept there
};

// One a worker: the block and the lists live from tile to tile.
class Gatherer {
public:
    Gatherer();
    ~Gatherer();
    // For the tile that is shaded next; null: nothing was counted.
    void set_shadow(const TileShadow* shadow);
    // Writes every pixel of the tile that shows a primitive; the others are left alone. Returns how
    // many lanes were shaded.
    std::uint64_t shade(const raster::VisibilityTile& tile, const GatherInput& input,
                        image::Image& picture);

private:
    struct Fragment;
    // Primitives of the tile, made when first seen.
    class Primitives;
    void collect(const raster::VisibilityTile& tile, const GatherInput& input);
    void collect_shared(const raster::VisibilityTile& tile, const GatherInput& input, int x, int y);
    void add_run(const raster::VisibilityTile& tile, const GatherInput& input,
                 const Fragment& fragment, int skip, int count);
    void finish_block(const raster::VisibilityTile& tile, const GatherInput& input,
                      image::Image& picture);
    void keep_linear(const raster::VisibilityTile& tile, LinearPicture& linear) const;
    void resolve_shared(const raster::VisibilityTile& tile, const GatherInput& input,
                        image::Image& picture);

    std::vector<Fragment> fragments_;
    std::unique_ptr<Primitives> primitives_;
    std::unique_ptr<Block> block_;
    struct Piece; // lanes of a block that one fragment fills
    std::vector<Piece> pieces_;
    PixelSums sums_; // of the pixels in shared_
    std::vector<std::uint16_t> shared_;
    std::vector<std::uint32_t> codes_;
};

} // namespace scanout::shade
