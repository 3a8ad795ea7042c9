// The transparency of a tile: samples cut out by their alpha, and fragments that blend with the
// surfaces behind. Blending is a sum: a fragment's weight is its alpha times the transmittance of
// all fragments in front of it, at every sample; it is shaded once, like any other, and added by
// its weight. Hidden fragments are not shaded, and a pixel whose fragments all have alpha 1 or 0 is
// the same as without blending, to the bit. Modes in which a fragment's colour sets its
// transmittance have no weights: see shade/transparency/colour_blend.h.
#pragma once

#include "raster/tile/probe.h"
#include "shade/gather/gather.h"
#include "shade/transparency.h"
#include "shade/transparency/alpha_evaluator.h"
#include "shade/transparency/colour_blend.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace scanout::shade {

// Fragments of a part of a tile, with their weights.
struct BlendedPixels {
    image::Rect region; // of the tile, in pixels of the picture
    int samples = 1;
    BlendList list;
    std::vector<std::uint32_t> of_pixel;               // fragments, by pixel
    std::vector<std::uint32_t> start;                  // first index of each pixel; and the end
    std::array<std::uint64_t, raster::kTileSize> rows; // bit x: the pixel has some
    // Transmittance to the opaque surface at each sample of pixels with fragments, from `slot` on.
    std::vector<float> transmittance;
    std::vector<std::uint32_t> slot; // of a pixel of the tile
    // Where the fragments blend by colour, not by weight: holds their order; `transmittance` is
    // empty then, and `slot` holds the places of its samples.
    ColourBlend* colour_blend = nullptr;

    std::span<const std::uint32_t> fragments(int pixel) const {
        const auto p = static_cast<std::size_t>(pixel);
        return std::span(of_pixel).subspan(start[p], start[p + 1] - start[p]);
    }
};

// One a worker.
class TransparencyPass {
public:
    // Draws the samples of cut-out triangles that pass the alpha test.
    void cut_out(const raster::Geometry& geometry, int tile, const GatherInput& input,
                 raster::VisibilityTile& visibility);
    // The tile with its blended triangles drawn as if they were opaque.
    const raster::VisibilityTile& opaque_base(const raster::Geometry& geometry, int tile,
                                              const raster::VisibilityTile& visibility);
    // Shades the tile with its blended fragments, in parts if they are more than the list holds.
    // Returns the number of shaded items.
    std::uint64_t shade(const raster::Geometry& geometry, int tile, const GatherInput& input,
                        const raster::VisibilityTile& visibility, Gatherer& gatherer,
                        PixelSink& sink);

    // Bit x of row y, from the tile's corner: the pixel has blended fragments.
    using Pixels = std::array<std::uint64_t, raster::kTileSize>;
    // Also notes the pixels with blended fragments, of the next tiles; null: notes none.
    void note_pixels(Pixels* pixels) { noted_ = pixels; }

    void begin_frame() {
        found_ = longest_list_ = 0;
        colour_blend_.reset();
    }
    std::uint64_t fragments() const { return found_; } // blended ones since then
    // Bytes of the longest list since then: fragments with their depths and weights.
    std::size_t list_bytes() const { return longest_list_; }
    std::size_t bytes() const; // held

private:
    struct Task; // the arguments of one tile
    struct Candidate {
        std::uint32_t id;
        float depth;
        std::uint16_t pixel;
        std::uint8_t sample;
    };
    void draw_candidates(const GatherInput& input, raster::VisibilityTile& visibility);
    struct Region { // of the tile, with the triangles that may touch it
        image::Rect pixels;
        std::size_t begin, end; // of triangles_
    };
    std::uint64_t shade_region(const Task& task, const Region& region);
    std::uint64_t shade_part(const Task& task, const Region& of, const image::Rect& pixels);
    bool find(const Task& task, const Region& region);
    void find(const Task& task, const image::Rect& box, std::uint32_t triangle);
    void sort_by_pixel();
    void weigh(const Task& task, int pixel);
    void arrange(const Task& task, int pixel);
    void note_list();

    raster::Probe probe_;
    raster::VisibilityTile opaque_base_;
    AlphaEvaluator alpha_evaluator_;
    std::vector<float> alpha_;
    std::vector<std::uint32_t> triangles_; // of the tile, then of parts that are being drawn
    std::vector<image::Rect> boxes_;       // of those, while a tile is drawn in parts
    std::vector<Candidate> candidates_;
    BlendedPixels pixels_;
    std::unique_ptr<ColourBlend> colour_blend_; // while a blend mode wants it
    std::vector<std::uint32_t> at_sample_;
    std::uint64_t found_ = 0;
    std::size_t longest_list_ = 0;
    Pixels* noted_ = nullptr;
};

} // namespace scanout::shade
