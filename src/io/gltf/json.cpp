#include "io/gltf/json.h"

#include "io/gltf/extensions.h"
#include "io/gltf/json_reader.h"
#include "io/text.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

constexpr std::uint64_t kMany = std::uint64_t{1} << 53; // whole numbers of JSON are exact up to it

void read_asset(JsonReader& in, Json root) {
    const Json asset = in.object(root, "asset");
    const std::string version = in.text(asset, "version"), least = in.text(asset, "minVersion");
    const std::string_view needed = least.empty() ? version : least;
    if (!version.starts_with("2."))
        in.fault(version.empty()
                     ? "asset.version is missing: it is no glTF 2.0 file"
                     : fmt::format("glTF {} is not read: export it as glTF 2.0", shown(version)));
    else if (needed != "2.0" && !least.empty())
        in.fault(fmt::format("needs glTF {}, and 2.0 is read", shown(least)));
}

Buffer read_buffer(JsonReader& in, Json o) {
    Buffer buffer;
    buffer.has_uri = in.has(o, "uri");
    buffer.uri = in.text(o, "uri");
    buffer.bytes = in.whole(o, "byteLength", 0, kMany);
    return buffer;
}

BufferView read_view(JsonReader& in, Json o) {
    BufferView view;
    view.buffer = in.index(o, "buffer", "buffers", view.fault);
    view.offset = in.whole(o, "byteOffset", 0, kMany);
    view.bytes = in.whole(o, "byteLength", 0, kMany);
    view.stride = in.whole(o, "byteStride", 0, 65535);
    Json packed = in.extension(o, "EXT_meshopt_compression");
    if (!packed.there()) packed = in.extension(o, "KHR_meshopt_compression");
    if (packed.there()) {
        Meshopt& m = view.meshopt.emplace();
        m.buffer = in.index(packed, "buffer", "buffers", m.fault);
        m.offset = in.whole(packed, "byteOffset", 0, kMany);
        m.bytes = in.whole(packed, "byteLength", 0, kMany);
        m.stride = in.whole(packed, "byteStride", 0, 256);
        m.count = in.whole(packed, "count", 0, kMany);
        m.mode = in.text(packed, "mode");
        m.filter = in.text(packed, "filter");
    }
    return view;
}

// What no primitive uses may be of any type: the fault is the accessor's.
Component read_component(JsonReader& in, Json o, Accessor& of) {
    const std::uint64_t code = in.whole(o, "componentType", 0, 65535);
    constexpr std::uint64_t kCodes[] = {5120, 5121, 5122, 5123, 5125, 5126};
    if (std::find(std::begin(kCodes), std::end(kCodes), code) != std::end(kCodes))
        return static_cast<Component>(code);
    if (of.fault.empty())
        of.fault = fmt::format("componentType is {}, which is none of glTF's", code);
    return Component::u8;
}

Accessor read_accessor(JsonReader& in, Json o) {
    struct Type {
        std::string_view name;
        int rows, columns;
    };
    static constexpr Type kTypes[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1},
                                      {"VEC4", 4, 1},   {"MAT2", 2, 2}, {"MAT3", 3, 3},
                                      {"MAT4", 4, 4}};
    Accessor a;
    a.view = in.index(o, "bufferView", "bufferViews", a.fault);
    a.offset = in.whole(o, "byteOffset", 0, kMany);
    a.count = in.whole(o, "count", 0, kMany);
    a.component = read_component(in, o, a);
    a.normalized = in.flag(o, "normalized");
    const std::string name = in.text(o, "type");
    const auto* type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                    [&](const Type& t) { return t.name == name; });
    if (type == std::end(kTypes)) {
        if (a.fault.empty())
            a.fault = fmt::format("type is '{}', which is none of glTF's", shown(name));
        return a;
    }
    a.rows = type->rows;
    a.columns = type->columns;
    if (const Json sparse = in.object(o, "sparse"); sparse.there()) {
        Sparse& s = a.sparse.emplace();
        s.count = in.whole(sparse, "count", 0, kMany);
        const Json indices = in.object(sparse, "indices"), values = in.object(sparse, "values");
        s.index_view = in.index(indices, "bufferView", "bufferViews", a.fault);
        s.index_offset = in.whole(indices, "byteOffset", 0, kMany);
        s.index_type = read_component(in, indices, a);
        s.value_view = in.index(values, "bufferView", "bufferViews", a.fault);
        s.value_offset = in.whole(values, "byteOffset", 0, kMany);
    }
    return a;
}

