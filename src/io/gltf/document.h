// The JSON part of a glTF 2.0 file as plain data (Khronos 2021). Indices lie within their arrays,
// -1 where there is none; counts and offsets are any numbers: gltf_accessor.h holds them against
// the bytes.
#pragma once

#include "math/vec.h"
#include "scene/material.h"
#include "scene/motion/track.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scanout::io::gltf {

using Index = std::int32_t; // into an array of the document; -1: none

enum class Component : std::uint16_t {
    i8 = 5120,
    u8 = 5121,
    i16 = 5122,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126
};

struct Buffer {
    std::string uri;      // as the file has it
    bool has_uri = false; // none: the GLB file's chunk
    std::uint64_t bytes = 0;
};

// EXT_meshopt_compression of a buffer view.
struct Meshopt {
    Index buffer = -1;
    std::uint64_t offset = 0, bytes = 0, stride = 0, count = 0;
    std::string mode, filter;
    std::string fault; // why it cannot be used
};

struct BufferView {
    Index buffer = -1;
    std::uint64_t offset = 0, bytes = 0, stride = 0; // stride 0: tightly packed
    std::optional<Meshopt> meshopt;
    std::string fault; // why it cannot be used
};

struct Sparse {
    std::uint64_t count = 0;
    Index index_view = -1, value_view = -1;
    std::uint64_t index_offset = 0, value_offset = 0;
    Component index_type = Component::u16;
};

struct Accessor {
    Index view = -1; // -1: zeros
    std::uint64_t offset = 0, count = 0;
    Component component = Component::f32;
    int rows = 1, columns = 1; // SCALAR and vectors are one column
    bool normalized = false;
    std::optional<Sparse> sparse;
    std::string fault; // why it cannot be used
};

// KHR_texture_transform: uv -> offset + rotation * scale * uv, in glTF's uv, whose v runs down.
struct TextureTransform {
    DVec2 offset{0}, scale{1};
    double rotation = 0; // radians, counter-clockwise
    friend bool operator==(const TextureTransform&, const TextureTransform&) = default;
};

struct TextureInfo {
    Index texture = -1;
    int set = 0;      // n of TEXCOORD_n
    double scale = 1; // of a normal map
    TextureTransform transform;
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

struct MaterialInfo {
    std::string name;
    std::array<double, 4> base_colour{1, 1, 1, 1};
    double metallic = 1, roughness = 1;
    std::array<double, 3> emissive{0, 0, 0};
    double emissive_strength = 1;
    TextureInfo base_texture, metallic_roughness, normal, emissive_texture;
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5;
    bool double_sided = false, unlit = false;
};

using scene::Wrap;

struct Sampler {
    Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
};

struct TextureSource {
    Index sampler = -1, image = -1;
};

struct ImageSource {
    std::string uri; // empty: in a buffer view
    Index view = -1;
    std::string fault; // why it cannot be used
};

using Attributes = std::vector<std::pair<std::string, Index>>; // name, accessor

inline Index find(const Attributes& attributes, std::string_view name) {
    for (const auto& [known, accessor] : attributes)
        if (known == name) return accessor;
    return -1;
}

struct Draco {
    Index view = -1;
    std::vector<std::pair<std::string, std::uint32_t>> attributes; // name, Draco's unique id
};

struct Primitive {
    Attributes attributes;
    Index indices = -1, material = -1;
    int mode = 4;
    std::optional<Draco> draco;
    std::vector<Attributes> targets; // of morphing
    std::string fault;               // why it cannot be drawn
};

struct MeshInfo {
    std::vector<Primitive> primitives;
    std::vector<double> weights; // of the targets
};

struct Node {
    std::vector<Index> children;
    Index mesh = -1, skin = -1;
    DMat4 matrix{1};                // of its own, to its parent
    DVec3 translation{0}, scale{1}; // that it is made of, unless the file gives a matrix
    std::array<double, 4> rotation{0, 0, 0, 1};
    std::vector<double> weights; // of its mesh's targets; empty: the mesh's own
    Attributes instances;        // EXT_mesh_gpu_instancing
    std::string fault;           // why its instances cannot be used
};

struct Skin {
    std::vector<Index> joints; // nodes
    Index inverse_bind = -1;   // accessor
    std::string fault;         // why it cannot be used
};

enum class AnimationPath : std::uint8_t { translation, rotation, scale, weights, other };

struct AnimationSampler {
    Index input = -1, output = -1; // accessors
    scene::Interpolation by = scene::Interpolation::linear;
    std::string fault; // why it cannot be used
};

struct AnimationChannel {
    Index sampler = -1, node = -1; // of its animation; of the document
    AnimationPath path = AnimationPath::other;
    std::string fault; // why it cannot be used
};

struct AnimationInfo {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

struct CameraInfo {
    std::string name;
    bool orthographic = false;
    double y_fov = 0;
};

struct Document {
    std::vector<Buffer> buffers;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<ImageSource> images;
    std::vector<Sampler> samplers;
    std::vector<TextureSource> textures;
    std::vector<MaterialInfo> materials;
    std::vector<MeshInfo> meshes;
    std::vector<Node> nodes;
    std::optional<std::vector<Index>> scene; // root nodes of the default one, where there is one
    std::vector<CameraInfo> cameras;
    std::vector<Skin> skins;
    std::vector<AnimationInfo> animations;
    std::vector<std::string> used, required; // extensions
};

} // namespace scanout::io::gltf
