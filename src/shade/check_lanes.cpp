#include "shade/check_lanes.h"

#ifdef SCANOUT_CHECK_LANES
#include "base/check.h"
#include "rows.h"
#include "shade/setup/shading_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace scanout::shade {
namespace {

void check(const float* lanes, std::size_t count, std::string_view what, std::string_view stage) {
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(lanes[i]))
            check_failed(__FILE__, __LINE__, "every live lane is finite",
                         fmt::format("{} of lane {} is {} after {}", what, i, lanes[i], stage));
}

void check_value(double value, std::string_view what, std::string_view of, std::size_t number,
                 std::string_view stage) {
    if (!std::isfinite(value))
        check_failed(__FILE__, __LINE__, "every live lane is finite",
                     fmt::format("{} of {} {} is {} after {}", what, of, number, value, stage));
}

// What a stage of the axis light writes: the lights of its kind that vary. Shadows write them all.
// Of a stage of light, null of one of shadow.
void check_light(const ShadingBlock& b, const FrameState& frame, const LightStage* by,
                 std::string_view stage) {
    for (std::size_t k = 0; k < frame.varies.size(); ++k) {
        if (!frame.varies[k] || (by != nullptr && by->kind != frame.lights[k].kind)) continue;
        for (int c = 0; c < 3; ++c) {
            check(b.light[k].towards[c], static_cast<std::size_t>(b.count), "direction", stage);
            check(b.light[k].colour[c], static_cast<std::size_t>(b.count), "light", stage);
        }
    }
}

} // namespace

void check_lights(const FrameState& frame) {
    for (std::size_t k = 0; k < frame.lights.size(); ++k) {
        const scene::ViewLight& light = frame.lights[k];
        const auto check_one = [&](double value, std::string_view what) {
            check_value(value, what, "light", k, "the frame's set-up");
        };
        for (int c = 0; c < 3; ++c) {
            check_one(light.colour[c], "colour");
            check_one(light.towards[c], "direction");
            check_one(light.position[c], "position");
            check_one(light.axis[c], "axis");
        }
        for (const float length : {light.reach, light.nearest, light.size})
            check_one(length, "length");
        for (const float cosine : {light.cos_inner, light.cos_outer})
            check_one(cosine, "cosine");
    }
}

void check_primitive(const Primitive& p, const Attributes& wanted) {
    const auto check_one = [&](double value, std::string_view what) {
        check_value(value, what, "triangle", p.id, "set-up");
    };
    for (std::size_t k = 0; k < 3; ++k) {
        for (const double value : {p.a[k], p.b[k], p.c[k], p.least[k]})
            check_one(value, "weight");
        check_one(p.inverse_w[k], "1 / w");
        check_one(p.facing[k], "facing");
        for (int c = 0; c < 3; ++c) {
            if (wanted.normal) check_one(p.normal[c][k], "normal");
            if (wanted.colour) check_one(p.colour[c][k], "colour");
            if (wanted.position) check_one(p.position[c][k], "position");
            if (wanted.uv && c < 2) check_one(p.uv[c][k], "uv");
            if (wanted.object) check_one(p.object[c][k], "place");
        }
    }
}

void check_triangles(const ShadingSetup& t, const Attributes& wanted, int first, int count) {
    for (int i = first; i < first + count; ++i) {
        const int n = t.triangle_of[i];
        const auto check_one = [&](double value, std::string_view what) {
            check_value(value, what, "triangle", t.id[n], "set-up");
        };
        for (int k = 0; k < 3; ++k) {
            check_one(t.weight[k][i], "weight");
            for (int c = 0; c < 3; ++c) {
                if (wanted.normal) check_one(t.normal[c][k][n], "normal");
                if (wanted.colour) check_one(t.colour[c][k][n], "colour");
                if (wanted.position) check_one(t.position[c][k][n], "position");
                if (wanted.uv && c < 2) check_one(t.uv[c][k][n], "uv");
            }
        }
        for (const auto& component : t.facing)
            check_one(component[n], "facing");
        if (wanted.uv && wanted.footprint)
            for (const auto& slope : t.slope)
                check_one(slope[i], "slope of u or v");
    }
}

