// Facts about backs: is a mesh closed, wound outwards, and do its normals say the same?
#include "frame/facts/back_faces.h"
#include "math/rotation.h"
#include "math/transcendental.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace scanout::frame {
namespace {

using test::empty_mesh;

geom::Mesh sphere() {
    geom::Mesh mesh = empty_mesh();
    test::add_sphere(mesh, {0.2F, 0, 0}, 0.5F, 24, 12);
    return mesh;
}

void turn(geom::Mesh& mesh, bool winding, bool normals) {
    if (winding)
        for (std::size_t i = 0; i < mesh.index.size(); i += 3)
            std::swap(mesh.index[i], mesh.index[i + 1]);
    if (normals)
        for (Vec3& n : mesh.normal)
            n = -n;
}

TEST(MeshTopology, OfASolidAreClosedAndOutward) {
    geom::Mesh mesh = sphere();
    test::add_cube(mesh, 0.3F); // vertices of its own at every face: joined by place
    const geom::MeshTopology topology = geom::topology(mesh);
    EXPECT_TRUE(topology.closed);
    EXPECT_EQ(topology.inside_out, 0U);
    EXPECT_EQ(topology.reversed_triangles, 0U);
}

TEST(MeshTopology, AHoleOfOneTriangleShows) {
    for (const std::size_t hole : {0U, 100U, 400U}) {
        geom::Mesh mesh = sphere();
        mesh.index.erase(mesh.index.begin() + static_cast<std::ptrdiff_t>(3 * hole),
                         mesh.index.begin() + static_cast<std::ptrdiff_t>(3 * hole + 3));
        EXPECT_FALSE(geom::topology(mesh).closed);
    }
    geom::Mesh turned = sphere(); // one wound the other way
    std::swap(turned.index[300], turned.index[301]);
    EXPECT_FALSE(geom::topology(turned).closed);
    EXPECT_EQ(geom::topology(turned).reversed_triangles, 1U);
    EXPECT_FALSE(geom::topology(empty_mesh()).closed);
    geom::Mesh square = empty_mesh();
    test::add_square(square, 1);
    EXPECT_FALSE(geom::topology(square).closed);
    EXPECT_EQ(geom::topology(square).reversed_triangles, 0U);
    // A sheet with a front and a back closes round itself.
    test::add_quad(square, {{{1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}}, {0, 0, -1});
    EXPECT_TRUE(geom::topology(square).closed);
}

TEST(MeshTopology, InsideOutIsNotOutward) {
    geom::Mesh mesh = sphere();
    const std::size_t all = mesh.triangles();
    turn(mesh, true, true);
    EXPECT_TRUE(geom::topology(mesh).closed);
    EXPECT_EQ(geom::topology(mesh).inside_out, all);
    EXPECT_EQ(geom::topology(mesh).reversed_triangles, 0U);
    turn(mesh, false, true); // normals outwards, winding not
    EXPECT_EQ(geom::topology(mesh).reversed_triangles, all);
    turn(mesh, true, false);
    EXPECT_EQ(geom::topology(mesh).reversed_triangles, 0U);
}

TEST(MeshTopology, EachClosedPartIsInsideOutOrNotByItself) {
    geom::Mesh mesh = sphere();
    const std::size_t large = mesh.index.size();
    test::add_sphere(mesh, {-0.7F, 0.1F, 0}, 0.125F, 12, 6);
    EXPECT_EQ(geom::topology(mesh).inside_out, 0U);
    for (std::size_t i = large; i < mesh.index.size(); i += 3) {
        std::swap(mesh.index[i], mesh.index[i + 1]);
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3& n = mesh.normal[mesh.index[i + k]];
            const Vec3 out = mesh.position[mesh.index[i + k]] - Vec3(-0.7F, 0.1F, 0);
            n = dot3(DVec3(n), DVec3(out)) > 0 ? -n : n;
        }
    }
    const geom::MeshTopology topology = geom::topology(mesh);
    EXPECT_TRUE(topology.closed);
    EXPECT_EQ(topology.reversed_triangles, 0U);
    EXPECT_EQ(topology.inside_out, mesh.triangles() - large / 3);
    test::Shot s = test::shot("balls");
    s.scene.mesh = mesh;
    s.scene.materials = {test::plain(Vec3(0.7F))};
    const auto planned = plan(s.options, facts(s.scene));
    ASSERT_TRUE(planned);
    EXPECT_TRUE(planned->decision("two_sided")->needed);
    EXPECT_NE(planned->decision("two_sided")->because.find("inside out"), std::string::npos);
    const image::Image right = test::draw(s);
    s.options.effects["two_sided"] = false;
    EXPECT_NE(test::draw(s), right);
}

TEST(MeshTopology, AFaceOnTheBackOfAnotherIsFound) {
    // One sheet as exporters write it: the second time from its last corner on, so that diagonals
    // cross. It holds no volume, and a body that it hangs on does not hide that.
    for (const bool on_a_body : {false, true}) {
        geom::Mesh mesh = empty_mesh();
        if (on_a_body) test::add_cube(mesh, 0.25F);
        const Vec3 a(0.25F), b(0.25F, 0.75F, 0.25F), c(0.75F, 0.75F, 0.25F), d(0.75F, 0.25F, 0.25F);
        test::add_quad(mesh, {{a, b, c, d}}, {0, 0, -1});
        test::add_quad(mesh, {{d, c, b, a}}, {0, 0, 1});
        const geom::MeshTopology topology = geom::topology(mesh);
        EXPECT_TRUE(topology.closed);
        EXPECT_EQ(topology.inside_out, on_a_body ? 0U : 4U);
        EXPECT_TRUE(topology.back_to_back);
    }
    // Balls that touch at a point do not.
    geom::Mesh touching = empty_mesh();
    test::add_sphere(touching, {-0.5F, 0, 0}, 0.5F, 24, 12);
    test::add_sphere(touching, {0.5F, 0, 0}, 0.5F, 24, 12);
    EXPECT_FALSE(geom::topology(touching).back_to_back);
    EXPECT_FALSE(geom::topology(sphere()).back_to_back);
}

// Many faces at one edge are not compared by pairs: each with those that stand nearest to its
// opposite. The answer is that of all pairs.
TEST(MeshTopology, OppositeFacesAtOneEdgeAreFoundAmongMany) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        test::Random random(seed);
        geom::Mesh mesh = empty_mesh();
        std::vector<std::pair<bool, DVec3>> faces; // rises along the edge; normal
        const auto add = [&](double degrees, bool rises) {
            const DVec3 out(scanout::cos_degrees(degrees), 0, scanout::sin_degrees(degrees));
            const Vec3 low(0), high(0, 0.5F, 0), tip(out * random.in(0.1, 0.4));
            const Vec3 &from = rises ? low : high, &to = rises ? high : low;
            const DVec3 n = normalized(cross3(DVec3(to - from), DVec3(tip - from)));
            const std::uint32_t a = test::add_vertex(mesh, from, Vec3(n)),
                                b = test::add_vertex(mesh, to, Vec3(n)),
                                c = test::add_vertex(mesh, tip, Vec3(n));
            test::add_triangle(mesh, a, b, c);
            faces.emplace_back(rises, n);
        };
        add(0, true);
        add(180, true); // looks the other way: their corners are asked about
        for (int more = random.whole(0, 12); more > 0; --more)
            add(random.in(0, 90), random.unit() < 0.8);
        bool expected = false;
        for (const auto& [rises, normal] : faces)
            for (const auto& [other_rises, other] : faces)
                expected |= rises != other_rises && dot3(normal, other) < -0.99;
        EXPECT_EQ(geom::topology(mesh).back_to_back, expected) << seed;
        found += expected ? 1 : 0;
    }
    EXPECT_GT(found, 40);
    EXPECT_LT(found, 360);
}

