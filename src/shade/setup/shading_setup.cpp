#include "shade/setup/shading_setup.h"

#include "shade/check_lanes.h"
#include "shade/gather/gather_input.h"

#define SIMD_FILE "shade/setup/shading_setup.cpp"
#include "simd/for_each_target.h"

#include "shade/setup/footprint-inl.h"
#include "shade/setup/triangle_setup-inl.h"
#include "simd/entries-inl.h"

SIMD_BEGIN(scanout::shade)

using Plane = texture::HWY_NAMESPACE::PlaneTerms<2, F64x8>;

// visit(a term of the plane, where it is kept).
template <class Visit>
SIMD_INLINE void for_terms(Plane& plane, const Visit& visit) {
    SIMD_FOR (int n = 0; n < 2; ++n) {
        visit(plane.f[n][0], 5 * n);
        visit(plane.f[n][1], 5 * n + 1);
        visit(plane.f_x[n], 5 * n + 2);
        visit(plane.f_y[n], 5 * n + 3);
    }
    visit(plane.sum_x, 4);
    visit(plane.sum_y, 9);
}

// How u and v lie on a register of triangles that are set up.
SIMD_INLINE void store_uv_plane(ShadingSetup& t, int at) {
    F64x8 a[3], b[3], inverse_w[3], f[2][3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        if (k > 0) {
            a[k] = to_f64(load<I32x8>(t.right[k - 1] + at));
            b[k] = to_f64(load<I32x8>(t.down[k - 1] + at));
        }
        inverse_w[k] = to_f64(load<F32x8>(t.inverse_w[k] + at));
        f[0][k] = to_f64(load<F32x8>(t.uv[0][k] + at));
        f[1][k] = to_f64(load<F32x8>(t.uv[1][k] + at));
    }
    a[0] = F64x8(0.0) - (a[1] + a[2]);
    b[0] = F64x8(0.0) - (b[1] + b[2]);
    Plane plane = texture::HWY_NAMESPACE::PlaneOf<2, F64x8>(a, b, inverse_w, f).terms();
    for_terms(plane,
              [&](const F64x8& term, int row) SIMD_LAMBDA { store(term, t.uv_plane[row] + at); });
}

// Of vertices 1 and 2; what is left of the triangle lies opposite vertex 0.
template <class N>
struct Areas {
    N one, two;
};

// Areas opposite the vertices are exact in 32 bits, or in doubles. The register is as wide as D.
template <class D>
struct AreaInt32 {
    using Number = Int<D>;
    static SIMD_INLINE Number of(Int<D> a) { return a; }
    static SIMD_INLINE Number twice(const ShadingSetup& t, int, int, const Entries<D>& entries) {
        return entries.of(t.twice_area);
    }
    static SIMD_INLINE Mask<D> narrow(Mask<D> mask) { return mask; }
    // For read_areas, in registers of another width.
    static SIMD_INLINE void keep(Number area, std::int32_t* to) { store(area, to); }
};
template <class D>
struct AreaDouble {
    using Number = Double<D>;
    static SIMD_INLINE Number of(Int<D> a) { return to_f64(a); }
    static SIMD_INLINE Number twice(const ShadingSetup& t, int item, int live, const Entries<D>&) {
        return DoubleEntries<D>(t.triangle_of + item, live).of(t.exact_twice_area);
    }
    static SIMD_INLINE Mask<D> narrow(const typename Number::DoubleMask& mask) {
        return HWY_NAMESPACE::narrow<D>(mask);
    }
    static SIMD_INLINE void keep(Number, std::int32_t*) {}
};
// At these places of the lanes, 1/256 pixel.
template <class In, class D>
SIMD_INLINE Areas<typename In::Number> areas_at(In, const ShadingSetup& t,
                                                const Entries<D>& entries, Int<D> x, Int<D> y) {
    const auto across = In::of(x - entries.of(t.x)), along = In::of(y - entries.of(t.y));
    const auto area = [&](int k) SIMD_LAMBDA {
        return (In::of(entries.of(t.right[k])) * across + In::of(entries.of(t.down[k])) * along) +
               In::of(Int<D>(0)); // no double is -0
    };
    return {area(0), area(1)};
}

