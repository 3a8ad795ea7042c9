// Black and white: the zone plate and the checker board, as pictures and as models that carry their
// colours at their vertices.
#include "formula/height_field.h"
#include "formula/makers.h"
#include "math/srgb.h"
#include "math/transcendental.h"

#include <algorithm>

namespace scanout::formula {
namespace {

image::Rgba8 grey(std::uint8_t code) {
    return {code, code, code, 255};
}

// A face with corners of its own, white or black.
void add_face(geom::PolygonMesh& mesh, std::initializer_list<DVec3> corners, bool white) {
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.face_material.push_back(-1);
    for (const DVec3& corner : corners) {
        mesh.corners.push_back({static_cast<std::int32_t>(mesh.positions.size()), -1, -1});
        mesh.positions.push_back(corner);
        mesh.colours.push_back(Vec3(white ? 1.0F : 0.0F));
    }
}

} // namespace

// The phase is half a turn for each ring, all of them within the shorter side.
image::Image zone_plate_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress) {
    image::Image out(wanted.width, wanted.height);
    const double radius = std::min(wanted.width, wanted.height) / 2.0;
    jobs.for_each(wanted.height, [&](int y, int /*worker*/) {
        for (int x = 0; x < wanted.width; ++x) {
            const double dx = x + 0.5 - wanted.width / 2.0, dy = y + 0.5 - wanted.height / 2.0;
            const double rings = wanted.detail * (dx * dx + dy * dy) / (radius * radius);
            const double light = 0.5 + 0.5 * cos_degrees(180 * rings);
            out.at(x, y) = grey(srgb_encode(static_cast<float>(light)));
        }
    });
    if (progress) progress(1);
    return out;
}

// Rings of equal area around the origin, radius 1, seen from +z; white in the middle.
geom::PolygonMesh zone_plate_model(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    constexpr int kSegments = 256;
    geom::PolygonMesh mesh;
    const auto on_circle = [](double radius, int segment) {
        const double angle = 360.0 * segment / kSegments;
        return DVec3(rounded(radius * cos_degrees(angle)), rounded(radius * sin_degrees(angle)), 0);
    };
    for (int ring = 0; ring < wanted.detail; ++ring) {
        const double inner = sqrt(static_cast<double>(ring) / wanted.detail);
        const double outer = sqrt((ring + 1.0) / wanted.detail);
        // The two circles of a ring, shared by its faces.
        const auto first = static_cast<std::int32_t>(mesh.positions.size());
        for (int s = 0; s < kSegments; ++s)
            for (const double radius : {inner, outer}) {
                mesh.positions.push_back(on_circle(radius, s));
                mesh.colours.push_back(Vec3(ring % 2 == 0 ? 1.0F : 0.0F));
            }
        for (int s = 0; s < kSegments; ++s) {
            const std::int32_t here = first + 2 * s, next = first + 2 * ((s + 1) % kSegments);
            mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
            mesh.face_material.push_back(-1);
            if (ring > 0) mesh.corners.push_back({here, -1, -1});
            for (const std::int32_t corner : {here + 1, next + 1, next})
                mesh.corners.push_back({corner, -1, -1});
        }
        if (progress) progress((ring + 1.0) / wanted.detail);
    }
    return mesh;
}

image::Image checker_picture(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    image::Image out(wanted.width, wanted.height);
    const auto square = [&](int pixel, int pixels) {
        return std::int64_t{pixel} * wanted.detail / pixels;
    };
    for (int y = 0; y < wanted.height; ++y)
        for (int x = 0; x < wanted.width; ++x)
            out.at(x, y) =
                grey((square(x, wanted.width) + square(y, wanted.height)) % 2 == 0 ? 255 : 0);
    if (progress) progress(1);
    return out;
}

geom::PolygonMesh checker_model(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    geom::PolygonMesh mesh;
    const int n = wanted.detail;
    for (int row = 0; row < n; ++row) {
        for (int column = 0; column < n; ++column) {
            const double left = column - n / 2, near = -row;
            add_face(mesh,
                     {{left, 0, near},
                      {left + 1, 0, near},
                      {left + 1, 0, near - 1},
                      {left, 0, near - 1}},
                     (row + column) % 2 == 0);
        }
        if (progress) progress((row + 1.0) / n);
    }
    return mesh;
}

} // namespace scanout::formula
