// What the techniques with a shadow map share: from lanes to texels, and the one question to a
// texel. Williams 1978.
//
// No bias is guessed. A texel knows the depth at its centre, up to half a texel from the receiver;
// there the receiver's own plane is deeper or nearer by at most half a texel times
// |dz/dx| + |dz/dy|, the bias of HARD-CASES 41. It is known exactly, so the plane is carried to the
// centre and compared there: what lies in the plane is never in its own shadow, at any slope, and
// what stands on it is hardly lit under its foot (kRise). What remains is rounding: of the map's
// vertices to 1/256 texel, of its depth to a float, and of the receiver's position.
#if defined(SCANOUT_SHADE_SHADOW_MAP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SHADOW_MAP_INL_H
#undef SCANOUT_SHADE_SHADOW_MAP_INL_H
#else
#define SCANOUT_SHADE_SHADOW_MAP_INL_H
#endif

#include "shade/shadow/plane-inl.h"
#include "simd/quads-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

// Steeper planes count as this steep: 4096 units along the light's ray for one across it.
constexpr double kSteepest = 0x1p12;

// The plane of a face that the light meets edge-on soon passes whatever stands before the light.
// So beyond the face itself it comes nearer to the light by no more than this, for one unit across
// the ray: the surface goes on there in faces that lean less or bend away. On a ball of 250 texels
// that is more than it rises anywhere but in the last texel of its lit side.
constexpr float kBeyond = 16;

// In the map a face that the light meets edge-on is thinner than a texel. What covers it, as the
// lid of a box does the wall that nearly contains the lamp, stands in texels on the face's lit
// side alone; those behind it show what lies beyond, as if the light came in there. So from kBeyond
// on, and wholly from here on, lookups move over to the lit side, where the plane falls, and ask
// nothing behind.
constexpr float kEdgeOn = 3 * kBeyond;

// The lanes' triangles' planes in a map.
struct MapPlane {
    F32 per_x, per_y;     // depth a texel
    F32 bias, bias_slope; // fixed part, a unit of depth; and times 1 / distance
    F32 error;            // of a position, view units
    F32 nearest;          // depth of the triangle's vertices: the greatest
};

SIMD_INLINE MapPlane plane_in(const ShadowMap& m, const Facing& facing) {
    const Vec3F64 move = everywhere<Vec3F64>(m.translation),
                  n = transformed(m.rotation, facing.normal),
                  p = transformed(m.rotation, facing.vertex[0]) + move;
    F64 extent = greatest(abs(move));
    SIMD_FOR (int k = 0; k < 3; ++k)
        extent = maximum(extent, greatest(abs(facing.vertex[k])));
    // Positions are floats, and so is the light's matrix: each of some eight roundings adds at most
    // half a unit in the last place of the largest term.
    const F64 error = extent * F64(0x1p-21), scale = double{m.depth_scale}, zero = 0.0;
    const F64 length = greatest(abs(n));
    F64 to_depth;
    if (m.perspective) {
        // n.(x, y, -w) = d, so 1 / w = (n_x x/w + n_y y/w - n_z) / d; d < 0 on the lit side.
        const F64 reach = greatest(abs(p));
        to_depth = scale / -maximum(-dot(n, p), length * reach * F64(1 / kSteepest));
    } else {
        to_depth = -scale / maximum(n.z, length * F64(1 / kSteepest));
    }
    F64 nearest = 0.0;
    SIMD_FOR (int k = 0; k < 3; ++k) {
        F64 depth = dot(everywhere<Vec3F64>(m.rotation[2]), facing.vertex[k]) + move.z;
        if (m.perspective) // else beside the light, or behind it
            depth = select(depth < zero, scale / -depth, F64(0x1p100));
        else
            depth = depth * scale + F64(double{m.depth_offset});
        nearest = maximum(nearest, depth);
    }
    const F64 per_x = n.x * to_depth * F64(1 / double{m.scale_x}),
              per_y = -(n.y * to_depth) * F64(1 / double{m.scale_y});
    // In perspective x / w errs by error (1 + |x / w|) / w, and |x / w| stays below 1.5.
    const F64 slope = abs(per_x) + abs(per_y);
    const F64 texels = F64(double{m.scale_x > m.scale_y ? m.scale_x : m.scale_y}) * error *
                       F64(m.perspective ? 2.5 : 1.0);
    const F64 fixed = m.perspective ? zero : scale * error;
    return {to_f32(per_x),          to_f32(per_y), to_f32(slope * F64(0x1p-6) + fixed),
            to_f32(slope * texels), to_f32(error), to_f32(nearest)};
}

