// The gatherer's part in pixels whose layers' colours decide what shows of that which lies behind:
// each layer is shaded once, as a fragment with a place of its own in place of a weight.
#include "shade/gather_types.h"
#include "shade/layers.h"

#include <bit>

namespace scanout::shade {

using raster::kTileSize;

void Gatherer::collect_composed(const raster::VisibilityTile& tile, const GatherInput& in,
                                const BlendedPixels& blended, int x, int y) {
    ComposedLayers& layers = *blended.composed;
    const std::uint16_t pixel = pixel_number(x, y);
    const auto edge_pixel = static_cast<std::uint16_t>(edge_pixels_.size());
    const auto add = [&](std::uint32_t id, unsigned mask, std::uint32_t layer) {
        const int first = std::countr_zero(mask);
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(first)];
        fragments_.push_back({id, in.looks.of(id), pixel, static_cast<std::uint8_t>(first), 0,
                              edge_pixel, 0, static_cast<std::uint16_t>(mask), byte_of(at.x),
                              byte_of(at.y), layer});
    };
    std::array<std::uint32_t, 16> ground{};
    const int samples = tile.samples();
    for (int s = 0; s < samples; ++s) {
        const std::uint32_t id = tile.id(x, y, s);
        unsigned mask = 0;
        for (int other = 0; other < samples; ++other)
            mask |= static_cast<unsigned>(tile.id(x, y, other) == id) << other;
        const auto first = static_cast<std::size_t>(std::countr_zero(mask));
        std::uint32_t& layer = ground[static_cast<std::size_t>(s)];
        if (id == raster::kNoPrimitive)
            layer = ComposedLayers::kNothing;
        else if (first < static_cast<std::size_t>(s))
            layer = ground[first];
        else
            add(id, mask, layer = layers.add_opaque_layer());
    }
    for (const std::uint32_t i : blended.fragments(pixel)) {
        const BlendFragment& f = blended.list.fragments[i];
        if (f.shown != 0) add(f.id, f.shown, i);
    }
    edge_pixels_.push_back(pixel);
    through_.push_back(0); // known when all is shaded
    layers.add_pixel(pixel, edge_pixel, blended.slot[pixel],
                     std::span(ground).first(static_cast<std::size_t>(samples)));
}

void Gatherer::keep_layers(ComposedLayers::Of of, float white) {
    const Block& b = *block_;
    for (int lane = interior_count_; lane < b.count; ++lane) {
        const std::uint32_t layer = contributions_[static_cast<std::size_t>(lane)].layer;
        if (layer == kNoLayer) continue;
        LayerColour colour;
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] = b.colour[c][lane] / white;
        b.blended->composed->set(of, layer, colour);
    }
}

// When all layers are shaded.
void Gatherer::put_composed(const GatherInput& in) {
    for (const ComposedLayers::Pixel& pixel : block_->blended->composed->pixels()) {
        put_composed(pixel, ComposedLayers::Of::mixture, in);
        if (in.linear != nullptr) put_composed(pixel, ComposedLayers::Of::linear, in);
    }
}

void Gatherer::put_composed(const ComposedLayers::Pixel& pixel, ComposedLayers::Of of,
                            const GatherInput& in) {
    const bool mixture = of == ComposedLayers::Of::mixture;
    const float white = mixture ? in.output.blend_space->white : 1;
    const Encoding& encoding = mixture ? in.output.of_mixture() : *in.output.encoding;
    ComposedLayers::Background back{{}, static_cast<float>(in.background.a) / 255};
    const std::uint8_t code[] = {in.background.r, in.background.g, in.background.b};
    for (std::size_t c = 0; c < 3; ++c)
        back.colour[c] = encoding.decode(code[c]) / white * back.alpha;

    const int x = area_.x0 + pixel.number % kTileSize, y = area_.y0 + pixel.number / kTileSize;
    const float each = 1.0F / static_cast<float>(samples_);
    const auto add = [white](std::array<float, 4>& to, const ComposedLayers::Sample& sample,
                             float share) {
        for (std::size_t c = 0; c < 3; ++c)
            to[c] += sample.colour[c] * white * share;
        to[3] += (1 - sample.through) * share;
    };
    std::array<float, 4> mean{};
    for (int s = 0; s < samples_; ++s) {
        const BlendedPixels& blended = *block_->blended;
        const ComposedLayers::Sample sample =
            blended.composed->at(of, pixel, s, *in.layers->blend, blended.list, back);
        add(mean, sample, each);
        if (mixture && sink_.filter != nullptr)
            for (std::size_t cell = 0; cell < kCells; ++cell)
                add(parts_[pixel.edge_pixel][cell], sample, sink_.filter->share(cell, 1U << s));
    }
    if (!mixture || (sink_.own != nullptr && sink_.filter == nullptr)) {
        std::array<float, 4>& sum = mixture ? sink_.own->at(x, y) : in.linear->at(x, y);
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += mean[c];
    } else if (sink_.filter == nullptr) {
        sums_.red[pixel.edge_pixel] = mean[0];
        sums_.green[pixel.edge_pixel] = mean[1];
        sums_.blue[pixel.edge_pixel] = mean[2];
        through_[pixel.edge_pixel] = 1 - mean[3];
    }
}

} // namespace scanout::shade
