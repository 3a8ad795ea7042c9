// Texture filters against a reference of 48 x 48 samples a pixel on a tiled floor that runs to the
// horizon (HARD-CASES 40, L4), and the bound that decides whether a view needs mipmaps.
#include "frame/facts/minification.h"
#include "math/srgb.h"
#include "rows.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace scanout::test {
namespace {

constexpr int kWidth = 120, kHeight = 80;
constexpr double kEye = 0.006, kTurns = 160; // eye above the floor; tiles a unit

scene::Texture tile() {
    image::Image image(32, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            image.at(x, y) = (x / 8 + y / 8) % 2 == 0 ? image::Rgba8{250, 250, 250, 255}
                                                      : image::Rgba8{20, 20, 20, 255};
    return {"tile", image};
}

Shot floor_to_the_horizon(const std::string& filter) {
    Shot s = shot("floor", kWidth, kHeight);
    s.scene.materials = {textured(0)};
    s.scene.textures = {tile()};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(mesh, {{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}}, {0, 1, 0}, 0);
    for (std::size_t i = 0; i < mesh.uv.size(); ++i)
        mesh.uv[i] = {mesh.position[i].x * static_cast<float>(kTurns),
                      -mesh.position[i].z * static_cast<float>(kTurns)};
    s.camera.eye = DVec3(0.0013, kEye, 0.9);
    s.camera.target = DVec3(0.0013, kEye - 0.15, 0);
    s.options.texture = filter;
    return s;
}

struct Hit {
    bool on_floor;
    double u, v;
};
// Where a point of the picture (pixels) meets the floor, from the camera's own description.
Hit hit(double x, double y) {
    const double tan_half = std::tan(22.5 * 3.14159265358979323846 / 180),
                 pitch = std::atan2(0.15, 0.9);
    const double right = (x / kWidth * 2 - 1) * tan_half * kWidth / kHeight,
                 up = (1 - y / kHeight * 2) * tan_half;
    const double dy = up * std::cos(pitch) - std::sin(pitch),
                 dz = -up * std::sin(pitch) - std::cos(pitch);
    if (dy >= 0) return {false, 0, 0};
    const double t = kEye / -dy, at_x = 0.0013 + t * right, at_z = 0.9 + t * dz;
    return {std::abs(at_x) < 1 && std::abs(at_z) < 1, at_x * kTurns, -at_z * kTurns};
}

double bilinear(const std::vector<double>& texel, double u, double v) {
    const double x = u * 32 - 0.5, y = v * 32 - 0.5;
    const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    const auto at = [&](double tx, double ty) {
        const auto wrapped = [](double t) {
            return static_cast<std::size_t>(static_cast<long>(t) & 31);
        };
        return texel[(31 - wrapped(ty)) * 32 + wrapped(tx)];
    };
    return (at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx) * (1 - fy) +
           (at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx) * fy;
}

// Mean over the pixel; below 0 where not all of it shows the floor.
std::vector<double> reference() {
    constexpr int kSide = 48;
    std::vector<double> texel, mean;
    const scene::Texture texture = tile();
    for (const image::Rgba8& p : texture.image.pixels())
        texel.push_back(srgb_decode(p.r));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            bool whole = true;
            for (const double dx : {0.0, 1.0})
                for (const double dy : {0.0, 1.0})
                    whole = whole && hit(x + dx, y + dy).on_floor;
            double sum = 0;
            for (int j = 0; whole && j < kSide; ++j)
                for (int i = 0; i < kSide; ++i) {
                    const Hit h = hit(x + (i + 0.5) / kSide, y + (j + 0.5) / kSide);
                    sum += bilinear(texel, h.u, h.v);
                }
            mean.push_back(whole ? sum / (kSide * kSide) : -1);
        }
    return mean;
}

TEST(TextureFilter, AnisotropicKeepsWithinItsErrorUpToTheHorizonAndEveryRungIsBetter) {
    const std::vector<double> exact = reference();
    Shot white = floor_to_the_horizon("nearest");
    for (image::Rgba8& p : white.scene.textures[0].image.pixels())
        p = {255, 255, 255, 255};
    const image::Image lit = draw(white);
    double before = 1;
    for (const shade::Filter* filter : shade::texture::kRows) {
        if (filter->card.kind != Kind::rung) continue;
        const std::string name(filter->card.name);
        const image::Image got = draw(floor_to_the_horizon(name));
        double sum = 0;
        int count = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double mean = exact[static_cast<std::size_t>(y * kWidth + x)];
                if (mean < 0) continue;
                const double error =
                    srgb_decode(got.at(x, y).g) / double{srgb_decode(lit.at(x, y).g)} - mean;
                sum += error * error;
                ++count;
            }
        ASSERT_GT(count, kWidth * kHeight / 2);
        const double rmse = std::sqrt(sum / count);
        std::cout << name << " RMSE " << rmse << std::endl;
        EXPECT_LT(rmse, before) << name;
        before = rmse;
        // As measured, and 1 %: a probe less than a rung has is more. HARD-CASES 40 asks for 0.015.
        for (const auto& [rung, least] : {std::pair{"anisotropic_2", 0.0423},
                                          {"anisotropic_4", 0.02068},
                                          {"anisotropic_8", 0.01306},
                                          {"anisotropic_16", 0.01233}})
            if (name == rung) {
                EXPECT_LE(rmse, least * 1.01) << name;
            }
        RecordProperty(name, testing::PrintToString(rmse));
    }
}

