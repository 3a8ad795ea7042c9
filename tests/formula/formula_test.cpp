// Pictures and models by formulas: their known areas, counts and symmetries, and their bits.
#include "formula/formula.h"
#include "formula/makers.h"
#include "image/hash.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace scanout::formula {
namespace {

geom::PolygonMesh model_of(std::string_view name, const Wanted& wanted) {
    Jobs jobs(1);
    return find_formula(name)->model(wanted, jobs, {});
}
image::Image picture_of_formula(std::string_view name, const Wanted& wanted, int threads = 1) {
    Jobs jobs(threads);
    return find_formula(name)->picture(wanted, jobs, {});
}

// Of faces in a plane, by the shoelace formula of two axes.
double area_of(const geom::PolygonMesh& mesh, std::size_t face, int u, int v) {
    double twice = 0;
    for (std::size_t c = mesh.face_begin[face], end = mesh.face_end(face); c < end; ++c) {
        const std::size_t next = c + 1 < end ? c + 1 : mesh.face_begin[face];
        const DVec3 a = mesh.positions[static_cast<std::size_t>(mesh.corners[c].position)];
        const DVec3 b = mesh.positions[static_cast<std::size_t>(mesh.corners[next].position)];
        twice += a[u] * b[v] - b[u] * a[v];
    }
    return twice / 2;
}

bool is_white(const geom::PolygonMesh& mesh, std::size_t face) {
    const Vec3 colour =
        mesh.colours[static_cast<std::size_t>(mesh.corners[mesh.face_begin[face]].position)];
    return colour.x > 0.5F;
}

TEST(ZonePlate, RingsHaveEqualAreasInTurnWhiteAndBlack) {
    const geom::PolygonMesh mesh = model_of("zone_plate", {0, 0, 30, 1});
    ASSERT_EQ(mesh.faces(), 30U * 256);
    double white = 0, black = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const double area = area_of(mesh, f, 0, 1);
        ASSERT_NEAR(area, M_PI / 30 / 256, 1e-5); // counter-clockwise from +z
        (is_white(mesh, f) ? white : black) += area;
        ASSERT_EQ(is_white(mesh, f), f / 256 % 2 == 0);
    }
    EXPECT_NEAR(white, black, 1e-4);
    EXPECT_NEAR(white + black, M_PI, 0.001);
}

TEST(ZonePlate, APictureIsTheWaveOfItsRadius) {
    const image::Image out = picture_of_formula("zone_plate", {101, 80, 10, 1});
    EXPECT_EQ(out.at(50, 40).r, 255);
    for (const auto& [x, y] : {std::pair{50, 40}, {70, 22}, {3, 60}}) {
        const double r2 = std::pow(x + 0.5 - 50.5, 2) + std::pow(y + 0.5 - 40, 2);
        const double light = 0.5 + 0.5 * std::cos(M_PI * 10 * r2 / 1600);
        const double encoded =
            light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
        EXPECT_NEAR(out.at(x, y).g, 255 * encoded, 0.51);
    }
}

TEST(Checker, SquaresOfOneUnitAlternateToTheHorizon) {
    const geom::PolygonMesh mesh = model_of("checker", {0, 0, 9, 1});
    ASSERT_EQ(mesh.faces(), 81U);
    for (std::size_t f = 0; f < 81; ++f) {
        EXPECT_EQ(area_of(mesh, f, 2, 0), 1); // seen from +y
        EXPECT_EQ(is_white(mesh, f), f % 2 == 0);
    }
    const image::Image board = picture_of_formula("checker", {17, 11, 5, 1});
    int changes = 0;
    for (int x = 1; x < 17; ++x)
        changes += board.at(x, 0) == board.at(x - 1, 0) ? 0 : 1;
    EXPECT_EQ(changes, 4);
}

