// A texture at half, a quarter, ... of its size, for filters that read it minified: Williams 1983.
// Linear light, so that a minified texture is as bright as the whole; floats, so that no level adds
// an error of rounding to 8 bits. A chain exists while a plan needs it.
#pragma once

#include "base/jobs.h"
#include "base/large_array.h"
#include "image/image.h"
#include "scene/scene.h"
#include "shade/stage.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace scanout::shade {

struct MipChain {
    static constexpr int kMaxLevels = 16; // a side of up to 2^15 texels
    int last = 0;                         // the level of one texel
    // Of each level: its size, and where it begins in `texels`, in texels. Level 0 is the image.
    std::int32_t width[kMaxLevels], height[kMaxLevels], begin[kMaxLevels];
    // Levels 1 to last, rows from the top: red, green, blue, alpha of each texel.
    LargeArray<float> texels;
};

// Each level has half the sides of the one above, rounded down; every texel is the mean of the
// texels that it covers. Colours are decoded from sRGB, data are code / 255. Sides of 1 to 2^15
// texels.
MipChain make_mip_chain(const image::Image& image, TexelKind kind, Jobs& jobs);
// The bytes that make_mip_chain allocates.
std::uint64_t mip_chain_bytes(const image::Image& image);

// A texture that the frame reads minified, and its kind: colour or data.
struct MipUse {
    std::int32_t texture;
    TexelKind kind;
    friend bool operator==(const MipUse&, const MipUse&) = default;
};
// The kind of a map's mip chain. Alpha is the same in both kinds: a map that reads only alpha
// shares the chain of a map_Kd with the same texture.
MipUse mip_use(Map map, const scene::TextureMap& options);

// The chains of a scene's textures, from frame to frame.
class MipChains {
public:
    // Afterwards exactly the chains in `used` exist. Chains of a scene with the same revision are
    // kept (0: no scene has it).
    void update(const scene::Scene& scene, std::span<const MipUse> used, Jobs& jobs);
    // Null where there is none.
    const MipChain* find(const MipUse& use) const;
    std::uint64_t bytes() const;

private:
    std::vector<std::unique_ptr<MipChain>> chains_; // two a texture
    std::vector<std::unique_ptr<MipChain>> kept_;   // empty but in update(); its room is not
    std::uint64_t revision_ = 0;
};

} // namespace scanout::shade
