#include "formula/height_field.h"

#include "image/image.h"
#include "math/srgb.h"

#include <algorithm>
#include <array>

namespace scanout::formula {
namespace {

// A code of each channel at a height, and straight lines between.
struct Stop {
    double height;
    std::array<double, 3> code;
};
constexpr std::array<Stop, 6> kStops = {{{0.0, {40, 70, 120}},
                                         {0.18, {200, 190, 140}},
                                         {0.3, {80, 130, 50}},
                                         {0.55, {60, 90, 45}},
                                         {0.75, {120, 110, 100}},
                                         {1.0, {245, 245, 250}}}};

Vec3 colour_at(double height) {
    std::size_t i = 1;
    while (i + 1 < kStops.size() && height > kStops[i].height)
        ++i;
    const Stop &low = kStops[i - 1], &high = kStops[i];
    const double share = std::clamp((height - low.height) / (high.height - low.height), 0.0, 1.0);
    Vec3 colour;
    for (std::size_t c = 0; c < 3; ++c) {
        const double code = low.code[c] + share * (high.code[c] - low.code[c]);
        colour[static_cast<int>(c)] = srgb_decode(static_cast<std::uint8_t>(code + 0.5));
    }
    return colour;
}

} // namespace

double rounded(double x) {
    const auto millionths = static_cast<std::int64_t>(x * 1e6 + (x < 0 ? -0.5 : 0.5));
    return static_cast<double>(millionths) / 1e6;
}

geom::PolygonMesh surface_of(const image::Plane& heights, double height) {
    geom::PolygonMesh mesh;
    const int width = heights.width, depth = heights.height;
    const int longer = std::max({width - 1, depth - 1, 1});
    for (int z = 0; z < depth; ++z)
        for (int x = 0; x < width; ++x) {
            mesh.positions.push_back({rounded((2.0 * x - (width - 1)) / longer),
                                      rounded(height * heights.at(x, z)),
                                      rounded((2.0 * z - (depth - 1)) / longer)});
            mesh.colours.push_back(colour_at(heights.at(x, z)));
            mesh.uvs.push_back({rounded(static_cast<double>(x) / std::max(width - 1, 1)),
                                rounded(1 - static_cast<double>(z) / std::max(depth - 1, 1))});
        }
    const auto corner = [&](int x, int z) {
        mesh.corners.push_back({z * width + x, z * width + x, -1});
    };
    const auto face = [&] {
        mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
        mesh.face_material.push_back(-1);
    };
    for (int z = 0; z + 1 < depth; ++z)
        for (int x = 0; x + 1 < width; ++x) {
            face();
            corner(x, z);
            corner(x, z + 1);
            corner(x + 1, z + 1);
            face();
            corner(x, z);
            corner(x + 1, z + 1);
            corner(x + 1, z);
        }
    return mesh;
}

} // namespace scanout::formula
