// Meshes around a picture whose rim lies off it: beyond the guard band, behind the near plane or
// behind the eye. Each covers every sample of the picture once (HARD-CASES 3, 8, 12, P7). Vertices
// in the picture stand on the grid of 1/256 pixel, so snapping turns no triangle over.
#pragma once

#include "raster/exact.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace scanout::raster::test {

struct OffScreenMesh {
    static constexpr int kSide = 48; // pixels
    static constexpr double kNear = 0x1p-20;

    std::vector<Vec3> position; // view space: a pixel is as wide as the distance
    std::vector<std::array<std::size_t, 3>> triangle;

    static scene::View view() { return eye_view(kSide / 2.0, kSide / 2.0, 0, kNear); }
    std::array<Vec3, 3> corners(std::size_t t) const {
        return {position[triangle[t][0]], position[triangle[t][1]], position[triangle[t][2]]};
    }

    // At a point of the screen (pixels); behind the eye where w is negative.
    std::size_t add(const DVec2& at, double w) {
        constexpr double kCentre = kSide / 2.0;
        position.emplace_back((at.x - kCentre) * w, (kCentre - at.y) * w, -w);
        return position.size() - 1;
    }
    // In direction `to` from `from`, beyond the guard band, too near, or behind the eye.
    std::size_t add_far(Random& random, const DVec2& from, const DVec2& to, double guard) {
        const double length = std::sqrt(to.x * to.x + to.y * to.y);
        const double least = std::log2(guard + 9.0 * kSide), most = std::max(20.0, least);
        const auto away = [&](double low, double high) {
            return to * (std::exp2(random.in(low, high)) / length);
        };
        switch (random.whole(0, 3)) {
        case 0: // before the near plane
            return add(from + away(12, 20), kNear * random.in(0.2, 0.9));
        case 1: // what lies behind the eye stands on the other side of the screen
            return add(from - away(0, 20), -std::exp2(random.in(-3, 3)));
        default:
            return add(from + away(least, most), std::exp2(random.in(-3, 3)));
        }
    }

    // Likewise, but a few pixels beyond the guard band or less.
    std::size_t add_close(Random& random, const DVec2& from, const DVec2& to, double guard) {
        const auto out = [&](double at, double step) { // steps to the band's edge
            const double edge =
                step > 0 ? std::min(kSide + guard, kGuardPixels) : std::max(-guard, -kGuardPixels);
            return step == 0 ? HUGE_VAL : (edge - at) / step;
        };
        const double steps = std::min(out(from.x, to.x), out(from.y, to.y));
        const double length = std::sqrt(to.x * to.x + to.y * to.y);
        return add(from + to * (steps + std::exp2(random.in(-6, 4)) / length),
                   std::exp2(random.in(-3, 3)));
    }

    // Do all triangles wind the same way, and by more than rounding?
    bool is_flat() const {
        for (std::size_t t = 0; t < triangle.size(); ++t) {
            const auto [a, b, c] = corners(t);
            const DVec3 p(a), q(b), r(c);
            const double terms[] = {p.x * q.y * r.z,  q.x * r.y * p.z,  r.x * p.y * q.z,
                                    -r.x * q.y * p.z, -q.x * p.y * r.z, -p.x * r.y * q.z};
            double sum = 0, size = 0;
            for (const double term : terms) {
                sum += term;
                size += std::abs(term);
            }
            // y up and -w: a triangle that winds clockwise on the screen has a positive one.
            if (!(sum > size * 1e-13)) return false;
        }
        return true;
    }
};

inline DVec2 anywhere(Random& random) {
    const auto along = [&] { return random.in(2, OffScreenMesh::kSide - 2); };
    const DVec2 v(along(), along());
    // On the grid, on pixel centres and on pixel corners.
    const double step = random.whole(0, 2) == 0 ? 0.5 : 1.0 / 256;
    return {std::nearbyint(v.x / step) * step, std::nearbyint(v.y / step) * step};
}
// Clockwise from +x on the screen. Many run through samples, and many nearly do.
inline DVec2 direction(Random& random, double angle) {
    const DVec2 d(std::cos(angle), std::sin(angle));
    switch (random.whole(0, 3)) {
    case 0:
        return {std::nearbyint(d.x * 2), std::nearbyint(d.y * 2)};
    case 1:
        return {std::nearbyint(d.x * 7) + random.in(-1, 1) * 0x1p-20, std::nearbyint(d.y * 7)};
    default:
        return d;
    }
}

