// Edges in the reference against exact areas: what its samples leave of an error where a pixel is
// divided, and where a filter weighs them.
#include "support/meshes.h"
#include "support/random.h"
#include "support/srgb_formula.h"
#include "trace/render.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::trace {
namespace {

constexpr int kSide = 24; // pixels

using Polygon = std::vector<DVec2>;

// The part of a polygon on one side of a line along an axis: Sutherland and Hodgman 1974.
Polygon cut(const Polygon& polygon, int axis, double at, double side) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const DVec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double from = (a[axis] - at) * side, to = (b[axis] - at) * side;
        if (from >= 0) out.push_back(a);
        if ((from < 0) != (to < 0)) out.push_back(a + (b - a) * (from / (from - to)));
    }
    return out;
}

// The area of a polygon in the box of pixel (x, y); pixels right and down.
double area_in(Polygon polygon, int x, int y) {
    polygon = cut(cut(polygon, 0, x, 1), 0, x + 1, -1);
    polygon = cut(cut(polygon, 1, y, 1), 1, y + 1, -1);
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const DVec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return std::abs(twice) / 2;
}

scene::View facing_the_plane() {
    scene::View view;
    view.projection = scene::Projection::orthographic;
    return view;
}

Look white_on(const image::Rgba8& background) {
    Look look;
    look.width = look.height = kSide;
    look.background = background;
    scene::Light light;
    light.kind = scene::LightKind::ambient;
    light.power = 1;
    look.lights = {light};
    return look;
}

scene::Scene white(const std::vector<Vec3>& corners) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(1);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const std::uint32_t first = test::add_vertex(s.mesh, corners[i]);
        test::add_vertex(s.mesh, corners[i + 1]);
        test::add_vertex(s.mesh, corners[i + 2]);
        test::add_triangle(s.mesh, first, first + 1, first + 2, 0);
    }
    return s;
}

struct Errors {
    double square = 0, most = 0;
    int edges = 0, over = 0; // a quarter of a code
    double rmse() const { return std::sqrt(square / edges); }
};

// White triangles on a background of this light.
Errors errors_of_triangles(const image::Rgba8& background, std::uint32_t samples) {
    test::Random random(5);
    Jobs jobs(2);
    Errors errors;
    const double behind = test::decoded(background.r);
    for (int n = 0; n < 12; ++n) {
        std::vector<Vec3> corners;
        Polygon polygon;
        for (int k = 0; k < 3; ++k) {
            const DVec3 p = random.in_cube(0.95);
            corners.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), 0.0F);
            polygon.emplace_back((double{corners.back().x} + 1) * kSide / 2,
                                 (1 - double{corners.back().y}) * kSide / 2);
        }
        const auto made =
            render(white(corners), facing_the_plane(), white_on(background), jobs, {}, {samples});
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double area = area_in(polygon, x, y);
                const double found = double{made->light[static_cast<std::size_t>(y * kSide + x)].x};
                if (area == 0 || area == 1) {
                    EXPECT_NEAR(found, area == 0 ? behind : 1, 1e-6) << x << " " << y;
                    continue;
                }
                const double off = test::encoded(found) - test::encoded(area + (1 - area) * behind);
                errors.square += off * off;
                errors.most = std::max(errors.most, std::abs(off));
                errors.over += std::abs(off) > 0.25 ? 1 : 0;
                ++errors.edges;
            }
    }
    return errors;
}

// The most samples, which edges take, leave less than the quarter of a code that is asked for: as a
// root of the mean square on the background that is drawn by default. Where codes stand for less
// light, on black, they leave a third.
TEST(ReferenceEdges, AreTheExactAreasToAQuarterOfACode) {
    const Errors on_grey = errors_of_triangles({48, 48, 48, 255}, kMostSamples);
    EXPECT_GT(on_grey.edges, 400);
    EXPECT_LT(on_grey.rmse(), 0.25);
    EXPECT_LT(on_grey.most, 1);
    EXPECT_LT(on_grey.over, 0.2 * on_grey.edges);
    const Errors on_black = errors_of_triangles({0, 0, 0, 255}, kMostSamples);
    EXPECT_LT(on_black.rmse(), 0.4);
}

// Of a filter's weights the part left of an edge that runs down at `edge`, pixels from the middle.
using Share = double (*)(double edge);
double share_of_tent(double edge) {
    const double e = std::clamp(edge, -1.0, 1.0);
    return e < 0 ? (1 + e) * (1 + e) / 2 : 1 - (1 - e) * (1 - e) / 2;
}
double share_of_gaussian(double edge) { // of deviation 1/2, cut off at 1.5
    const auto part = [](double x) { return std::erf(std::numbers::sqrt2 * x); };
    return (part(std::clamp(edge, -1.5, 1.5)) + part(1.5)) / (2 * part(1.5));
}

TEST(ReferenceEdges, AreWeighedByTheFilter) {
    constexpr double kEdge = 11.37; // pixels from the left
    const auto x = static_cast<float>(kEdge / (kSide / 2.0) - 1);
    const scene::Scene s =
        white({{-3, -3, 0}, {x, -3, 0}, {x, 3, 0}, {-3, -3, 0}, {x, 3, 0}, {-3, 3, 0}});
    Jobs jobs(2);
    const struct {
        std::function<double(double)> weight;
        Share share;
    } filters[] = {{[](double d) { return d < 1 ? 1 - d : 0.0; }, share_of_tent},
                   {[](double d) { return std::exp(-2 * d * d); }, share_of_gaussian}};
    for (const auto& filter : filters) {
        Look look = white_on({48, 48, 48, 255});
        look.filter = filter.weight;
        const auto made = render(s, facing_the_plane(), look, jobs);
        const double behind = test::decoded(48);
        int between = 0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double share = filter.share(kEdge - (i % kSide + 0.5));
            EXPECT_NEAR(test::encoded(double{made->light[static_cast<std::size_t>(i)].x}),
                        test::encoded(share + (1 - share) * behind), 0.5)
                << i % kSide << " " << i / kSide;
            between += share > 0 && share < 1 ? 1 : 0;
        }
        EXPECT_GE(between, 2 * kSide);
    }
}

} // namespace
} // namespace scanout::trace
