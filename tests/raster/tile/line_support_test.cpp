// Lines over the faces that they lie on: HARD-CASES 17. None of their samples is hidden at any
// tilt, none is more than two steps of the depth's precision in front, and none shines through.
#include "geom/line_faces.h"
#include "raster/coverage/depth_bias.h"
#include "raster/exact.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scanout::raster::test {
namespace {

using scanout::test::add_line;
using scanout::test::add_vertex;

constexpr int kFaceSide = 96;
constexpr double kTilts[] = {0, 20, 45, 60, 75, 85, 88, 89, 89.5, 89.9};
constexpr double kDegree = std::numbers::pi / 180;

// A line with vertices of its own, as a loader makes it.
void add_line_between(geom::Mesh& mesh, const Vec3& a, const Vec3& b) {
    const std::uint32_t first = add_vertex(mesh, a);
    add_line(mesh, first, add_vertex(mesh, b));
}

void add_edges(geom::Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.index.size(); ++i) {
        const Vec3 a = mesh.position[mesh.index[i]],
                   b = mesh.position[mesh.index[i % 3 == 2 ? i - 2 : i + 1]];
        if (a != b) add_line_between(mesh, a, b);
    }
}

// A plane through the origin: turned about z by `spin`, tilted from the eye by `tilt`, in degrees.
struct Plane {
    double spin, tilt, turn;
    Vec3 at(double u, double v) const {
        const double s = std::sin(spin * kDegree), c = std::cos(spin * kDegree);
        const double x = u * c - v * s, y = u * s + v * c;
        const double up = y * std::cos(tilt * kDegree), back = -y * std::sin(tilt * kDegree);
        const double ts = std::sin(turn * kDegree), tc = std::cos(turn * kDegree);
        return {static_cast<float>(x * tc - up * ts), static_cast<float>(x * ts + up * tc),
                static_cast<float>(back)};
    }
};

// One face of the file: a convex polygon, cut into a fan from its first corner.
void add_polygon(geom::Mesh& mesh, const std::vector<Vec3>& corner) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    const std::uint32_t face = mesh.face.empty() ? 0 : mesh.face.back() + 1;
    for (const Vec3& p : corner)
        add_vertex(mesh, p);
    for (std::uint32_t i = 2; i < corner.size(); ++i) {
        scanout::test::add_triangle(mesh, first, first + i - 1, first + i);
        mesh.face.back() = face;
    }
}

struct Counts {
    std::int64_t seen = 0, hidden = 0;
    double steps = 0; // the most that a line's sample is in front of the surface
    void operator+=(const Counts& o) {
        seen += o.seen;
        hidden += o.hidden;
        steps = std::max(steps, o.steps);
    }
};

// The samples that the lines have when nothing is before them, in the picture with all triangles.
Counts count(Jobs& jobs, const geom::Mesh& mesh, const scene::View& view, int samples) {
    geom::Mesh lines = mesh, surface = mesh;
    lines.index.clear();
    lines.material.clear();
    lines.face.clear();
    lines.line_faces = {};
    surface.line_index.clear();
    surface.line_material.clear();
    surface.line_faces = {};
    const Planes whole = draw_planes(jobs, mesh, view, kFaceSide, kFaceSide, samples),
                 alone = draw_planes(jobs, lines, view, kFaceSide, kFaceSide, samples),
                 bare = draw_planes(jobs, surface, view, kFaceSide, kFaceSide, samples);
    Counts counts;
    for (std::size_t i = 0; i < whole.ids.size(); ++i) {
        if (alone.ids[i] == kNoPrimitive) continue;
        const bool seen = whole.ids[i] != kNoPrimitive && whole.ids[i] >= mesh.triangles();
        (seen ? counts.seen : counts.hidden) += 1;
        if (!seen || bare.ids[i] == kNoPrimitive) continue;
        const double gap = double{whole.depths[i]} - double{bare.depths[i]};
        counts.steps = std::max(counts.steps, gap / depth_step(bare.depths[i]));
    }
    return counts;
}

