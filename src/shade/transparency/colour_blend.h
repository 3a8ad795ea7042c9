// Pixels that blend by colour: a layer's colour decides how much of the layers behind shows
// through, so no weight is known beforehand. All layers are shaded first, then combined at every
// sample from the back. Every sample uses the order that the transparency technique finds there, so
// that the order of the file changes no bit.
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
        std::uint32_t slot;        // place of its first sample among the added samples
        std::uint32_t opaque_base; // place of its first sample's opaque layer
    };
    // The colour of a sample without the background's share, and the transmittance.
    struct Sample {
        LayerColour colour;
        float transmittance;
    };
    struct Background {
        LayerColour colour; // times its alpha
        float alpha;
    };
    // Two colours of each layer: in the blend space, and linear, if asked for.
    enum class Of : std::uint8_t { blend_space, linear };

    // Begins a part of a tile.
    void begin();
    // Adds the fragments of the next sample, nearest first; returns its place.
    std::uint32_t add_sample(std::span<const std::uint32_t> nearest_first);
    // Call when all samples are added. Fragments are the first layers, by their place in the list.
    void begin_pixels(std::size_t fragments);
    // opaque_base: the opaque layer of each of the pixel's samples; kNothing where there is none.
    void add_pixel(std::uint16_t number, std::uint16_t edge_pixel, std::uint32_t slot,
                   std::span<const std::uint32_t> opaque_base);
    std::uint32_t add_opaque_layer() { return layers_++; }

    // Colours outside of [0, 1] are clamped where one layer lies in front of another.
    void set(Of of, std::uint32_t layer, const LayerColour& colour);
    std::span<const Pixel> pixels() const { return pixels_; }
    Sample at(Of of, const Pixel& pixel, int sample, const Blend& blend, const BlendList& list,
              const Background& background) const;

    std::size_t list_bytes() const; // the contents of this part's lists
    std::size_t bytes() const;      // held

private:
    std::vector<std::uint32_t> order_, end_; // fragments of all samples; where a sample's end
    std::vector<std::uint32_t> opaque_base_;
    std::vector<Pixel> pixels_;
    std::array<std::vector<LayerColour>, 2> colour_; // Of
    std::uint32_t layers_ = 0;
};

} // namespace scanout::shade
