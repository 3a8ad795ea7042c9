// What is not opaque: techniques for it, and the fragments that they order. A fragment is one
// triangle in one pixel, in front of what is opaque there.
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

// How alpha is found: of each material, the default one first.
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
    float weight;          // of its colour in the pixel
    std::uint16_t visible; // samples of the mask that show it
};

struct BlendList {
    std::vector<BlendFragment> fragments;
    std::vector<float> depth; // of each sample in a mask, lowest first

    float depth_at(const BlendFragment& fragment, int sample) const;
};

struct Transparency {
    Technique card;
    // Puts the triangles of a tile into the order in which the technique wants them drawn; null
    // where their order, by id, will do.
    void (*sort_triangles)(std::span<std::uint32_t> triangles, const GatherInput& input);
    // Puts fragments of one pixel that cover this sample into the order seen there, nearest first;
    // null where they are left in the order of their triangles.
    void (*sort_sample)(std::span<std::uint32_t> fragments, const BlendList& list, int sample);
    // Fragments are shown whole or not at all, by their alpha at every sample: never blended.
    bool cuts;
};

// When a fragment hides what lies behind it.
enum class Hides : std::uint8_t { never, by_alpha, always };

// How a fragment meets what lies behind it: by weights that its alpha alone decides (meet), or by
// its colour (compose); the other is null.
struct Blend {
    Technique card;
    struct Weights {
        float weight;        // of the fragment's colour in the pixel's
        float transmittance; // what it leaves of that which lies behind
    };
    // transmittance: what the fragments before it left.
    Weights (*meet)(float alpha, float transmittance);
    // One channel of a sample with the fragment in front: times the alpha there is then, as
    // `behind` is times that of what lies behind. The fragment's colour is undiluted, in [0, 1];
    // 1 is white of the blend space. Alpha itself goes as with `over`. Alpha 0 changes nothing.
    float (*compose)(float behind, float behind_alpha, float colour, float alpha) = nullptr;
    Hides hides = Hides::never;
};

} // namespace scanout::shade