// Where two faces meet in a hollow edge, texels beside the receiver show the other face, which
// rises above the receiver's plane. What rises less than so many texels for each one aside hides
// nothing from there: enough for right angles that the light meets 21 degrees and more from either
// face. A light of 18 degrees has no penumbra from what is that low. The price: what is thinner
// than that lets light under its foot, at most 1.5 texels (HARD-CASES 42).
constexpr float kRise = 3;

// Where the light grazes a face, the next one, which leans towards it by an angle, rises above the
// face's plane by that angle times the slope's square: so much more hides nothing there, up to what
// kBeyond allows above the plane, or to the receiver's own depth: what is nearer to the light than
// that covers it, however far the plane has fallen. For six degrees.
constexpr float kFold = 0.1F;

struct Receiver {
    F32 x, y; // texels
    F32 depth, per_x, per_y, bias;
    F32 rise_x, rise_y;   // depth that hides nothing, a texel aside
    F32 nearest;          // of its triangle
    F32 fold;             // rises more that hide nothing
    F32 aside_x, aside_y; // towards its lit side, a texel that a lookup reaches from its middle
    Mask<F32::Tag> asked; // an answer for the other lanes is not used
};

// The lanes from i on, in a map. inside: which stand in it; the others are in its middle.
SIMD_INLINE Receiver receiver(const ShadowMap& m, const MapPlane& plane, const Places& places,
                              int i, Mask<F32::Tag>& inside) {
    const Vec3F32 place = transformed(m.rotation, load_vec3<Vec3F32>(places, i)) +
                          everywhere<Vec3F32>(m.translation); // as the light sees it
    const F32 one = 1.0F;
    const F32 middle = 0.5F * static_cast<float>(m.size), half = m.half;
    F32 inverse = one, depth = place.z * F32(m.depth_scale) + F32(m.depth_offset);
    inside = one == one;
    if (m.perspective) {
        const F32 w = F32(0.0F) - place.z;
        inside = w > F32(0x1p-40F);
        inverse = one / select(inside, w, one);
        depth = F32(m.depth_scale) * inverse;
    }
    const F32 right = (place.x * inverse) * F32(m.scale_x),
              up = (place.y * inverse) * F32(m.scale_y);
    inside = inside & (abs(right) <= half) & (abs(up) <= half);
    Receiver r;
    r.x = select(inside, middle + right, middle);
    r.y = select(inside, middle - up, middle);
    r.depth = depth;
    r.per_x = plane.per_x;
    r.per_y = plane.per_y;
    r.bias = (plane.bias + plane.bias_slope * inverse) + abs(depth) * F32(0x1p-21F);
    if (m.perspective) r.bias = r.bias + (depth * plane.error) * inverse;
    const F32 rise = F32(kRise) * (m.perspective ? depth : F32(m.depth_scale));
    r.rise_x = rise * F32(1.0F / m.scale_x);
    r.rise_y = rise * F32(1.0F / m.scale_y);
    r.nearest = plane.nearest + r.bias;
    const F32 slope_x = r.per_x / r.rise_x, slope_y = r.per_y / r.rise_y; // of kRise
    const F32 steep = slope_x * slope_x + slope_y * slope_y;
    r.fold = steep * F32(kFold * kRise);
    constexpr float kFrom = kBeyond * kBeyond / (kRise * kRise),
                    kTo = kEdgeOn * kEdgeOn / (kRise * kRise);
    const F32 edge_on =
        minimum(maximum((steep - F32(kFrom)) * F32(1 / (kTo - kFrom)), F32(0.0F)), one);
    // Down the plane, as far as a square's corner is.
    const F32 aside = edge_on * (abs(r.per_x) + abs(r.per_y)) /
                      maximum(r.per_x * r.per_x + r.per_y * r.per_y, F32(0x1p-100F));
    r.aside_x = F32(0.0F) - r.per_x * aside;
    r.aside_y = F32(0.0F) - r.per_y * aside;
    return r;
}

// Towards -infinity.
SIMD_INLINE I32 texel_of(F32 a) {
    const I32 whole = to_i32(a);
    return whole - select(to_f32(whole) > a, I32(1), I32(0));
}

