#include "shade/ambient_occlusion/horizon.h"

#include "math/transcendental.h"

#define SIMD_FILE "shade/ambient_occlusion/horizon.cpp"
#include "simd/for_each_target.h"

#include "shade/ambient_occlusion/surface-inl.h"

SIMD_BEGIN(scanout::shade::ambient_occlusion)

// Surfaces that rise less than this part of a pixel above a face's plane lie in it: corners are
// moved by up to 1/512 pixel each way when they snap to the grid.
constexpr float kLevel = 1.0F / 64;
constexpr float kMaxReach = 1.0F / 3; // of the picture's height, so that steps stay dense
constexpr float kPi = 3.14159265F;

// acos(c) - c sin(acos(c)), to 4e-6: its slope is -2 sin, so near 1 it falls as (1 - c)^(3/2).
SIMD_INLINE F32 arc_of(F32 cosine) {
    const F32 x = abs(cosine), rest = maximum(F32(1.0F) - x, F32(0.0F));
    const F32 series =
        F32(1.5707993F) +
        x * (F32(0.35604175F) +
             x * (F32(-0.053460901F) + x * (F32(0.015317534F) + x * F32(-0.0030815867F))));
    const F32 arc = rest * sqrt(rest) * series;
    return select(cosine < F32(0.0F), F32(kPi) - arc, arc);
}

// One side of a plane through the eye's ray: up to an angle from it, twice the light that comes
// from there, the integral of (n . direction) sin(angle).
struct SideOfPlane {
    F32 towards_eye, aside; // the normal along the ray and across it
    SIMD_INLINE F32 light_within(F32 cosine) const {
        return towards_eye * (F32(1.0F) - cosine * cosine) + aside * arc_of(cosine);
    }
};

struct Horizon {
    SideOfPlane side;
    F32 cosine, light; // from the eye's ray; what comes from above it
    F32 hidden;        // of what came from above the face's plane
};

// Falls with the square of the distance, to 0 at `reach`.
struct Falloff {
    F32 inverse_square;
    SIMD_INLINE F32 at(F32 square) const {
        return maximum(F32(1.0F) - square * inverse_square, F32(0.0F));
    }
};

struct Asked {
    const SurfaceImage& image;
    const Seen& seen;
    I32 x, y;
    F32 level;
    Falloff falloff;
};

// Looks at the pixel that is so far aside.
template <bool kOrthographic>
SIMD_INLINE void look(const Asked& asked, I32 aside, I32 down, Horizon& h) {
    const SurfaceImage& s = asked.image;
    const I32 x = asked.x + aside, y = asked.y + down;
    const auto inside = !(less_unsigned(I32(s.width - 1), x) | less_unsigned(I32(s.height - 1), y));
    const I32 at = select(inside, y * I32(s.stride) + x, I32(0));
    const Vec3F32 way =
        place_at<kOrthographic>(s, to_f32(x), to_f32(y), gather(s.distance, at)) - asked.seen.place;
    const F32 square = maximum(length_squared(way), F32(0x1p-100F));
    const F32 cosine = minimum(dot(asked.seen.eye, way) * (F32(1.0F) / sqrt(square)), F32(1.0F));
    const auto raised = inside & (dot(asked.seen.normal, way) > asked.level) & (cosine > h.cosine);
    const F32 light = h.side.light_within(cosine);
    h.hidden = h.hidden + select(raised, asked.falloff.at(square) * (h.light - light), F32(0.0F));
    h.cosine = select(raised, cosine, h.cosine);
    h.light = select(raised, light, h.light);
}

SIMD_INLINE I32 nearest_whole(F32 a) { // |a| < 2^14
    return to_i32(a + F32(16384.5F)) - I32(16384);
}

