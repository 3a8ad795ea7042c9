// How a mesh's primitives are shaded: the key that groups them.
#pragma once

#include "geom/mesh.h"

#include <cstdint>
#include <optional>

namespace scanout::shade {

struct ShadingKey {
    std::int32_t material; // index, -1: the default material
    bool lit;              // lines and points are not
    friend bool operator==(const ShadingKey&, const ShadingKey&) = default;
};

struct ShadingKeys {
    const geom::Mesh* mesh = nullptr;
    // The material of all primitives, if all are triangles with one material: a look-up in the mesh
    // misses the cache each time.
    std::optional<std::int32_t> only_material;
    ShadingKey of(std::uint32_t id) const {
        return only_material ? ShadingKey{*only_material, true} : of_mesh(id);
    }

private:
    ShadingKey of_mesh(std::uint32_t id) const;
};

} // namespace scanout::shade
