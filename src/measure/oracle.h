// What an axis's own measure is compared with: the truth about single pixels, told by whoever
// shares no code with raster, shade and frame (src/trace: the program asks its rays).
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <optional>

namespace scanout::measure {

class Oracle {
public:
    virtual ~Oracle() = default;
    // The share of a pixel's box in which anything shows.
    virtual double covered(int x, int y) const = 0;
    // No edge crosses the pixel.
    virtual bool is_inside(int x, int y) const = 0;
    // The first surface in the middle of the pixel lets light through.
    virtual bool is_seen_through(int x, int y) const = 0;
    // Where the ray through the middle of a pixel meets a triangle of the mesh.
    struct Place {
        double distance = 0; // from the eye's plane
        DVec2 uv{0};
    };
    virtual std::optional<Place> on_triangle(std::uint32_t triangle, int x, int y) const = 0;
    // All lights that cast shadows reach all of the pixel, or none of them any part of it.
    virtual std::optional<bool> is_lit(int x, int y) const = 0;
};

} // namespace scanout::measure
