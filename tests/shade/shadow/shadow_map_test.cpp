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
        block->position[2][lane] = static_cast<float>(height(x, y));
    }
    double height(double x, double y) const { return -lean * x - 0.1 * y; }
    void lean_by(double slope) {
        lean = slope;
        triangle.facing[0] = static_cast<float>(lean);
        triangle.facing[1] = 0.1F;
        triangle.facing[2] = 1;
        const double corner[3][2] = {{-50, -50}, {50, -50}, {0, 50}};
        for (int k = 0; k < 3; ++k) {
            const double x = corner[k][0], y = corner[k][1], at[3] = {x, y, height(x, y)};
            for (int c = 0; c < 3; ++c)
                triangle.position[c][k] = static_cast<float>(at[c]);
        }
    }
    // The plane itself, and about it noise of so many texels' width.
    void map_the_plane(double noise, Random& random) {
        map.depth_scale = 0x1p-12F;
        for (int y = 0; y < map.size; ++y)
            for (int x = 0; x < map.size; ++x) {
                const double middle = 0.5 * map.size - 0.5;
                const double z = height(x - middle, middle - y) + random.in(-noise, noise);
                depth[static_cast<std::size_t>(y * map.size + x)] =
                    static_cast<float>(z * 0x1p-12 + 0.5);
            }
    }
    // Each lane's share of the light.
    std::vector<float> shares(int filter) {
        frame.shadow_filter = filter;
        std::fill_n(block->light[0].colour[0], kPaddedBlock, 1.0F);
        stage("shadow", "map_pcf").run(*block, frame);
        return {block->light[0].colour[0], block->light[0].colour[0] + kBlockSize};
    }
    void SetUp() override {
        for (int k = 0; k < 3; ++k)
            map.rotation[k][k] = 1;
        lean_by(0.2);
        light.kind = scene::LightKind::directional;
        light.towards = {0, 0, 1};
        block->count = 0;
        add_items(*block, &triangle, kBlockSize);
        block->light.resize(1);
        frame.lights = {&light, 1};
        frame.varies = {&varies, 1};
        shadow.maps = {&map, 1};
        shadow.casts = true;
        frame.shadows = &shadow;
    }

    scene::Material material = scanout::test::plain(Vec3(1));
    std::unique_ptr<ShadingBlock> block = new_block(material);
    FrameState frame = identity_frame();
    scene::ViewLight light;
    bool varies = true;
    Primitive triangle{};
    double lean = 0;
    std::vector<float> depth;
    ShadowMap map;
    LightShadow shadow;
};

TEST_F(ShadowMaps, SayTheSameOfALaneWhateverLanesAreBesideIt) {
    Random random(5);
    int partly = 0, moved = 0;
    for (const int size : {64, 8})
        for (int filter = 1; filter <= kMaxFilter; ++filter) {
            make_map(size, random);
            // In the middle, and where a square reaches beyond the border.
            const double inside = size == 64 ? 15 : 1, everywhere = 0.5 * size;
            const auto any_place = [&](int lane, double most) {
                place(lane, random.in(-most, most), random.in(-most, most));
            };
            for (int lane = 0; lane < kPaddedBlock; ++lane)
                any_place(lane, inside);
            std::vector<float> first;
            scanout::test::on_every_target([&](const std::string&) {
                const std::vector<float> alone = shares(filter);
                if (first.empty()) first = alone;
                EXPECT_EQ(alone, first) << filter;
            });
            for (int lane = 0; lane < kBlockSize; lane += 3)
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

// Where all that a register asks of surely lies low, or far behind, there are no more questions.
TEST_F(ShadowMaps, SayTheSameOfWhatLiesLowBesideWhatDoesNot) {
    Random random(8);
    int lit = 0, partly = 0, dark = 0;
    for (const double slope : {0.2, 3.0, 14.0, 40.0, 300.0})
        for (const double noise : {0.0, 1.0, 4.0, 40.0, 400.0})
            for (const int filter : {1, 2, 3, 4, 7}) {
                lean_by(slope);
                make_map(64, random);
                map_the_plane(noise, random);
                for (int x = 0; x < 12; ++x) // a tower in one corner, in another a pit
                    for (int y = 0; y < 12; ++y) {
                        depth[static_cast<std::size_t>(y * 64 + x)] = 100;
                        depth[static_cast<std::size_t>((63 - y) * 64 + x)] = 0;
                    }
                for (int x = 32; x < 64; ++x) // and half a roof over it all
                    for (int y = 0; y < 64; ++y)
                        depth[static_cast<std::size_t>(y * 64 + x)] +=
                            random.whole(0, 3) > 0 ? 40 * static_cast<float>(random.in(0, 1)) : 0;
                for (int lane = 0; lane < kPaddedBlock; ++lane)
                    place(lane, random.in(-14, 14), random.in(-14, 14));
                for (int lane = 0; lane < kBlockSize; lane += 8) { // registers of one place each
                    for (int k = 1; k < 8; ++k)
                        for (auto& axis : block->position)
                            axis[lane + k] = axis[lane];
                }
                const std::vector<float> alone = shares(filter);
                for (const double corner : {27, -27}) {
                    for (int lane = 3; lane < kBlockSize; lane += 4)
                        place(lane, -27, corner);
                    scanout::test::on_every_target([&](const std::string&) {
                        const std::vector<float> beside = shares(filter);
                        for (std::size_t lane = 0; lane < beside.size(); ++lane)
                            EXPECT_TRUE(lane % 4 == 3 ? (beside[lane] < 1) == (corner > 0)
                                                      : beside[lane] == alone[lane])
                                << slope << ' ' << noise << ' ' << filter;
                    });
                }
                for (const float share : alone) {
                    lit += share == 1 ? 1 : 0;
                    dark += share == 0 ? 1 : 0;
                    partly += share > 0 && share < 1 ? 1 : 0;
                }
            }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(dark, 1000);
    EXPECT_GT(partly, 1000);
}

} // namespace
} // namespace scanout::shade::test