scene::View view_of(bool perspective, double distance = 2.5) {
    scene::View view = eye_view(1.2 / distance, 1.2 / distance, distance, 0x1p-6);
    if (perspective) return view;
    view.projection = scene::Projection::orthographic;
    view.half_width = view.half_height = 1.2;
    view.translation = DVec3(0);
    view.depth_origin = -1.5;
    view.depth_scale = 1 / 3.0;
    return view;
}

class LineOnFace : public testing::TestWithParam<int> {}; // samples

// Edges and all diagonals of polygons, whichever way they were cut.
TEST_P(LineOnFace, IsSeenAtEverySampleAtEveryTilt) {
    Jobs jobs(1);
    Random random(1);
    for (const double tilt : kTilts) {
        Counts counts;
        for (int i = 0; i < 24; ++i) {
            const Plane plane{random.in(0, 360), tilt, random.in(0, 360)};
            const int n = 3 + i % 5;
            std::vector<Vec3> corner;
            for (int k = 0; k < n; ++k) {
                const double angle = (k + random.in(0, 0.6)) * 2 * std::numbers::pi / n;
                corner.push_back(plane.at(0.9 * std::cos(angle), 0.9 * std::sin(angle)));
            }
            geom::Mesh mesh = scanout::test::empty_mesh();
            add_polygon(mesh, corner);
            for (std::size_t a = 0; a < corner.size(); ++a)
                for (std::size_t b = a + 1; b < corner.size(); ++b)
                    add_line_between(mesh, corner[a], corner[b]);
            geom::find_line_faces(mesh);
            counts += count(jobs, mesh, view_of(i % 2 == 0), GetParam());
        }
        EXPECT_EQ(counts.hidden, 0) << tilt;
        EXPECT_GT(counts.seen, 1000) << tilt;
        EXPECT_LE(counts.steps, 2) << tilt;
        record("seen_at_" + std::to_string(tilt), static_cast<double>(counts.seen));
    }
}

// Lines from node to node across a plane of many faces, few of which they belong to.
TEST_P(LineOnFace, IsSeenAcrossOtherFacesOfItsPlane) {
    Jobs jobs(1);
    Random random(2);
    for (const double tilt : kTilts) {
        Counts counts;
        for (int i = 0; i < 12; ++i) {
            const Plane plane{random.in(0, 360), tilt, random.in(0, 360)};
            const auto node = [&](int x, int y) {
                return plane.at(x * 0.25 - 0.5, y * 0.25 - 0.5);
            };
            geom::Mesh mesh = scanout::test::empty_mesh();
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x)
                    add_polygon(mesh,
                                {node(x, y), node(x + 1, y), node(x + 1, y + 1), node(x, y + 1)});
            for (int k = 0; k < 12; ++k)
                add_line_between(mesh, node(random.whole(0, 4), random.whole(0, 4)),
                                 node(random.whole(0, 4), random.whole(0, 4)));
            geom::find_line_faces(mesh);
            counts += count(jobs, mesh, view_of(i % 2 == 0), GetParam());
        }
        EXPECT_EQ(counts.hidden, 0) << tilt;
        EXPECT_GT(counts.seen, 500) << tilt;
        record("steps_at_" + std::to_string(tilt), counts.steps);
    }
}

// A floor under and behind the eye: its triangles and its lines are clipped.
TEST_P(LineOnFace, IsSeenOnAFloorThatRunsBehindTheEye) {
    Jobs jobs(1);
    for (const double height : {0.5, 0.1, 0.01, 0.001}) {
        const auto y = static_cast<float>(-height);
        const std::vector<Vec3> corner = {{-1, y, 5}, {1.1F, y, 4}, {0.9F, y, -3}, {-0.7F, y, -4}};
        geom::Mesh mesh = scanout::test::empty_mesh();
        add_polygon(mesh, corner);
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a + 1; b < 4; ++b)
                add_line_between(mesh, corner[a], corner[b]);
        geom::find_line_faces(mesh);
        const Counts counts = count(jobs, mesh, eye_view(1, 1, 0), GetParam());
        EXPECT_EQ(counts.hidden, 0) << height;
        EXPECT_GT(counts.seen, 50) << height;
        EXPECT_LE(counts.steps, 2) << height;
    }
}

