// The set-up of the triangles that a tile shows, made when first seen and kept while the tile is
// shaded.
#pragma once

#include "shade/gather.h"

#include <vector>

namespace scanout::shade {

class Gatherer::Primitives {
public:
    Primitives();
    // Ids mean another frame's triangles now.
    void clear();
    // No room for another triangle: what points to the present ones must be done first.
    bool full() const { return pool_.size() == pool_.capacity(); }
    const Primitive& get(const GatherInput& input, std::uint32_t triangle);

private:
    static constexpr std::size_t kRoom = 512, kSlots = 1024;
    std::vector<Primitive> pool_;
    std::vector<std::uint16_t> slot_; // by id modulo kSlots: place in the pool
};

} // namespace scanout::shade