struct Texel {
    F32 depth; // in the map; its border goes on for ever
    F32 own;   // of the receiver's plane at the texel's centre, and what is forgiven there
    F32 plane; // without that
};
// What texels of a column, or of a row, have in common.
struct Line {
    I32 place; // in the map: the column; where the row begins
    F32 rise, plane;
};
SIMD_INLINE Line column(const ShadowMap& m, const Receiver& r, I32 x) {
    const F32 aside = (to_f32(x) + F32(0.5F)) - r.x;
    return {minimum(maximum(x, I32(0)), I32(m.size - 1)), r.rise_x * abs(aside), r.per_x * aside};
}
SIMD_INLINE Line row(const ShadowMap& m, const Receiver& r, I32 y) {
    const F32 aside = (to_f32(y) + F32(0.5F)) - r.y;
    return {minimum(maximum(y, I32(0)), I32(m.size - 1)) * I32(m.size), r.rise_y * abs(aside),
            r.per_y * aside};
}
// depth: the map's, where column and row cross.
SIMD_INLINE Texel texel(const Receiver& r, const Line& column, const Line& row, F32 depth) {
    const F32 rise = column.rise + row.rise;
    const F32 plane = (r.depth + (column.plane + row.plane)) + r.bias;
    const F32 beyond = minimum(plane, r.nearest) + rise * F32(kBeyond / kRise);
    const F32 own = minimum(plane + rise * r.fold, maximum(beyond, r.depth)) + rise;
    return {depth, maximum(own, F32(0.0F)), plane};
}
SIMD_INLINE F32 depth_at(const ShadowMap& m, const Line& column, const Line& row) {
    return gather(m.depth, row.place + column.place);
}
// The one that lies so far aside from the receiver.
SIMD_INLINE Texel texel_at(const ShadowMap& m, const Receiver& r, F32 dx, F32 dy) {
    const F32 half = 0.5F;
    const Line across = column(m, r, texel_of((r.x + half * r.aside_x) + dx)),
               down = row(m, r, texel_of((r.y + half * r.aside_y) + dy));
    return texel(r, across, down, depth_at(m, across, down));
}
SIMD_INLINE Texel own_texel(const ShadowMap& m, const Receiver& r) {
    return texel_at(m, r, F32(0.0F), F32(0.0F));
}
// 1 where something stands between the texel's part of the receiver's plane and the light.
SIMD_INLINE F32 hidden(const Texel& t) {
    return select(t.depth > t.own, F32(1.0F), F32(0.0F));
}

// Where the receiver's own texel hides it, it lies in no hollow edge that the light looks into:
// what rises aside then stands between it and the light, however close behind (a face that is
// folded over, as the lips of a mouth about a lamp within). Without this a filter let in light from
// as far behind as kRise forgives at its rim.
SIMD_INLINE void forgive_nothing_behind(const Texel& own, Line& line) {
    line.rise = select(own.depth > own.own, F32(0.0F), line.rise);
}

// Surely light: no higher than the lower of plane and receiver. What the fold forgives, and the
// triangle's own height, only add to that.
SIMD_INLINE Mask<F32::Tag> is_low(const Receiver& r, const Line& column, const Line& row,
                                  F32 depth) {
    const F32 plane = (r.depth + (column.plane + row.plane)) + r.bias;
    return depth <= minimum(r.depth, plane) + (column.rise + row.rise);
}

// What a square asks of a row is read four texels at a time: up to three more.
constexpr int kMaxColumns = kMaxFilter / 4 * 4 + 4;

// Four texels of a row, from a column on, that lie side by side in the map.
SIMD_INLINE void four_depths(const ShadowMap& m, const Line& column, const Line& row, F32* out) {
    std::int32_t place[kLanes];
    store(row.place + column.place, place);
    const auto* words = reinterpret_cast<const std::int32_t*>(m.depth);
    const auto four =
        load_four<F32::Tag>([&](int lane) SIMD_LAMBDA { return words + place[lane]; });
    SIMD_FOR (int i = 0; i < 4; ++i)
        out[i] = from_bits(four.word(i));
}

// f(0), ... as often as is known when this is compiled, or, where that is 0, `count` times.
template <int kCount, class F>
SIMD_INLINE void times(int count, const F& f) {
    if constexpr (kCount > 0) {
        SIMD_FOR (int i = 0; i < kCount; ++i)
            f(i);
    } else {
        for (int i = 0; i < count; ++i)
            f(i);
    }
}

