#include "app/frontier/measurement.h"

#include "app/overlay/text.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr double kDegreesARadian = 180 / 3.14159265358979323846;

double distance_of(const DVec3& v) {
    return std::sqrt(dot3(v, v));
}

// The picture's part of a line between two places in view space; pixels. Nothing where there is
// none.
class PictureLine {
public:
    PictureLine(const scene::View& view, int width, int height)
        : view_(view), width_(width), height_(height) {}

    std::optional<std::pair<DVec2, DVec2>> between(DVec3 a, DVec3 b) const {
        if (view_.projection == scene::Projection::perspective) {
            const double near = -view_.target_distance * 0x1p-14;
            if (a.z > near && b.z > near) return std::nullopt;
            if (a.z > near) a = a + (b - a) * ((near - a.z) / (b.z - a.z));
            if (b.z > near) b = b + (a - b) * ((near - b.z) / (a.z - b.z));
        }
        const DVec2 from = scene::picture_point(view_, a, width_, height_),
                    to = scene::picture_point(view_, b, width_, height_), along = to - from;
        double first = 0, last = 1; // Liang and Barsky 1984
        for (const auto& [step, room] :
             {std::pair(-along.x, from.x), std::pair(along.x, width_ - from.x),
              std::pair(-along.y, from.y), std::pair(along.y, height_ - from.y)}) {
            if (step == 0 && room < 0) return std::nullopt;
            if (step < 0) first = std::max(first, room / step);
            if (step > 0) last = std::min(last, room / step);
        }
        if (!(first <= last)) return std::nullopt;
        return std::pair(from + along * first, from + along * last);
    }

private:
    const scene::View& view_;
    int width_, height_;
};

PixelPlace place_of(const DVec2& pixel) {
    return {static_cast<int>(std::floor(pixel.x)), static_cast<int>(std::floor(pixel.y))};
}

std::string step_text(const DVec3& step, double distance) {
    return fmt::format("{:.6g}  dx {:.6g}  dy {:.6g}  dz {:.6g}", distance, step.x, step.y, step.z);
}

} // namespace

Measured measure_points(std::span<const DVec3> points) {
    Measured found;
    for (std::size_t i = 1; i < points.size(); ++i) {
        found.steps.push_back(points[i] - points[i - 1]);
        found.distances.push_back(distance_of(found.steps.back()));
    }
    if (found.steps.size() < 2) return found;
    const DVec3 back = DVec3(0) - found.steps[0];
    const double across = distance_of(cross3(back, found.steps[1]));
    const double along = dot3(back, found.steps[1]);
    found.angle = across == 0 && along == 0 ? 0 : scanout::atan2(across, along) * kDegreesARadian;
    return found;
}

std::vector<std::string> measured_text(std::span<const DVec3> points) {
    const Measured found = measure_points(points);
    if (found.steps.size() == 1)
        return {"distance " + step_text(found.steps[0], found.distances[0])};
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < found.steps.size(); ++i)
        lines.push_back(fmt::format("distance {} to {}: {}", i + 1, i + 2,
                                    step_text(found.steps[i], found.distances[i])));
    if (found.angle) lines.push_back(fmt::format("angle at 2: {:.6g} degrees", *found.angle));
    return lines;
}

MeasuredMarks measured_marks(std::span<const DVec3> points, const scene::View& view,
                             const geom::Mesh& mesh, int width, int height) {
    MeasuredMarks marks;
    const PictureLine line(view, width, height);
    std::vector<DVec3> seen; // view space
    for (const DVec3& p : points)
        seen.push_back(scene::in_view(p, view, mesh));
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (const auto at = line.between(seen[i], seen[i]))
            marks.points.push_back(place_of(at->first));
        if (i == 0) continue;
        if (const auto part = line.between(seen[i - 1], seen[i]))
            marks.lines.emplace_back(place_of(part->first), place_of(part->second));
    }
    return marks;
}

// Yellow with a dark border, as other marks are.
void draw_measured(image::Image& picture, const MeasuredMarks& marks, int scale) {
    constexpr image::Rgba8 kYellow{255, 220, 0, 255}, kDark{0, 0, 0, 255};
    constexpr int kHalf = 3; // of a point's square, font pixels
    for (const bool dark : {true, false}) {
        const int border = dark ? scale : 0;
        const image::Rgba8 colour = dark ? kDark : kYellow;
        for (const auto& [from, to] : marks.lines) {
            const int dx = to.x - from.x, dy = to.y - from.y;
            const int steps = std::max({std::abs(dx), std::abs(dy), 1});
            for (int i = 0; i <= steps; ++i) {
                const auto along = [&](int start, int by) { // rounded, halves away from 0
                    const int doubled = 2 * by * i;
                    return start + (doubled + (by < 0 ? -steps : steps)) / (2 * steps);
                };
                const int x = along(from.x, dx), y = along(from.y, dy);
                fill(picture, {x - border, y - border, x + scale + border, y + scale + border},
                     colour);
            }
        }
        for (const PixelPlace& p : marks.points)
            fill(picture,
                 {p.x - kHalf * scale - border, p.y - kHalf * scale - border,
                  p.x + (kHalf + 1) * scale + border, p.y + (kHalf + 1) * scale + border},
                 colour);
    }
}

} // namespace scanout::app