// Which lanes their triangles cover where these areas are.
template <class In, class D, class N>
SIMD_INLINE Mask<D> covered(const ShadingSetup& t, const Entries<D>& entries, const N (&area)[3]) {
    const Int<D> zero = 0, one = 1;
    const Int<D> a[2] = {entries.of(t.right[0]), entries.of(t.right[1])};
    const Int<D> b[2] = {entries.of(t.down[0]), entries.of(t.down[1])};
    const auto inside = [&](const N& at, Int<D> right, Int<D> down) SIMD_LAMBDA {
        return In::narrow(at >= In::of(select(is_top_left(right, down), zero, one)));
    };
    return inside(area[0], zero - (a[0] + a[1]), zero - (b[0] + b[1])) &
           inside(area[1], a[0], b[0]) & inside(area[2], a[1], b[1]);
}

// The exact areas of a register of triangles, where twice_area_of has left them out.
SIMD_INLINE void fill_exact(ShadingSetup& t, int at) {
    const I32x8 known = load<I32x8>(t.fits_int32 + at);
    const F64x8 twice = to_f64(load<I32x8>(t.twice_area + at));
    const auto whole = to_f64(known) > F64x8(0.5);
    store(select(whole, twice, load<F64x8>(t.exact_twice_area + at)), t.exact_twice_area + at);
}

// Moves a register of lanes where they are shaded, and finds their weights there. sloped: slopes
// will be wanted, too.
template <class D, template <class> class In>
SIMD_INLINE void find_weights(ShadingSetup& t, ShadingBlock& block, int item, int live,
                              bool sloped) {
    using I = Int<D>;
    using N = typename In<D>::Number;
    const Entries<D> entries(t.triangle_of + item, live);
    I x = load<I>(block.x + item), y = load<I>(block.y + item);
    const N twice = In<D>::twice(t, item, live, entries);
    auto found = areas_at(In<D>(), t, entries, x, y);
    if (item + static_cast<int>(I::kLanes) > t.centred) { // not all cover the centre
        const I sample_x = load<I>(t.sample_x + item), sample_y = load<I>(t.sample_y + item);
        const N area[3] = {(twice - found.one) - found.two, found.one, found.two};
        const auto mine = (iota<I>(0) < I(live)) & (iota<I>(item) >= I(t.centred));
        const auto moves = mine & !covered<In<D>>(t, entries, area);
        x = x + select(moves, sample_x, I(0));
        y = y + select(moves, sample_y, I(0));
        store(x, block.x + item);
        store(y, block.y + item);
        found = areas_at(In<D>(), t, entries, x, y);
    }
    const N area[3] = {(twice - found.one) - found.two, found.one, found.two};
    SIMD_FOR (int k = 0; k < 3; ++k) {
        store(to_f32(area[k]) * entries.of(t.inverse_w[k]), t.weight[k] + item);
        if (sloped) In<D>::keep(area[k], t.area[k] + item);
    }
}

// The areas at a register of lanes that have been weighed.
template <class D>
SIMD_INLINE void read_areas(AreaInt32<D>, const ShadingSetup& t, const ShadingBlock&, int item, int,
                            Double<D> (&area)[3]) {
    SIMD_FOR (int k = 0; k < 3; ++k)
        area[k] = to_f64(load<Int<D>>(t.area[k] + item));
}
template <class D>
SIMD_INLINE void read_areas(AreaDouble<D>, const ShadingSetup& t, const ShadingBlock& block,
                            int item, int live, Double<D> (&area)[3]) {
    const Entries<D> entries(t.triangle_of + item, live);
    const auto found = areas_at(AreaDouble<D>(), t, entries, load<Int<D>>(block.x + item),
                                load<Int<D>>(block.y + item));
    area[0] = (AreaDouble<D>::twice(t, item, live, entries) - found.one) - found.two;
    area[1] = found.one;
    area[2] = found.two;
}

// How u and v change on the screen (footprint-inl.h).
template <template <class> class In>
SIMD_INLINE void store_slopes(ShadingSetup& t, const ShadingBlock& block, int item, int live) {
    using D = F32x8::Tag;
    const Entries<D> entries(t.triangle_of + item, live);
    const DoubleEntries<D> doubles(t.triangle_of + item, live);
    F64x8 area[3];
    read_areas(In<D>(), t, block, item, live, area);
    Plane plane;
    SIMD_FOR (int k = 0; k < 3; ++k)
        plane.inverse_w[k] = to_f64(entries.of(t.inverse_w[k]));
    for_terms(plane, [&](F64x8& term, int row) SIMD_LAMBDA { term = doubles.of(t.uv_plane[row]); });
    plane.f0[0] = plane.f0[1] = F64x8(0.0); // the values are not read
    const auto at = texture::HWY_NAMESPACE::PlaneOf<2, F64x8>(plane).at(area);
    SIMD_FOR (int c = 0; c < 2; ++c) {
        store(at.right[c], t.slope[c] + item);
        store(at.down[c], t.slope[2 + c] + item);
    }
}

