// A triangle is shaded once a pixel, at any number of samples: the count of items is what the
// visibility buffer says, and on pictures simple enough what a reader can count.
#include "raster/screen/primitive.h"
#include "support/scenes.h"

#include <set>

namespace scanout::test {
namespace {

constexpr int kSamples[] = {1, 2, 4, 8, 16};

// Primitives seen in a pixel, summed over the pixels.
std::uint64_t ids_in_pixels(const frame::Visibility& v) {
    const std::size_t pixels =
        static_cast<std::size_t>(v.width) * static_cast<std::size_t>(v.height);
    std::uint64_t count = 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        std::set<std::uint32_t> ids;
        for (std::size_t at = pixel; at < v.id.size(); at += pixels)
            ids.insert(v.id[at]);
        ids.erase(raster::kNoPrimitive);
        count += ids.size();
    }
    return count;
}

struct Drawn {
    std::uint64_t items, ids;
};
Drawn items_of(const Shot& s, int threads = 1, int tile_size = 64) {
    frame::FrameStats stats;
    frame::Visibility seen;
    draw(s, {.threads = threads, .tile_size = tile_size, .stats = &stats, .visibility = &seen});
    return {stats.items_shaded, ids_in_pixels(seen)};
}

TEST(ItemsShaded, AreThePrimitivesSeenInEveryPixel) {
    std::vector<Shot> shots = golden_shots();
    shots.push_back(soup("soup", 3000, 0.8, 1));
    shots.push_back(soup("soup_around_the_eye", 500, 6, 2));
    std::uint64_t items = 0, most = 0;
    for (Shot& s : shots) {
        if (s.name == "transparency_sorted" || s.name == "transparency_exact" ||
            s.name == "map_opacity" || s.name.starts_with("see_through"))
            continue; // a sample shows more than one
        // Likewise, and pictures that show nothing.
        if (s.options.blend != "auto" || s.options.depth_test != "auto") continue;
        if (s.options.stencil != "auto") continue; // likewise
        if (s.options.aa != "auto") continue;      // what is said here of numbers of samples
        s.options.width = 150;
        s.options.height = 97;
        for (const int samples : kSamples) {
            s.options.samples = samples;
            const Drawn d = items_of(s, 1 + samples % 3, samples > 2 ? 64 : 16);
            EXPECT_EQ(d.items, d.ids) << s.name << " at " << samples << " samples";
            EXPECT_GT(d.items, 100U) << s.name;
            items += d.items;
            most = std::max(most, d.items);
        }
    }
    EXPECT_GT(most, 150U * 97); // pixels that several share are among them
    testing::Test::RecordProperty("items", testing::PrintToString(items));
}

// Mesh x, y are pixels, y up from the lower left corner; z greater is nearer.
Shot in_pixels(int width, int height) {
    Shot s = shot("pixels", width, height);
    s.scene.materials = {plain({0.5F, 0.5F, 0.5F})};
    return s;
}
std::uint64_t items_in_pixels(const Shot& s) {
    frame::FrameStats stats;
    draw_in_pixels(s, {.threads = 2, .stats = &stats});
    return stats.items_shaded;
}
void add_covering(Shot& s, float x0, float y0, float x1, float y1, float z) {
    add_quad(s.scene.mesh, {{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}}, {0, 0, 1}, 0);
}

// Twenty pixels on a side, cut from corner to corner of twenty pixels. On the screen the cut rises
// to the right: the two samples of a pair lie on its two sides.
TEST(ItemsShaded, OfASquareAreItsPixelsAndOnceMoreThoseOfItsDiagonal) {
    for (const int samples : kSamples) {
        Shot s = in_pixels(100, 80);
        s.options.samples = samples;
        add_covering(s, 50, 30, 70, 50, 0.5F);
        EXPECT_EQ(items_in_pixels(s), samples == 1 ? 400U : 420U) << samples;
    }
}

TEST(ItemsShaded, OfWhatIsHiddenAreNone) {
    for (const int samples : kSamples) {
        Shot s = in_pixels(100, 80);
        s.options.samples = samples;
        const std::uint64_t diagonal = samples == 1 ? 0 : 1;
        add_covering(s, 10, 10, 50, 50, 0.3F);
        add_covering(s, 10, 10, 50, 50, 0.4F);
        EXPECT_EQ(items_in_pixels(s), 1600 + 40 * diagonal) << samples;
        add_covering(s, 20, 20, 40, 40, 0.5F); // the cuts are one line
        EXPECT_EQ(items_in_pixels(s), 1600 + 40 * diagonal) << samples;
    }
}

TEST(ItemsShaded, OfLinesAndPointsAreOneAPixel) {
    for (const int samples : kSamples) {
        Shot s = in_pixels(64, 64);
        s.options.samples = samples;
        geom::Mesh& mesh = s.scene.mesh;
        add_line(mesh, add_vertex(mesh, {3.5F, 7.5F, 0.5F}), add_vertex(mesh, {23.5F, 7.5F, 0.5F}),
                 0);
        add_point(mesh, add_vertex(mesh, {40.5F, 40.5F, 0.5F}), 0);
        EXPECT_EQ(items_in_pixels(s), 22U) << samples;
    }
}

} // namespace
} // namespace scanout::test