// All edges of a solid, its outline too: a line's pixel shows wherever the line's point shows.
TEST_P(LineOnFace, IsSeenOnTheSolidsSideThatIsSeen) {
    Jobs jobs(1);
    for (const int around : {4, 7, 16, 24}) {
        geom::Mesh mesh = scanout::test::empty_mesh();
        scanout::test::add_sphere(mesh, Vec3(0), 0.9F, around, around / 2);
        const Plane plane{33, 57, 12};
        for (Vec3& p : mesh.position) { // turned, its poles included
            const Vec3 a = plane.at(1, 0), b = plane.at(0, 1), c = cross3(a, b);
            p = a * p.x + b * p.y + c * p.z;
        }
        // Its front alone, whose lines must all show, and behind it the rest, whose lines must not.
        const scene::View view = view_of(true);
        const Planes front = [&] {
            geom::Mesh edges = mesh;
            add_edges(edges);
            geom::find_line_faces(edges);
            return draw_planes(jobs, edges, view, kFaceSide, kFaceSide, GetParam());
        }();
        geom::Mesh kept = scanout::test::empty_mesh();
        kept.position = mesh.position;
        kept.normal = mesh.normal;
        const ScreenTransform transform(view, kFaceSide, kFaceSide);
        for (std::uint32_t t = 0; t < mesh.triangles(); ++t) {
            ScreenVertex v[3];
            for (std::size_t k = 0; k < 3; ++k)
                v[k] = transform.transform(mesh.position[mesh.index[t * 3 + k]]);
            if (signed_area({v[0].x, v[1].x, v[2].x}, {v[0].y, v[1].y, v[2].y}) < 0)
                scanout::test::add_triangle(kept, mesh.index[t * 3], mesh.index[t * 3 + 1],
                                            mesh.index[t * 3 + 2]);
        }
        add_edges(kept);
        geom::find_line_faces(kept);
        const Counts counts = count(jobs, kept, view, GetParam());
        EXPECT_EQ(counts.hidden, 0) << around;
        EXPECT_GT(counts.seen, 200) << around;
        // Nothing but the front's lines is seen of the whole.
        const Planes alone = draw_planes(jobs, kept, view, kFaceSide, kFaceSide, GetParam());
        int through = 0;
        for (std::size_t i = 0; i < front.ids.size(); ++i) {
            const bool line = front.ids[i] != kNoPrimitive && front.ids[i] >= mesh.triangles();
            const bool triangle = alone.ids[i] < kept.triangles();
            through += line && triangle ? 1 : 0;
        }
        EXPECT_EQ(through, 0) << around;
    }
}

// Behind a surface by no more than what the surface moves in half a pixel, and 4 r.
TEST_P(LineOnFace, IsHiddenWhenItLiesBehindTheSurface) {
    Jobs jobs(1);
    Random random(3);
    std::int64_t seen = 0, expected = 0;
    for (int i = 0; i < 60; ++i) {
        // x and y are pixels, z is depth. The surface reaches beyond the lines.
        const double zx = random.in(-1, 1) * std::exp2(random.in(-20, -9)),
                     zy = random.in(-1, 1) * std::exp2(random.in(-20, -9));
        const auto depth = [&](double x, double y) {
            return 0.6 + (zx * (x - 48) + zy * (y - 48));
        };
        const auto at = [&](double x, double y, double back) {
            return Vec3(static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(depth(x, y) - back));
        };
        geom::Mesh mesh = scanout::test::empty_mesh();
        add_polygon(mesh, {at(0, 0, 0), at(96, 0, 0), at(96, 96, 0), at(0, 96, 0)});
        const double back = 4 * 0x1p-24 + (std::abs(zx) + std::abs(zy)) / 2;
        for (int k = 0; k < 10; ++k)
            add_line_between(mesh, at(random.whole(2, 94), random.whole(2, 94), back),
                             at(random.whole(2, 94), random.whole(2, 94), back));
        geom::find_line_faces(mesh);
        const Counts counts = count(jobs, mesh, pixel_view(kFaceSide, kFaceSide), GetParam());
        seen += counts.seen;
        expected += counts.hidden;
    }
    EXPECT_EQ(seen, 0);
    EXPECT_GT(expected, 10000);
}

