// Perspective-correct interpolation: f = sum(b_i f_i / w_i) / sum(b_i / w_i) with the screen's
// areas b_i [A ch.5], Heckbert and Moreton 1991. All terms are positive, so nothing cancels at any
// ratio of distances. A result never leaves the range of its vertices, not even by rounding: u just
// below 0 would show the texel at the other end of the texture (HARD-CASES 34).
#include "shade/stage.h"

#include <algorithm>
#include <cmath>

namespace scanout::shade::interpolate {
namespace {

struct Float3 {
    float x, y, z;
};

void weights(Block& b) {
    for (int i = 0; i < b.count; ++i) {
        const float p0 = b.area[0][i] * b.inverse_w[0][i];
        const float p1 = b.area[1][i] * b.inverse_w[1][i];
        const float p2 = b.area[2][i] * b.inverse_w[2][i];
        const float sum = (p0 + p1) + p2;
        b.weight1[i] = p1 / sum;
        b.weight2[i] = p2 / sum;
    }
}

float mix(const Block& b, int i, float f0, float f1, float f2) {
    const float f = f0 + (b.weight1[i] * (f1 - f0) + b.weight2[i] * (f2 - f0));
    return std::min(std::max(f, std::min(std::min(f0, f1), f2)), std::max(std::max(f0, f1), f2));
}

Float3 mix(const Block& b, int i, std::span<const Vec3> attribute) {
    const Vec3 &f0 = attribute[b.vertex[0][i]], &f1 = attribute[b.vertex[1][i]],
               &f2 = attribute[b.vertex[2][i]];
    return {mix(b, i, f0.x, f1.x, f2.x), mix(b, i, f0.y, f1.y, f2.y), mix(b, i, f0.z, f1.z, f2.z)};
}

void normals(Block& b, const FrameState& frame) {
    const auto& m = frame.normal_matrix;
    for (int i = 0; i < b.count; ++i) {
        Float3 n = mix(b, i, frame.normal);
        // The side that the eye sees is lit, whichever way the file wound it or its normals.
        const float side = (n.x * b.facing[0][i] + n.y * b.facing[1][i]) + n.z * b.facing[2][i];
        const float sign = side < 0 ? -1.0F : 1.0F;
        n = {n.x * sign, n.y * sign, n.z * sign};
        const float x = (m[0][0] * n.x + m[0][1] * n.y) + m[0][2] * n.z;
        const float y = (m[1][0] * n.x + m[1][1] * n.y) + m[1][2] * n.z;
        const float z = (m[2][0] * n.x + m[2][1] * n.y) + m[2][2] * n.z;
        const float length = std::sqrt((x * x + y * y) + z * z);
        const bool usable = length > 0x1p-60F; // opposite normals can cancel: then face the eye
        const float scale = 1.0F / (usable ? length : 1.0F);
        b.normal[0][i] = usable ? x * scale : 0.0F;
        b.normal[1][i] = usable ? y * scale : 0.0F;
        b.normal[2][i] = usable ? z * scale : 1.0F;
    }
}

void run(Block& b, const FrameState& frame) {
    weights(b);
    if (frame.attributes.normal && b.lit) normals(b, frame);
    if (frame.attributes.uv && b.texture != nullptr) {
        for (int i = 0; i < b.count; ++i) {
            const Vec2 &f0 = frame.uv[b.vertex[0][i]], &f1 = frame.uv[b.vertex[1][i]],
                       &f2 = frame.uv[b.vertex[2][i]];
            b.u[i] = mix(b, i, f0.x, f1.x, f2.x);
            b.v[i] = mix(b, i, f0.y, f1.y, f2.y);
        }
    }
    const Vec3 kd = b.material->diffuse;
    for (int i = 0; i < b.count; ++i) {
        const Float3 c = frame.attributes.colour ? mix(b, i, frame.colour) : Float3{1, 1, 1};
        b.albedo[0][i] = kd.x * c.x;
        b.albedo[1][i] = kd.y * c.y;
        b.albedo[2][i] = kd.z * c.z;
    }
}

} // namespace

extern const Stage perspective;
constinit const Stage perspective{
    {.axis = "interpolate",
     .name = "perspective",
     .blurb = "weights divided by w at every pixel: straight lines stay straight",
     .source = "[A ch.5], Heckbert and Moreton 1991",
     .kind = Kind::rung,
     .needs = {}},
    run};

} // namespace scanout::shade::interpolate
