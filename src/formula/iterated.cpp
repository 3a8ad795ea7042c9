// Iterated function systems (Barnsley 1988) by the chaos game: a point goes through maps that
// chance draws, and never leaves what consists of its own images.
#include "formula/height_field.h"
#include "formula/makers.h"
#include "math/random.h"
#include "math/transcendental.h"

#include <algorithm>
#include <span>

namespace scanout::formula {
namespace {

struct Map {
    double a, b, c, d, e, f; // x' = a x + b y + e, y' = c x + d y + f
    double share;            // how often it is drawn; all of them are 1 together
};

struct System {
    std::span<const Map> maps;
    DVec2 low, high; // the box of its points, a little larger
    image::Rgba8 colour;
};

constexpr double kHalfRoot3 = 0.8660254037844386;
constexpr Map kFernMaps[] = {{0, 0, 0, 0.16, 0, 0, 0.01},
                             {0.85, 0.04, -0.04, 0.85, 0, 1.6, 0.85},
                             {0.2, -0.26, 0.23, 0.22, 0, 1.6, 0.07},
                             {-0.15, 0.28, 0.26, 0.24, 0, 0.44, 0.07}};
constexpr Map kSierpinskiMaps[] = {{0.5, 0, 0, 0.5, 0, 0, 1.0 / 3},
                                   {0.5, 0, 0, 0.5, 0.5, 0, 1.0 / 3},
                                   {0.5, 0, 0, 0.5, 0.25, kHalfRoot3 / 2, 1.0 / 3}};
constexpr Map kDragonMaps[] = {{0.5, -0.5, 0.5, 0.5, 0, 0, 0.5},
                               {-0.5, -0.5, 0.5, -0.5, 1, 0, 0.5}};
const System kFern{kFernMaps, {-2.2, -0.01}, {2.67, 10.01}, {120, 220, 110, 255}};
const System kSierpinski{
    kSierpinskiMaps, {-0.001, -0.001}, {1.001, kHalfRoot3 + 0.001}, {240, 190, 80, 255}};
const System kDragon{kDragonMaps, {-0.34, -0.34}, {1.17, 0.67}, {110, 170, 250, 255}};

template <class Take>
void play(const System& system, const Wanted& wanted, const Progress& progress, Take&& take) {
    Random random(wanted.seed);
    constexpr int kAway = 100; // until the point is where it stays
    const std::int64_t points = std::int64_t{1000} * wanted.detail;
    DVec2 p(0);
    for (std::int64_t i = -kAway; i < points; ++i) {
        double drawn = random.unit();
        std::size_t k = 0;
        while (k + 1 < system.maps.size() && drawn >= system.maps[k].share)
            drawn -= system.maps[k++].share;
        const Map& m = system.maps[k];
        p = DVec2((m.a * p.x + m.b * p.y) + m.e, (m.c * p.x + m.d * p.y) + m.f);
        if (i >= 0) take(p);
        if (progress && i % 100000 == 0)
            progress(std::max(0.0, static_cast<double>(i) / static_cast<double>(points)));
    }
}

// Light grows with the logarithm of how many points a pixel has.
image::Image picture_of(const System& system, const Wanted& wanted, const Progress& progress) {
    const DVec2 box = system.high - system.low;
    const double scale = 0.96 * std::min(wanted.width / box.x, wanted.height / box.y);
    const double left = (wanted.width - scale * box.x) / 2,
                 top = (wanted.height - scale * box.y) / 2;
    const auto width = static_cast<std::size_t>(wanted.width);
    std::vector<std::uint32_t> hits(width * static_cast<std::size_t>(wanted.height), 0);
    play(system, wanted, progress, [&](DVec2 p) {
        const auto x = static_cast<int>(left + scale * (p.x - system.low.x));
        const auto y = static_cast<int>(top + scale * (system.high.y - p.y));
        if (x >= 0 && y >= 0 && x < wanted.width && y < wanted.height)
            ++hits[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
    });
    const double most = log2(1.0 + *std::max_element(hits.begin(), hits.end()));
    image::Image out(wanted.width, wanted.height);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const double share = most > 0 ? log2(1.0 + hits[i]) / most : 0;
        const auto code = [&](std::uint8_t full) {
            return static_cast<std::uint8_t>(full * share + 0.5);
        };
        out.pixels()[i] = {code(system.colour.r), code(system.colour.g), code(system.colour.b),
                           255};
    }
    return out;
}

// Points within 1 of the origin.
geom::PolygonMesh points_of(const System& system, const Wanted& wanted, const Progress& progress) {
    geom::PolygonMesh mesh;
    const DVec2 box = system.high - system.low, middle = system.low + box / 2.0;
    const double scale = 2 / std::max(box.x, box.y);
    play(system, wanted, progress, [&](DVec2 p) {
        mesh.point_vertices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.point_material.push_back(-1);
        mesh.positions.push_back(
            {rounded(scale * (p.x - middle.x)), rounded(scale * (p.y - middle.y)), 0});
    });
    return mesh;
}

} // namespace

image::Image fern_picture(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    return picture_of(kFern, wanted, progress);
}
geom::PolygonMesh fern_model(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    return points_of(kFern, wanted, progress);
}
image::Image sierpinski_picture(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    return picture_of(kSierpinski, wanted, progress);
}
geom::PolygonMesh sierpinski_model(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    return points_of(kSierpinski, wanted, progress);
}
image::Image dragon_picture(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    return picture_of(kDragon, wanted, progress);
}
geom::PolygonMesh dragon_model(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    return points_of(kDragon, wanted, progress);
}

} // namespace scanout::formula