INSTANTIATE_TEST_SUITE_P(Row17, LineOnFace, testing::Values(1, 2, 4, 8, 16),
                         [](const auto& samples) {
                             return "with_" + std::to_string(samples.param) + "_samples";
                         });

// Steep triangles of any shape, slivers too, as snapped: no plane is the plane of the file.
TEST(LineOnTriangle, IsSeenWhateverTheTrianglesSlope) {
    Jobs jobs(1);
    Random random(5);
    Counts counts;
    for (int i = 0; i < 400; ++i) {
        geom::Mesh mesh = scanout::test::empty_mesh();
        std::vector<Vec3> corner;
        for (int k = 0; k < 3; ++k)
            corner.emplace_back(static_cast<float>(random.whole(0, 96 * 256)) / 256,
                                static_cast<float>(random.whole(0, 96 * 256)) / 256,
                                static_cast<float>(std::exp2(random.in(-20, 0))));
        if (i % 3 == 0) {
            corner[2] = (corner[0] + corner[1]) * 0.5F;
            corner[2].x += static_cast<float>(random.whole(-300, 300)) / 256;
        }
        add_polygon(mesh, corner);
        add_edges(mesh);
        geom::find_line_faces(mesh);
        counts += count(jobs, mesh, pixel_view(kFaceSide, kFaceSide), 1 << (i % 5));
    }
    EXPECT_EQ(counts.hidden, 0);
    EXPECT_GT(counts.seen, 100000);
    EXPECT_LE(counts.steps, 2);
}

// The three edges at the far corner of a cube, seen so that some run behind diagonals and edges.
TEST(LineOnFace, OfTheFarSideDoesNotShineThroughWhereTrianglesMeet) {
    Jobs jobs(1);
    std::int64_t through = 0, hidden = 0;
    for (int turn = 0; turn < 72; ++turn) {
        if (turn % 18 == 0) continue; // sides are seen edge-on: far edges are on the outline
        const double s = std::sin(turn * 5 * kDegree), c = std::cos(turn * 5 * kDegree);
        const double up = turn % 2 == 0 ? 1 / std::sqrt(3.0) : 0.3, flat = std::sqrt(1 - up * up);
        const auto turned = [&](const Vec3& p) {
            const double x = p.x * c + p.z * s, z = p.z * c - p.x * s;
            return Vec3(static_cast<float>(x), static_cast<float>(p.y * flat - z * up),
                        static_cast<float>(p.y * up + z * flat));
        };
        geom::Mesh surface = scanout::test::empty_mesh();
        scanout::test::add_cube(surface, 0.55F, 0);
        Vec3 far(0.55F);
        for (const Vec3& p : surface.position)
            if (turned(p).z < turned(far).z) far = p;
        for (Vec3& p : surface.position)
            p = turned(p);
        geom::Mesh mesh = surface;
        const scene::View view = view_of(turn % 4 < 2);
        const ScreenTransform screen(view, kFaceSide, kFaceSide);
        std::vector<std::size_t> ends; // pixels
        for (const Vec3& other :
             {Vec3(-far.x, far.y, far.z), Vec3(far.x, -far.y, far.z), Vec3(far.x, far.y, -far.z)}) {
            add_line_between(mesh, turned(far), turned(other));
            const ClipVertex end = screen.to_clip(turned(other));
            ends.push_back(static_cast<std::size_t>(end.y / end.w) * kFaceSide +
                           static_cast<std::size_t>(end.x / end.w));
        }
        geom::find_line_faces(mesh);
        const Planes whole = draw_planes(jobs, mesh, view, kFaceSide, kFaceSide, 4),
                     bare = draw_planes(jobs, surface, view, kFaceSide, kFaceSide, 4);
        // The other ends are corners of faces that are seen: their own pixels may show the line.
        for (std::size_t i = 0; i < whole.ids.size(); ++i)
            if (std::find(ends.begin(), ends.end(), i / 4) == ends.end())
                through += bare.ids[i] != kNoPrimitive && whole.ids[i] != bare.ids[i] ? 1 : 0;
        hidden += count(jobs, mesh, view, 4).hidden;
    }
    EXPECT_EQ(through, 0);
    EXPECT_GT(hidden, 10000);
}