TEST(Koch, HasTheLengthAndTheAreaOfTheSnowflake) {
    for (int n = 0; n <= 7; ++n) {
        const std::vector<DVec2> curve = koch_curve(n);
        ASSERT_EQ(curve.size(), std::size_t{3} << (2 * n));
        double length = 0, twice = 0;
        for (std::size_t i = 0; i < curve.size(); ++i) {
            const DVec2 a = curve[i], b = curve[(i + 1) % curve.size()];
            length += std::hypot(b.x - a.x, b.y - a.y);
            twice += a.x * b.y - b.x * a.y;
        }
        const double side = std::sqrt(3.0), triangle = std::sqrt(3.0) / 4 * side * side;
        EXPECT_NEAR(length, 3 * side * std::pow(4 / 3.0, n), 1e-9);
        const double area = triangle * (8 - 3 * std::pow(4 / 9.0, n)) / 5;
        EXPECT_NEAR(twice / 2, area, 1e-9);
        double covered = 0;
        const image::Image picture = picture_of_formula("koch", {300, 250, n, 1}, 2);
        for (const image::Rgba8& p : picture.pixels())
            covered += p.r / 255.0;
        const double scale = 0.48 * 250;
        EXPECT_NEAR(covered / (scale * scale), area, 0.004 * area) << n;
    }
}

TEST(Terrain, HasItsFacesAndHeightsOfAnySize) {
    for (const auto& [width, depth] : {std::pair{2, 2}, {65, 65}, {40, 23}, {7, 90}}) {
        const geom::PolygonMesh mesh = model_of("terrain", {width, depth, 16, 4});
        ASSERT_EQ(mesh.positions.size(), static_cast<std::size_t>(width * depth));
        ASSERT_EQ(mesh.faces(), static_cast<std::size_t>(2 * (width - 1) * (depth - 1)));
        double low = 1, high = 0, area = 0;
        for (const DVec3& p : mesh.positions) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
        EXPECT_EQ(low, 0);
        EXPECT_EQ(high, 0.5);
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            const double part = area_of(mesh, f, 2, 0);
            EXPECT_GT(part, 0);
            area += part;
        }
        const double longer = std::max(width, depth) - 1;
        EXPECT_NEAR(area, 4 * (width - 1) * (depth - 1) / (longer * longer), 1e-3);
    }
}

// The middle is the mean of the corners where only the corners are drawn by chance.
TEST(Terrain, WithoutChanceMiddlesAreMeans) {
    const Wanted one{257, 257, 1, 9}, all{257, 257, 16, 9};
    const image::Image smooth = picture_of_formula("terrain", one);
    const image::Image rough = picture_of_formula("terrain", all);
    const auto roughness = [](const image::Image& p) { // mean squared bend along a row
        double sum = 0;
        for (int x = 1; x < 256; ++x)
            sum += std::pow(p.at(x - 1, 100).r - 2 * p.at(x, 100).r + p.at(x + 1, 100).r, 2);
        return sum / 255;
    };
    EXPECT_LT(roughness(smooth), 2.5); // rounding to codes, and a few folds
    EXPECT_GT(roughness(rough), 2 * roughness(smooth));
    EXPECT_EQ(picture_of_formula("terrain", {100, 60, 16, 9}).width(), 100);
    EXPECT_NE(picture_of_formula("terrain", {100, 60, 16, 9}),
              picture_of_formula("terrain", {100, 60, 16, 10}));
}

TEST(Mandelbrot, HasItsAreaAndItsSymmetry) {
    const Wanted wanted{600, 500, 2000, 1};
    const image::Image out = picture_of_formula("mandelbrot", wanted, 3);
    int inside = 0;
    for (int y = 0; y < 500; ++y)
        for (int x = 0; x < 600; ++x) {
            inside += out.at(x, y) == image::Rgba8{0, 0, 0, 255} ? 1 : 0;
            ASSERT_EQ(out.at(x, y), out.at(x, 499 - y));
        }
    const double pixel = 2.5 / 500;
    EXPECT_NEAR(inside * pixel * pixel, 1.5066, 0.02); // Foerstemann's measurement: 1.50659
    const geom::PolygonMesh mesh = model_of("mandelbrot", {30, 25, 100, 1});
    EXPECT_EQ(mesh.positions.size(), 750U);
}

