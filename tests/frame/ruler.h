// A ruler for what is interpolated, read off pictures: the texture coordinate runs through a
// texture of 16384 texels of different colours, repeated 1024 times, so that a pixel's colour tells
// u to 2^-24.
#pragma once

#include "oracle/placed.h"
#include "oracle/plane.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace scanout::test {

inline constexpr int kTexels = 16384, kRepeats = 1024; // 2^24 texels from u = 0 to u = 1

// Codes far enough apart that the way through linear light and back cannot mix them up.
inline image::Rgba8 texel_colour(int i) {
    const auto code = [](int level) { return static_cast<std::uint8_t>(level * 7 + 20); };
    return {code(i & 31), code(i >> 5 & 31), code(i >> 10), 255};
}
inline int texel_of(const image::Rgba8& p) {
    const auto level = [](int code) { return (code - 20 + 3) / 7; };
    return level(p.r) | level(p.g) << 5 | level(p.b) << 10;
}

// Square to both default lights: whichever side is seen, only ambient light falls on it.
inline const Vec3 kUnlit{3.0F / 7, 6.0F / 7, -2.0F / 7};

// A scene of triangles whose snapped corners, distances and u the test knows.
struct Known {
    oracle::Corners corner;
    oracle::Three w, u;
};

class Ruler {
public:
    explicit Ruler(int width, int height = 0) : shot_(shot("ruler", width, height)) {
        if (height == 0) shot_.options.height = width;
        scene::Material material = textured(0);
        material.diffuse = Vec3(1 / scene::kAmbient);
        material.map_diffuse.edit().scale = {kRepeats, 1, 1};
        shot_.scene.materials = {material};
        scene::Texture texture{"ruler", image::Image(kTexels, 1)};
        for (int i = 0; i < kTexels; ++i)
            texture.image.at(i, 0) = texel_colour(i);
        shot_.scene.textures = {texture};
        shot_.options.texture = "nearest";
        view_.near_distance = 0x1p-24;
    }
    void add(const Known& t) {
        std::array<Vec3, 3> place;
        for (std::size_t i = 0; i < 3; ++i)
            place[i] =
                oracle::placed(t.corner[i], t.w[i], shot_.options.width, shot_.options.height);
        add(place, t.u);
    }
    // In view space.
    void add(const std::array<Vec3, 3>& place, const oracle::Three& u) {
        geom::Mesh& mesh = shot_.scene.mesh;
        std::uint32_t index[3];
        for (std::size_t i = 0; i < 3; ++i) {
            index[i] = add_vertex(mesh, place[i], kUnlit);
            mesh.uv.emplace_back(u[i], 0.5);
        }
        add_triangle(mesh, index[0], index[1], index[2], 0);
    }
    void set_near(double distance) { view_.near_distance = distance; }
    const image::Image& draw() {
        const auto plan = frame::plan(shot_.options, frame::facts(shot_.scene));
        EXPECT_TRUE(plan);
        picture_ = renderer_.render(shot_.scene, view_, *plan);
        return picture_;
    }
    bool covered(int x, int y) const { return !(picture_.at(x, y) == shot_.options.background); }
    // How far the shown u is from the exact one, in units of 2^-24: 0 where the texel holds it.
    double error(int x, int y, double exact_u) const {
        const double at = exact_u * (double{kTexels} * kRepeats);
        double off = std::fmod(at - texel_of(picture_.at(x, y)), kTexels);
        off += off < -kTexels / 2.0  ? kTexels
               : off > kTexels / 2.0 ? -kTexels
                                     : 0; // [0, 1): inside
        return std::max({0.0, -off, off - 1});
    }
    void clear() { shot_.scene.mesh = empty_mesh(); }

private:
    Shot shot_;
    scene::View view_; // 2 units across the picture at distance 1
    Jobs jobs_{2};
    frame::Renderer renderer_{jobs_};
    image::Image picture_;
};

inline void record(const std::string& name, double value) {
    testing::Test::RecordProperty(name, testing::PrintToString(value));
}

} // namespace scanout::test
