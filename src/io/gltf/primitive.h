// A primitive of a mesh, found and checked: what of it is there, and how much. Khronos 2021, 3.7.2.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "io/gltf/accessor.h"
#include "io/gltf/draco.h"
#include "io/gltf/skin.h"

#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <vector>

namespace scanout::io::gltf {

enum class Mode : std::uint8_t {
    points,
    lines,
    line_loop,
    line_strip,
    triangles,
    triangle_strip,
    triangle_fan
};

// What a morph target adds; as many elements as positions.
struct MorphTarget {
    std::optional<View> positions, normals;
};

struct PrimitiveData {
    Mode mode = Mode::triangles;
    Index material = -1;
    View positions;                            // three components
    std::optional<View> normals, colours, uvs; // as many elements as positions
    std::optional<View> indices;               // one component, unsigned
    std::vector<Influences> influences;        // of joints; as many elements as positions
    std::vector<MorphTarget> targets;
    std::uint64_t corners() const { return indices ? indices->count : positions.count; }
};

class Primitives {
public:
    Primitives(const Document& document, Buffers& buffers, const std::string& path,
               Warnings& warnings, Budget& budget)
        : document_(document), buffers_(buffers), accessors_(document, buffers, path, budget),
          path_(path), warnings_(warnings), budget_(budget) {}

    // Asked once of each primitive: packed ones are unpacked. uv_set: which TEXCOORD_n. Fails
    // (Exit::unreadable) where positions or indices are not there; other attributes that are not
    // are warnings, and none. Views are good as long as this object.
    Result<PrimitiveData> find(Index mesh, std::size_t primitive, int uv_set);

    // From now on morph targets are found, too.
    void find_targets() { targets_ = true; }
    Accessors& accessors() { return accessors_; }

private:
    Result<const UnpackedDraco*> draco(Index mesh, std::size_t primitive);
    std::optional<View> attribute(const Attributes& attributes, const UnpackedDraco* packed,
                                  std::string_view name, int least_rows, std::uint64_t count,
                                  const std::string& place);

    const Document& document_;
    Buffers& buffers_;
    Accessors accessors_;
    const std::string& path_;
    Warnings& warnings_;
    Budget& budget_;
    bool targets_ = false;
    std::list<UnpackedDraco> unpacked_; // that views are of
};

} // namespace scanout::io::gltf
