#include "shade/mip/mip_chain.h"

#include "base/check.h"
#include "math/srgb.h"
#include "shade/check_lanes.h"
#include "shade/mip/downsample.h"

#include <algorithm>
#include <utility>

namespace scanout::shade {

// Sets the levels' sizes and places, but no texels; MipReader (mip-inl.h) computes the same ones.
static MipChain mip_levels(const image::Image& image, std::int32_t& texels) {
    MipChain chain;
    chain.width[0] = image.width();
    chain.height[0] = image.height();
    chain.begin[0] = texels = 0;
    while (chain.width[chain.last] > 1 || chain.height[chain.last] > 1) {
        const int above = chain.last++;
        CHECK(chain.last < MipChain::kMaxLevels);
        chain.width[chain.last] = std::max(chain.width[above] / 2, 1);
        chain.height[chain.last] = std::max(chain.height[above] / 2, 1);
        chain.begin[chain.last] = texels;
        texels += chain.width[chain.last] * chain.height[chain.last];
    }
    return chain;
}

std::uint64_t mip_chain_bytes(const image::Image& image) {
    std::int32_t texels = 0;
    mip_levels(image, texels);
    return std::uint64_t{4} * sizeof(float) * static_cast<std::uint64_t>(texels);
}

MipChain make_mip_chain(const image::Image& image, TexelKind kind, Jobs& jobs) {
    std::int32_t texels = 0;
    MipChain chain = mip_levels(image, texels);
    chain.texels = LargeArray<float>(static_cast<std::size_t>(texels) * 4);
    const auto& codes = scanout::detail::kSrgb;
    double colour[256], alpha[256];
    std::copy_n(kind == TexelKind::colour ? codes.decode : codes.linear, 256, colour);
    std::copy_n(codes.linear, 256, alpha);
    LevelAbove above{
        image.width(), image.height(), reinterpret_cast<const std::int32_t*>(image.pixels().data()),
        colour,        alpha,          nullptr};
    for (int level = 1; level <= chain.last; ++level) {
        const int width = chain.width[level];
        float* const out = chain.texels.data() + static_cast<std::size_t>(chain.begin[level]) * 4;
        jobs.for_each(chain.height[level], [&](int y, int) {
            downsample_row(above, y, width, out + std::ptrdiff_t{4} * y * width);
        });
        above = {width, chain.height[level], nullptr, nullptr, nullptr, out};
    }
    check_values(chain.texels, "texel", "the mip chain");
    return chain;
}

namespace {
std::size_t place_of(const MipUse& use) {
    return static_cast<std::size_t>(use.texture) * 2 + (use.kind == TexelKind::data ? 1 : 0);
}
} // namespace

MipUse mip_use(Map map, const scene::TextureMap& options) {
    const bool alpha = map == kOpacityMap && options.channel == 'm';
    return {options.texture, alpha ? TexelKind::colour : map_slots()[map].kind};
}

void MipChains::update(const scene::Scene& scene, std::span<const MipUse> used, Jobs& jobs) {
    if (scene.revision == 0 || scene.revision != revision_) chains_.clear();
    revision_ = scene.revision;
    kept_.clear();
    kept_.resize(used.empty() ? 0 : scene.textures.size() * 2);
    for (const MipUse& use : used) {
        const std::size_t place = place_of(use);
        if (place < chains_.size()) kept_[place] = std::move(chains_[place]);
        const image::Image& image = scene.textures[static_cast<std::size_t>(use.texture)].image;
        if (kept_[place] == nullptr)
            kept_[place] = std::make_unique<MipChain>(make_mip_chain(image, use.kind, jobs));
    }
    std::swap(chains_, kept_);
    kept_.clear();
}

const MipChain* MipChains::find(const MipUse& use) const {
    const std::size_t place = place_of(use);
    return place < chains_.size() ? chains_[place].get() : nullptr;
}

std::uint64_t MipChains::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& chain : chains_)
        if (chain != nullptr) sum += chain->texels.size() * sizeof(float);
    return sum;
}

} // namespace scanout::shade