TEST(MeshTopology, ATriangleWithoutAnAreaHasNoSide) {
    geom::Mesh mesh = empty_mesh();
    for (const float y : {0.0F, 1e-12F, 1e-3F}) {
        const std::uint32_t a = test::add_vertex(mesh, {0, 0, 0}),
                            b = test::add_vertex(mesh, {1, 0, 0}),
                            c = test::add_vertex(mesh, {0.5F, y, 0});
        test::add_triangle(mesh, a, b, c);
    }
    EXPECT_EQ(geom::topology(mesh).reversed_triangles, 1U); // the first
    std::fill(mesh.normal.end() - 3, mesh.normal.end(),
              Vec3(1, 0, 0)); // along the face: no clear side
    EXPECT_EQ(geom::topology(mesh).reversed_triangles, 2U);
}

// Programs that draw parts write 0 for a corner here and 2e-18 there.
TEST(MeshTopology, PlacesARoundingApartAreOne) {
    geom::Mesh mesh = empty_mesh();
    test::add_cube(mesh, 0.25F);
    for (std::size_t i = 0; i < mesh.position.size(); i += 3)
        mesh.position[i] += Vec3(2e-18F, -3e-8F, 3e-8F);
    EXPECT_TRUE(geom::topology(mesh).closed);
    mesh.position[0].x += 1e-6F;
    EXPECT_FALSE(geom::topology(mesh).closed);
}