void check_before_clamp(const float* lanes, int count, int first) {
    for (int i = 0; i < count; ++i)
        check_value(lanes[i], "value", "lane", static_cast<std::size_t>(first + i),
                    "interpolation, before it is clamped");
}

void check_rays(const ShadingBlock& b, const FrameState& frame) {
    if (!b.lit || !frame.attributes.ray) return;
    const auto count = static_cast<std::size_t>(b.count);
    check(b.ray_x, count, "ray x", "set_rays");
    check(b.ray_y, count, "ray y", "set_rays");
}

void check_lanes(const ShadingBlock& b, const FrameState& frame, const Stage& stage) {
    std::array<char, 80> text; // no string: frames are counted not to allocate
    const auto written =
        fmt::format_to_n(text.data(), text.size(), "{} {}", stage.card.axis, stage.card.name);
    const std::string_view name(text.data(), std::min(written.size, text.size()));
    const auto count = static_cast<std::size_t>(b.count);
    for (int c = 0; c < 3; ++c) {
        check(b.albedo[c], count, "albedo", name);
        if (b.lit && frame.attributes.normal) check(b.normal[c], count, "normal", name);
        if (b.lit && stage.pass == Pass::emission) check(b.colour[c], count, "colour", name);
        if (b.lit && frame.attributes.position) check(b.position[c], count, "position", name);
        if (stage.pass == Pass::shading || stage.pass == Pass::tone)
            check(b.colour[c], count, "colour", name);
    }
    if (b.lit && stage.pass == Pass::light)
        check_light(b, frame, find_row(light::kRows, stage.card.name), name);
    if (b.lit && stage.pass == Pass::shadow) check_light(b, frame, nullptr, name);
    for (int c = 0; c < 3; ++c)
        check_value(b.ambient[c], "colour", "ambient light", 0, name);
    for (int c = 0; c < 3 && b.hemispheres; ++c)
        check(b.from_hemispheres[c], count, "colour of a hemisphere", name);
    const auto scales_by = [&](Map map) {
        return (stage.needs.maps & bit_of(map)) != 0 && b.map[map].texture != nullptr;
    };
    if (scales_by(kShininessMap)) check(b.shininess, count, "exponent", name);
    if (scales_by(kRoughnessMap)) check(b.roughness, count, "roughness", name);
    if (scales_by(kMetalnessMap)) check(b.metalness, count, "share of metal", name);
    if (!wants_uv(b, frame)) return;
    check(b.u, count, "u", name);
    check(b.v, count, "v", name);
    if (frame.attributes.footprint)
        for (const float* slope : {b.u_x, b.v_x, b.u_y, b.v_y})
            check(slope, count, "slope of u or v", name);
    if (stage.pass != Pass::maps && stage.pass != Pass::emission) return;
    if ((stage.needs.maps & bit_of(kOpacityMap)) != 0) return check(b.alpha, count, "alpha", name);
    // Where one number counts, it may be the sample's alpha alone.
    constexpr MapBits kScalars =
        bit_of(kShininessMap) | bit_of(kBumpMap) | bit_of(kRoughnessMap) | bit_of(kMetalnessMap);
    if ((stage.needs.maps & kScalars) != 0) return;
    for (int c = 0; c < 3; ++c)
        check(b.sampled[c], count, "sampled", name);
}

void check_values(std::span<const float> values, std::string_view what, std::string_view stage) {
    check(values.data(), values.size(), what, stage);
}

void check_sums(const PixelSums& sums, std::size_t count) {
    for (const auto* channel : {&sums.red, &sums.green, &sums.blue})
        check(channel->data(), count, "sum", "the sums of samples");
}

} // namespace scanout::shade
#endif