// The texels that a square of k x k about the receiver touches, k + 1 each way. kSide: k, or 0
// where it is not known when this is compiled.
template <int kSide>
class Square {
public:
    SIMD_INLINE Square(const ShadowMap& m, const Receiver& r, int k) : k_(k) {
        const float wide = static_cast<float>(k);
        const F32 reach = 0.5F * (wide + 1);
        const F32 x0 = (r.x + reach * r.aside_x) - F32(wide * 0.5F),
                  y0 = (r.y + reach * r.aside_y) - F32(wide * 0.5F);
        const I32 left = texel_of(x0), top = texel_of(y0);
        const auto part = [](F32 a) SIMD_LAMBDA {
            return to_f32(to_i32(maximum(a, F32(0.0F)) * F32(256.0F))) * F32(1.0F / 256);
        };
        fx_ = part(x0 - to_f32(left));
        fy_ = part(y0 - to_f32(top));
        each([&](int i) SIMD_LAMBDA {
            columns_[i] = column(m, r, left + I32(i));
            rows_[i] = row(m, r, top + I32(i));
        });
        read(m, left);
    }

    // Are all lanes that ask surely lit, for they lie low in all texels? Its own is one of them and
    // so forgives as much; where lookups have moved over, rounding may leave it out.
    SIMD_INLINE bool lie_low(const Receiver& r) const {
        // What is hidden shows in the middle.
        auto low = (r.aside_x == F32(0.0F)) & (r.aside_y == F32(0.0F)) &
                   is_low(r, columns_[k_ / 2], rows_[k_ / 2], depth_[k_ / 2][k_ / 2]);
        if (!all(low | !r.asked)) return false;
        each([&](int y) SIMD_LAMBDA {
            each([&](int x)
                     SIMD_LAMBDA { low = low & is_low(r, columns_[x], rows_[y], depth_[y][x]); });
        });
        return all(low | !r.asked);
    }
    // Do all lanes that ask lie behind all texels? Of what lies behind, nothing is forgiven that is
    // higher than its triangle.
    SIMD_INLINE bool lie_behind(const Receiver& r, const Texel& own) const {
        if (!all((own.depth > own.own) | !r.asked)) return false;
        F32 lowest = depth_[0][0];
        each([&](int y) SIMD_LAMBDA {
            each([&](int x) SIMD_LAMBDA { lowest = minimum(lowest, depth_[y][x]); });
        });
        return all((lowest > maximum(maximum(r.nearest, r.depth), F32(0.0F))) | !r.asked);
    }
    // Weighted by how much of each texel the square covers. Weights are whole 256ths: all hidden
    // sums up to 1 exactly.
    SIMD_INLINE F32 hidden_fraction(const Receiver& r, const Texel& own) {
        each([&](int i) SIMD_LAMBDA {
            forgive_nothing_behind(own, columns_[i]);
            forgive_nothing_behind(own, rows_[i]);
        });
        const F32 one = 1.0F;
        F32 sum = 0.0F;
        each([&](int y) SIMD_LAMBDA {
            F32 in_row = 0.0F;
            each([&](int x) SIMD_LAMBDA {
                const F32 weight = x == 0 ? one - fx_ : x == k_ ? fx_ : one;
                in_row = in_row + weight * hidden(texel(r, columns_[x], rows_[y], depth_[y][x]));
            });
            sum = sum + (y == 0 ? one - fy_ : y == k_ ? fy_ : one) * in_row;
        });
        const float wide = static_cast<float>(k_);
        return sum / F32(wide * wide);
    }

private:
    static constexpr int kLines = kSide > 0 ? kSide + 1 : 0, kFours = kSide > 0 ? kSide / 4 + 1 : 0;
    static constexpr int kRows = kSide > 0 ? kLines : kMaxFilter + 1;
    static constexpr int kColumns = kSide > 0 ? kFours * 4 : kMaxColumns;

    template <class F>
    SIMD_INLINE void each(const F& f) const {
        times<kLines>(k_ + 1, f);
    }
    SIMD_INLINE void read(const ShadowMap& m, I32 left) {
        // No column that is read lies beyond the map's border.
        const int count = k_ / 4 * 4 + 4;
        const bool side_by_side = all((left >= I32(0)) & (left <= I32(m.size - count)));
        each([&](int y) SIMD_LAMBDA {
            if (side_by_side)
                times<kFours>(count / 4, [&](int x) SIMD_LAMBDA {
                    four_depths(m, columns_[4 * x], rows_[y], depth_[y] + 4 * x);
                });
            else
                each([&](int x) SIMD_LAMBDA { depth_[y][x] = depth_at(m, columns_[x], rows_[y]); });
        });
    }

