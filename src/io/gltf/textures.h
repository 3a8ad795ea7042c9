// The images of a glTF file, decoded once each, and made ready for the role that a map gives them.
#pragma once

#include "base/warnings.h"
#include "io/gltf/buffers.h"
#include "io/gltf/document.h"
#include "scene/material.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace scanout::io::gltf {

// opaque: without alpha; cut: colours that alpha hides are filled from beside; plain: as it is.
enum class Role : std::uint8_t { plain, opaque, cut };

class Textures {
public:
    Textures(const Document& document, Buffers& buffers, const std::string& path,
             Warnings& warnings, const Reading& how, Budget& budget)
        : document_(document), buffers_(buffers), path_(path), warnings_(warnings),
          bytes_left_(how.texture_bytes), budget_(budget) {}

    // The index of the texture's picture among take(); -1, with a warning, where it cannot be read.
    std::int32_t find(Index texture, Role role);
    std::string name_of(Index texture) const; // of its file, or its place in the JSON

    std::vector<scene::Texture> take() { return std::move(out_); }
    std::uint64_t bytes() const { return bytes_; }

private:
    struct Key {
        Index image;
        Role role;
        auto operator<=>(const Key&) const = default;
    };
    std::int32_t load(Index image);
    Result<image::Image> decode(Index image, std::string& name);
    std::int32_t made_of(std::int32_t plain, Role role);
    std::int32_t refuse(Index image, std::string_view why);
    void charge(std::uint64_t bytes); // no more than room()
    std::uint64_t room() const { return std::min(bytes_left_, budget_.left()); }

    const Document& document_;
    Buffers& buffers_;
    const std::string& path_;
    Warnings& warnings_;
    std::uint64_t bytes_left_, bytes_ = 0;
    Budget& budget_;
    std::map<Key, std::int32_t> known_;
    std::vector<scene::Texture> out_;
    std::size_t faults_ = 0;
};

} // namespace scanout::io::gltf
