// Tables of all stages together, and of the materials' maps.
#include "rows.h"
#include "shade/ambient_occlusion.h"
#include "shade/colour_by.h"
#include "shade/stage.h"

#include <type_traits>

namespace scanout::shade {

namespace {

// Adds nothing where the rows of an axis are no stages.
template <class Row>
void add_stages(std::span<const Row* const> rows, std::vector<const Stage*>& found) {
    if constexpr (std::is_convertible_v<const Row*, const Stage*>)
        found.insert(found.end(), rows.begin(), rows.end());
}

} // namespace

std::span<const Stage* const> stages() {
    static const std::vector<const Stage*> all = [] {
        std::vector<const Stage*> found;
#define SCANOUT_ADD(module, axis, LIST, Row, choice, help)                                         \
    add_stages<module::Row>(module::axis::kRows, found);
        SCANOUT_AXES(SCANOUT_ADD)
#undef SCANOUT_ADD
        return found;
    }();
    return all;
}

const std::array<MapSlot, kMaps>& map_slots() {
    static constexpr std::array<MapSlot, kMaps> kSlots = {
        MapSlot{&scene::Material::map_diffuse, TexelKind::colour},
        MapSlot{&scene::Material::map_opacity, TexelKind::data},
        MapSlot{&scene::Material::map_normal, TexelKind::data},
        MapSlot{&scene::Material::map_bump, TexelKind::data},
        MapSlot{&scene::Material::map_specular, TexelKind::data},
        MapSlot{&scene::Material::map_shininess, TexelKind::data},
        MapSlot{&scene::Material::map_roughness, TexelKind::data},
        MapSlot{&scene::Material::map_metalness, TexelKind::data},
        MapSlot{&scene::Material::map_emission, TexelKind::colour}};
    return kSlots;
}

const Stage* find_stage(std::string_view axis, std::string_view name) {
    for (const Stage* stage : stages())
        if (stage->card.axis == axis && stage->card.name == name) return stage;
    return nullptr;
}

} // namespace scanout::shade
