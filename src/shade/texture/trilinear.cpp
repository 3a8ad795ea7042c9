// Trilinear filtering: bilinear in the two levels of detail around the pixel's size, and linear
// between them, so that no line shows where they change. The pixel's footprint counts as a circle
// as wide as its longer side: slanted surfaces blur. Williams 1983, [Primer 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/trilinear.cpp"
#include "simd/for_each_target.h"

#include "shade/mip/mip-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// Registers of lanes that are all minified: places are found for the whole block before the first
// texel is read. A register that is read by itself waits for memory; so those behind it wait with
// it.
template <int kChannels>
class Minified {
public:
    // s and t in repeats of the texture, level in [1, last].
    SIMD_INLINE void add(const MipReader& reader, F32 s, F32 t, F32 level, int item) {
        s = reader.image().unit_x(s);
        t = reader.image().unit_y(t);
        const I32 sharp = to_i32(level);
        const MipReader::Levels level_near = reader.levels(sharp);
        near_.store_taps(reader.taps_in_chain(s, t, level_near), item);
        far_.store_taps(reader.taps_in_chain(s, t, reader.next(level_near)), item);
        store(level - to_f32(sharp), fraction_ + item);
        item_[count_++] = item;
    }
    SIMD_INLINE void read(const MipReader& reader, ShadingBlock& b) const {
        if (count_ == 0) return;
        const ChainTexels texels = reader.texels();
        for (int i = 0; i < count_; ++i) {
            const int item = item_[i];
            const auto found = quads_of_rows<F32::Tag>([&](auto number) SIMD_LAMBDA {
                return row<decltype(number)::value>(texels, item);
            });
            for (int c = kFirst; c < kFirst + kChannels; ++c)
                store(from_bits(found.word(c)), b.sampled[c] + item);
        }
    }

private:
    static constexpr int kFirst = kChannels == 1 ? 3 : 0;
    // Four texels around each lane of a block, in one level a lane.
    struct TapsOfBlock {
        TapWords<ChainTexels, kPaddedBlock> words_of_taps;
        float x[kPaddedBlock], y[kPaddedBlock];
        SIMD_INLINE void store_taps(const BilinearTaps& at, int item) {
            words_of_taps.store_taps(at, item);
            store(at.x, x + item);
            store(at.y, y + item);
        }
        template <int kRow>
        SIMD_INLINE F32 row(const ChainTexels& texels, int item) const {
            return blend_row<kRow>(texels, words_of_taps, item, load<F32>(x + item),
                                   load<F32>(y + item));
        }
    };
    template <int kRow>
    SIMD_INLINE F32 row(const ChainTexels& texels, int item) const {
        return mix(broadcast_in_quad<kRow>(load<F32>(fraction_ + item)),
                   near_.template row<kRow>(texels, item), far_.template row<kRow>(texels, item));
    }
    TapsOfBlock near_, far_;
    float fraction_[kPaddedBlock];
    int item_[kPaddedBlock / kLanes], count_ = 0;
};

template <int kChannels>
SIMD_INLINE void trilinear_lanes(ShadingBlock& b, const MipReader& reader) {
    // Levels first: with what follows a register's way would be a chain of some hundred cycles, and
    // registers overlap only as far as the processor looks ahead.
    alignas(64) float levels[kPaddedBlock];
    const F32 last = reader.last();
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 detail = level_of_detail(reader.slopes(b, i));
        store(minimum(maximum(detail, F32(0.0F)), last), levels + i);
    }
    Minified<kChannels> minified;
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 level = load<F32>(levels + i);
        const F32 s = reader.image().repeats_x(load<F32>(b.u + i));
        const F32 t = reader.image().repeats_y(load<F32>(b.v + i));
        if (any(level < F32(1.0F)))
            store_sample(reader.trilinear<kChannels>(s, t, level), b, i);
        else
            minified.add(reader, s, t, level, i);
    }
    minified.read(reader, b);
}

void trilinear_sample(ShadingBlock& b, const BoundMap& map, TexelKind kind) {
    const MipReader reader(map, kind);
    if (kind == TexelKind::alpha)
        trilinear_lanes<1>(b, reader);
    else
        trilinear_lanes<3>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(trilinear_sample);

extern const Filter trilinear;
constinit const Filter trilinear{
    {.axis = "texture",
     .name = "trilinear",
     .blurb = "bilinear in the two nearest levels of detail, linear between them",
     .source = "Williams 1983",
     .kind = Kind::rung,
     .may_err_more =
         {"nearest bilinear",
          "it blurs over two pixels, and along slanted surfaces over more: where a texture is "
          "flat but for sharp edges, one point of it is right more often"}},
    {.uv = true, .footprint = true},
    [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
        SIMD_CALL(trilinear_sample, block, map, kind);
    }};

} // namespace scanout::shade::texture
#endif
