// The set-up of the triangles that a tile shows, made when first seen and kept while the tile is
// shaded.
#pragma once

#include "shade/gather/gather_input.h"
#include "shade/setup/shading_setup.h"

#include <memory>
#include <vector>

namespace scanout::shade {

class PrimitiveCache {
public:
    PrimitiveCache();
    // Forgets all: ids mean triangles of this frame now. The input must outlive the use.
    void begin(const GatherInput& input);
    void clear();
    // No room for another triangle: what points to the present ones must be done first.
    bool full() const { return used_ + 1 >= pool_.size(); }
    // The triangle, or what is drawn first of it.
    const Primitive& get(std::uint32_t triangle) { return find(triangle, false); }
    // The same, in frames whose items may set up triangles of their own: one that is not clipped is
    // set up when set_up() is next called, side by side with others.
    const Primitive& get_later(std::uint32_t triangle) { return find(triangle, true); }
    void set_up();
    const TriangleSource& source() const { return source_; }
    // Has no triangle of the frame been clipped? Has this one not?
    bool all_unclipped() const { return all_unclipped_; }
    bool unclipped(std::uint32_t triangle) const {
        return all_unclipped_ || is_unclipped(source_, triangle);
    }
    // Of a triangle drawn as two clipped ones, the second of which stands behind the first: does
    // the second cover a sample that shows the triangle (1/256 pixel)? Of other triangles: no.
    static bool is_of_second(const Primitive& first, std::int32_t x, std::int32_t y);
    // The clipped triangle that does.
    static const Primitive& at(const Primitive& first, std::int32_t x, std::int32_t y) {
        return is_of_second(first, x, y) ? *(&first + 1) : first;
    }

private:
    const Primitive& find(std::uint32_t triangle, bool later) {
        const std::uint16_t slot = slot_[triangle % kSlots];
        return slot < used_ && pool_[slot].id == triangle ? pool_[slot] : add(triangle, later);
    }
    const Primitive& add(std::uint32_t triangle, bool later);
    void add_clipped(std::uint32_t triangle);
    Primitive& next(std::uint32_t triangle, bool clipped);
    void finish(Primitive& primitive) const;
    static constexpr std::size_t kMaxPrimitives = 512, kSlots = 1024;
    const GatherInput* in_ = nullptr;
    TriangleSource source_{}; // of in_
    bool all_unclipped_ = false;
    std::vector<Primitive> pool_; // in use: the first `used_`
    std::size_t used_ = 0;
    std::size_t ready_ = 0;                 // those behind are yet to be set up, if not clipped
    std::unique_ptr<ShadingSetup> scratch_; // of set_up_primitives
    std::vector<std::uint16_t> slot_;       // by id modulo kSlots: place in the pool
};

// The two clipped triangles of one stand side by side. On their common edge both say the same, so
// that the rounding of this does not show.
inline bool PrimitiveCache::is_of_second(const Primitive& first, std::int32_t x, std::int32_t y) {
    if (first.across < 0) return false;
    const auto outside = [&](int k) { return (first.a[k] * x + first.b[k] * y) + first.c[k] < 0; };
    return first.across == Primitive::kFolded ? outside(0) || outside(1) || outside(2)
                                              : outside(first.across);
}

} // namespace scanout::shade