scene::View view_of(const geom::Mesh& mesh, double azimuth, double elevation, double distance = 3) {
    scene::CameraOptions camera;
    camera.azimuth_degrees = azimuth;
    camera.elevation_degrees = elevation;
    camera.distance = distance;
    const auto view = scene::make_view(mesh, {}, {}, camera, {}, 64, 64);
    EXPECT_TRUE(view);
    return *view;
}

TEST(MeshTopology, AFlatPartShowsItsBackFromBehindAlone) {
    geom::Mesh mesh = empty_mesh();
    test::add_square(mesh, 0.5F); // looks to +z
    test::add_cube(mesh, 0.25F);  // closed, and in two places: its backs are never seen
    const geom::MeshTopology topology = geom::topology(mesh);
    EXPECT_FALSE(topology.closed);
    EXPECT_EQ(topology.open_triangles, 2U);
    EXPECT_EQ(topology.open_planes.planes().size(), 1U);
    for (int azimuth = 0; azimuth < 360; azimuth += 20)
        for (const int elevation : {-60, 0, 45}) {
            const bool front = azimuth < 90 || azimuth > 270;
            EXPECT_EQ(back_faces_in_view(topology, view_of(mesh, azimuth, elevation)),
                      front ? BackFaces::none : BackFaces::of_open_components)
                << azimuth << " " << elevation;
        }
    EXPECT_EQ(back_faces_in_view(topology, scene::View()), BackFaces::of_open_components)
        << "no view is known";
}

TEST(MeshTopology, WhatLetsLightThroughIsNotClosed) {
    const geom::Mesh mesh = sphere();
    std::vector<bool> glass(mesh.triangles(), false);
    glass[7] = true;
    const geom::MeshTopology topology = geom::topology(mesh, glass);
    EXPECT_FALSE(topology.closed);
    EXPECT_EQ(topology.open_triangles, mesh.triangles());
    EXPECT_EQ(back_faces_in_view(topology, view_of(mesh, 0, 0)), BackFaces::of_open_components);
    EXPECT_EQ(back_faces_in_view(geom::topology(mesh), view_of(mesh, 0, 0)), BackFaces::none);
}

TEST(MeshTopology, FromInsideBacksAreSeen) {
    geom::Mesh mesh = empty_mesh();
    test::add_cube(mesh, 0.25F);
    const geom::MeshTopology topology = geom::topology(mesh);
    EXPECT_EQ(back_faces_in_view(topology, view_of(mesh, 30, 20, 0.1)), BackFaces::from_inside);
    EXPECT_EQ(back_faces_in_view(topology, view_of(mesh, 30, 20, 2)), BackFaces::none);
    // Outside by less than the near plane cuts away.
    scene::View near = view_of(mesh, 0, 0);
    near.translation = {0, 0, -near.linear[2].z * 0.251};
    EXPECT_EQ(back_faces_in_view(topology, near), BackFaces::none);
    near.near_distance = 0.01;
    EXPECT_EQ(back_faces_in_view(topology, near), BackFaces::from_inside);
}