// --- what a view says about minification

TEST(Minification, BoundsTheFootprintOfEveryPixelThatSlantsByUpTo75Degrees) {
    Random random(1);
    double tightest = 0;
    int pixels = 0;
    for (int round = 0; round < 2000; ++round) {
        Shot s = shot("plane", 40, 30);
        s.scene.materials = {textured(0)};
        s.scene.materials[0].map_diffuse.edit().scale = {random.in(0.1, 3), random.in(0.1, 3), 1};
        s.scene.textures = {{"any", image::Image(random.whole(1, 900), random.whole(1, 900))}};
        const DVec3 p = random.in_cube(0.3), e1 = random.in_cube(0.4), e2 = random.in_cube(0.4);
        const auto any_uv = [&] { return Vec2(random.in(-2, 2), random.in(-2, 2)); };
        geom::Mesh& mesh = s.scene.mesh;
        for (const DVec3& corner : {p, p + e1, p + e2}) {
            add_vertex(mesh, Vec3(corner));
            mesh.uv.push_back(any_uv());
        }
        add_triangle(mesh, 0, 1, 2, 0);
        s.model.scale = {random.in(0.3, 2), random.in(0.3, 2), random.in(-2, -0.3)};
        s.model.rotate_degrees = random.in_cube(180);
        s.camera.azimuth_degrees = random.in(0, 360);
        s.camera.elevation_degrees = random.in(-90, 90);
        if (round % 3 == 0) s.camera.projection = scene::Projection::orthographic;
        const auto view = scene::make_view(mesh, s.model, s.pose, s.camera, {}, 40, 30);
        ASSERT_TRUE(view);
        const auto surfaces = frame::textured_surfaces(s.scene);
        ASSERT_EQ(surfaces.size(), 1U);
        const frame::Minification bound = frame::texels_per_pixel(surfaces[0], *view, 40, 30);

        // The plane in view space, and u, v as functions of its points.
        DVec3 corner[3];
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = view->linear * DVec3(mesh.position[k]) + view->translation;
        const DVec3 a = corner[1] - corner[0], b = corner[2] - corner[0], n = cross3(a, b);
        const double length = std::sqrt(dot3(n, n));
        const image::Image& image = s.scene.textures[0].image;
        const Vec3& scale = s.scene.materials[0].map_diffuse->scale;
        const DVec2 size(image.width() * double{scale.x}, image.height() * double{scale.y});
        const bool flat = view->projection == scene::Projection::orthographic;
        struct Place {
            double inside;
            DVec2 texel;
            double slant_cosine;
        };
        const auto place = [&](double x, double y) -> Place {
            const double right = (x / 40 * 2 - 1) * view->half_width,
                         up = (1 - y / 30 * 2) * view->half_height;
            const DVec3 from = flat ? DVec3(right, up, 0) : DVec3(0),
                        ray = flat ? DVec3(0, 0, -1) : DVec3(right, up, -1);
            const double t = dot3(corner[0] - from, n) / dot3(ray, n);
            const DVec3 q = from + ray * t - corner[0];
            const double s1 = dot3(cross3(q, b), n) / (length * length),
                         s2 = dot3(cross3(a, q), n) / (length * length);
            const DVec2 uv = DVec2(mesh.uv[0]) + (DVec2(mesh.uv[1]) - DVec2(mesh.uv[0])) * s1 +
                             (DVec2(mesh.uv[2]) - DVec2(mesh.uv[0])) * s2;
            return {std::min({s1, s2, 1 - s1 - s2}), uv * size,
                    std::abs(dot3(ray, n)) / length / std::sqrt(dot3(ray, ray))};
        };
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const double h = 1e-4; // of a pixel
                const Place here = place(x + 0.5, y + 0.5);
                if (here.inside < 0 || here.slant_cosine < 1 / frame::kMaxSlant) continue;
                const DVec2 dx = (place(x + 0.5 + h, y + 0.5).texel - here.texel) / h,
                            dy = (place(x + 0.5, y + 0.5 + h).texel - here.texel) / h;
                const double span =
                    std::sqrt(std::max(dx.x * dx.x + dx.y * dx.y, dy.x * dy.x + dy.y * dy.y));
                ASSERT_LE(span, bound.slanted * 1.001) << round;
                tightest = std::max(tightest, span / bound.slanted);
                ++pixels;
            }
    }
    EXPECT_GT(pixels, 10000);
    EXPECT_GT(tightest, 0.7) << "a bound that says little";
}

