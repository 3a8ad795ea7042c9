// The set-up of unclipped triangles for shading, one a lane: their vertices in canonical order, the
// edges between them, and what those carry. Included once for every SIMD target.
#if defined(SCANOUT_SHADE_SETUP_TRIANGLE_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SETUP_TRIANGLE_SETUP_INL_H
#undef SCANOUT_SHADE_SETUP_TRIANGLE_SETUP_INL_H
#else
#define SCANOUT_SHADE_SETUP_TRIANGLE_SETUP_INL_H
#endif

#include "shade/setup/shading_setup.h"

#include "raster/coverage/triangle-inl.h"
#include "simd/quads-inl.h"

SIMD_BEGIN(scanout::shade)

using raster::HWY_NAMESPACE::exchange;
using raster::HWY_NAMESPACE::is_top_left;
using raster::HWY_NAMESPACE::screen_lanes;

// All of this is for registers of any width. D: the tag of its floats.

// Vertex k of a register of triangles.
template <class D>
struct Vertices {
    Int<D> x, y; // 1/256 pixel
    Float<D> inverse_w;
};

// How the canonical order (raster/screen/primitive.h) turns that of the file round: vertices 0 and
// 1, then 1 and 2, then 0 and 1 change places where these hold.
template <class D>
struct Reordering {
    Mask<D> of[3];
};
template <class D, class T>
SIMD_INLINE void reorder(const Reordering<D>& reordering, T (&of_vertex)[3]) {
    exchange(reordering.of[0], of_vertex[0], of_vertex[1]);
    exchange(reordering.of[1], of_vertex[1], of_vertex[2]);
    exchange(reordering.of[2], of_vertex[0], of_vertex[1]);
}
template <class D>
SIMD_INLINE Mask<D> sort_two(Vertices<D>& a, Vertices<D>& b) {
    const Mask<D> later = (b.y < a.y) | ((b.y == a.y) & (b.x < a.x));
    exchange(later, a.x, b.x);
    exchange(later, a.y, b.y);
    exchange(later, a.inverse_w, b.inverse_w);
    return later;
}
template <class D>
SIMD_INLINE Reordering<D> sort_canonically(Vertices<D> (&v)[3]) {
    Reordering<D> reordering;
    reordering.of[0] = sort_two(v[0], v[1]);
    reordering.of[1] = sort_two(v[1], v[2]);
    reordering.of[2] = sort_two(v[0], v[1]);
    return reordering;
}

// Of a register of triangles, in the order of the file. In memory, whence they are read one by one.
template <class D>
SIMD_INLINE void load_vertex_indices(const TriangleSource& source, ShadingSetup& out, int at) {
    const int end = at + static_cast<int>(Int<D>::kLanes);
    const TriangleSource s = source; // no store writes to it
    for (int lane = at; lane < end; ++lane) {
        const std::uint32_t* index = vertices_of(s, out.id[lane]);
        SIMD_FOR (int k = 0; k < 3; ++k)
            out.vertex_index[k][lane] = index[k];
    }
    if (!s.wants_position()) return;
    for (int lane = at; lane < end; ++lane)
        SIMD_FOR (int k = 0; k < 3; ++k) {
            const std::size_t offset = std::size_t{out.vertex_index[k][lane]} * 3;
            __builtin_prefetch(s.position + offset);
            if (s.wants_normal()) __builtin_prefetch(s.normal + offset);
        }
}
// Into the order that their vertices have been put in: cheaper than to turn all that they carry.
template <class D>
SIMD_INLINE void reorder_vertex_indices(const Reordering<D>& reordering, ShadingSetup& out,
                                        int at) {
    Int<D> vertex_index[3] = {load<Int<D>>(out.vertex_index[0] + at),
                              load<Int<D>>(out.vertex_index[1] + at),
                              load<Int<D>>(out.vertex_index[2] + at)};
    reorder(reordering, vertex_index);
    SIMD_FOR (int k = 0; k < 3; ++k)
        store(vertex_index[k], out.vertex_index[k] + at);
}

