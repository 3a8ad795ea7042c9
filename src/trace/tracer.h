// The light of a pixel of the reference, by stratified samples. A pixel can be left between two
// samples and gone on with later: its bits do not depend on when.
#pragma once

#include "image/image.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "trace/display.h"
#include "trace/lights.h"
#include "trace/look.h"
#include "trace/noise.h"
#include "trace/occlusion_rays.h"
#include "trace/shadow_rays.h"
#include "trace/world.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>

namespace scanout::trace {

// What one ray sees: light, and how much of the background shows beside it.
struct Sample {
    DVec3 light{0};
    double transmittance = 1;
    DVec3 in_doubt{0}; // of one point among those that ask for a light which is seen in part
};

// Sums of samples, weighted by the filter.
struct SampleSum {
    DVec3 light{0};
    double transmittance = 0, weight = 0;
    void add(const Sample& s, double w) {
        light = light + s.light * w;
        transmittance += s.transmittance * w;
        weight += w;
    }
    void add(const SampleSum& other) {
        light = light + other.light;
        transmittance += other.transmittance;
        weight += other.weight;
    }
};

// A pixel on its way: its samples so far, in parts (noise.h).
struct PixelSamples {
    int x = 0, y = 0;
    std::uint32_t taken = 0, wanted = 0; // samples, before the error is looked at
    std::uint32_t halved = 0; // of them in the first half of the parts; 0: the parts are equal
    std::array<SampleSum, kParts> parts{};
    DVec3 low{INFINITY}, high{-INFINITY}, in_doubt{0}; // of the samples; the most of any
    double error = INFINITY;                           // of their mean: its bound, codes
    Scatter scatter;                                   // of one channel, squares of codes
};

struct TracedPixel {
    DVec3 light;
    image::Rgba8 code;
    double error; // codes
    Scatter scatter;
    std::uint32_t samples;
    double contrast; // of what its samples saw, codes
};

class Tracer {
public:
    using Time = std::chrono::steady_clock::time_point;

    // The world and the look outlive it. seed: as Effort's.
    Tracer(const World& world, const Look& look, PlacedLights lights, Tone tone, int seed = 0);

    // Takes samples, from `fewest` on twice as many each time, until the bound of the pixel's error
    // is below kErrorWanted or there are `most`. True when it is; false where `until` comes before.
    bool advance(PixelSamples& pixel, std::uint32_t most, Time until) const;
    // Of a pixel for which advance() was true.
    TracedPixel pixel(const PixelSamples& done) const;

private:
    struct Mean {
        DVec3 light;
        double alpha; // 0 to 1
    };
    Mean mean(const SampleSum& sum) const;
    void take(PixelSamples& pixel) const;
    Sample trace(const Ray& ray, std::uint32_t index, std::uint32_t seed) const;
    Sample shown(const Hit& hit, const Ray& ray, std::uint32_t index, std::uint32_t seed) const;
    double lit_share(const PlacedLight& light, int number, const Ground& ground,
                     std::uint32_t triangle, std::uint32_t index, std::uint32_t seed) const;
    void estimate_error(PixelSamples& pixel) const;

    const World& world_;
    ShadowRays shadows_;
    OcclusionRays occlusion_;
    const Look& look_;
    PlacedLights lights_;
    Tone tone_;
    int seed_;
    DVec3 background_;
};

} // namespace scanout::trace
