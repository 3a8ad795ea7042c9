#include "shade/transparency/colour_blend.h"

#include "base/check.h"
#include "shade/check_lanes.h"

#include <algorithm>

namespace scanout::shade {

void ColourBlend::begin() {
    order_.clear();
    end_.clear();
    begin_pixels(0);
}

std::uint32_t ColourBlend::add_sample(std::span<const std::uint32_t> nearest_first) {
    order_.insert(order_.end(), nearest_first.begin(), nearest_first.end());
    end_.push_back(static_cast<std::uint32_t>(order_.size()));
    return static_cast<std::uint32_t>(end_.size() - 1);
}

void ColourBlend::begin_pixels(std::size_t fragments) {
    opaque_base_.clear();
    pixels_.clear();
    for (auto& colours : colour_)
        colours.clear();
    layers_ = static_cast<std::uint32_t>(fragments);
}

void ColourBlend::add_pixel(std::uint16_t number, std::uint16_t edge_pixel, std::uint32_t slot,
                            std::span<const std::uint32_t> opaque_base) {
    pixels_.push_back({number, edge_pixel, slot, static_cast<std::uint32_t>(opaque_base_.size())});
    opaque_base_.insert(opaque_base_.end(), opaque_base.begin(), opaque_base.end());
}

void ColourBlend::set(Of of, std::uint32_t layer, const LayerColour& colour) {
    CHECK_LT(layer, layers_);
    auto& colours = colour_[static_cast<std::size_t>(of)];
    if (colours.size() < layers_) colours.resize(layers_);
    colours[layer] = colour;
}

ColourBlend::Sample ColourBlend::at(Of of, const Pixel& pixel, int sample, const Blend& blend,
                                    const BlendList& list, const Background& back) const {
    const auto& colours = colour_[static_cast<std::size_t>(of)];
    const std::uint32_t opaque_base =
        opaque_base_[pixel.opaque_base + static_cast<std::uint32_t>(sample)];
    const std::uint32_t slot = pixel.slot + static_cast<std::uint32_t>(sample);
    LayerColour colour = opaque_base == kNothing ? back.colour : colours[opaque_base];
    float transmittance = opaque_base == kNothing ? 1.0F : 0.0F;
    for (std::uint32_t i = end_[slot]; i-- > (slot == 0 ? 0 : end_[slot - 1]);) {
        const float alpha = list.fragments[order_[i]].alpha;
        if (alpha == 0) continue; // was not shaded
        const float behind_alpha = 1 - transmittance * (1 - back.alpha);
        for (std::size_t c = 0; c < 3; ++c) {
            // NaN counts as 0, as it does where light is encoded.
            const float layer = std::min(std::max(0.0F, colours[order_[i]][c]), 1.0F);
            colour[c] = blend.compose(colour[c], behind_alpha, layer, alpha);
        }
        transmittance *= 1 - alpha;
    }
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] -= back.colour[c] * transmittance;
    check_values(colour, "colour", "composing");
    return {colour, transmittance};
}

std::size_t ColourBlend::list_bytes() const {
    const auto of = [](const auto& held) { return held.size() * sizeof(decltype(*held.data())); };
    return of(order_) + of(end_);
}

std::size_t ColourBlend::bytes() const {
    const auto of = [](const auto& held) {
        return held.capacity() * sizeof(decltype(*held.data()));
    };
    return sizeof *this + of(order_) + of(end_) + of(opaque_base_) + of(pixels_) + of(colour_[0]) +
           of(colour_[1]);
}

} // namespace scanout::shade
