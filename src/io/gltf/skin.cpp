#include "io/gltf/skin.h"

#include <fmt/format.h>

namespace scanout::io::gltf {

Result<const Palette*> Skins::palette(Index skin) {
    auto known = made_.find(skin);
    if (known == made_.end()) known = made_.emplace(skin, make(skin)).first;
    if (!known->second) return tl::unexpected<Error>(known->second.error());
    return &*known->second;
}

Result<Palette> Skins::make(Index index) {
    const Skin& skin = document_.skins[static_cast<std::size_t>(index)];
    if (!skin.fault.empty())
        return fail(Exit::unreadable, "{}: skins[{}].{}", path_, index, skin.fault);
    Palette palette;
    for (const Index joint : skin.joints)
        palette.push_back(world_[static_cast<std::size_t>(joint)]);
    if (skin.inverse_bind < 0) return palette; // all are the identity
    TRY(View view, accessors_.view(skin.inverse_bind));
    const Accessor& a = document_.accessors[static_cast<std::size_t>(skin.inverse_bind)];
    if (a.rows != 4 || a.columns != 4 || a.component != Component::f32 ||
        view.count < palette.size())
        return fail(Exit::unreadable,
                    "{}: skins[{}]: accessors[{}] gives no matrix of 4 x 4 floats for each of {} "
                    "joints",
                    path_, index, skin.inverse_bind, palette.size());
    for (std::size_t i = 0; i < palette.size(); ++i) {
        std::array<float, 16> m;
        std::memcpy(m.data(), view.data + i * view.stride, sizeof m);
        DMat4 bind;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                bind[c][r] = double{m[static_cast<std::size_t>(4 * c + r)]};
        palette[i] = palette[i] * bind;
    }
    return palette;
}

VertexSkin::VertexSkin(const std::vector<Influences>& sets, const Palette& palette)
    : palette_(palette), sets_(sets.size()) {
    shares_.resize(sets.empty() ? 0 : sets.front().joints.count * sets_);
    for (std::size_t s = 0; s < sets_; ++s) {
        for_elements<4>(sets[s].joints, [&](std::uint64_t i, const auto* joint) {
            for (std::size_t k = 0; k < 4; ++k) {
                const bool there = joint[k] >= 0 && joint[k] < static_cast<double>(palette_.size());
                shares_[i * sets_ + s].joint[k] =
                    there ? static_cast<std::uint32_t>(joint[k]) : ~std::uint32_t{0};
            }
        });
        for_elements<4>(sets[s].weights, [&](std::uint64_t i, const auto* weight) {
            for (std::size_t k = 0; k < 4; ++k)
                shares_[i * sets_ + s].weight[k] = static_cast<float>(weight[k]);
        });
    }
}

std::optional<DMat4> VertexSkin::at(std::uint64_t vertex) const {
    DMat4 sum(0);
    double weights = 0;
    for (std::size_t s = 0; s < sets_; ++s)
        for (std::size_t k = 0; k < 4; ++k) {
            const Share& share = shares_[vertex * sets_ + s];
            const double weight = double{share.weight[k]};
            if (!(weight > 0) || share.joint[k] >= palette_.size()) continue;
            sum = sum + palette_[share.joint[k]] * weight;
            weights += weight;
        }
    if (!(weights > 0)) return std::nullopt;
    return sum * (1 / weights); // files round their weights
}

} // namespace scanout::io::gltf
