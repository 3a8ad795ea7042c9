// The gatherer's part for pixels that blend by colour, not by weight: each layer is shaded once, as
// a fragment with a place of its own instead of a weight.
#include "shade/gather/gather_types.h"
#include "shade/transparency/transparency_pass.h"

#include <bit>

namespace scanout::shade {

using raster::kTileSize;

void Gatherer::collect_layers(const raster::VisibilityTile& tile, const GatherInput& in,
                              const BlendedPixels& blended, int x, int y) {
    ColourBlend& layers = *blended.colour_blend;
    const std::uint16_t pixel = pixel_number(x, y);
    const auto edge_pixel = static_cast<std::uint16_t>(edge_pixels_.size());
    const auto add = [&](std::uint32_t id, unsigned mask, std::uint32_t layer) {
        const int first = std::countr_zero(mask);
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(first)];
        fragments_.push_back({id, in.keys.of(id), pixel, static_cast<std::uint8_t>(first), 0,
                              edge_pixel, 0, static_cast<std::uint16_t>(mask), byte_of(at.x),
                              byte_of(at.y), layer});
    };
    std::array<std::uint32_t, 16> opaque_base{};
    const int samples = tile.samples();
    for (int s = 0; s < samples; ++s) {
        const std::uint32_t id = tile.id(x, y, s);
        unsigned mask = 0;
        for (int other = 0; other < samples; ++other)
            mask |= static_cast<unsigned>(tile.id(x, y, other) == id) << other;
        const auto first = static_cast<std::size_t>(std::countr_zero(mask));
        std::uint32_t& layer = opaque_base[static_cast<std::size_t>(s)];
        if (id == raster::kNoPrimitive)
            layer = ColourBlend::kNothing;
        else if (first < static_cast<std::size_t>(s))
            layer = opaque_base[first];
        else
            add(id, mask, layer = layers.add_opaque_layer());
    }
    for (const std::uint32_t i : blended.fragments(pixel)) {
        const BlendFragment& f = blended.list.fragments[i];
        if (f.visible != 0) add(f.id, f.visible, i);
    }
    edge_pixels_.push_back(pixel);
    transmittance_.push_back(0); // known once all layers are shaded
    layers.add_pixel(pixel, edge_pixel, blended.slot[pixel],
                     std::span(opaque_base).first(static_cast<std::size_t>(samples)));
}

void Gatherer::keep_layer_colours(ColourBlend::Of of, float white) {
    const ShadingBlock& b = *block_;
    for (int item = interior_count_; item < b.count; ++item) {
        const std::uint32_t layer = contributions_[static_cast<std::size_t>(item)].layer;
        if (layer == kNoLayer) continue;
        LayerColour colour;
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] = b.colour[c][item] / white;
        b.blended->colour_blend->set(of, layer, colour);
    }
}

// Runs when all layers are shaded.
void Gatherer::blend_layers(const GatherInput& in) {
    for (const ColourBlend::Pixel& pixel : block_->blended->colour_blend->pixels()) {
        blend_layers(pixel, ColourBlend::Of::blend_space, in);
        if (in.linear != nullptr) blend_layers(pixel, ColourBlend::Of::linear, in);
    }
}

void Gatherer::blend_layers(const ColourBlend::Pixel& pixel, ColourBlend::Of of,
                            const GatherInput& in) {
    const bool in_blend_space = of == ColourBlend::Of::blend_space;
    const float white = in_blend_space ? in.output.blend_space->white : 1;
    const Encoding& encoding = in_blend_space ? in.output.sum_encoding() : *in.output.encoding;
    ColourBlend::Background back{{}, static_cast<float>(in.background.a) / 255};
    const std::uint8_t code[] = {in.background.r, in.background.g, in.background.b};
    for (std::size_t c = 0; c < 3; ++c)
        back.colour[c] = encoding.decode(code[c]) / white * back.alpha;

    const int x = area_.x0 + pixel.number % kTileSize, y = area_.y0 + pixel.number / kTileSize;
    const float each = 1.0F / static_cast<float>(samples_);
    const auto add = [white](std::array<float, 4>& to, const ColourBlend::Sample& sample,
                             float weight) {
        for (std::size_t c = 0; c < 3; ++c)
            to[c] += sample.colour[c] * white * weight;
        to[3] += (1 - sample.transmittance) * weight;
    };
    std::array<float, 4> mean{};
    for (int s = 0; s < samples_; ++s) {
        const BlendedPixels& blended = *block_->blended;
        const ColourBlend::Sample sample =
            blended.colour_blend->at(of, pixel, s, *in.transparency->blend, blended.list, back);
        add(mean, sample, each);
        if (in_blend_space && sink_.filter != nullptr)
            for (std::size_t cell = 0; cell < kCells; ++cell)
                add(splats_[pixel.edge_pixel][cell], sample, sink_.filter->weight(cell, 1U << s));
    }
    if (!in_blend_space || (sink_.own != nullptr && sink_.filter == nullptr)) {
        std::array<float, 4>& sum = in_blend_space ? sink_.own->at(x, y) : in.linear->at(x, y);
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += mean[c];
    } else if (sink_.filter == nullptr) {
        sums_.red[pixel.edge_pixel] = mean[0];
        sums_.green[pixel.edge_pixel] = mean[1];
        sums_.blue[pixel.edge_pixel] = mean[2];
        transmittance_[pixel.edge_pixel] = 1 - mean[3];
    }
}

} // namespace scanout::shade