ImageSource read_image(JsonReader& in, Json o) {
    ImageSource image;
    image.uri = in.text(o, "uri");
    image.view = in.index(o, "bufferView", "bufferViews", image.fault);
    return image;
}

Sampler read_sampler(JsonReader& in, Json o) {
    const auto wrap = [&](std::string_view key) {
        switch (in.whole(o, key, 10497, 65535)) {
        case 33071:
            return Wrap::clamp;
        case 33648:
            return Wrap::mirror;
        default:
            return Wrap::repeat;
        }
    };
    return {wrap("wrapS"), wrap("wrapT")};
}

TextureSource read_texture(JsonReader& in, Json o) {
    TextureSource texture;
    texture.sampler = in.soft_index(o, "sampler", "samplers");
    texture.image = in.soft_index(o, "source", "images");
    return texture;
}

TextureInfo read_texture_info(JsonReader& in, Json of, std::string_view key) {
    TextureInfo info;
    const Json o = in.object(of, key);
    if (!o.there()) return info;
    const JsonReader::Within within(in, std::string(key));
    info.texture = in.soft_index(o, "index", "textures");
    info.set = static_cast<int>(in.whole(o, "texCoord", 0, 1000));
    info.scale = in.number(o, "scale", 1);
    if (const Json t = in.extension(o, "KHR_texture_transform"); t.there()) {
        in.numbers(t, "offset", &info.transform.offset.x, 2);
        in.numbers(t, "scale", &info.transform.scale.x, 2);
        info.transform.rotation = in.number(t, "rotation", 0);
        info.set = static_cast<int>(in.whole(t, "texCoord", info.set, 1000));
    }
    return info;
}

MaterialInfo read_material(JsonReader& in, Json o) {
    MaterialInfo m;
    m.name = in.text(o, "name");
    if (const Json pbr = in.object(o, "pbrMetallicRoughness"); pbr.there()) {
        in.numbers(pbr, "baseColorFactor", m.base_colour.data(), 4);
        m.metallic = in.number(pbr, "metallicFactor", 1);
        m.roughness = in.number(pbr, "roughnessFactor", 1);
        m.base_texture = read_texture_info(in, pbr, "baseColorTexture");
        m.metallic_roughness = read_texture_info(in, pbr, "metallicRoughnessTexture");
    }
    if (const Json old = in.extension(o, "KHR_materials_pbrSpecularGlossiness"); old.there()) {
        // Its diffuse part; a mirror's colour becomes none, as no metal is told.
        in.numbers(old, "diffuseFactor", m.base_colour.data(), 4);
        m.base_texture = read_texture_info(in, old, "diffuseTexture");
        m.metallic_roughness = {};
        m.metallic = 0;
        m.roughness = 1 - in.number(old, "glossinessFactor", 1);
    }
    m.normal = read_texture_info(in, o, "normalTexture");
    m.emissive_texture = read_texture_info(in, o, "emissiveTexture");
    in.numbers(o, "emissiveFactor", m.emissive.data(), 3);
    if (const Json strength = in.extension(o, "KHR_materials_emissive_strength"); strength.there())
        m.emissive_strength = in.number(strength, "emissiveStrength", 1);
    const std::string mode = in.text(o, "alphaMode");
    m.alpha_mode = mode == "MASK"    ? AlphaMode::mask
                   : mode == "BLEND" ? AlphaMode::blend
                                     : AlphaMode::opaque;
    m.alpha_cutoff = in.number(o, "alphaCutoff", 0.5);
    m.double_sided = in.flag(o, "doubleSided");
    m.unlit = in.extension(o, "KHR_materials_unlit").there();
    return m;
}

// Others may lead nowhere.
bool is_read(std::string_view attribute) {
    constexpr std::string_view kNames[] = {"POSITION",    "NORMAL",   "COLOR_0",
                                           "TRANSLATION", "ROTATION", "SCALE"};
    return std::find(std::begin(kNames), std::end(kNames), attribute) != std::end(kNames) ||
           attribute.starts_with("TEXCOORD_") || attribute.starts_with("JOINTS_") ||
           attribute.starts_with("WEIGHTS_");
}

Attributes read_attributes(JsonReader& in, Json fields, std::string& fault) {
    Attributes attributes;
    in.each_field(fields, [&](std::string_view name, Json value) {
        std::string ignored;
        const Index accessor =
            in.index_of(value, name, "accessors", is_read(name) ? fault : ignored);
        if (accessor >= 0) attributes.emplace_back(name, accessor);
    });
    return attributes;
}

