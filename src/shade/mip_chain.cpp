#include "shade/mip_chain.h"

#include "base/check.h"
#include "math/srgb.h"
#include "shade/check_lanes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace scanout::shade {
namespace {

// The texels of a line that one of half as many covers, and their shares. Of an odd number 2m + 1
// each of the m covers 2 + 1/m: the middle ones' shares shift from the first to the third (Guthe
// and Heckbert, "Non-power-of-two mipmapping", 2005). Shares add up to 1, and over the line every
// texel counts alike.
struct Shares {
    int first = 0, count = 0;
    double share[3] = {};
};

Shares shares_of(int i, int size) {
    if (size == 1) return {0, 1, {1}};
    if (size % 2 == 0) return {2 * i, 2, {0.5, 0.5}};
    const double m = size / 2, whole = size;
    return {2 * i, 3, {(m - i) / whole, m / whole, (i + 1) / whole}};
}

using Rgba = std::array<double, 4>;

// texel(x, y): of the level above. The sums are in double, so the mean of equal floats is that
// float.
template <class TexelAt>
void shrink_row(TexelAt texel, int width, const Shares& down, std::span<float> row) {
    for (std::size_t i = 0; i < row.size() / 4; ++i) {
        const Shares across = shares_of(static_cast<int>(i), width);
        Rgba sum{};
        for (int k = 0; k < down.count; ++k) {
            Rgba line{};
            for (int l = 0; l < across.count; ++l) {
                const Rgba t = texel(across.first + l, down.first + k);
                for (std::size_t c = 0; c < 4; ++c)
                    line[c] += across.share[l] * t[c];
            }
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += down.share[k] * line[c];
        }
        for (std::size_t c = 0; c < 4; ++c)
            row[4 * i + c] = static_cast<float>(sum[c]);
    }
}

} // namespace

// The levels' sizes and places; no texels.
static MipChain mip_levels(const image::Image& image, std::int32_t& texels) {
    MipChain chain;
    chain.width[0] = image.width();
    chain.height[0] = image.height();
    chain.begin[0] = texels = 0;
    while (chain.width[chain.last] > 1 || chain.height[chain.last] > 1) {
        const int above = chain.last++;
        CHECK(chain.last < MipChain::kMostLevels);
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
    chain.texels.resize(static_cast<std::size_t>(texels) * 4);
    const float* decode =
        kind == TexelKind::colour ? scanout::detail::kSrgb.decode : scanout::detail::kSrgb.linear;
    for (int level = 1; level <= chain.last; ++level) {
        const int width = chain.width[level - 1];
        const auto row_floats = static_cast<std::size_t>(chain.width[level]) * 4;
        float* const out = chain.texels.data() + static_cast<std::size_t>(chain.begin[level]) * 4;
        const float* const above =
            chain.texels.data() + static_cast<std::size_t>(chain.begin[level - 1]) * 4;
        jobs.for_each(chain.height[level], [&](int y, int) {
            const Shares down = shares_of(y, chain.height[level - 1]);
            const std::span<float> row(out + static_cast<std::size_t>(y) * row_floats, row_floats);
            if (level == 1) {
                const auto texel = [&](int tx, int ty) -> Rgba {
                    const image::Rgba8& p = image.at(tx, ty);
                    return {decode[p.r], decode[p.g], decode[p.b],
                            scanout::detail::kSrgb.linear[p.a]};
                };
                shrink_row(texel, width, down, row);
            } else {
                const auto texel = [&](int tx, int ty) -> Rgba {
                    const float* p =
                        above + (static_cast<std::size_t>(ty) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(tx)) *
                                    4;
                    return {p[0], p[1], p[2], p[3]};
                };
                shrink_row(texel, width, down, row);
            }
        });
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
