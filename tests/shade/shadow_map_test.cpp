// What a filtered shadow map says of a lane does not hang on the lanes beside it: several texels of
// a row are read at once only where no lane of the register asks beyond the map's border.
#include "shade/block.h"
#include "shade/shadow.h"

#include <bit>
#include <cmath>

namespace scanout::shade::test {
namespace {

// A parallel light that looks down -z on a slanted plane, under which the map is noise.
class ShadowMaps : public testing::Test {
protected:
    void make_map(int size, Random& random) {
        depth.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
        for (float& d : depth)
            d = static_cast<float>(random.in(0, 1));
        map.size = size;
        map.half = 0.5F * static_cast<float>(size);
        map.depth_scale = 1.0F / 64;
        map.depth_offset = 0.5F;
        map.depth = depth.data();
    }
    void place(int lane, double x, double y) {
        block->position[0][lane] = static_cast<float>(x);
        block->position[1][lane] = static_cast<float>(y);
        block->position[2][lane] = static_cast<float>(-0.2 * x - 0.1 * y);
    }
    // Each lane's share of the light.
    std::vector<float> shares(int filter) {
        frame.shadow_filter = filter;
        std::fill_n(block->light[0].colour[0], kRoom, 1.0F);
        stage("shadow", "map_pcf").run(*block, frame);
        return {block->light[0].colour[0], block->light[0].colour[0] + kLanes};
    }
    void SetUp() override {
        for (int k = 0; k < 3; ++k) {
            triangle.facing[k] = k == 2 ? 1.0F : k == 0 ? 0.2F : 0.1F;
            map.turn[k][k] = 1;
        }
        const DVec3 corner[3] = {{-50, -50, 15}, {50, -50, -5}, {0, 50, -5}};
        for (int k = 0; k < 3; ++k)
            for (int c = 0; c < 3; ++c)
                triangle.position[c][k] = static_cast<float>(corner[k][c]);
        light.kind = scene::LightKind::directional;
        light.towards = {0, 0, 1};
        block->count = 0;
        add_lanes(*block, &triangle, kLanes);
        block->light.resize(1);
        frame.lights = {&light, 1};
        frame.varies = {&varies, 1};
        shadow.maps = {&map, 1};
        shadow.casts = true;
        frame.shadows = &shadow;
    }

    scene::Material material = scanout::test::plain(Vec3(1));
    std::unique_ptr<Block> block = new_block(material);
    FrameState frame = identity_frame();
    scene::ViewLight light;
    bool varies = true;
    Primitive triangle{};
    std::vector<float> depth;
    ShadowMap map;
    LightShadow shadow;
};

TEST_F(ShadowMaps, SayTheSameOfALaneWhateverLanesAreBesideIt) {
    Random random(5);
    int partly = 0, moved = 0;
    for (const int size : {64, 8})
        for (int filter = 1; filter <= kMostFilter; ++filter) {
            make_map(size, random);
            // In the middle, and where a square reaches beyond the border.
            const double inside = size == 64 ? 15 : 1, everywhere = 0.5 * size;
            const auto any_place = [&](int lane, double most) {
                place(lane, random.in(-most, most), random.in(-most, most));
            };
            for (int lane = 0; lane < kRoom; ++lane)
                any_place(lane, inside);
            std::vector<float> first;
            scanout::test::on_every_target([&](const std::string&) {
                const std::vector<float> alone = shares(filter);
                if (first.empty()) first = alone;
                EXPECT_EQ(alone, first) << filter;
            });
            for (int lane = 0; lane < kLanes; lane += 3)
                any_place(lane, everywhere);
            std::vector<float> first_beside;
            scanout::test::on_every_target([&](const std::string&) {
                const std::vector<float> beside = shares(filter);
                if (first_beside.empty()) first_beside = beside;
                EXPECT_EQ(beside, first_beside) << filter;
                for (std::size_t lane = 0; lane < beside.size(); ++lane)
                    EXPECT_TRUE(lane % 3 == 0 || beside[lane] == first[lane]) << filter;
            });
            for (std::size_t lane = 0; lane < first.size(); ++lane) {
                partly += first[lane] > 0 && first[lane] < 1 ? 1 : 0;
                moved += first[lane] != first_beside[lane] ? 1 : 0;
            }
        }
    EXPECT_GT(partly, 2000);
    EXPECT_GT(moved, 500);
}

} // namespace
} // namespace scanout::shade::test