// No loop over the triangles: how many there are is not foretold.
void take(const std::int32_t* number, const std::uint32_t* ids, int count, ShadingSetup& t,
          int item) {
    const std::int32_t first = number[0];
    std::int32_t* const to = t.triangle_of + item;
    std::uint32_t* const id = t.id + t.count;
    const I32 more = t.count - first;
    for (int i = 0; i < count; i += kLanes) {
        store(load<I32>(number + i) + more, to + i);
        store(load<I32>(ids + first + i), id + i);
    }
    t.count += number[count - 1] + 1 - first;
}

void set_up_triangles(const TriangleSource& s, ShadingSetup& t, ShadingBlock& b, int first,
                      int count) {
    const bool sloped = s.wanted.uv && s.wanted.footprint;
    const int begin = t.triangle_of[first], triangles = t.triangle_of[first + count - 1] + 1;
    bool fit_int32 = true;
    for (int i = 0; i < kLanes; ++i) // registers reach beyond the last
        t.id[t.count + i] = t.id[t.count - 1];
    using D = F32::Tag;
    for (int i = begin; i < triangles; i += kLanes)
        load_vertex_indices<D>(s, t, i);
    for (int i = begin; i < triangles; i += kLanes)
        fit_int32 &= set_up_register<D>(s, t, i);
    for (int i = begin; i < triangles; i += kLanes)
        set_up_attributes<D>(s, t, i);
    for (int i = begin; sloped && i < triangles; i += kLanesX8)
        store_uv_plane(t, i);
    const int end = first + count;
    if (fit_int32) {
        for (int i = first; i < end; i += kLanes)
            find_weights<F32::Tag, AreaInt32>(t, b, i, end - i, sloped);
    } else {
        for (int i = begin; i < triangles; i += kLanesX8)
            fill_exact(t, i);
        for (int i = first; i < end; i += kLanesX8)
            find_weights<F32x8::Tag, AreaDouble>(t, b, i, end - i, sloped);
    }
    if (!sloped) return;
    for (int i = first; i < end; i += kLanesX8) {
        if (fit_int32)
            store_slopes<AreaInt32>(t, b, i, end - i);
        else
            store_slopes<AreaDouble>(t, b, i, end - i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(take);
SIMD_REGISTER(set_up_triangles);

TriangleSource triangle_source(const GatherInput& in) {
    const geom::Mesh& mesh = *in.mesh;
    const auto floats = [](const auto& attribute) {
        return reinterpret_cast<const float*>(attribute.data());
    };
    TriangleSource s{};
    s.index = mesh.index_in_spatial_order().data();
    s.spatial_index =
        mesh.clusters.spatial_index.empty() ? nullptr : mesh.clusters.spatial_index.data();
    s.vertex = in.geometry->vertices().data();
    s.position = floats(mesh.position);
    s.normal = floats(mesh.normal);
    s.uv = floats(mesh.uv);
    s.exact_uv = in.frame->exact_uv ? mesh.exact_uv.data() : nullptr;
    s.colour = floats(mesh.colour);
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            s.linear[r][c] = in.view->linear[c][r];
        s.translation[r] = in.view->translation[r];
    }
    s.scale = in.unit;
    s.perspective = in.transform->perspective;
    s.mirrored = in.mirrored;
    s.sides = in.frame->sides;
    s.wanted = in.frame->attributes;
    return s;
}

void assign_triangles(const std::int32_t* number, const std::uint32_t* ids, int count,
                      ShadingSetup& triangles, int item) {
    SIMD_CALL(take, number, ids, count, triangles, item);
}

void set_up_run(const TriangleSource& source, ShadingSetup& triangles, ShadingBlock& block,
                int first, int count) {
    SIMD_CALL(set_up_triangles, source, triangles, block, first, count);
    check_triangles(triangles, source.wanted, first, count);
}

} // namespace scanout::shade
#endif
