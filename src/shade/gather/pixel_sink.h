// The gatherer's third part: where the light of shaded items goes. Interior pixels become codes at
// once and edge pixels when they are summed (PictureSink); or all is summed, and a later pass makes
// the pixels (SumSink, SplatSink).
#pragma once

#include "image/image.h"
#include "shade/gather/gather_types.h"
#include "shade/resolve/linear_picture.h"
#include "shade/resolve/output.h"
#include "shade/resolve/reconstruction_filter.h"
#include "shade/resolve/resolve.h"
#include "shade/stage.h"
#include "shade/transparency/colour_blend.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::shade {

// A block whose stages have run.
struct ShadedItems {
    const ShadingBlock& block;
    const std::int32_t* pixel;        // of each item, by its number in the tile
    int interior;                     // the first so many are of interior pixels
    const Contribution* contribution; // of the others
    const std::uint32_t* code;        // of all; not set unless the sink wants codes
};

// Red, green, blue in the blend space, and coverage.
using CoveredLight = std::array<float, 4>;

class PixelSink {
public:
    struct Tile {
        image::Rect area;
        int samples;
        const Output& output;
        image::Rgba8 background;
        EdgePixels& edge_pixels; // all of them are known
    };

    virtual ~PixelSink() = default;
    // Of each item, its code; of each edge fragment, the samples at which it shows.
    virtual bool wants_codes() const { return false; }
    virtual bool wants_samples() const { return false; }
    virtual void begin(const Tile& tile) = 0;
    virtual void store(const Tile& tile, const ShadedItems& items) = 0;
    // A pixel whose layers' colours decide: what each of its samples shows.
    virtual void store_layers(const Tile& tile, const ColourBlend::Pixel& pixel,
                              std::span<const CoveredLight> samples) = 0;
    virtual void end(const Tile& tile) = 0;
};

// Adds items to the sums of a linear picture, each by its weight.
void add_linear(LinearPicture& sums, const image::Rect& tile, const ShadedItems& items);
// Adds the mean of a pixel's samples.
void add_mean(CoveredLight& sum, std::span<const CoveredLight> samples);

// Makes the picture's pixels.
class PictureSink final : public PixelSink {
public:
    void set(image::Image& picture) { picture_ = &picture; }
    bool wants_codes() const override { return true; }
    void begin(const Tile& tile) override;
    void store(const Tile& tile, const ShadedItems& items) override;
    void store_layers(const Tile& tile, const ColourBlend::Pixel& pixel,
                      std::span<const CoveredLight> samples) override;
    void end(const Tile& tile) override;

private:
    image::Image* picture_ = nullptr;
    PixelSums sums_; // of the edge pixels
    std::vector<std::uint32_t> codes_;
    std::vector<float> offsets_; // dither
};

// Sums in the blend space: of pictures that are larger than theirs will be.
class SumSink final : public PixelSink {
public:
    void set(LinearPicture& sums) { sums_ = &sums; }
    void begin(const Tile&) override {}
    void store(const Tile& tile, const ShadedItems& items) override;
    void store_layers(const Tile& tile, const ColourBlend::Pixel& pixel,
                      std::span<const CoveredLight> samples) override;
    void end(const Tile&) override {}

private:
    LinearPicture* sums_ = nullptr;
};

// What each pixel gives to its neighbours, for a reconstruction filter that runs when all tiles are
// done.
class SplatSink final : public PixelSink {
public:
    void set(const ReconstructionFilter& filter, SplatPicture& splats) {
        filter_ = &filter;
        picture_ = &splats;
    }
    bool wants_samples() const override { return true; }
    void begin(const Tile& tile) override;
    void store(const Tile& tile, const ShadedItems& items) override;
    void store_layers(const Tile& tile, const ColourBlend::Pixel& pixel,
                      std::span<const CoveredLight> samples) override;
    void end(const Tile& tile) override;

private:
    const ReconstructionFilter* filter_ = nullptr;
    SplatPicture* picture_ = nullptr;
    std::vector<FilterSplat> splats_; // of the edge pixels
};

} // namespace scanout::shade
