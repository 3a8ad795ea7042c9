// HARD-CASES P4, OpenGL's rule: a primitive that moves by whole pixels moves its fragments along,
// and they hold the same values. What the stages interpolate is read by a stage behind them.
#include "oracle/placed.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace scanout::test {
namespace {

using oracle::Corner;
using oracle::Corners;

constexpr int kWholeSide = 128, kReach = 64; // pixels
constexpr int kCell = 16;                    // a triangle each, four of them in the middle

struct Fragment {
    int x, y; // pixel
    // u, v, Kd times colour, normal: as bits
    std::array<std::uint32_t, 8> values;
};
std::vector<Fragment> fragments; // of the frame drawn last

const shade::Stage kReader{
    {.axis = "test", .name = "reader", .blurb = "", .source = ""},
    shade::Pass::maps,
    {},
    [](shade::ShadingBlock& b, const shade::FrameState&) {
        for (int i = 0; i < b.count; ++i) {
            const float value[] = {b.u[i],         b.v[i],         b.albedo[0][i], b.albedo[1][i],
                                   b.albedo[2][i], b.normal[0][i], b.normal[1][i], b.normal[2][i]};
            Fragment& f = fragments.emplace_back(Fragment{b.x[i] >> 8, b.y[i] >> 8, {}});
            for (std::size_t k = 0; k < f.values.size(); ++k)
                f.values[k] = std::bit_cast<std::uint32_t>(value[k]);
        }
    }};

struct MovedTriangle {
    Corners corner;
    std::array<double, 3> w;
    std::array<Vec3, 3> normal, colour;
    std::array<Vec2, 3> uv;

    MovedTriangle(Random& random, int cell) {
        const int x = (kWholeSide / 2 - kCell + cell % 2 * kCell) * 256,
                  y = (kWholeSide / 2 - kCell + cell / 2 * kCell) * 256;
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = {x + random.whole(0, kCell * 256), y + random.whole(0, kCell * 256)};
            w[i] = oracle::few_bits(std::exp2(random.in(0, 10)));
            normal[i] = Vec3(random.in_cube(1));
            colour[i] = Vec3(random.in_cube(0.5) + DVec3(0.5));
            uv[i] = {static_cast<float>(random.in(-3, 3)), static_cast<float>(random.in(-3, 3))};
        }
    }
};

class Translation : public testing::TestWithParam<scene::Projection> {
protected:
    Translation() : shot_(shot("moved", kWholeSide, kWholeSide)) {
        shot_.scene.materials = {textured(0)};
        shot_.scene.textures = {checkers()};
        view_.projection = GetParam();
        view_.near_distance = 0x1p-12;
    }
    bool perspective() const { return GetParam() == scene::Projection::perspective; }
    // Its fragments, by rows.
    std::vector<Fragment> draw(const std::vector<MovedTriangle>& triangles, int dx, int dy) {
        geom::Mesh& mesh = shot_.scene.mesh = empty_mesh();
        for (const MovedTriangle& t : triangles) {
            std::uint32_t index[3];
            for (std::size_t i = 0; i < 3; ++i) {
                const Corner c{t.corner[i].x + dx * 256, t.corner[i].y + dy * 256};
                Vec3 p = oracle::placed(c, perspective() ? t.w[i] : 1, kWholeSide, kWholeSide);
                if (!perspective()) p.z = static_cast<float>(1 / t.w[i]);
                index[i] = add_vertex(mesh, p, t.normal[i]);
                mesh.uv.push_back(t.uv[i]);
                mesh.colour.push_back(t.colour[i]);
            }
            add_triangle(mesh, index[0], index[1], index[2], 0);
        }
        auto plan = frame::plan(shot_.options, frame::facts(shot_.scene));
        EXPECT_TRUE(plan);
        EXPECT_EQ(plan->stages.front()->card.axis, "interpolate");
        plan->stages.insert(plan->stages.begin() + 1, &kReader);
        fragments.clear();
        renderer_.render(shot_.scene, view_, *plan);
        std::sort(fragments.begin(), fragments.end(), [](const Fragment& a, const Fragment& b) {
            return std::pair(a.y, a.x) < std::pair(b.y, b.x);
        });
        return fragments;
    }

private:
    Shot shot_;
    scene::View view_; // 2 units across the picture at distance 1
    Jobs jobs_{1};
    frame::Renderer renderer_{jobs_};
};

// In perspective a triangle that moves on the screen turns in space: another side of its normals
// may face the eye.
bool same_values(Fragment a, const Fragment& b, bool either_side) {
    if (either_side && a.values[5] != b.values[5])
        for (std::size_t k = 5; k < 8; ++k)
            a.values[k] ^= 0x80000000;
    return a.values == b.values;
}

// Every shift in [-64, 64] squared. Stricter than P4, which allows a unit in the last place.
TEST_P(Translation, ByWholePixelsMovesEveryInterpolatedValueAlongToTheBit) {
    Random random(1);
    std::int64_t compared = 0;
    for (int dy = -kReach; dy <= kReach; ++dy) {
        std::vector<MovedTriangle> triangles;
        for (int cell = 0; cell < 4; ++cell)
            triangles.emplace_back(random, cell);
        const std::vector<Fragment> still = draw(triangles, 0, 0);
        for (int dx = -kReach; dx <= kReach; ++dx) {
            const std::vector<Fragment> moved = draw(triangles, dx, dy);
            auto next = moved.begin();
            for (const Fragment& f : still) {
                const int x = f.x + dx, y = f.y + dy;
                if (x < 0 || x >= kWholeSide || y < 0 || y >= kWholeSide)
                    continue; // has left the picture
                ASSERT_TRUE(next != moved.end() && next->x == x && next->y == y) << dx << ' ' << dy;
                ASSERT_TRUE(same_values(*next, f, perspective())) << dx << ' ' << dy;
                ++next;
                ++compared;
            }
            ASSERT_TRUE(next == moved.end()) << dx << ' ' << dy;
        }
    }
    EXPECT_GT(compared, 129 * 129 * 60);
    RecordProperty("fragments_equal", testing::PrintToString(compared));
}
INSTANTIATE_TEST_SUITE_P(P4, Translation,
                         testing::Values(scene::Projection::perspective,
                                         scene::Projection::orthographic),
                         [](const auto& tested) {
                             return tested.param == scene::Projection::perspective ? "perspective"
                                                                                   : "orthographic";
                         });

} // namespace
} // namespace scanout::test
