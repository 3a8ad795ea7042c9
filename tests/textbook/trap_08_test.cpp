// T8 [Compendium 8], HARD-CASES T8: spans from (int)sx to x <= ex.
#include "raster/exactly_once.h"
#include "textbook/trap_page.h"

namespace scanout::textbook::test {
namespace {

std::vector<Points> triangles_of(const raster::test::SnappedMesh& mesh) {
    std::vector<Points> out;
    for (std::size_t i = 0; i < mesh.triangle.size(); ++i) {
        Points p;
        const raster::test::Corners v = mesh.corners(i);
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = DVec2(v[k].x / 256.0 - 0.5, v[k].y / 256.0 - 0.5);
        out.push_back(p);
    }
    return out;
}

// In the picture of 64 x 64 pixels.
std::map<Pixel, int> hits_of(FillMethod fill, const std::vector<Points>& triangles) {
    std::map<Pixel, int> hits;
    for (const Points& p : triangles) {
        std::set<Pixel> own; // a triangle that draws a line of its own twice is no double hit
        fill(p, [&](int y, int x0, int x1) {
            for (int x = x0; x < x1; ++x)
                if (x >= 0 && x < 64 && y >= 0 && y < 64) own.insert({x, y});
        });
        for (const Pixel& pixel : own)
            ++hits[pixel];
    }
    return hits;
}

int doubles(const std::map<Pixel, int>& hits) {
    int count = 0;
    for (const auto& [pixel, n] : hits)
        count += n > 1 ? 1 : 0;
    return count;
}

TEST(Trap08, SpansThatHoldBothEndsDrawSharedEdgesTwice) {
    // Two triangles of a square of 8 x 8: the diagonal belongs to both.
    const std::vector<Points> square = {{DVec2(0, 0), DVec2(8, 0), DVec2(8, 8)},
                                        {DVec2(0, 0), DVec2(8, 8), DVec2(0, 8)}};
    EXPECT_EQ(doubles(hits_of(fill_flat_halves, square)), 9);
    EXPECT_EQ(hits_of(fill_flat_halves, square).size(), 81U); // 9 x 9
    for (const FillMethod fill : {fill_x_scanline, fill_box_all_edges, fill_box_edge_functions}) {
        EXPECT_EQ(doubles(hits_of(fill, square)), 0);
        EXPECT_EQ(hits_of(fill, square).size(), 64U);
    }

    raster::test::Random random(8);
    const raster::test::SnappedMesh mesh = raster::test::jittered_grid(random);
    const auto naive = hits_of(fill_flat_halves, triangles_of(mesh));
    EXPECT_GT(doubles(naive), 1000);
    const raster::test::Hits ours = raster::test::hits_in_tile(mesh, 0, 0, 1);
    EXPECT_EQ(ours.faults(), 0);
    EXPECT_EQ(ours.once, 64 * 64);
    check_page(
        {8, "shared-edges", "Shared edges",
         "Spans from (int)sx to x <= ex hold both ends, so triangles with a common edge both "
         "draw it (red: drawn more than once): blending doubles there; the top-left rule gives "
         "every pixel to one of them.",
         "[Compendium 8]",
         fmt::format("{} of 4096 pixels are drawn more than once, ours draws each once",
                     doubles(naive)),
         enlarged(picture_of(naive, 64, 64), 3),
         enlarged(picture_of(production_hits(triangles_of(mesh)), 64, 64), 3)});
}

} // namespace
} // namespace scanout::textbook::test
