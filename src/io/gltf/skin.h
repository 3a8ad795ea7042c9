// Skins at rest: where joints and weights put a vertex that no animation moves. Khronos
// 2021, 3.7.3.
#pragma once

#include "base/result.h"
#include "io/gltf/accessor.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanout::io::gltf {

// One matrix a joint: the mesh's coordinates -> the file's.
using Palette = std::vector<DMat4>;

class Skins {
public:
    // world: of each node, to the file's coordinates.
    Skins(const Document& document, Accessors& accessors, const std::vector<DMat4>& world,
          const std::string& path)
        : document_(document), accessors_(accessors), world_(world), path_(path) {}

    // Made once a skin. An error (Exit::unreadable) names the accessor that lacks matrices.
    Result<const Palette*> palette(Index skin);

private:
    Result<Palette> make(Index skin);

    const Document& document_;
    Accessors& accessors_;
    const std::vector<DMat4>& world_;
    const std::string& path_;
    std::map<Index, Result<Palette>> made_;
};

// JOINTS_n and WEIGHTS_n of a primitive.
struct Influences {
    View joints, weights; // four of each a vertex
};

// The joints and weights of some vertices.
class VertexSkin {
public:
    VertexSkin(const std::vector<Influences>& sets, const Palette& palette);

    // The mean of the joints' matrices by their weights; nothing where no weight is above 0.
    std::optional<DMat4> at(std::uint64_t vertex) const;

private:
    struct Share {
        std::array<std::uint32_t, 4> joint;
        std::array<float, 4> weight;
    };
    const Palette& palette_;
    std::size_t sets_;
    std::vector<Share> shares_; // of a vertex one after the other
};

} // namespace scanout::io::gltf