// The share of a register of pixels.
template <bool kOrthographic>
SIMD_INLINE F32 open_share(const SurfaceImage& s, const HorizonPattern& p, int x, int y,
                           std::ptrdiff_t at) {
    const F32 px = to_f32(iota<I32>(x)), py = F32(static_cast<float>(y));
    const Seen seen = seen_at<kOrthographic>(s, px, py, at);
    const F32 pixel = footprint<kOrthographic>(s, seen);
    const F32 reach = minimum(F32(s.radius) / pixel, F32(kMaxReach * static_cast<float>(s.height)));
    const F32 radius = reach * pixel;
    const Asked asked{
        s, seen, iota<I32>(x), I32(y), pixel * F32(kLevel), {F32(1.0F) / (radius * radius)}};
    const F32 towards_eye = maximum(dot(seen.normal, seen.eye), F32(0.0F));
    const F32 move = load<F32>(p.move[y % HorizonPattern::kTile]);
    F32 all = 0.0F, hidden = 0.0F;
    for (int k = 0; k < p.pairs; ++k) {
        const F32 cosine = load<F32>(p.cosine[k][y % HorizonPattern::kTile]),
                  sine = load<F32>(p.sine[k][y % HorizonPattern::kTile]);
        // Across the ray, in the plane.
        const Vec3F32 on_screen = {cosine, F32(0.0F) - sine, F32(0.0F)};
        const Vec3F32 level = on_screen - seen.eye * dot(on_screen, seen.eye);
        const F32 aside = dot(seen.normal, level) * (F32(1.0F) / length(level));
        const F32 size = sqrt(towards_eye * towards_eye + aside * aside);
        const F32 tilt = aside / maximum(size, F32(0x1p-40F));
        const auto from = [&](F32 sign) SIMD_LAMBDA {
            Horizon h;
            h.side = {towards_eye, aside * sign};
            h.cosine = F32(0.0F) - tilt * sign; // of the face's own plane
            h.light = h.side.light_within(h.cosine);
            h.hidden = 0.0F;
            return h;
        };
        Horizon there = from(F32(1.0F)), back = from(F32(-1.0F));
        all = all + (there.light + back.light);
        for (int step = 0; step < p.steps; ++step) {
            const F32 share =
                (F32(static_cast<float>(step)) + move) * F32(1.0F / static_cast<float>(p.steps));
            const F32 far = maximum(share * share * reach, F32(static_cast<float>(step + 1)));
            const I32 right = nearest_whole(cosine * far), down = nearest_whole(sine * far);
            look<kOrthographic>(asked, right, down, there);
            look<kOrthographic>(asked, I32(0) - right, I32(0) - down, back);
        }
        hidden = hidden + (there.hidden + back.hidden);
    }
    const F32 open = F32(1.0F) - hidden / maximum(all, F32(0x1p-40F));
    return minimum(maximum(open, F32(0.0F)), F32(1.0F));
}

template <bool kOrthographic>
void find_in_row(const SurfaceImage& s, const HorizonPattern& p, int y, float* open) {
    const std::ptrdiff_t row = std::ptrdiff_t{y} * s.stride;
    for (int x = 0; x < s.width; x += kLanes) {
        const auto seen = load<F32>(s.distance + row + x) < F32(SurfaceImage::kNowhere);
        F32 share = 1.0F;
        if (any(seen))
            share = select(seen, open_share<kOrthographic>(s, p, x, y, row + x), F32(1.0F));
        store(share, open + row + x);
    }
}

void find_in_rows(const SurfaceImage& s, const HorizonPattern& p, int y0, int y1, float* open) {
    for (int y = y0; y < y1; ++y) {
        if (s.orthographic)
            find_in_row<true>(s, p, y, open);
        else
            find_in_row<false>(s, p, y, open);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::ambient_occlusion {

SIMD_REGISTER(find_in_rows);

HorizonPattern horizon_pattern(const OcclusionTraits& of) {
    constexpr double kHalfTurn = 3.14159265358979323846;
    HorizonPattern p;
    p.pairs = of.directions / 2;
    p.steps = of.steps;
    for (int y = 0; y < HorizonPattern::kTile; ++y) {
        for (int lane = 0; lane < HorizonPattern::kRegister; ++lane) {
            const int x = lane % HorizonPattern::kTile;
            p.move[y][lane] = static_cast<float>((y - x) & 3) * 0.25F + 0.125F;
            const int turn = (((x + y) & 3) << 2) + x; // each of 16 once
            for (int k = 0; k < p.pairs; ++k) {
                const double angle = (k + turn / 16.0) * kHalfTurn / p.pairs;
                p.cosine[k][y][lane] = static_cast<float>(scanout::cos(angle));
                p.sine[k][y][lane] = static_cast<float>(scanout::sin(angle));
            }
        }
    }
    return p;
}

void find_horizons(const SurfaceImage& image, const HorizonPattern& pattern, int y0, int y1,
                   float* open) {
    SIMD_CALL(find_in_rows, image, pattern, y0, y1, open);
}

} // namespace scanout::shade::ambient_occlusion
#endif
