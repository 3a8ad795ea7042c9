// How a mesh's primitives are drawn.
#pragma once

#include "geom/mesh.h"

#include <cstdint>
#include <optional>

namespace scanout::shade {

struct Look {
    std::int32_t material; // index, -1: the default material
    bool lit;              // lines and points are not
    friend bool operator==(const Look&, const Look&) = default;
};

struct Looks {
    const geom::Mesh* mesh = nullptr;
    // Of all primitives, which are triangles then: asking the mesh misses the cache each time.
    std::optional<std::int32_t> only_material;
    Look of(std::uint32_t id) const {
        return only_material ? Look{*only_material, true} : of_mesh(id);
    }

private:
    Look of_mesh(std::uint32_t id) const;
};

} // namespace scanout::shade
