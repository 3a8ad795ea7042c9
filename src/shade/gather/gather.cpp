#include "shade/gather/gather.h"

#include "shade/transparency/transparency_pass.h"

#include <array>

namespace scanout::shade {

// What the samples of a pixel show whose layers' colours decide; all layers are shaded.
static std::span<const CoveredLight> layer_samples(const ColourBlend::Pixel& pixel,
                                                   ColourBlend::Of of, const GatherInput& in,
                                                   const BlendedPixels& blended,
                                                   std::array<CoveredLight, 16>& out) {
    const bool in_blend_space = of == ColourBlend::Of::blend_space;
    const float white = in_blend_space ? in.output.blend_space->white : 1;
    const Encoding& encoding = in_blend_space ? in.output.sum_encoding() : *in.output.encoding;
    ColourBlend::Background back{{}, static_cast<float>(in.background.a) / 255};
    const std::uint8_t code[] = {in.background.r, in.background.g, in.background.b};
    for (std::size_t c = 0; c < 3; ++c)
        back.colour[c] = encoding.decode(code[c]) / white * back.alpha;
    const auto count = static_cast<std::size_t>(blended.samples);
    for (std::size_t s = 0; s < count; ++s) {
        const ColourBlend::Sample sample = blended.colour_blend->at(
            of, pixel, static_cast<int>(s), *in.transparency->blend, blended.list, back);
        out[s] = {sample.colour[0] * white, sample.colour[1] * white, sample.colour[2] * white,
                  1 - sample.transmittance};
    }
    return std::span(out).first(count);
}

static void store_layers(const GatherInput& in, const BlendedPixels& blended,
                         const PixelSink::Tile& tile, PixelSink& sink) {
    std::array<CoveredLight, 16> samples;
    for (const ColourBlend::Pixel& pixel : blended.colour_blend->pixels()) {
        sink.store_layers(tile, pixel,
                          layer_samples(pixel, ColourBlend::Of::blend_space, in, blended, samples));
        if (in.linear != nullptr)
            add_mean(in.linear->at(tile.area.x0 + column_of(pixel.number),
                                   tile.area.y0 + row_of(pixel.number)),
                     layer_samples(pixel, ColourBlend::Of::linear, in, blended, samples));
    }
}

std::uint64_t Gatherer::shade_collected(const GatherInput& in,
                                        const raster::VisibilityTile* visible,
                                        const BlendedPixels* blended, PixelSink& sink) {
    const PixelSink::Tile tile{collector_.area(), collector_.samples(), in.output, in.background,
                               collector_.edge_pixels()};
    sink.begin(tile);
    const std::uint64_t items = builder_.shade(in, collector_, visible, blended, tile, sink);
    if (blended != nullptr && blended->colour_blend != nullptr)
        store_layers(in, *blended, tile, sink);
    sink.end(tile);
    return items;
}

std::uint64_t Gatherer::shade(const raster::VisibilityTile& tile, const GatherInput& in,
                              PixelSink& sink, const BlendedPixels* blended) {
    collector_.collect(tile, in, blended, sink.wants_samples());
    return shade_collected(in, &tile, blended, sink);
}

std::uint64_t Gatherer::shade(raster::AreaTile& tile, const GatherInput& in, PixelSink& sink) {
    collector_.collect(tile, in);
    return shade_collected(in, nullptr, nullptr, sink);
}

} // namespace scanout::shade
