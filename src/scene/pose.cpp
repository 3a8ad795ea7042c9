#include "scene/pose.h"

#include "math/transcendental.h"

#include <algorithm>

namespace scanout::scene {

int wrap_angle(std::int64_t units) {
    const std::int64_t wrapped = units % kFullTurn;
    return static_cast<int>(wrapped < 0 ? wrapped + kFullTurn : wrapped);
}

double zoom_scale(int level) {
    return scanout::exp2(static_cast<double>(level) / kZoomLevelsPerOctave);
}

int clamp_zoom(std::int64_t level) {
    return static_cast<int>(std::clamp<std::int64_t>(level, -kMaxZoomLevel, kMaxZoomLevel));
}

int clamp_elevation(std::int64_t units) {
    constexpr std::int64_t kQuarterTurn = kFullTurn / 4;
    return static_cast<int>(std::clamp(units, -kQuarterTurn, kQuarterTurn));
}

static std::int64_t to_pan_units(double radii) {
    constexpr double kLimit = 0x1p52; // far beyond any picture, and still a whole double
    const double units = std::clamp(radii * kPanUnitsPerRadius, -kLimit, kLimit);
    return static_cast<std::int64_t>(units + (units < 0 ? -0.5 : 0.5));
}

void zoom_towards(Pose& pose, int levels, double pointer_x, double pointer_y) {
    const int zoom = clamp_zoom(std::int64_t{pose.zoom} + levels);
    const double ratio = zoom_scale(zoom - pose.zoom);
    // pointer - pan is the vector from the model's centre to the pointer: it grows by the ratio.
    const double pan_x = static_cast<double>(pose.pan_x) / kPanUnitsPerRadius;
    const double pan_y = static_cast<double>(pose.pan_y) / kPanUnitsPerRadius;
    pose.pan_x = to_pan_units(pointer_x - (pointer_x - pan_x) * ratio);
    pose.pan_y = to_pan_units(pointer_y - (pointer_y - pan_y) * ratio);
    pose.zoom = zoom;
}

} // namespace scanout::scene
