#include "shade/gather/shading_key.h"

namespace scanout::shade {

ShadingKey ShadingKeys::of_mesh(std::uint32_t id) const {
    const std::size_t triangles = mesh->triangles(), lines = mesh->lines();
    if (id < triangles) return {mesh->material[id], true};
    const std::size_t line = id - triangles;
    if (line >= lines + mesh->points()) return {-1, false}; // added: has a colour of its own
    return {line < lines ? mesh->line_material[line] : mesh->point_material[line - lines], false};
}

} // namespace scanout::shade
