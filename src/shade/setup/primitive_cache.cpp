#include "shade/setup/primitive_cache.h"

#include "base/check.h"
#include "shade/check_lanes.h"
#include "shade/setup/clipped_primitive.h"
#include "shade/setup/interpolation_step.h"
#include "shade/setup/primitive_setup.h"

namespace scanout::shade {

PrimitiveCache::PrimitiveCache()
    : pool_(kMaxPrimitives), scratch_(std::make_unique<ShadingSetup>()), slot_(kSlots) {}

void PrimitiveCache::begin(const GatherInput& input) {
    in_ = &input;
    source_ = triangle_source(input);
    all_unclipped_ = input.geometry->all_unclipped();
    clear();
}

void PrimitiveCache::clear() {
    used_ = ready_ = 0;
}

Primitive& PrimitiveCache::next(std::uint32_t triangle, bool clipped) {
    Primitive& p = pool_[used_++];
    p.id = triangle;
    p.clipped = clipped;
    p.across = -1;
    p.step = 0;
    p.large_uv = false;
    return p;
}

const Primitive& PrimitiveCache::add(std::uint32_t triangle, bool later) {
    CHECK(!full());
    const std::size_t slot = used_;
    slot_[triangle % kSlots] = static_cast<std::uint16_t>(slot);
    if (unclipped(triangle)) {
        next(triangle, false);
        if (!later) set_up();
    } else {
        add_clipped(triangle);
    }
    return pool_[slot];
}

void PrimitiveCache::set_up() {
    while (ready_ < used_) {
        std::size_t end = ready_;
        while (end < used_ && !pool_[end].clipped)
            ++end;
        set_up_primitives(source_, *scratch_, pool_.data() + ready_,
                          static_cast<int>(end - ready_));
        for (; ready_ < end; ++ready_)
            finish(pool_[ready_]);
        while (ready_ < used_ && pool_[ready_].clipped)
            ++ready_;
    }
}

// What stages read that no item's own set-up has: those frames set triangles up one by one.
void PrimitiveCache::finish(Primitive& p) const {
    const FrameState& frame = *in_->frame;
    if (frame.attributes.object || frame.vertex_normals)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = scratch_->vertex_index[k][0];
            if (frame.attributes.object) set_attribute(p.object, k, DVec3(in_->mesh->position[v]));
            if (!frame.vertex_normals) continue;
            const DVec3 own = DVec3(in_->mesh->normal[v]) * double{scratch_->side[0]};
            set_attribute(p.normal, k, vertex_normal(frame, own));
        }
    if (frame.steps != nullptr) p.step = step_for(p, *frame.steps);
    check_primitive(p, frame.attributes);
}

void PrimitiveCache::add_clipped(std::uint32_t triangle) {
    const raster::ClippedTriangles clipped = in_->geometry->clipped_of(triangle);
    CHECK(clipped.count > 0); // what is visible has an area
    for (const raster::ClippedTriangle& one : clipped) {
        Primitive& p = next(triangle, true);
        set_up_clipped(*in_, one, p);
        check_primitive(p, in_->frame->attributes);
    }
    if (clipped.count < 2) return;
    const auto& [one, two] = clipped.triangle;
    pool_[used_ - 2].across = one.clockwise != two.clockwise
                                  ? Primitive::kFolded
                                  : static_cast<std::int8_t>(raster::opposite_common_edge(clipped));
}

} // namespace scanout::shade
