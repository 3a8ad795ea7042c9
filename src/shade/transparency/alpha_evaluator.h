// The alpha of many fragments, found in blocks of items by the plan's alpha stages: before anything
// is shaded, so that what is hidden behind it never is.
#pragma once

#include "shade/gather/gather.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace scanout::shade {

class AlphaEvaluator {
public:
    // Where a item's alpha is found: at the sample itself, or at the centre of the pixel where the
    // triangle covers it.
    enum class At : std::uint8_t { sample, centre };

    AlphaEvaluator();
    ~AlphaEvaluator();
    // input.layers is set. Values go to out, which grows as fragments are added.
    void begin(const GatherInput& input, At at, std::vector<float>& out);
    // The next value: of a triangle at a pixel's sample. Those side by side are cheapest.
    void add(std::uint32_t triangle, int x, int y, raster::SampleOffset sample);
    // Until then the values of the last fragments are not there.
    void finish();

private:
    void add_item(std::uint32_t triangle, int x, int y, raster::SampleOffset sample);
    void bind(std::int32_t material);
    void run_block();

    GatherInput in_; // with the frame state of the alpha stages
    At at_ = At::centre;
    std::vector<float>* out_ = nullptr;
    std::int32_t material_ = -2; // of the block; -2: none yet
    bool constant_ = true;       // no map matters
    std::unique_ptr<ShadingBlock> block_;
    std::unique_ptr<PrimitiveCache> primitives_;
    std::size_t place_[kBlockSize] = {}; // of each item's value
};

} // namespace scanout::shade