TEST(IteratedSystems, StayInTheirBoxesAndOutOfTheirHoles) {
    const geom::PolygonMesh triangle = model_of("sierpinski", {0, 0, 30, 1});
    ASSERT_EQ(triangle.positions.size(), 30000U);
    ASSERT_EQ(triangle.point_vertices.size(), 30000U);
    // In units of the side, from the lower left corner.
    const double side = 2 / 1.002;
    for (const DVec3& p : triangle.positions) {
        const double x = p.x / side + 0.5, y = p.y / side + std::sqrt(3.0) / 4;
        ASSERT_GE(y, -1e-5);
        ASSERT_LE(y, std::sqrt(3.0) * std::min(x, 1 - x) + 1e-5);
        const double below = std::sqrt(3.0) / 4 - y; // the middle triangle stands on its tip
        ASSERT_FALSE(below > 1e-4 && std::abs(x - 0.5) < y / std::sqrt(3.0) - 1e-4)
            << x << " " << y;
    }
    const geom::PolygonMesh fern = model_of("fern", {0, 0, 200, 1});
    double left = 9, right = -9, low = 9, high = -9;
    for (const DVec3& p : fern.positions) { // Barnsley's fern: -2.182 to 2.656, 0 to 9.998
        const double scale = 2 / 10.02;
        left = std::min(left, p.x / scale + (2.67 - 2.2) / 2);
        right = std::max(right, p.x / scale + (2.67 - 2.2) / 2);
        low = std::min(low, p.y / scale + 5);
        high = std::max(high, p.y / scale + 5);
    }
    EXPECT_NEAR(left, -2.182, 0.03);
    EXPECT_NEAR(right, 2.656, 0.03);
    EXPECT_NEAR(low, 0, 0.1);
    EXPECT_NEAR(high, 9.998, 0.03);
}

TEST(Formulas, HaveTheSameBitsForEveryNumberOfThreadsAndTheirHashes) {
    std::map<std::string_view, std::string> hashes;
    for (const Formula& f : formulas()) {
        const Wanted wanted{90, 70, std::min(f.of_picture, 64), 3};
        const image::Image one = picture_of_formula(f.name, wanted, 1);
        for (const int threads : {2, 5})
            EXPECT_EQ(picture_of_formula(f.name, wanted, threads), one) << f.name;
        hashes[f.name] = image::hash_text(image::frame_hash(one));
    }
    const std::map<std::string_view, std::string> expected = {
        {"zone_plate", "16f400ecc520439b"}, {"checker", "9d003acf66a39d1c"},
        {"terrain", "1e5aae44dbcfafc1"},    {"mandelbrot", "00d6697fe50be09a"},
        {"koch", "bb5b3f3690510010"},       {"fern", "0286a5fb8ee5ff48"},
        {"sierpinski", "507068e248bda7b9"}, {"dragon", "e976829b3b0b04f9"}};
    EXPECT_EQ(hashes, expected);
}

TEST(Formulas, HaveAsManyVerticesAsTheySay) {
    Jobs jobs(1);
    for (const Formula& f : formulas()) {
        const Wanted wanted{33, 20, std::min(f.of_model, 5), 3};
        double last = -1;
        const geom::PolygonMesh mesh = f.model(wanted, jobs, [&](double share) {
            EXPECT_GE(share, last);
            EXPECT_LE(share, 1);
            last = share;
        });
        EXPECT_GE(last, 0) << f.name;
        EXPECT_EQ(static_cast<std::int64_t>(mesh.positions.size()), vertices_of(f, wanted))
            << f.name;
        for (const DVec3& p : mesh.positions) // six decimal places
            for (int i = 0; i < 3; ++i)
                ASSERT_NEAR(p[i] * 1e6, std::round(p[i] * 1e6), 1e-6) << f.name;
    }
}

TEST(Formulas, DrawEverySizeDownToOnePixel) {
    for (const Formula& f : formulas())
        for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {9, 1}, {2, 3}}) {
            const image::Image out =
                picture_of_formula(f.name, {width, height, std::min(f.of_picture, 20), 1});
            EXPECT_EQ(out.width(), width);
            EXPECT_EQ(out.height(), height);
        }
}

} // namespace
} // namespace scanout::formula
