// Pixels whose layers' colours decide what shows of that which lies behind them. No weight says it
// beforehand: all layers are shaded first, then put together at every sample, from the back.
// Every sample takes them in the order that the transparency's technique sees there, so that the
// order of the file changes no bit.
#pragma once

#include "shade/transparency.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::shade {

using LayerColour = std::array<float, 3>; // white is 1

class ColourBlend {
public:
    static constexpr std::uint32_t kNothing = 0xffffffff; // the background

    struct Pixel {
        std::uint16_t number;      // in the tile
        std::uint16_t edge_pixel;  // index in the gatherer's list of edge pixels
        std::uint32_t slot;        // place of its first sample among those that were added
        std::uint32_t opaque_base; // place of what is opaque at its first sample
    };
    // What a sample shows, less what the background adds to it; and the transmittance.
    struct Sample {
        LayerColour colour;
        float transmittance;
    };
    struct Background {
        LayerColour colour; // times its alpha
        float alpha;
    };
    // Of one layer twice: in the blend space, and linear where somebody wants that.
    enum class Of : std::uint8_t { blend_space, linear };

    // A part of a tile.
    void begin();
    // The fragments of the next sample, nearest first; returns its place.
    std::uint32_t add_sample(std::span<const std::uint32_t> nearest_first);
    // All samples have been added. Fragments are the first layers, by their place in the list.
    void begin_pixels(std::size_t fragments);
    // TransparencyPass of the samples of a pixel that are opaque; kNothing where none is.
    void add_pixel(std::uint16_t number, std::uint16_t edge_pixel, std::uint32_t slot,
                   std::span<const std::uint32_t> opaque_base);
    std::uint32_t add_opaque_layer() { return layers_++; }

    // What lies outside of [0, 1] is cut off where a layer lies before another.
    void set(Of of, std::uint32_t layer, const LayerColour& colour);
    std::span<const Pixel> pixels() const { return pixels_; }
    Sample at(Of of, const Pixel& pixel, int sample, const Blend& blend, const BlendList& list,
              const Background& background) const;

    std::size_t list_bytes() const; // of what the lists of this part hold
    std::size_t bytes() const;      // held

private:
    std::vector<std::uint32_t> order_, end_; // fragments of all samples; where a sample's end
    std::vector<std::uint32_t> opaque_base_;
    std::vector<Pixel> pixels_;
    std::array<std::vector<LayerColour>, 2> colour_; // Of
    std::uint32_t layers_ = 0;
};

} // namespace scanout::shade