TEST(MeshTopology, WhatIsFlatOrConvexThrowsNoShadowOnItself) {
    geom::Mesh mesh = empty_mesh();
    test::add_square(mesh, 0.5F);
    EXPECT_TRUE(geom::topology(mesh).flat);
    test::add_quad(mesh, {{{1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}}, {0, 0, -1});
    EXPECT_TRUE(geom::topology(mesh).flat) << "a sheet of two sides";
    test::add_square(mesh, 0.25F, 0.1F);
    EXPECT_FALSE(geom::topology(mesh).flat);
    geom::Mesh cube = empty_mesh();
    test::add_cube(cube, 0.25F);
    EXPECT_EQ(geom::topology(cube).convex_components.size(), 1U);
    EXPECT_FALSE(geom::topology(cube).flat);
    geom::Mesh open = cube; // its inside is dark
    open.index.resize(open.index.size() - 6);
    EXPECT_TRUE(geom::topology(open).convex_components.empty());
    test::add_cube(cube, 0.1F);
    for (std::size_t i = 24; i < cube.position.size(); ++i)
        cube.position[i].x += 0.5F;
    const auto bodies = geom::topology(cube).convex_components;
    ASSERT_EQ(bodies.size(), 2U) << "one may shade the other";
    EXPECT_EQ(bodies[0].low, DVec3(-0.25));
    EXPECT_EQ(bodies[1].high.y, double{0.1F});
    EXPECT_TRUE(geom::topology(sphere()).convex_components.empty()) << "rounded: not convex";
    test::add_square(cube, 0.25F, 0.75F);
    EXPECT_EQ(geom::topology(cube).convex_components.size(), 3U);
    for (std::size_t i = 0; i < geom::MeshTopology::kMaxConvex - 2; ++i)
        test::add_square(cube, 0.01F, 0.8F + 0.001F * static_cast<float>(i));
    EXPECT_TRUE(geom::topology(cube).convex_components.empty()) << "too many";
}

TEST(MeshTopology, TellsWhichFacesAreShadedByOtherNormalsThanTheirOwn) {
    geom::Mesh mesh = empty_mesh();
    test::add_cube(mesh, 0.25F);
    EXPECT_EQ(geom::topology(mesh).smooth_triangles, 0U);
    mesh.normal[0] = mesh.normal[0] + Vec3(1e-6F); // rounding
    EXPECT_EQ(geom::topology(mesh).smooth_triangles, 0U);
    mesh.normal[0] = mesh.normal[0] + Vec3(1e-3F);
    EXPECT_EQ(geom::topology(mesh).smooth_triangles, 2U) << "both triangles of a side";
    geom::Mesh round = empty_mesh(); // a cube that is shaded like a ball
    test::add_cube(round, 0.5F);
    for (std::size_t i = 0; i < round.normal.size(); ++i)
        round.normal[i] = Vec3(normalized(DVec3(round.position[i])));
    EXPECT_EQ(geom::topology(round).convex_components.size(), 1U);
    EXPECT_EQ(geom::topology(round).smooth_triangles, 12U);
    geom::Mesh sheet = empty_mesh();
    test::add_square(sheet, 0.5F);
    sheet.normal[2] = {0, 0, -1};
    EXPECT_TRUE(geom::topology(sheet).flat);
    EXPECT_EQ(geom::topology(sheet).smooth_triangles, 2U);
}

// And no bit of the picture has one: volumes, which are exact, against none.
TEST(MeshTopology, AConvexModelHasNoShadowsAndNoShadowPass) {
    test::Random random(3);
    for (int round = 0; round < 20; ++round) {
        test::Shot s = test::shot("cube");
        s.scene.materials = {test::plain(Vec3(0.7F))};
        test::add_cube(s.scene.mesh, 0.5F, 0);
        s.camera.azimuth_degrees = random.in(0, 360);
        s.camera.elevation_degrees = random.in(-80, 80);
        scene::Light lamp = test::light_of(scene::LightKind::directional, 0.9);
        lamp.casts = true;
        lamp.towards = random.in_cube(1);
        s.options.lights = {lamp, test::light_of(scene::LightKind::ambient, 0.1)};
        s.options.shadow = "volume";
        FrameStats stats;
        const image::Image without = test::draw(s, {.stats = &stats});
        EXPECT_EQ(stats.shadow_bytes, 0U);
        // A micro-triangle behind the cube makes it a model of two parts: now the volumes are
        // drawn.
        const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, 64, 64);
        test::add_quad(s.scene.mesh,
                       {{{0, 0, 0}, {0.001F, 0, 0}, {0.001F, 0.001F, 0}, {0, 0.001F, 0}}},
                       {0, 0, 1}, 0);
        EXPECT_EQ(test::draw(s, *view, {.stats = &stats}), without) << round;
        EXPECT_GT(stats.shadow_bytes, 0U);
    }
}

// Whatever the plan says shows no back shows none: counted from the ids that are seen.
TEST(MeshTopology, WhereNoBackCanBeSeenNoneIs) {
    int none = 0, some = 0;
    for (test::Shot s : test::golden_shots()) {
        s.options.aa = "auto";
        s.options.samples = 1;
        s.options.stencil = "auto";
        s.options.depth = s.options.depth_test = "auto";
        s.options.cull = Cull::none;
        const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                           s.options.width, s.options.height);
        ASSERT_TRUE(view);
        const auto plan = frame::plan(s.options, facts(s.scene), *view);
        ASSERT_TRUE(plan) << plan.error().what;
        Visibility visible;
        test::draw(s, {.visibility = &visible});
        const std::vector<bool> away = back_facing(s.scene.mesh, *view);
        const auto seen =
            std::count_if(visible.id.begin(), visible.id.end(),
                          [&](std::uint32_t id) { return id < away.size() && away[id]; });
        if (plan->decision("two_sided")->needed) {
            some += seen > 0 ? 1 : 0;
            continue;
        }
        EXPECT_EQ(seen, 0) << s.name;
        none += s.scene.mesh.triangles() > 0 ? 1 : 0;
    }
    EXPECT_GT(none, 60);
    EXPECT_GT(some, 2);
}

} // namespace
} // namespace scanout::frame