template <class D>
SIMD_INLINE void load_vertices(const TriangleSource& source, const ShadingSetup& of, int at,
                               Vertices<D> (&v)[3]) {
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const auto found = screen_lanes<D>(source.vertex, of.vertex_index[k] + at);
        v[k] = {found.x, found.y, source.perspective ? to_f32(found.last) : Float<D>(1.0F)};
    }
}

template <class D>
SIMD_INLINE Mask<D> narrow(const typename Double<D>::DoubleMask& mask) {
    return to_f32(select(mask, Double<D>(1.0), Double<D>(0.0))) > Float<D>(0.5F);
}

// No side as long as 64 pixels: then areas within a pixel of the triangle are numbers of 31 bits.
template <class D>
SIMD_INLINE bool are_short(const Vertices<D> (&v)[3]) {
    const auto extent = [](Int<D> a, Int<D> b, Int<D> c) SIMD_LAMBDA {
        return maximum(maximum(a, b), c) - minimum(minimum(a, b), c);
    };
    return all(maximum(extent(v[0].x, v[1].x, v[2].x), extent(v[0].y, v[1].y, v[2].y)) <
               Int<D>(1 << 14));
}

// Twice the area of a register of triangles, counter-clockwise below 0 as y runs down.
template <class D>
struct TwiceArea {
    Mask<D> below_zero, above_zero, fits_int32;
    Int<D> low; // its amount, modulo 2^32
};
template <class D>
SIMD_INLINE TwiceArea<D> twice_area_of(const Vertices<D> (&v)[3], double* exact) {
    const Int<D> right_1 = v[1].x - v[0].x, down_1 = v[1].y - v[0].y, right_2 = v[2].x - v[0].x,
                 down_2 = v[2].y - v[0].y, zero = 0;
    const Int<D> low = right_1 * down_2 - down_1 * right_2;
    if (are_short(v)) return {low<zero, low> zero, zero == zero, maximum(low, zero - low)};
    const Double<D> twice = to_f64(right_1) * to_f64(down_2) - to_f64(down_1) * to_f64(right_2);
    const Mask<D> below_zero = narrow<D>(twice < Double<D>(0.0));
    store(abs(twice), exact);
    // Below 2^30 inside, and a pixel further by less than 2^30 more: sides of less than 2^20.
    Mask<D> fits_int32 = narrow<D>(abs(twice) < Double<D>(0x1p30));
    const Int<D> side = 1 << 20;
    const Int<D> steps[6] = {right_1, down_1, right_2, down_2, right_2 - right_1, down_2 - down_1};
    SIMD_FOR (const Int<D>& step : steps)
        fits_int32 = fits_int32 & (zero - side < step) & (step < side);
    return {below_zero, narrow<D>(twice > Double<D>(0.0)), fits_int32,
            select(below_zero, zero - low, low)};
}

// The areas opposite the vertices.
template <class D>
SIMD_INLINE void store_areas(const Vertices<D> (&v)[3], const TwiceArea<D>& twice,
                             ShadingSetup& out, int lane) {
    const Int<D> zero = 0;
    store(v[0].x, out.x + lane);
    store(v[0].y, out.y + lane);
    store(twice.low, out.twice_area + lane);
    store(select(twice.fits_int32, Int<D>(1), zero), out.fits_int32 + lane);
    SIMD_FOR (int k = 1; k < 3; ++k) { // the edge from vertex 2 to 0, or 0 to 1
        const Vertices<D>&from = v[k == 1 ? 2 : 0], &to = v[k == 1 ? 0 : 1];
        const Int<D> up = from.y - to.y, right = to.x - from.x;
        const Int<D> across = select(twice.below_zero, zero - up, up),
                     down = select(twice.below_zero, zero - right, right);
        store(across, out.right[k - 1] + lane);
        store(down, out.down[k - 1] + lane);
    }
    SIMD_FOR (int k = 0; k < 3; ++k)
        store(v[k].inverse_w, out.inverse_w[k] + lane);
}

