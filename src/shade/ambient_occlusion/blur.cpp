#include "shade/ambient_occlusion/blur.h"

#define SIMD_FILE "shade/ambient_occlusion/blur.cpp"
#include "simd/for_each_target.h"

#include "shade/ambient_occlusion/surface-inl.h"

SIMD_BEGIN(scanout::shade::ambient_occlusion)

// Places that are farther from a pixel's plane than this part of the radius do not count.
constexpr float kPlane = 1.0F / 16;

// Two pixels to each side, which may lie beside the picture; the outermost two count half, so that
// each of four neighbours counts alike.
template <bool kOrthographic, bool kRows>
SIMD_INLINE F32 mean_around(const SurfaceImage& s, int x, int y, std::ptrdiff_t at,
                            const float* from) {
    const F32 px = to_f32(iota<I32>(x)), py = F32(static_cast<float>(y));
    const Seen seen = seen_at<kOrthographic>(s, px, py, at);
    const F32 steepness = F32(1.0F / (kPlane * s.radius));
    F32 sum = load<F32>(from + at), weights = 1.0F;
    SIMD_FOR (int k = -2; k <= 2; ++k) {
        if (k == 0 || (!kRows && (y + k < 0 || y + k >= s.height))) continue;
        const std::ptrdiff_t there = at + std::ptrdiff_t{k} * (kRows ? 1 : s.stride);
        const F32 shift = static_cast<float>(k);
        const Vec3F32 place = place_at<kOrthographic>(
            s, kRows ? px + shift : px, kRows ? py : py + shift, load<F32>(s.distance + there));
        const F32 off = abs(dot(seen.normal, place - seen.place)) * steepness;
        const F32 weight =
            maximum(F32(1.0F) - off, F32(0.0F)) * F32(k == -2 || k == 2 ? 0.5F : 1.0F);
        sum = sum + load<F32>(from + there) * weight;
        weights = weights + weight;
    }
    return sum / weights;
}

template <bool kOrthographic, bool kRows>
void blur_row(const SurfaceImage& s, int y, const float* from, float* to) {
    const std::ptrdiff_t row = std::ptrdiff_t{y} * s.stride;
    for (int x = 0; x < s.width; x += kLanes) {
        const auto seen = load<F32>(s.distance + row + x) < F32(SurfaceImage::kNowhere);
        F32 share = 1.0F;
        if (any(seen))
            share =
                select(seen, mean_around<kOrthographic, kRows>(s, x, y, row + x, from), F32(1.0F));
        store(share, to + row + x);
    }
}

template <bool kRows>
void blur_rows_of(const SurfaceImage& s, int y0, int y1, const float* from, float* to) {
    for (int y = y0; y < y1; ++y) {
        if (s.orthographic)
            blur_row<true, kRows>(s, y, from, to);
        else
            blur_row<false, kRows>(s, y, from, to);
    }
}

void along_rows(const SurfaceImage& s, int y0, int y1, const float* from, float* to) {
    blur_rows_of<true>(s, y0, y1, from, to);
}
void along_columns(const SurfaceImage& s, int y0, int y1, const float* from, float* to) {
    blur_rows_of<false>(s, y0, y1, from, to);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::ambient_occlusion {

SIMD_REGISTER(along_rows);
SIMD_REGISTER(along_columns);

void blur_along_rows(const SurfaceImage& image, int y0, int y1, const float* from, float* to) {
    SIMD_CALL(along_rows, image, y0, y1, from, to);
}
void blur_along_columns(const SurfaceImage& image, int y0, int y1, const float* from, float* to) {
    SIMD_CALL(along_columns, image, y0, y1, from, to);
}

} // namespace scanout::shade::ambient_occlusion
#endif
