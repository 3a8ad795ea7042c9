// A texture, a block of coordinates, and what a filter reads there.
#pragma once

#include "rows.h"
#include "shade/block.h"
#include "shade/mip/mip_chain.h"
#include "support/srgb_formula.h"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::shade::test {

inline scene::Texture noise(int width, int height, std::uint64_t seed) {
    Random random(seed);
    scene::Texture texture{"noise", image::Image(width, height)};
    for (image::Rgba8& p : texture.image.pixels()) {
        const std::uint64_t bits = random.bits();
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
             static_cast<std::uint8_t>(bits >> 16), 255};
    }
    return texture;
}

inline constexpr float kNaNTexel = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfTexel = std::numeric_limits<float>::infinity();
inline constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::mirror, Wrap::clamp};

// Slopes of u and v from pixel to pixel: along x, then along y.
struct Slopes {
    Vec2 x{0}, y{0};
};

struct Sampler {
    explicit Sampler(const scene::Texture& t, Wrap wrap = Wrap::repeat)
        : texture(t), chain(make_mip_chain(t.image, TexelKind::colour, jobs())) {
        block->map[kDiffuseMap] = {&texture, material.map_diffuse.operator->(), &chain, wrap, wrap};
    }
    static Jobs& jobs() {
        static Jobs one(1);
        return one;
    }
    void set_slopes(int lane, const Slopes& s) {
        block->u_x[lane] = s.x.x;
        block->v_x[lane] = s.x.y;
        block->u_y[lane] = s.y.x;
        block->v_y[lane] = s.y.y;
    }
    // Every lane has slopes of its own, of any size.
    void set_random_slopes(Random& random) {
        for (int i = 0; i < kBlockSize; ++i) {
            const double size = std::exp2(random.in(-20, 60));
            const DVec3 x = random.in_cube(size), y = random.in_cube(size);
            set_slopes(i, {Vec2(x.x, x.y), Vec2(y.x, y.y)});
        }
    }
    // Up to a block of coordinates at once.
    void sample(std::string_view filter, const std::vector<Vec2>& uv) {
        block->count = static_cast<int>(uv.size());
        for (int i = 0; i < block->count; ++i) {
            block->u[i] = uv[static_cast<std::size_t>(i)].x;
            block->v[i] = uv[static_cast<std::size_t>(i)].y;
            for (auto& channel : block->albedo)
                channel[i] = 1;
        }
        run_stage("texture", filter, *block, {});
    }
    Vec3 one(std::string_view filter, float u, float v) {
        sample(filter, {Vec2(u, v)});
        return {block->albedo[0][0], block->albedo[1][0], block->albedo[2][0]};
    }
    const scene::Texture& texture;
    MipChain chain;
    scene::Material material = scanout::test::textured(0);
    std::unique_ptr<ShadingBlock> block = new_block(material);
};

inline std::vector<Vec2> random_uv(Random& random, double size) {
    std::vector<Vec2> uv(kBlockSize);
    for (Vec2& t : uv)
        t = {static_cast<float>(random.in(-size, size)),
             static_cast<float>(random.in(-size, size))};
    return uv;
}

inline std::vector<std::string> filters() {
    std::vector<std::string> names;
    for (const Filter* filter : shade::texture::kRows)
        names.emplace_back(filter->card.name);
    return names;
}

} // namespace scanout::shade::test
