// Where triangles are clipped, and into which tiles a picture is cut, changes nothing of what is
// covered: HARD-CASES 12, P7, P8.
#include "oracle/homogeneous.h"
#include "raster/exactly_once.h"
#include "raster/off_screen_mesh.h"

#include <cmath>

namespace scanout::raster::test {
namespace {

using oracle::ClipPoint;
using oracle::HomogeneousTriangle;
using oracle::Place;

constexpr double kGuards[] = {0, 1, 0x1p11, 32767};
constexpr double kSnapped = 1.0 / 256; // an edge passes within this of where it was before snapping

Planes draw_guarded(Jobs& jobs, const geom::Mesh& mesh, const scene::View& view, int width,
                    int height, double guard, int tile_size = 64, int samples = 1) {
    Geometry geometry;
    GeometryOptions options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    options.tile_size = tile_size;
    ScreenTransform transform(view, width, height);
    if (guard < 32767) transform.set_guard(guard);
    geometry.run(jobs, mesh, transform, options);
    Planes out{width, samples, {}, {}};
    out.ids.resize(out.at(0, height));
    out.depths.resize(out.at(0, height));
    VisibilityTile tile;
    for (int i = 0; i < geometry.tiles(); ++i) {
        tile.reset(geometry.tile_area(i), samples);
        geometry.draw(i, tile);
        for (int y = tile.area().y0; y < tile.area().y1; ++y)
            for (int x = tile.area().x0; x < tile.area().x1; ++x)
                for (int s = 0; s < samples; ++s) {
                    out.ids[out.at(x, y, s)] = tile.id(x, y, s);
                    out.depths[out.at(x, y, s)] = tile.depth(x, y, s);
                }
    }
    return out;
}

ClipPoint<double> projected(const scene::View& view, int width, int height, const Vec3& p) {
    const double w = -p.z;
    return {(p.x / view.half_width + w) * (width / 2.0),
            (w - p.y / view.half_height) * (height / 2.0), w};
}

// HARD-CASES P7: guard bands of 0, 1, 2^11 and 2^15 pixels around the picture.
TEST(Guard, ItsWidthChangesNoSampleFurtherThanASnapFromAnEdge) {
    constexpr int kWidth = 60, kHeight = 44;
    const scene::View view = eye_view(0.6, 0.44, 0);
    Jobs jobs(1);
    Random random(1);
    std::int64_t compared = 0, close = 0, differ = 0;
    for (int i = 0; i < 4000; ++i) {
        const double size = std::exp2(random.in(-3, 9));
        std::array<Vec3, 3> v;
        for (Vec3& p : v) {
            p = Vec3(random.in_cube(size));
            if (i % 2 == 0) p.z = -std::abs(p.z) - 0.01F;
        }
        geom::Mesh mesh;
        add_triangle(mesh, v);
        const HomogeneousTriangle<double> exact(
            projected(view, kWidth, kHeight, v[0]), projected(view, kWidth, kHeight, v[1]),
            projected(view, kWidth, kHeight, v[2]), view.near_distance);
        std::vector<Planes> planes;
        for (const double guard : kGuards)
            planes.push_back(draw_guarded(jobs, mesh, view, kWidth, kHeight, guard));
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const Place place = exact.place(x + 0.5, y + 0.5, kSnapped);
                close += place == Place::close ? 1 : 0;
                for (const Planes& p : planes) {
                    differ += p.id(x, y) != planes.back().id(x, y) ? 1 : 0;
                    if (place == Place::close) continue;
                    ++compared;
                    ASSERT_EQ(p.id(x, y) == 0, place == Place::inside)
                        << i << ": " << x << ' ' << y << " guard " << kGuards[&p - planes.data()];
                }
            }
    }
    EXPECT_GT(compared, 1000000);
    record("samples_compared", static_cast<double>(compared));
    record("samples_within_1/256_px", static_cast<double>(close));
    record("samples_that_differ_there", static_cast<double>(differ));
}

// HARD-CASES 1, 12, P7: never a gap or a double hit, where every triangle at the picture's rim is
// clipped and its neighbours are not.
TEST(Guard, MeshesAcrossThePicturesEdgesAreCoveredOnceAtEveryWidth) {
    Jobs jobs(1);
    Random random(2);
    constexpr int kSide = 64;
    std::int64_t once = 0;
    for (int i = 0; i < 40; ++i) {
        const SnappedMesh snapped = i % 4 == 0
                                        ? fan({32 * 256 + 128, 20 * 256 + 128}, 1000, around(kSide))
                                    : i % 4 == 1 ? jittered_grid(random, kSide)
                                    : i % 4 == 2 ? delaunay(random, 60, around(kSide, 100))
                                                 : turned_grid(random.in(0, 90), kSide);
        geom::Mesh mesh[2];
        for (const bool falling : {false, true})
            mesh[falling ? 1 : 0] = mesh_of(snapped, kSide, falling);
        for (const double guard : kGuards) {
            const int samples = i % 2 == 0 ? 1 : 4;
            const Planes a = draw_guarded(jobs, mesh[0], pixel_view(kSide, kSide), kSide, kSide,
                                          guard, 64, samples),
                         b = draw_guarded(jobs, mesh[1], pixel_view(kSide, kSide), kSide, kSide,
                                          guard, 64, samples);
            for (std::size_t k = 0; k < a.ids.size(); ++k) {
                ASSERT_NE(a.ids[k], kNoPrimitive) << i << " guard " << guard;
                ASSERT_EQ(a.ids[k], b.ids[k]) << i << " guard " << guard;
                ++once;
            }
        }
    }
    record("samples_covered_once", static_cast<double>(once));
}

// Of every triangle alone.
Hits hits_one_by_one(Jobs& jobs, const OffScreenMesh& off_screen, double guard, int samples) {
    constexpr int kSide = OffScreenMesh::kSide;
    std::vector<int> count(static_cast<std::size_t>(kSide * kSide * samples));
    for (std::size_t t = 0; t < off_screen.triangle.size(); ++t) {
        geom::Mesh mesh;
        add_triangle(mesh, off_screen.corners(t));
        const Planes planes =
            draw_guarded(jobs, mesh, OffScreenMesh::view(), kSide, kSide, guard, 64, samples);
        for (std::size_t k = 0; k < count.size(); ++k)
            count[k] += planes.ids[k] == 0 ? 1 : 0;
    }
    Hits hits;
    for (const int n : count)
        (n == 0 ? hits.none : n == 1 ? hits.once : hits.more) += 1;
    return hits;
}

using Generator = std::optional<OffScreenMesh> (*)(Random&, double guard);
void expect_once(Generator make, int meshes, std::uint64_t seed) {
    Jobs jobs(1);
    Random random(seed);
    for (const double guard : kGuards) {
        Hits all;
        int drawn = 0, tries = 0;
        for (; drawn < meshes && tries < 100 * meshes; ++tries) {
            const std::optional<OffScreenMesh> mesh = make(random, guard);
            if (!mesh) continue;
            all += hits_one_by_one(jobs, *mesh, guard, drawn % 4 == 3 ? 8 : 1);
            ++drawn;
        }
        EXPECT_EQ(drawn, meshes);
        EXPECT_EQ(all.none, 0) << "guard " << guard;
        EXPECT_EQ(all.more, 0) << "guard " << guard;
        const std::string name = "_at_guard_" + testing::PrintToString(guard);
        record("once" + name, static_cast<double>(all.once));
        record("tries" + name, tries);
    }
}

// HARD-CASES 3, 8, 12, P7: never a gap or a double hit, slivers included.
TEST(Guard, ASliverWithAnEndOffTheScreenAndItsNeighboursCoverEverySampleOnce) {
    expect_once(sliver, 2000, 4);
}
TEST(Guard, TrianglesAboutAVertexOfThePictureCoverEverySampleOnceWhereverTheirRimLies) {
    expect_once(star, 1000, 5);
}
TEST(Guard, TrianglesAboutAVertexOffThePictureCoverEverySampleOnce) {
    expect_once(comb, 1000, 6);
}

// HARD-CASES P8: tiles of 8, 16, 32 and 64 pixels, on 1, 2, 3, 7 and 16 threads; colour is compared
// by the table of hashes.
TEST(Guard, TheSizeOfTilesChangesNoBit) {
    Random random(3);
    int pictures = 0;
    for (const double size : {0.2, 1.0, 30.0}) {
        geom::Mesh mesh;
        for (int t = 0; t < 300; ++t) {
            const DVec3 middle = random.in_cube(size);
            std::array<Vec3, 3> v;
            for (Vec3& p : v)
                p = Vec3(middle + random.in_cube(size * (t % 3 == 0 ? 1 : 0.1)));
            add_triangle(mesh, v);
        }
        for (std::uint32_t i = 0; i < 200; ++i) {
            mesh.line_index.insert(mesh.line_index.end(), {3 * i, 3 * i + 1});
            mesh.line_material.push_back(-1);
            mesh.point_index.push_back(3 * i + 2);
            mesh.point_material.push_back(-1);
        }
        for (const int samples : {1, 2, 4, 8, 16}) {
            const scene::View view = eye_view(0.5, 0.4, samples % 3 == 1 ? 1 : 0.01);
            Jobs one(1);
            const Planes first = draw_guarded(one, mesh, view, 203, 137, 32767, 64, samples);
            for (const int tile_size : {8, 16, 32, 64}) {
                for (const int threads : {1, 2, 3, 7, 16}) {
                    Jobs jobs(threads);
                    ASSERT_TRUE(draw_guarded(jobs, mesh, view, 203, 137, 32767, tile_size,
                                             samples) == first)
                        << size << ' ' << samples << ' ' << tile_size << ' ' << threads;
                    ++pictures;
                }
            }
        }
    }
    record("pictures_equal", pictures);
}

} // namespace
} // namespace scanout::raster::test
