// Facts about backs: is a mesh closed, wound outwards, and do its normals say the same?
#include "frame/mesh_sides.h"
#include "support/scenes.h"

#include <utility>

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

TEST(MeshSides, OfASolidAreClosedAndOutward) {
    geom::Mesh mesh = sphere();
    test::add_cube(mesh, 0.3F); // vertices of its own at every face: joined by place
    const MeshSides sides = mesh_sides(mesh);
    EXPECT_TRUE(sides.closed);
    EXPECT_TRUE(sides.outward);
    EXPECT_EQ(sides.leaning, 0U);
}

TEST(MeshSides, AHoleOfOneTriangleShows) {
    for (const std::size_t hole : {0U, 100U, 400U}) {
        geom::Mesh mesh = sphere();
        mesh.index.erase(mesh.index.begin() + static_cast<std::ptrdiff_t>(3 * hole),
                         mesh.index.begin() + static_cast<std::ptrdiff_t>(3 * hole + 3));
        EXPECT_FALSE(mesh_sides(mesh).closed);
    }
    geom::Mesh turned = sphere(); // one wound the other way
    std::swap(turned.index[300], turned.index[301]);
    EXPECT_FALSE(mesh_sides(turned).closed);
    EXPECT_EQ(mesh_sides(turned).leaning, 1U);
    EXPECT_FALSE(mesh_sides(empty_mesh()).closed);
    geom::Mesh square = empty_mesh();
    test::add_square(square, 1);
    EXPECT_FALSE(mesh_sides(square).closed);
    EXPECT_EQ(mesh_sides(square).leaning, 0U);
    // A sheet with a front and a back closes round itself.
    test::add_quad(square, {{{1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}}, {0, 0, -1});
    EXPECT_TRUE(mesh_sides(square).closed);
}

TEST(MeshSides, InsideOutIsNotOutward) {
    geom::Mesh mesh = sphere();
    const std::size_t all = mesh.triangles();
    turn(mesh, true, true);
    EXPECT_TRUE(mesh_sides(mesh).closed);
    EXPECT_FALSE(mesh_sides(mesh).outward);
    EXPECT_EQ(mesh_sides(mesh).leaning, 0U);
    turn(mesh, false, true); // normals outwards, winding not
    EXPECT_EQ(mesh_sides(mesh).leaning, all);
    turn(mesh, true, false);
    EXPECT_EQ(mesh_sides(mesh).leaning, 0U);
}

TEST(MeshSides, ATriangleWithoutAnAreaHasNoSide) {
    geom::Mesh mesh = empty_mesh();
    for (const float y : {0.0F, 1e-12F, 1e-3F}) {
        const std::uint32_t a = test::add_vertex(mesh, {0, 0, 0}),
                            b = test::add_vertex(mesh, {1, 0, 0}),
                            c = test::add_vertex(mesh, {0.5F, y, 0});
        test::add_triangle(mesh, a, b, c);
    }
    EXPECT_EQ(mesh_sides(mesh).leaning, 1U); // the first
    mesh.normal.back() = {1, 0, 0};          // along the face: no clear side
    EXPECT_EQ(mesh_sides(mesh).leaning, 2U);
}

} // namespace
} // namespace scanout::frame