// Attributes of kComponents floats a vertex, in canonical order: of[component][vertex].
template <class D, int kComponents>
struct Attribute {
    Float<D> of[kComponents][3];
};
template <class D, int kComponents>
SIMD_INLINE void fetch_vertex(const float* from, const std::uint32_t* index, int vertex,
                              Attribute<D, kComponents>& to) {
    const auto at = [&](int lane) SIMD_LAMBDA {
        return reinterpret_cast<const std::int32_t*>(from) + std::size_t{index[lane]} * kComponents;
    };
    Quads128<D> blocks;
    if constexpr (kComponents == 2)
        blocks = load_two<D>(at);
    else
        blocks = load_three<D>(at);
    SIMD_FOR (int c = 0; c < kComponents; ++c)
        to.of[c][vertex] = from_bits(blocks.word(c == 2 ? kThird : c));
}
template <class D, int kComponents>
SIMD_INLINE Attribute<D, kComponents> fetch(const float* from, const ShadingSetup& of, int at) {
    Attribute<D, kComponents> fetched;
    SIMD_FOR (int k = 0; k < 3; ++k)
        fetch_vertex(from, of.vertex_index[k] + at, k, fetched);
    return fetched;
}
template <class D, int kComponents>
SIMD_INLINE void store_attribute(const Attribute<D, kComponents>& attribute,
                                 float (&to)[kComponents][3][kPaddedBlock], int lane) {
    SIMD_FOR (int c = 0; c < kComponents; ++c)
        SIMD_FOR (int k = 0; k < 3; ++k)
            store(attribute.of[c][k], to[c][k] + lane);
}

// Where vertices stand in the mesh.
template <class D>
using MeshPositions = Attribute<D, 3>;

template <class D>
SIMD_INLINE void store_positions(const TriangleSource& s, const MeshPositions<D>& position,
                                 ShadingSetup& out, int lane) {
    for (int k = 0; k < 3; ++k)
        for (int r = 0; r < 3; ++r) {
            const auto term = [&](int c) SIMD_LAMBDA {
                return Double<D>(s.linear[r][c]) * to_f64(position.of[c][k]);
            };
            const Double<D> flipped = (term(0) + term(1)) + term(2);
            store(to_f32((flipped + Double<D>(s.translation[r])) * Double<D>(s.scale)),
                  out.position[r][k] + lane);
        }
}

// Sides::eye. No bit depends on the winding: the steepest normal is the same.
template <class D>
SIMD_INLINE Float<D> side_of_normals(const Attribute<D, 3>& normal, const ShadingSetup& of,
                                     int lane) {
    const auto facing = [&](int c) SIMD_LAMBDA { return load<Float<D>>(of.facing[c] + lane); };
    const Float<D> x = facing(0), y = facing(1), z = facing(2); // towards the eye
    const auto lean = [&](int k) SIMD_LAMBDA {
        return (normal.of[0][k] * x + normal.of[1][k] * y) + normal.of[2][k] * z;
    };
    const Float<D> one = lean(0), two = lean(1), three = lean(2);
    const Float<D> most = maximum(maximum(one, two), three),
                   least = minimum(minimum(one, two), three);
    return select(most + least < Float<D>(0.0F), Float<D>(-1.0F), Float<D>(1.0F));
}

// On the side that they light. The triangle's `facing` is known.
template <class D>
SIMD_INLINE void store_normals(const TriangleSource& s, Attribute<D, 3> normal, ShadingSetup& out,
                               int lane) {
    if (s.sides == Sides::file) return store_attribute(normal, out.normal, lane);
    if (s.sides == Sides::eye) store(side_of_normals(normal, out, lane), out.side + lane);
    const Float<D> side = load<Float<D>>(out.side + lane);
    SIMD_FOR (int c = 0; c < 3; ++c)
        SIMD_FOR (int k = 0; k < 3; ++k)
            normal.of[c][k] = normal.of[c][k] * side;
    store_attribute(normal, out.normal, lane);
}

