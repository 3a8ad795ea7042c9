// Computes the alpha of many fragments, in blocks of items, by the plan's alpha stages, before any
// fragment is shaded: hidden ones then never are.
#pragma once

#include "shade/gather/gather_input.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace scanout::shade {

class PrimitiveCache;

class AlphaEvaluator {
public:
    // Where an item's alpha is evaluated: at the sample itself, or at the pixel's centre where the
    // triangle covers that.
    enum class At : std::uint8_t { sample, centre };

    AlphaEvaluator();
    ~AlphaEvaluator();
    // Needs input.layers. Values go to out, which grows as fragments are added.
    void begin(const GatherInput& input, At at, std::vector<float>& out);
    // Adds the next value: of a triangle at a pixel's sample. Adjacent ones are cheapest.
    void add(std::uint32_t triangle, int x, int y, raster::SampleOffset sample);
    // Computes the last values, which are missing until then.
    void finish();

private:
    void add_item(std::uint32_t triangle, int x, int y, raster::SampleOffset sample);
    void bind(std::int32_t material);
    void run_block();
    float value_of(float alpha) const;

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