// Each of an array; none of what is no array: a model at rest is shown whatever its motion says.
template <class Visit>
void each_if_any(const JsonReader& in, Json of, std::string_view key, Visit&& visit) {
    const Json value = in.field(of, key);
    simdjson::dom::array array;
    if (!value.there() || (*value).get(array) != simdjson::SUCCESS) return;
    for (const simdjson::dom::element one : array)
        visit(one);
}

// What is no number counts as 0.
std::vector<double> weights_in(const JsonReader& in, Json of) {
    std::vector<double> weights;
    each_if_any(in, of, "weights", [&](const simdjson::dom::element& one) {
        double weight = 0;
        weights.push_back(one.get(weight) == simdjson::SUCCESS ? weight : 0);
    });
    return weights;
}

Primitive read_primitive(JsonReader& in, Json o) {
    Primitive p;
    p.attributes = read_attributes(in, in.object(o, "attributes"), p.fault);
    p.indices = in.index(o, "indices", "accessors", p.fault);
    p.material = in.soft_index(o, "material", "materials");
    p.mode = static_cast<int>(in.whole(o, "mode", 4, 65535));
    each_if_any(in, o, "targets", [&](const simdjson::dom::element& target) {
        std::string ignored; // without it the target adds nothing
        p.targets.push_back(read_attributes(in, Json(target), ignored));
    });
    if (const Json packed = in.extension(o, "KHR_draco_mesh_compression"); packed.there()) {
        Draco& draco = p.draco.emplace();
        draco.view = in.index(packed, "bufferView", "bufferViews", p.fault);
        in.each_field(in.object(packed, "attributes"), [&](std::string_view name, Json value) {
            draco.attributes.emplace_back(
                name, static_cast<std::uint32_t>(in.whole_of(value, name, 0xffffffff)));
        });
    }
    return p;
}

MeshInfo read_mesh(JsonReader& in, Json o) {
    MeshInfo mesh;
    in.each(o, "primitives", [&](Json primitive) {
        const JsonReader::Within within(in, fmt::format("primitives[{}]", mesh.primitives.size()));
        mesh.primitives.push_back(read_primitive(in, primitive));
    });
    mesh.weights = weights_in(in, o);
    for (const Primitive& p : mesh.primitives)
        mesh.weights.resize(std::max(mesh.weights.size(), p.targets.size()), 0);
    return mesh;
}

// Of a quaternion x, y, z, w of any length but 0, which turns nothing.
DMat3 rotation_of(const double* q) {
    const double square = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
    if (!(square > 0) || !std::isfinite(square)) return DMat3(1);
    const double s = 2 / square, x = q[0], y = q[1], z = q[2], w = q[3];
    return {DVec3(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)),
            DVec3(s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)),
            DVec3(s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y))};
}

Node read_node(JsonReader& in, Json o) {
    Node node;
    in.each(o, "children",
            [&](Json child) { node.children.push_back(in.index_of(child, "children", "nodes")); });
    node.mesh = in.index(o, "mesh", "meshes");
    node.skin = in.soft_index(o, "skin", "skins");
    if (in.has(o, "matrix")) {
        in.numbers(o, "matrix", &node.matrix[0][0], 16);
    } else {
        in.numbers(o, "translation", &node.translation.x, 3);
        in.numbers(o, "scale", &node.scale.x, 3);
        in.numbers(o, "rotation", node.rotation.data(), 4);
        node.matrix = trs_matrix(node.translation, node.rotation.data(), node.scale);
    }
    node.weights = weights_in(in, o);
    if (const Json many = in.extension(o, "EXT_mesh_gpu_instancing"); many.there())
        node.instances = read_attributes(in, in.object(many, "attributes"), node.fault);
    return node;
}

Skin read_skin(JsonReader& in, Json o) {
    Skin skin;
    in.each(o, "joints", [&](Json joint) {
        skin.joints.push_back(in.index_of(joint, "joints", "nodes", skin.fault));
    });
    skin.inverse_bind = in.index(o, "inverseBindMatrices", "accessors", skin.fault);
    return skin;
}

AnimationSampler read_animation_sampler(JsonReader& in, Json o) {
    AnimationSampler sampler;
    sampler.input = in.index(o, "input", "accessors", sampler.fault);
    sampler.output = in.index(o, "output", "accessors", sampler.fault);
    const std::string by = in.text(o, "interpolation");
    sampler.by = by == "STEP"          ? scene::Interpolation::step
                 : by == "CUBICSPLINE" ? scene::Interpolation::hermite
                                       : scene::Interpolation::linear;
    return sampler;
}

