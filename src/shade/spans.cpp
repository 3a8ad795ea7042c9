#include "shade/spans.h"

#include "raster/coverage.h"

#include <algorithm>
#include <tuple>

namespace scanout::shade {

Look Looks::of_mesh(std::uint32_t id) const {
    const std::size_t triangles = mesh->triangles(), lines = mesh->lines();
    if (id < triangles) return {mesh->material[id], true};
    const std::size_t line = id - triangles;
    return {line < lines ? mesh->line_material[line] : mesh->point_material[line - lines], false};
}

Spans::Spans() : span_(std::size_t{raster::kTileSize} * raster::kTileSize) {
    groups_.reserve(span_.size());
    clear();
}

void Spans::clear() {
    spans_ = 0;
    groups_.clear();
    slot_.fill({raster::kNoPrimitive, 0});
    one_look_ = true;
}

void Spans::add_group(const Look& look, std::uint32_t id, int pixel, int count) {
    slot_[id % kSlots] = {id, static_cast<std::uint32_t>(groups_.size())};
    if (!groups_.empty() && look != groups_.back().look) one_look_ = false;
    groups_.push_back({id, look, add_span(pixel, count, kNone), static_cast<std::uint16_t>(count)});
}

void Spans::arrange() {
    if (!one_look_)
        std::sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) {
            // No two have the same last span: one order, without the room that a stable sort takes.
            return std::tuple(a.look.lit, a.look.material, a.last) <
                   std::tuple(b.look.lit, b.look.material, b.last);
        });
}

} // namespace scanout::shade
