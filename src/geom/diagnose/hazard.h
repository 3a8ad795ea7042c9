// The hazards that a model file can hold: what makes a picture other than the surface that was
// meant, or is worth knowing before it does.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace scanout::geom {

// warning: some picture is not that of the surface which was meant. note: worth knowing.
enum class Severity : std::uint8_t { warning, note };

// In the order in which they are reported.
enum class Hazard : std::uint8_t {
    not_finite,
    collapsed_faces,
    t_vertices,
    cracks,
    duplicate_faces,
    overlaps,
    mixed_winding,
    flipped_shells,
    opposite_normals,
    zero_normals,
    missing_uvs,
    degenerate_uvs,
    intersections,
    non_manifold_edges,
    open_edges,
    zero_areas,
    slivers,
    back_to_back,
    long_normals,
    missing_normals,
    large_uvs,
    unreferenced,
    denormals,
    far_from_origin,
    unusual_unit,
    small_triangles,
};

struct HazardCard {
    Hazard hazard;
    std::string_view name; // in reports and JSON
    Severity severity;
    std::string_view one, many; // what is counted
    std::string_view measure;   // of the worst one, {} for the number; empty: none
    std::string_view advice;
    bool mended = false; // by geom/mend.h
};
std::span<const HazardCard> hazard_cards(); // in the order of Hazard
const HazardCard& card_of(Hazard hazard);

} // namespace scanout::geom