AnimationChannel read_animation_channel(JsonReader& in, Json o, std::size_t samplers) {
    AnimationChannel channel;
    const std::uint64_t sampler = in.whole(o, "sampler", samplers, kMany);
    if (sampler < samplers)
        channel.sampler = static_cast<Index>(sampler);
    else
        channel.fault = fmt::format("sampler is {}, and there are {}", sampler, samplers);
    const Json target = in.object(o, "target");
    channel.node = in.index(target, "node", "nodes", channel.fault);
    const std::string path = in.text(target, "path");
    channel.path = path == "translation" ? AnimationPath::translation
                   : path == "rotation"  ? AnimationPath::rotation
                   : path == "scale"     ? AnimationPath::scale
                   : path == "weights"   ? AnimationPath::weights
                                         : AnimationPath::other;
    return channel;
}

AnimationInfo read_animation(JsonReader& in, Json o) {
    AnimationInfo animation;
    animation.name = in.text(o, "name");
    in.each(o, "samplers", [&](Json sampler) {
        animation.samplers.push_back(read_animation_sampler(in, sampler));
    });
    in.each(o, "channels", [&](Json channel) {
        animation.channels.push_back(
            read_animation_channel(in, channel, animation.samplers.size()));
    });
    return animation;
}

CameraInfo read_camera(JsonReader& in, Json o) {
    CameraInfo camera;
    camera.name = in.text(o, "name");
    camera.orthographic = in.text(o, "type") == "orthographic";
    camera.y_fov = in.number(in.object(o, "perspective"), "yfov", 0);
    return camera;
}

template <class T>
void read_all(JsonReader& in, Json root, std::string_view key, std::vector<T>& out,
              T (*read)(JsonReader&, Json)) {
    out.reserve(in.size_of(key));
    in.each_top(root, key, [&](Json o) { out.push_back(read(in, o)); });
}

void read_names(JsonReader& in, Json root, std::string_view key, std::vector<std::string>& out) {
    in.each(root, key, [&](Json name) { out.push_back(in.text_of(name, key)); });
}

} // namespace

DMat4 trs_matrix(const DVec3& translation, const double* rotation, const DVec3& scale) {
    const DMat3 turn = rotation_of(rotation);
    return {DVec4(turn[0] * scale.x, 0), DVec4(turn[1] * scale.y, 0), DVec4(turn[2] * scale.z, 0),
            DVec4(translation, 1)};
}

Result<Document> read_document(std::string_view json, const std::string& path, Warnings& warnings,
                               bool moves) {
    JsonReader in(path, warnings);
    const Json root = in.parse(json);
    read_asset(in, root);
    TRY_VOID(in.outcome());
    Document d;
    read_names(in, root, "extensionsUsed", d.used);
    read_names(in, root, "extensionsRequired", d.required);
    TRY_VOID(in.outcome());
    TRY_VOID(check_extensions(d, path, warnings)); // may change the meaning of all else
    read_all(in, root, "buffers", d.buffers, read_buffer);
    read_all(in, root, "bufferViews", d.views, read_view);
    read_all(in, root, "accessors", d.accessors, read_accessor);
    read_all(in, root, "images", d.images, read_image);
    read_all(in, root, "samplers", d.samplers, read_sampler);
    read_all(in, root, "textures", d.textures, read_texture);
    read_all(in, root, "materials", d.materials, read_material);
    read_all(in, root, "meshes", d.meshes, read_mesh);
    read_all(in, root, "nodes", d.nodes, read_node);
    read_all(in, root, "skins", d.skins, read_skin);
    read_all(in, root, "cameras", d.cameras, read_camera);
    if (moves) {
        read_all(in, root, "animations", d.animations, read_animation);
    } else {
        each_if_any(in, root, "animations", [&](const simdjson::dom::element& animation) {
            std::string_view name;
            if (animation["name"].get(name) != simdjson::SUCCESS) name = {};
            d.animations.emplace_back().name = name;
        });
    }
    const Index scene = std::max(in.index(root, "scene", "scenes"), 0);
    Index number = 0;
    in.each_top(root, "scenes", [&](Json o) {
        if (number++ != scene) return;
        auto& roots = d.scene.emplace();
        in.each(o, "nodes", [&](Json n) { roots.push_back(in.index_of(n, "nodes", "nodes")); });
    });
    TRY_VOID(in.outcome());
    return d;
}

} // namespace scanout::io::gltf
