// Meshes and scenes made by the tests, without any code of the program: everything within the unit
// sphere, in the form that the loader gives.
#pragma once

#include "scene/scene.h"
#include "support/random.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace scanout::test {

inline geom::Mesh empty_mesh() {
    geom::Mesh mesh;
    mesh.radius = 1;
    return mesh;
}

inline std::uint32_t add_vertex(geom::Mesh& mesh, const Vec3& position,
                                const Vec3& normal = {0, 0, 1}) {
    mesh.position.push_back(position);
    mesh.normal.push_back(normal);
    return static_cast<std::uint32_t>(mesh.position.size() - 1);
}

inline void add_triangle(geom::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                         int material = -1) {
    mesh.index.insert(mesh.index.end(), {a, b, c});
    mesh.material.push_back(material);
    mesh.face.push_back(static_cast<std::uint32_t>(mesh.face.size()));
}

inline void add_line(geom::Mesh& mesh, std::uint32_t a, std::uint32_t b, int material = -1) {
    mesh.line_index.insert(mesh.line_index.end(), {a, b});
    mesh.line_material.push_back(material);
}

inline void add_point(geom::Mesh& mesh, std::uint32_t a, int material = -1) {
    mesh.point_index.push_back(a);
    mesh.point_material.push_back(material);
}

// Four vertices of its own, counter-clockwise from the lower left, and two triangles; uv 0..1.
inline void add_quad(geom::Mesh& mesh, const std::array<Vec3, 4>& corner, const Vec3& normal,
                     int material = -1) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const Vec3& p : corner)
        add_vertex(mesh, p, normal);
    mesh.uv.resize(mesh.position.size());
    for (std::uint32_t i = 0; i < 4; ++i)
        mesh.uv[first + i] = {i == 1 || i == 2 ? 1.0F : 0.0F, i >= 2 ? 1.0F : 0.0F};
    add_triangle(mesh, first, first + 1, first + 2, material);
    add_triangle(mesh, first, first + 2, first + 3, material);
}

// In the plane z, from -size to size.
inline void add_square(geom::Mesh& mesh, float size, float z = 0, int material = -1) {
    add_quad(mesh, {{{-size, -size, z}, {size, -size, z}, {size, size, z}, {-size, size, z}}},
             {0, 0, 1}, material);
}

// Rings of latitude from pole to pole, smooth normals, u around and v up.
inline void add_sphere(geom::Mesh& mesh, const Vec3& centre, float radius, int around, int up,
                       int material = -1) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (int j = 0; j <= up; ++j) {
        for (int i = 0; i <= around; ++i) {
            // Whole turns only come from the same number: the seam closes to the bit.
            const double azimuth = 2 * std::numbers::pi * (i % around) / around;
            const double elevation = std::numbers::pi * (static_cast<double>(j) / up - 0.5);
            const double ring = j == 0 || j == up ? 0 : std::cos(elevation);
            // libm may differ in the last bit between machines: 2^-16 does not.
            const auto tidy = [](double x) {
                return static_cast<float>(std::nearbyint(x * 65536) / 65536);
            };
            const Vec3 n{tidy(ring * std::sin(azimuth)), tidy(std::sin(elevation)),
                         tidy(ring * std::cos(azimuth))};
            add_vertex(mesh,
                       {centre.x + radius * n.x, centre.y + radius * n.y, centre.z + radius * n.z},
                       n);
            mesh.uv.resize(mesh.position.size());
            mesh.uv.back() = {static_cast<float>(i) / static_cast<float>(around),
                              static_cast<float>(j) / static_cast<float>(up)};
        }
    }
    const auto at = [&](int i, int j) {
        return first + static_cast<std::uint32_t>(j * (around + 1) + i);
    };
    for (int j = 0; j < up; ++j) {
        for (int i = 0; i < around; ++i) {
            if (j > 0) add_triangle(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), material);
            if (j + 1 < up) add_triangle(mesh, at(i, j), at(i + 1, j + 1), at(i, j + 1), material);
        }
    }
}

// Six faces with normals of their own; half the edge is `size`.
inline void add_cube(geom::Mesh& mesh, float size, int material = -1) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            Vec3 n(0), right(0), up(0);
            n[axis] = side;
            right[(axis + 1) % 3] = side;
            up[(axis + 2) % 3] = 1;
            const auto corner = [&](float r, float u) {
                return Vec3{size * (n.x + r * right.x + u * up.x),
                            size * (n.y + r * right.y + u * up.y),
                            size * (n.z + r * right.z + u * up.z)};
            };
            add_quad(mesh, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, n,
                     material);
        }
    }
}

inline scene::Material plain(const Vec3& kd, const Vec3& ks = Vec3(0), float ns = 0) {
    scene::Material material;
    material.diffuse = kd;
    material.specular = ks;
    material.shininess = ns;
    return material;
}

inline scene::Material textured(int texture) {
    scene::Material material;
    material.diffuse = Vec3(1);
    material.map_diffuse.edit().texture = texture;
    material.map_diffuse.edit().path = "made by the test";
    return material;
}

// Eight by eight: black and white squares, with the lower left one red and the lower right one
// green, so that every flip of the picture shows.
inline scene::Texture checkers() {
    image::Image image(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            image.at(x, y) =
                (x + y) % 2 == 0 ? image::Rgba8{235, 235, 235, 255} : image::Rgba8{40, 40, 60, 255};
    for (int y = 6; y < 8; ++y) {
        for (int x = 0; x < 2; ++x)
            image.at(x, y) = {230, 30, 30, 255};
        for (int x = 6; x < 8; ++x)
            image.at(x, y) = {30, 200, 30, 255};
    }
    return {"checkers", image};
}

// Squares of two by two texels, each in a colour of its own.
inline scene::Texture noisy(int side, std::uint64_t seed) {
    Random random(seed);
    image::Image image(side, side);
    for (int y = 0; y < side; y += 2)
        for (int x = 0; x < side; x += 2) {
            const std::uint64_t bits = random.bits();
            for (int i = 0; i < 4; ++i)
                image.at(x + i % 2, y + i / 2) = {static_cast<std::uint8_t>(bits),
                                                  static_cast<std::uint8_t>(bits >> 8),
                                                  static_cast<std::uint8_t>(bits >> 16), 255};
        }
    return {"noisy", image};
}

// A normal map of one pyramid: its four sides lean away from the middle.
inline scene::Texture pyramids() {
    image::Image image(16, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const int right = 2 * x - 15, up = 15 - 2 * y; // of the middle
            const bool sideways = right * right > up * up;
            const auto lean = [](int by) {
                return static_cast<std::uint8_t>(128 + (by > 0 ? 70 : -70));
            };
            image.at(x, y) = {sideways ? lean(right) : std::uint8_t{128},
                              sideways ? std::uint8_t{128} : lean(up), 234, 255};
        }
    return {"pyramids", image};
}

} // namespace scanout::test