// Lines are held against triangles alone: whichever comes first, the picture is the same.
TEST(LineOnFace, DoesNotDependOnTheOrderOfLines) {
    Random random(7);
    geom::Mesh mesh = scanout::test::empty_mesh();
    scanout::test::add_sphere(mesh, Vec3(0), 0.9F, 12, 6);
    add_edges(mesh);
    for (int i = 0; i < 5000; ++i) // some chunks of lines: workers take them in any order
        add_line_between(mesh, Vec3(random.in_cube(0.9)), Vec3(random.in_cube(0.9)));
    geom::Mesh turned = mesh;
    for (std::size_t i = 0; i < mesh.line_index.size(); ++i)
        turned.line_index[i] = mesh.line_index[mesh.line_index.size() - 1 - i];
    geom::find_line_faces(mesh);
    geom::find_line_faces(turned);
    Jobs one(1), many(4);
    const scene::View view = view_of(true);
    const Planes expected = draw_planes(one, mesh, view, kFaceSide, kFaceSide, 2);
    EXPECT_EQ(draw_planes(many, mesh, view, kFaceSide, kFaceSide, 2), expected);
    EXPECT_EQ(draw_planes(one, turned, view, kFaceSide, kFaceSide, 2).depths, expected.depths);
}

TEST(PointOnFace, IsSeenWhereItIsACorner) {
    Jobs jobs(1);
    Random random(6);
    Counts counts;
    for (int i = 0; i < 200; ++i) {
        const Plane plane{random.in(0, 360), kTilts[i % 10], random.in(0, 360)};
        geom::Mesh mesh = scanout::test::empty_mesh();
        const std::vector<Vec3> corner = {plane.at(-0.8, -0.7), plane.at(0.7, -0.8),
                                          plane.at(0.8, 0.9), plane.at(-0.9, 0.6)};
        add_polygon(mesh, corner);
        for (const Vec3& p : corner)
            scanout::test::add_point(mesh, add_vertex(mesh, p));
        counts += count(jobs, mesh, view_of(i % 4 < 2), 1 << (i % 5));
    }
    EXPECT_EQ(counts.hidden, 0);
    EXPECT_GT(counts.seen, 1000);
    EXPECT_LE(counts.steps, 2);
}

// Four points of one plane, each rounded to floats, however large, thin or far away: the bound must
// hold the rounding of all four, and not much more.
TEST(PointOnFace, IsInThePlaneOfATriangleWhateverRoundingDidToBoth) {
    scanout::test::Random random(17);
    int missed = 0, wrongly = 0;
    constexpr int kPoints = 200'000;
    for (int i = 0; i < kPoints; ++i) {
        const DVec3 origin = random.in_cube(std::exp2(random.in(-4, 1)));
        const DVec3 e = random.in_cube(std::exp2(random.in(-6, 0))),
                    f = random.in_cube(std::exp2(random.in(-6, 0)));
        const double s = random.in(-1, 2), t = random.in(-1, 2);
        const DVec3 n = cross3(e, f), off = n * (0x1p-10 / length(n));
        for (const bool raised : {false, true}) {
            geom::Mesh mesh;
            for (const DVec3& p : {origin, origin + e, origin + f,
                                   origin + e * s + f * t + (raised ? off : DVec3(0))})
                add_vertex(mesh, Vec3(p));
            scanout::test::add_triangle(mesh, 0, 1, 2);
            mesh.point_index = {3};
            const ScreenTransform transform(scene::View{}, 64, 64);
            const LineSupport support(mesh, {}, transform);
            const bool held = support.contact(0, 1) == LineSupport::Contact::holds;
            missed += !held && !raised ? 1 : 0;
            // Of slivers nothing is known.
            wrongly += held && raised && length(n) > 0x1p-8 ? 1 : 0;
        }
    }
    EXPECT_EQ(missed, 0);
    EXPECT_EQ(wrongly, 0);
}

} // namespace
} // namespace scanout::raster::test
