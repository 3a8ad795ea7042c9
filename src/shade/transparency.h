// Transparency techniques, and the fragments that they order. A fragment is one triangle in one
// pixel, in front of the opaque surface there.
#pragma once

#include "base/technique.h"
#include "raster/stage/geometry.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scanout::shade {

struct GatherInput;
struct Stage;

// The maps that alpha is read from. One entry a material, the default one first.
struct MaterialAlpha {
    bool diffuse_map = false; // the alpha channel of map_Kd matters
    bool opacity_map = false; // there is a map_d
    friend bool operator==(const MaterialAlpha&, const MaterialAlpha&) = default;
};

struct BlendFragment {
    std::uint32_t id;
    std::uint32_t depths; // place of the first one's depth in BlendList::depth
    std::uint16_t pixel;  // of the tile
    std::uint16_t mask;   // samples that it covers and that no opaque surface hides
    float alpha;
    float weight;          // of its colour in the pixel's colour
    std::uint16_t visible; // samples of the mask at which it is visible
};

struct BlendList {
    std::vector<BlendFragment> fragments;
    std::vector<float> depth; // of each sample in a mask, lowest first

    float depth_at(const BlendFragment& fragment, int sample) const;
};

struct Transparency {
    Technique card;
    // Sorts the triangles of a tile into the order in which the technique draws them; null where
    // the order of their ids will do.
    void (*sort_triangles)(std::span<std::uint32_t> triangles, const GatherInput& input);
    // Sorts the fragments of one pixel that cover this sample, nearest first; null where they stay
    // in the order of their triangles.
    void (*sort_sample)(std::span<std::uint32_t> fragments, const BlendList& list, int sample);
    // Each sample shows a fragment or not, by its alpha there; it never blends.
    bool cuts;
};

// When a fragment hides all behind it.
enum class Hides : std::uint8_t { never, by_alpha, always };

// How a fragment blends with the layers behind it: by weights that depend on its alpha alone
// (meet), or by its colour (compose); the other function is null.
struct Blend {
    Technique card;
    struct Weights {
        float weight;        // of the fragment's colour in the pixel's
        float transmittance; // the share of the light from behind that it lets through
    };
    // transmittance: the share that the fragments in front of it let through.
    Weights (*meet)(float alpha, float transmittance);
    // One channel of a sample with the fragment in front, premultiplied by the alpha of the result,
    // as `behind` is by the alpha behind. The fragment's colour is not premultiplied, in [0, 1]; 1
    // is white of the blend space. Alpha itself is mixed as with `over`. Alpha 0 changes nothing.
    float (*compose)(float behind, float behind_alpha, float colour, float alpha) = nullptr;
    Hides hides = Hides::never;
};

} // namespace scanout::shade
