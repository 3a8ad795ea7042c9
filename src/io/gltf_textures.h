// The images of a glTF file, decoded once each, and made ready for the role that a map gives them.
#pragma once

#include "base/warnings.h"
#include "io/gltf_buffers.h"
#include "io/gltf_document.h"
#include "scene/material.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace scanout::io::gltf {

// opaque: without alpha; cut: colours that alpha hides are filled from beside; plain: as it is;
// leaning: a normal map whose x and y are scaled.
enum class Role : std::uint8_t { plain, opaque, cut, leaning };

class Textures {
public:
    Textures(const Document& document, Buffers& buffers, const std::string& path,
             Warnings& warnings, const Reading& how)
        : document_(document), buffers_(buffers), path_(path), warnings_(warnings),
          bytes_left_(how.texture_bytes) {}

    // The index of the texture's picture among take(); -1, with a warning, where it cannot be read.
    std::int32_t find(Index texture, Role role, double scale = 1);
    std::string name_of(Index texture) const; // of its file, or its place in the JSON

    std::vector<scene::Texture> take() { return std::move(out_); }
    std::uint64_t bytes() const { return bytes_; }

private:
    struct Key {
        Index image;
        Role role;
        double scale;
        auto operator<=>(const Key&) const = default;
    };
    std::int32_t load(Index image);
    Result<image::Image> decode(Index image, std::string& name);
    std::int32_t made_of(std::int32_t plain, Role role, double scale);

    const Document& document_;
    Buffers& buffers_;
    const std::string& path_;
    Warnings& warnings_;
    std::uint64_t bytes_left_, bytes_ = 0;
    std::map<Key, std::int32_t> known_;
    std::vector<scene::Texture> out_;
    std::size_t faults_ = 0;
};

} // namespace scanout::io::gltf