    int k_;
    F32 fx_, fy_; // how much of the first texels it leaves, of the last ones it covers
    Line columns_[kColumns], rows_[kRows];
    F32 depth_[kRows][kColumns];
};

// The share of a square that is hidden.
template <int kSide>
SIMD_INLINE F32 hidden_square_of(const ShadowMap& m, const Receiver& r, int k) {
    Square<kSide> square(m, r, k);
    if (square.lie_low(r)) return F32(0.0F); // most of what is lit
    const Texel own = own_texel(m, r);
    if (square.lie_behind(r, own)) return F32(1.0F);
    return square.hidden_fraction(r, own);
}
SIMD_INLINE F32 hidden_square(const ShadowMap& m, const Receiver& r, int k) {
    switch (k) {
    case 2: // what a GPU's filter reads
        return hidden_square_of<2>(m, r, k);
    case 3: // usual
        return hidden_square_of<3>(m, r, k);
    default:
        return hidden_square_of<0>(m, r, k);
    }
}

SIMD_INLINE Mask<F32::Tag> of_inner_side(const LightShadow& shadow, const Facing& facing) {
    const auto all = F32(0.0F) == F32(0.0F);
    switch (shadow.inner) {
    case raster::Facing::back:
        return facing.back;
    case raster::Facing::front:
        return facing.back ^ all;
    default:
        return all ^ all;
    }
}

// Of a receiver within a closed mesh, for which the light stands outside: does any texel about it
// lie above its plane? Then it is dark. In the edge where the face that hides it meets its own,
// texels beyond the edge show what lies outside, and those before it rise so little that a hollow
// edge might be there, which the light looks into.
SIMD_INLINE Mask<F32::Tag> hidden_within(const ShadowMap& m, Receiver r) {
    r.rise_x = r.rise_y = r.aside_x = r.aside_y = F32(0.0F);
    auto hides = F32(0.0F) > F32(0.0F);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const Texel t = texel_at(m, r, F32(static_cast<float>(x)), F32(static_cast<float>(y)));
            hides = hides | (t.depth > t.own);
        }
    return hides;
}

// hide(map, receiver, light): the share that is hidden. A lane asks the first map that it stands
// in; outside of all of them nothing stands between it and the light (HARD-CASES 43).
template <class Hide>
SIMD_INLINE void shadow_by_maps(ShadingBlock& b, const FrameState& frame, Hide hide) {
    const auto store_visibility = [&](std::size_t k, int first, int end, const Facing& facing,
                                      const Places& places, float* visibility) SIMD_LAMBDA {
        const LightShadow& shadow = frame.shadows[k];
        const F32 none = -1.0F; // asked no map yet
        for (int i = first; i < end; i += kLanes)
            store(none, visibility + i);
        const auto lit = to_f32(select(facing.lit, F64(1.0), F64(0.0))) >
                         F32(0.5F); // the others lie in their own shadow
        const auto within = of_inner_side(shadow, facing);
        const std::size_t maps = shadow.maps.size();
        for (std::size_t face = 0; face < maps; ++face) {
            const ShadowMap& m = shadow.maps.data()[face];
            const MapPlane plane = plane_in(m, facing);
            for (int i = first; i < end; i += kLanes) {
                auto inside = F32(0.0F) < F32(0.0F);
                Receiver r = receiver(m, plane, places, i, inside);
                const F32 before = load<F32>(visibility + i);
                r.asked = inside & lit & (before < F32(0.0F));
                if (!any(r.asked)) continue;
                F32 visible = F32(1.0F) - hide(m, r, shadow);
                if (any(within & r.asked & (visible > F32(0.0F))))
                    visible = select(within & hidden_within(m, r), F32(0.0F), visible);
                store(select(r.asked, visible, before), visibility + i);
            }
        }
        for (int i = first; i < end; i += kLanes) {
            const F32 visible = load<F32>(visibility + i);
            store(select(visible < F32(0.0F), F32(1.0F), visible), visibility + i);
        }
    };
    shadow_lanes(b, frame, store_visibility);
}

SIMD_END

#endif
