// What is drawn on both sides, and how much faster than llvmpipe it must be drawn here.
#pragma once

#include "base/result.h"
#include "frame/options.h"
#include "scene/scene.h"
#include "scene/view.h"

#include <span>
#include <string_view>

namespace scanout::bench {

enum class Shading { depth, blinn_phong, textured, shadowed };

// gate: what a release needs; goal: what we are here for. Times of llvmpipe with its read-back over
// ours.
struct Load {
    std::string_view name, mesh;
    Shading shading;
    int samples;
    double gate, goal;
};
std::span<const Load> loads();

inline constexpr int kShadowTexels = 1024, kShadowFilter = 2, kTextureTexels = 1024;
inline constexpr double kAmbient = 0.1;
// Camera space: the light stands still while the model turns.
inline constexpr DVec3 kTowardsLight{0.4, 0.7, 0.6};
inline constexpr float kInsideNear = 0.005F, kInsideFar = 2.5F; // radii; of GL alone

// GL clears to linear light in 8 bits: a colour whose code is exactly that of such a number. It has
// no red, of which every surface shows some by the ambient light alone, in a quarter of a pixel,
// too: whatever has another colour is covered.
extern const image::Rgba8 kBackground;

// A mesh in the load's material, with its texture.
Result<scene::Scene> scene_of(const Load& load);
bool is_inside(const Load& load);
frame::FrameOptions options_of(const Load& load, int width, int height);

// Outside, the model turns once about its axis in `count` frames; inside, the camera does.
Result<scene::View> view_of(const Load& load, const scene::Scene& scene, int frame, int count,
                            int width, int height);

} // namespace scanout::bench
