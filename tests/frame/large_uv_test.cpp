// Faces that repeat a texture very often, through the whole renderer: the texture has a different
// colour in each of its texels, so a pixel tells which one it shows. HARD-CASES 36.
#include "ruler.h"

namespace scanout::test {
namespace {

using oracle::Three;

class ManyRepeats {
public:
    ManyRepeats(int width, int texels)
        : shot_(shot("many_repeats", width, width)), texels_(texels) {
        scene::Material material = textured(0);
        material.diffuse = Vec3(1 / scene::kAmbient);
        shot_.scene.materials = {material};
        scene::Texture texture{"ruler", image::Image(texels, 1)};
        for (int i = 0; i < texels; ++i)
            texture.image.at(i, 0) = texel_colour(i);
        shot_.scene.textures = {texture};
        shot_.options.texture = "nearest";
        view_.near_distance = 0x1p-24;
        shot_.scene.mesh = empty_mesh();
    }
    frame::FrameOptions& options() { return shot_.options; }
    scene::Material& material() { return shot_.scene.materials[0]; }
    int width() const { return shot_.options.width; }
    void add(const Known& t) {
        std::array<Vec3, 3> place;
        for (std::size_t i = 0; i < 3; ++i)
            place[i] = oracle::placed(t.corner[i], t.w[i], width(), width());
        add(place, t.u);
    }
    void add(const std::array<Vec3, 3>& place, const Three& u) {
        geom::Mesh& mesh = shot_.scene.mesh;
        std::uint32_t index[3];
        for (std::size_t i = 0; i < 3; ++i) {
            index[i] = add_vertex(mesh, place[i], kUnlit);
            mesh.uv.emplace_back(u[i], 0.5);
            exact_.emplace_back(u[i], 0.5);
        }
        add_triangle(mesh, index[0], index[1], index[2], 0);
    }
    // in_floats: the naive method, of a mesh that has floats alone.
    void draw(bool in_floats) {
        shot_.scene.mesh.exact_uv = in_floats ? std::vector<DVec2>() : exact_;
        const auto plan = frame::plan(shot_.options, frame::facts(shot_.scene));
        ASSERT_TRUE(plan);
        picture_ = renderer_.render(shot_.scene, view_, *plan);
    }
    const image::Image& picture() const { return picture_; }
    bool covered(int x, int y) const { return !(picture_.at(x, y) == shot_.options.background); }
    // How far the shown texel lies from a place, in texels: 0 where it holds it.
    double error(int x, int y, double repeats) const {
        const double at = (repeats - std::floor(repeats)) * texels_;
        double off = at - texel_of(picture_.at(x, y));
        off -= std::floor(off / texels_) * texels_; // [0, 1): inside
        return off < 1 ? 0 : std::min(off - 1, texels_ - off);
    }

private:
    Shot shot_;
    std::vector<DVec2> exact_;
    int texels_;
    scene::View view_; // 2 units across the picture at distance 1
    Jobs jobs_{2};
    frame::Renderer renderer_{jobs_};
    image::Image picture_;
};

// The greatest error of one triangle over the whole picture.
double worst_of(ManyRepeats& scene, const Known& t, bool in_floats) {
    scene.draw(in_floats);
    double worst = 0;
    int seen = 0;
    for (int y = 0; y < scene.width(); ++y)
        for (int x = 0; x < scene.width(); ++x) {
            if (!scene.covered(x, y)) continue;
            const oracle::Twofold exact =
                oracle::perspective_at(t.corner, t.u, t.w, x * 256 + 128, y * 256 + 128);
            worst = std::max(worst, scene.error(x, y, exact.nearest()));
            ++seen;
        }
    EXPECT_GT(seen, scene.width() * scene.width() / 3);
    return worst;
}

class Row36 : public testing::TestWithParam<const char*> {};

// Up to 100 000 repeats of 256 texels from one vertex to the next, near ones and far ones.
TEST_P(Row36, AHundredThousandRepeatsInAFaceAreWithinA256thOfATexel) {
    constexpr int kSide = 192;
    for (const double repeats : {100.37, 10'000.123456, 100'000.654321})
        for (const double ratio : {1.0, 3.0, 1000.0}) {
            const Known t{{{{0, 0}, {kSide * 256, 64 * 256}, {32 * 256, kSide * 256}}},
                          {1, ratio, 1},
                          {0.123456789, repeats, -repeats / 3}};
            ManyRepeats scene(kSide, 256);
            scene.options().interpolate = GetParam();
            scene.add(t);
            const double naive = worst_of(scene, t, true), ours = worst_of(scene, t, false);
            EXPECT_LE(ours, 1.0 / 256) << repeats << " repeats, distances as 1 to " << ratio;
            EXPECT_TRUE(repeats < 1000 || naive > 8.0 / 256) << repeats;
            record("naive_in_texels", naive);
            record("ours_in_texels", ours);
        }
}
INSTANTIATE_TEST_SUITE_P(Rungs, Row36, testing::Values("perspective", "adaptive"),
                         [](const auto& rung) { return std::string(rung.param); });

// A floor up to the horizon, under the eye and behind it: its triangles are cut by the near plane.
TEST(Row36, AFloorThatPassesUnderTheEyeKeepsItsTexels) {
    constexpr int kSide = 128;
    constexpr double kBelow = 2, kReach = 32768, kPerUnit = 1.0000123;
    ManyRepeats scene(kSide, 256);
    const float y = -kBelow, r = kReach;
    const std::array<Vec3, 4> corner = {Vec3(-r, y, r), Vec3(r, y, r), Vec3(r, y, -r),
                                        Vec3(-r, y, -r)};
    const double u = kReach * kPerUnit;
    scene.add({corner[0], corner[1], corner[2]}, {-u, u, u});
    scene.add({corner[0], corner[2], corner[3]}, {-u, u, -u});
    double worst[2] = {0, 0};
    for (const bool in_floats : {false, true}) {
        scene.draw(in_floats);
        int seen = 0;
        for (int row = kSide / 2 + 1; row < kSide; ++row)
            for (int x = 0; x < kSide; ++x) {
                ASSERT_TRUE(scene.covered(x, row));
                const double down = (row + 0.5) / (kSide / 2.0) - 1,
                             across = (x + 0.5) / (kSide / 2.0) - 1;
                worst[in_floats ? 1 : 0] =
                    std::max(worst[in_floats ? 1 : 0],
                             scene.error(x, row, across * kBelow / down * kPerUnit));
                ++seen;
            }
        EXPECT_GT(seen, 8000);
    }
    EXPECT_LE(worst[0], 1.0 / 256);
    EXPECT_GT(worst[1], 8.0 / 256);
    record("ours_in_texels", worst[0]);
    record("naive_in_texels", worst[1]);
}

// Whole repeats are those of the map after its -s; mirrored tiles stay in step.
TEST(Row36, ManyRepeatsStayInStepUnderScaleAndMirror) {
    constexpr int kSide = 64;
    for (const float scale : {0.3F, 2.5F, 1.0F})
        for (const char* wrap : {"repeat", "mirror"}) {
            const auto picture = [&](double first) {
                // `first`: an even number of repeats of either scale.
                ManyRepeats scene(kSide, 16);
                scene.material().map_diffuse.edit().scale = Vec3(scale, 1, 1);
                scene.options().wrap = wrap;
                const Known t{{{{0, 0}, {kSide * 256, 0}, {0, kSide * 256}}},
                              {1, 1, 1},
                              {first, first + 3.7, first + 1.9}};
                scene.add(t);
                scene.draw(false);
                return scene.picture();
            };
            const image::Image near = picture(0), far = picture(100'000);
            int different = 0;
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x)
                    different += near.at(x, y) == far.at(x, y) ? 0 : 1;
            EXPECT_LE(different, kSide / 4) << scale << ' ' << wrap; // on the border of texels
        }
}

// Under -clamp on nothing is moved: what lies past the texture is its border, however far.
TEST(Row36, ManyRepeatsOfAClampedMapAreItsBorder) {
    constexpr int kSide = 64;
    for (const bool by_option : {false, true}) {
        ManyRepeats scene(kSide, 16);
        if (!by_option)
            scene.material().map_diffuse.edit().wrap_u =
                scene.material().map_diffuse.edit().wrap_v = scene::Wrap::clamp;
        if (by_option) scene.options().wrap = "clamp";
        const Known t{{{{0, 0}, {kSide * 256, 0}, {0, kSide * 256}}}, {1, 1, 1}, {-1e5, 3e5, -1e5}};
        scene.add(t);
        scene.draw(false);
        int first = 0, last = 0;
        for (int x = 0; x < kSide - 1; ++x) {
            const image::Rgba8 shown = scene.picture().at(x, 0);
            first += texel_of(shown) == 0 ? 1 : 0;
            last += texel_of(shown) == 15 ? 1 : 0;
        }
        EXPECT_EQ(first, kSide / 4);
        EXPECT_EQ(first + last, kSide - 1);
    }
}

} // namespace
} // namespace scanout::test