TEST(Minification, IsExactForASquareSeenStraightOn) {
    Shot s = shot("square", 64, 64);
    s.scene.materials = {textured(0)};
    s.scene.textures = {{"any", image::Image(256, 256)}};
    add_square(s.scene.mesh, 0.5, 0, 0);
    s.camera.projection = scene::Projection::orthographic;
    const auto view = scene::make_view(s.scene.mesh, {}, {}, s.camera, {}, 64, 64);
    ASSERT_TRUE(view);
    const auto surfaces = frame::textured_surfaces(s.scene);
    ASSERT_EQ(surfaces.size(), 1U);
    EXPECT_NEAR(surfaces[0].texels_per_unit, 256, 1e-9);
    const frame::Minification texels = frame::texels_per_pixel(surfaces[0], *view, 64, 64);
    EXPECT_NEAR(texels.facing, 256 * 2 * view->half_width / 64, 1e-9);
    EXPECT_NEAR(texels.slanted, texels.facing, 1e-9);
    scene::View behind = *view;
    behind.projection = scene::Projection::perspective;
    behind.translation = {0, 0, 5};
    EXPECT_EQ(frame::texels_per_pixel(surfaces[0], behind, 64, 64).slanted, 0);
}

// A flat surface slants as it stands, not as much as any may.
TEST(Minification, OfASquareThatIsNowhereMinifiedCallsForNoMipmaps) {
    Shot s = shot("square", 64, 64);
    s.scene.materials = {textured(0)};
    s.scene.textures = {checkers()};
    s.scene.materials[0].map_diffuse.edit().scale = {2, 2, 1}; // 16 texels in 42 pixels
    add_square(s.scene.mesh, 0.5, 0, 0);
    s.camera.azimuth_degrees = 30;
    frame::FrameStats stats;
    draw(s, {.stats = &stats});
    EXPECT_EQ(stats.mipmap_bytes, 0U);
    s.camera.azimuth_degrees = 80;
    draw(s, {.stats = &stats});
    EXPECT_GT(stats.mipmap_bytes, 0U) << "where it slants, texels share a pixel";
}

TEST(Minification, DecidesAboutMipmapsAndTheirMemory) {
    Shot near = textured_cube("near", "auto"), far = near, named = near;
    near.camera.distance = 1.7; // 8 texels on a side that fills the picture
    far.camera.distance = 8;    // 2 texels a pixel
    named.options.texture = "trilinear";
    frame::FrameStats stats;
    const image::Image magnified = draw(near, {.stats = &stats});
    EXPECT_EQ(stats.mipmap_bytes, 0U);
    near.options.texture = "bilinear";
    EXPECT_EQ(draw(near), magnified);
    near.options.texture = "auto";
    near.options.effects = {{"mipmaps", true}};
    EXPECT_EQ(draw(near, {.stats = &stats}), magnified) << "forcing them on changes no bit";
    EXPECT_EQ(stats.mipmap_bytes, 0U);
    draw(far, {.stats = &stats});
    EXPECT_EQ(stats.mipmap_bytes, 16U * (16 + 4 + 1));
    draw(named, {.stats = &stats});
    EXPECT_EQ(stats.mipmap_bytes, 16U * (16 + 4 + 1)) << "what the user names is drawn";
    const image::Image minified = draw(far);
    far.options.effects = {{"mipmaps", false}};
    const image::Image without = draw(far, {.stats = &stats});
    EXPECT_EQ(stats.mipmap_bytes, 0U);
    EXPECT_FALSE(minified == without) << "leaving them out changes the picture";
    far.options.effects.clear();
    far.options.texture = "bilinear";
    EXPECT_EQ(draw(far), without);
}

} // namespace
} // namespace scanout::test