// The triangles' own normals, brought near length 1; `flipped` ones the other way round.
template <class D>
SIMD_INLINE void store_facing(const MeshPositions<D>& position, Mask<D> flipped, ShadingSetup& out,
                              int lane) {
    Double<D> one[3], two[3], n[3];
    SIMD_FOR (int c = 0; c < 3; ++c) {
        const Double<D> from = to_f64(position.of[c][0]);
        one[c] = to_f64(position.of[c][1]) - from;
        two[c] = to_f64(position.of[c][2]) - from;
    }
    n[0] = one[1] * two[2] - one[2] * two[1];
    n[1] = one[2] * two[0] - one[0] * two[2];
    n[2] = one[0] * two[1] - one[1] * two[0];
    const Double<D> largest = maximum(maximum(abs(n[0]), abs(n[1])), abs(n[2]));
    const Double<D> sign = to_f64(select(flipped, Float<D>(-1.0F), Float<D>(1.0F)));
    const Double<D> scale =
        Double<D>(1.0) / select(largest > Double<D>(0.0), largest * sign, Double<D>(1.0));
    SIMD_FOR (int c = 0; c < 3; ++c)
        store(to_f32(n[c] * scale), out.facing[c] + lane);
}

// Which way round the vertices wind on the screen. Behind: as seen where the view is no mirror.
template <class D>
struct Windings {
    Mask<D> of_file, of_order;
};
template <class D>
SIMD_INLINE Windings<D> windings_of(Mask<D> clockwise_in_order, const Reordering<D>& reordering,
                                    Mask<D> mirrored) {
    const Mask<D> behind = clockwise_in_order ^ mirrored;
    return {behind ^ reordering.of[0] ^ reordering.of[1] ^ reordering.of[2], behind};
}

// The side that normals are on, as far as the winding tells, and which way `facing` goes.
template <class D>
SIMD_INLINE void store_sides(const TriangleSource& s, const Windings<D>& behind, ShadingSetup& out,
                             int lane) {
    const Mask<D> none = Float<D>(0.0F) > Float<D>(0.0F);
    store(select(s.sides == Sides::face ? behind.of_file : none, Float<D>(-1.0F), Float<D>(1.0F)),
          out.side + lane);
    if (!s.wants_facing()) return;
    const Mask<D> flipped =
        s.sides == Sides::file ? behind.of_order ^ behind.of_file : behind.of_order;
    store(select(flipped, Int<D>(1), Int<D>(0)), out.flipped + lane);
    store(select(behind.of_file, Int<D>(1), Int<D>(0)), out.back + lane);
}

// A register of triangles in `out`, from `at` on, whose ids are known: how they lie on the screen.
// Returns whether numbers of 32 bits hold the areas of all. exact_twice_area is set where not all
// are_short.
template <class D>
SIMD_INLINE bool set_up_register(const TriangleSource& s, ShadingSetup& out, int at) {
    Vertices<D> v[3];
    load_vertices(s, out, at, v);
    const Reordering<D> reordering = sort_canonically(v);
    reorder_vertex_indices(reordering, out, at);
    const TwiceArea<D> twice = twice_area_of(v, out.exact_twice_area + at);
    store_areas(v, twice, out, at);
    const Mask<D> mirrored = Float<D>(s.mirrored ? 1.0F : 0.0F) > Float<D>(0.0F);
    store_sides(s, windings_of(twice.above_zero, reordering, mirrored), out, at);
    return all(twice.fits_int32);
}
// And then what their vertices carry: not at once with it, so that compilers leave the corners in
// memory, and so that no load waits for them.
template <class D>
SIMD_INLINE void set_up_attributes(const TriangleSource& s, ShadingSetup& out, int at) {
    if (s.wants_position()) {
        const MeshPositions<D> position = fetch<D, 3>(s.position, out, at);
        if (s.wants_facing())
            store_facing(position, load<Int<D>>(out.flipped + at) == Int<D>(1), out, at);
        if (s.wants_view_position()) store_positions(s, position, out, at);
    }
    if (s.wants_normal()) store_normals(s, fetch<D, 3>(s.normal, out, at), out, at);
    if (s.wanted.colour) store_attribute(fetch<D, 3>(s.colour, out, at), out.colour, at);
    if (s.wanted.uv) store_attribute(fetch<D, 2>(s.uv, out, at), out.uv, at);
}

SIMD_END

#endif