// Triangles about a vertex of the picture.
inline std::optional<OffScreenMesh> star(Random& random, double guard) {
    OffScreenMesh mesh;
    const DVec2 hub = anywhere(random);
    mesh.add(hub, std::exp2(random.whole(-3, 3)));
    const int n = random.whole(5, 9);
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + random.in(-0.3, 0.3)) / n;
        const DVec2 to = direction(random, angle);
        mesh.add_far(random, hub, to, guard);
        if (random.whole(0, 3) == 0) // and one right beside it
            mesh.add_far(random, hub, to + DVec2(-to.y, to.x) * std::exp2(random.in(-20, -4)),
                         guard);
    }
    const std::size_t rim = mesh.position.size() - 1;
    for (std::size_t i = 0; i < rim; ++i)
        mesh.triangle.push_back({0, 1 + i, 1 + (i + 1) % rim});
    if (!mesh.is_flat()) return std::nullopt;
    return mesh;
}

// A sliver between two vertices of the picture and one that lies off it at either end, and what
// surrounds them.
inline std::optional<OffScreenMesh> sliver(Random& random, double guard) {
    OffScreenMesh mesh;
    const DVec2 first = anywhere(random);
    // Often samples lie on the line through both.
    const double step = random.whole(0, 1) == 0 ? 1 : 1.0 / 256;
    const DVec2 second = first + DVec2(random.whole(-9, 9), random.whole(-9, 9)) * step;
    const DVec2 along = second - first, across(-along.y, along.x);
    // How far the second vertex stands from the line, as a share of the way to it.
    const auto thin = [&] { return std::exp2(random.in(-18, -4)); };
    mesh.add(first, std::exp2(random.whole(-3, 3)));
    mesh.add(second, std::exp2(random.whole(-3, 3)));
    const double front = thin(), back = thin();
    std::vector<std::size_t> rim;
    const std::size_t kSteps = 3;
    // The sliver's end, close to the picture or not; then there is another vertex beyond it.
    const DVec2 to = along + across * front;
    const bool close = random.whole(0, 1) == 0;
    rim.push_back(close ? mesh.add_close(random, first, to, guard)
                        : mesh.add_far(random, first, to, guard));
    const auto arc = [&](const DVec2& from, double sign) { // half a turn
        for (std::size_t i = 1; i < kSteps; ++i) {
            const double angle = std::numbers::pi * static_cast<double>(i) / kSteps;
            rim.push_back(mesh.add_far(
                random, from, (along * std::cos(angle) + across * std::sin(angle)) * sign, guard));
        }
    };
    arc(first, 1);
    rim.push_back(mesh.add_far(random, second, (along + across * back) * -1.0, guard));
    arc(second, -1);
    for (std::size_t i = 0; i < rim.size(); ++i)
        mesh.triangle.push_back({i < kSteps ? 0U : 1U, rim[i], rim[(i + 1) % rim.size()]});
    mesh.triangle.push_back({0, 1, rim[0]});
    mesh.triangle.push_back({1, 0, rim[kSteps]});
    if (close) {
        const std::size_t beyond = mesh.add_far(random, first, to, guard);
        mesh.triangle.push_back({rim[0], beyond, rim[1]});
        mesh.triangle.push_back({rim.back(), beyond, rim[0]});
    }
    if (!mesh.is_flat()) return std::nullopt;
    return mesh;
}

// A line across the picture and a vertex off it above and below, to which every step is joined.
inline std::optional<OffScreenMesh> comb(Random& random, double guard) {
    OffScreenMesh mesh;
    const int n = random.whole(3, 9);
    std::vector<DVec2> line;
    for (int i = 0; i < n; ++i)
        line.push_back(anywhere(random));
    for (int i = 1; i < n; ++i) // some a step of the grid beside the one before
        if (random.whole(0, 2) == 0)
            line[static_cast<std::size_t>(i)].x =
                line[static_cast<std::size_t>(i - 1)].x + random.whole(0, 2) / 256.0;
    std::sort(line.begin(), line.end(), [](const DVec2& a, const DVec2& b) { return a.x < b.x; });
    const DVec2 middle(OffScreenMesh::kSide / 2.0, OffScreenMesh::kSide / 2.0);
    const std::size_t above = mesh.add_far(random, middle, {random.in(-0.1, 0.1), -1}, guard),
                      below = mesh.add_far(random, middle, {random.in(-0.1, 0.1), 1}, guard);
    std::vector<std::size_t> step;
    step.push_back(mesh.add_far(random, middle, {-1, random.in(-0.1, 0.1)}, guard));
    for (const DVec2& at : line)
        step.push_back(mesh.add(at, std::exp2(random.whole(-3, 3))));
    step.push_back(mesh.add_far(random, middle, {1, random.in(-0.1, 0.1)}, guard));
    for (std::size_t i = 1; i < step.size(); ++i) {
        mesh.triangle.push_back({step[i], step[i - 1], above});
        mesh.triangle.push_back({step[i - 1], step[i], below});
    }
    if (!mesh.is_flat()) return std::nullopt;
    return mesh;
}

} // namespace scanout::raster::test
