// Koch's snowflake (Koch 1904): the middle third of every side becomes two sides of a triangle
// that stands on it.
#include "formula/height_field.h"
#include "formula/makers.h"
#include "math/transcendental.h"

#include <algorithm>

namespace scanout::formula {

std::vector<DVec2> koch_curve(int recursions) {
    std::vector<DVec2> corners;
    for (const double angle : {90.0, 210.0, 330.0})
        corners.push_back({cos_degrees(angle), sin_degrees(angle)});
    const double c = 0.5, s = -sqrt(3.0) / 2; // a turn outwards by 60 degrees
    for (int r = 0; r < recursions; ++r) {
        std::vector<DVec2> finer;
        finer.reserve(4 * corners.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const DVec2 a = corners[i], b = corners[(i + 1) % corners.size()];
            const DVec2 third = (b - a) / 3.0;
            const DVec2 turned(c * third.x - s * third.y, s * third.x + c * third.y);
            finer.insert(finer.end(), {a, a + third, a + third + turned, a + 2.0 * third});
        }
        corners = std::move(finer);
    }
    return corners;
}

geom::PolygonMesh koch_model(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    geom::PolygonMesh mesh;
    mesh.line_begin = {0};
    mesh.line_material = {-1};
    for (const DVec2& corner : koch_curve(wanted.detail)) {
        mesh.line_vertices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back({rounded(corner.x), rounded(corner.y), 0});
    }
    mesh.line_vertices.push_back(0);
    if (progress) progress(1);
    return mesh;
}

// White on black, by 16 samples a pixel: on each of four lines a pixel, whatever lies between the
// first and second crossing, the third and fourth and so on is inside.
image::Image koch_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress) {
    constexpr int kSamples = 4;
    const double scale = 0.48 * std::min(wanted.width, wanted.height) * kSamples;
    std::vector<DVec2> corners = koch_curve(wanted.detail); // in samples
    for (DVec2& p : corners)
        p = {wanted.width * kSamples / 2.0 + scale * p.x,
             wanted.height * kSamples / 2.0 - scale * p.y};
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(wanted.height) * kSamples);
    const auto first_line = [](double y) { // whose middle is not above y
        return static_cast<int>(y + 0.5);
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        DVec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        if (a.y > b.y) std::swap(a, b);
        for (int line = first_line(a.y); line < first_line(b.y); ++line)
            crossings[static_cast<std::size_t>(line)].push_back(
                a.x + (line + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    if (progress) progress(0.5);
    image::Image out(wanted.width, wanted.height);
    jobs.for_each(wanted.height, [&](int y, int /*worker*/) {
        std::vector<int> covered(static_cast<std::size_t>(wanted.width), 0);
        for (int line = y * kSamples; line < (y + 1) * kSamples; ++line) {
            std::vector<double>& at = crossings[static_cast<std::size_t>(line)];
            std::sort(at.begin(), at.end());
            for (std::size_t k = 0; k + 1 < at.size(); k += 2)
                for (int x = first_line(at[k]); x < first_line(at[k + 1]); ++x)
                    ++covered[static_cast<std::size_t>(x / kSamples)];
        }
        for (int x = 0; x < wanted.width; ++x) {
            const int count = covered[static_cast<std::size_t>(x)];
            const auto code = static_cast<std::uint8_t>(count * 255 / (kSamples * kSamples));
            out.at(x, y) = {code, code, code, 255};
        }
    });
    if (progress) progress(1);
    return out;
}

} // namespace scanout::formula
