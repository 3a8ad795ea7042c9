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
#include "shade/mip_chain.h"
#include "shade/place_lanes.h"
#include "shade/resolve.h"
#include "shade/stage.h"
#include "shade/transparency.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace scanout::shade {

// What is not opaque, and how it is drawn.
struct LayerInput {
    const Transparency* cut_out = nullptr; // null where no triangle wants it
    const Transparency* blended = nullptr;
    bool opaque_blended = false;          // all that is blended has alpha 1
    std::span<const MaterialAlpha> alpha; // of the default material, then of each of the scene
    std::span<const Stage* const> stages; // find alpha
    FrameState frame;                     // of those stages
    float cut = 0.5F;                     // least alpha that is drawn
    std::size_t most_fragments = 0;       // of a list; what is drawn does not depend on it
};

struct BlendedPixels;

// What shading a tile needs to know of the frame.
struct GatherInput {
    const geom::Mesh* mesh = nullptr;
    const raster::Geometry* geometry = nullptr;
    const raster::ScreenTransform* transform = nullptr;
    const scene::View* view = nullptr;
    std::span<const scene::Material> materials;
    std::span<const scene::Texture> textures;
    const MipChains* mips = nullptr;
    std::optional<Wrap> wrap; // of every map; else as each says
    std::span<const Stage* const> stages;
    const FrameState* frame = nullptr;
    bool mirrored = false;
    Rays rays;
    image::Rgba8 background{};
    LinearPicture* linear = nullptr;    // also kept there
    const LayerInput* layers = nullptr; // null where all is opaque

    const scene::Material& material(std::int32_t index) const; // -1: the default material
};

// A map of a material, ready to be read: it has a texture.
BoundMap bound_map(const GatherInput& input, Map map, const scene::Material& material);

// One lane for a triangle in a pixel: at the centre where the triangle covers it, else at a sample
// that it covers; place_lanes has the last word.
Run run_at(const GatherInput& input, const Primitive& primitive, int lane, int x, int y,
           raster::SampleOffset sample);

// One a worker: the block and the lists live from tile to tile.
class Gatherer {
public:
    Gatherer();
    ~Gatherer();
    // Writes every pixel of the tile that shows a primitive; the others are left alone. With
    // blended fragments: of their part of the tile. Returns how many lanes were shaded.
    std::uint64_t shade(const raster::VisibilityTile& tile, const GatherInput& input,
                        image::Image& picture, const BlendedPixels* blended = nullptr);

    // Primitives of the tile, made when first seen.
    class Primitives;

private:
    struct Fragment;
    void collect(const raster::VisibilityTile& tile, const GatherInput& input,
                 const BlendedPixels* blended);
    void collect_blended(const raster::VisibilityTile& tile, const GatherInput& input,
                         const BlendedPixels& blended, int x, int y);
    void collect_shared(const raster::VisibilityTile& tile, const GatherInput& input, int x, int y);
    void add_run(const raster::VisibilityTile& tile, const GatherInput& input,
                 const Fragment& fragment, int skip, int count);
    void join_runs();
    void finish_block(const raster::VisibilityTile& tile, const GatherInput& input,
                      image::Image& picture);
    void keep_linear(const raster::VisibilityTile& tile, LinearPicture& linear) const;
    void resolve_shared(const raster::VisibilityTile& tile, const GatherInput& input,
                        image::Image& picture);

    std::vector<Fragment> fragments_;
    struct Seen; // a fragment of one pixel
    std::vector<Seen> seen_;
    std::unique_ptr<Primitives> primitives_;
    std::unique_ptr<Block> block_;
    std::unique_ptr<CornerLight> corners_; // while frames light vertices or faces
    struct Piece;                          // lanes of a block that one fragment fills
    std::vector<Piece> pieces_;
    PixelSums sums_; // of the pixels in shared_
    std::vector<std::uint16_t> shared_;
    std::vector<float> through_; // the background's share of each
    std::vector<std::uint32_t> codes_;
};

} // namespace scanout::shade
