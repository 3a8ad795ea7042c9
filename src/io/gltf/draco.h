// KHR_draco_mesh_compression: a primitive's indices and attributes in Draco's packed form (Google
// 2018), unpacked into what plain accessors would give.
#pragma once

#include "base/result.h"
#include "io/gltf/accessor.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scanout::io::gltf {

struct UnpackedDraco {
    std::vector<std::uint32_t> indices; // three a triangle
    std::uint64_t vertices = 0;
    // By attribute: as many elements as vertices, of the type that the accessor says.
    std::vector<std::pair<std::string, Bytes>> attributes;
    std::vector<View> views; // of the attributes

    const View* find(std::string_view name) const;
};

// An error (Exit::unreadable) names `what`, the primitive. Attributes without an accessor are left
// out.
Result<UnpackedDraco> unpack_draco(ByteSpan bytes, const Primitive& primitive,
                                   const Document& document, Budget& budget,
                                   const std::string& path, const std::string& what);

} // namespace scanout::io::gltf
