#include "io/formats.h"

#include "io/cursor.h"
#include "io/gltf/gltf.h"
#include "io/off.h"
#include "io/ply/header.h"
#include "io/stl/stl.h"
#include "io/text.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace scanout::io {
namespace {

constexpr std::array kFormats = {
    Format{ModelFormat::obj, "obj", ".obj",
           "Wavefront OBJ with MTL materials: polygons, lines, points"},
    Format{ModelFormat::stl, "stl", ".stl", "STL, binary and ASCII: triangles"},
    Format{ModelFormat::ply, "ply", ".ply",
           "PLY, binary and ASCII: polygons, strips, edges, points, colours, a texture"},
    Format{ModelFormat::off, "off", ".off", "OFF, ASCII: polygons, lines, points, colours"},
    Format{ModelFormat::gltf, "gltf", ".gltf",
           "glTF 2.0 and GLB: meshes, materials, textures, at rest"},
};

// As much of a file is looked at, however large it is.
constexpr std::size_t kHeadBytes = 65536;

// Formats that are told apart in order to be named.
struct ForeignFormat {
    std::string_view name;
    std::array<std::string_view, 4> extensions; // "" beyond the last
    std::array<std::string_view, 2> beginnings; // of the file, likewise
    std::string_view mark;                      // somewhere in the first bytes of a text
};
constexpr std::array kForeign = {
    ForeignFormat{"3MF", {".3mf"}, {}, ""},
    ForeignFormat{"AMF", {".amf"}, {}, "<amf"},
    ForeignFormat{"USD", {".usd", ".usda", ".usdc", ".usdz"}, {"PXR-USDC", "#usda "}, ""},
    ForeignFormat{"FBX", {".fbx"}, {"Kaydara FBX Binary", "; FBX"}, "FBXHeaderExtension"},
    ForeignFormat{"Collada", {".dae"}, {}, "<COLLADA"},
    ForeignFormat{"Draco", {".drc"}, {"DRACO"}, ""},
    ForeignFormat{"PCD", {".pcd"}, {"# .PCD"}, ""},
    ForeignFormat{"VRML", {".wrl", ".vrml"}, {"#VRML"}, ""},
    ForeignFormat{"X3D", {".x3d"}, {}, "<X3D"},
    ForeignFormat{"Blender", {".blend"}, {"BLENDER"}, ""},
    ForeignFormat{"STEP", {".stp", ".step"}, {"ISO-10303-21"}, ""},
    ForeignFormat{"IGES", {".igs", ".iges"}, {}, ""},
    ForeignFormat{"3DS", {".3ds"}, {}, ""},
    ForeignFormat{"VTK", {".vtk", ".vtp", ".vtu"}, {"# vtk"}, "<VTKFile"},
    ForeignFormat{"Gaussian splat", {".splat", ".spz", ".ksplat"}, {}, ""},
    ForeignFormat{"point list", {".xyz", ".pts", ".asc"}, {}, ""},
};

std::string extensions_read() {
    std::string text;
    for (const Format& format : kFormats)
        text += fmt::format("{} ", format.extension);
    return text + ".glb, each as .gz, too";
}

const ForeignFormat* foreign_format(std::string_view head, const std::string& extension) {
    for (const ForeignFormat& format : kForeign) {
        for (const std::string_view beginning : format.beginnings)
            if (!beginning.empty() && head.starts_with(beginning)) return &format;
        if (!format.mark.empty() && head.find(format.mark) != std::string_view::npos &&
            (head.starts_with("{") || head.starts_with("<") || head.starts_with("\xef\xbb\xbf") ||
             head.starts_with(";")))
            return &format;
    }
    for (const ForeignFormat& format : kForeign)
        for (const std::string_view known : format.extensions)
            if (!known.empty() && known == extension) return &format;
    return nullptr;
}

// Some early line is a vertex or names a library, as in hardly any other text.
bool looks_like_obj(std::string_view head) {
    Cursor at(head);
    for (int line = 0; !at.done() && line < 200; ++line) {
        at.skip_blanks();
        const std::string_view word = at.word();
        if (word == "mtllib") return true;
        if (word == "v") {
            double x = 0;
            at.skip_blanks();
            return at.number(x) == NumberFault::none;
        }
        at.skip_to_line_end(head.size());
        at.next_line();
    }
    return false;
}

// What the content alone tells beyond doubt.
std::optional<ModelFormat> format_of_content(std::string_view head, std::uint64_t size) {
    if (is_ply(head)) return ModelFormat::ply;
    if (is_stl(head, size)) return ModelFormat::stl;
    if (is_off(head)) return ModelFormat::off;
    if (is_gltf(head)) return ModelFormat::gltf;
    return std::nullopt;
}

} // namespace

std::span<const Format> formats() {
    return kFormats;
}

Result<ModelFormat> format_named(std::string_view name) {
    std::string names;
    for (const Format& format : kFormats) {
        if (format.name == name) return format.format;
        names += fmt::format(" {}", format.name);
    }
    return fail(Exit::usage, "'{}' is not a model format; known are{}", shown(name), names);
}

std::string extension_of(const std::string& path) {
    std::string name = lower_case(path.substr(path.rfind('/') + 1));
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? "" : name.substr(dot);
}

Result<ModelFormat> tell_format(std::string_view head, std::uint64_t size,
                                const std::string& path) {
    head = head.substr(0, kHeadBytes);
    if (const auto told = format_of_content(head, size)) return *told;
    const std::string extension = extension_of(path);
    if (const ForeignFormat* foreign = foreign_format(head, extension))
        return fail(Exit::unreadable, "{}: {} is not read; formats that are: {}", path,
                    foreign->name, extensions_read());
    for (const Format& format : kFormats)
        if (format.extension == extension) return format.format;
    if (extension == ".glb" && !looks_like_obj(head)) return ModelFormat::gltf;
    if (const auto reason = not_a_text_model(head))
        return fail(Exit::unreadable, "{}: {}", path, *reason);
    if (looks_like_obj(head)) return ModelFormat::obj;
    if (extension.empty())
        return fail(Exit::unreadable,
                    "{}: neither its content nor its name tells a format that is "
                    "read: {}",
                    path, extensions_read());
    return fail(Exit::unreadable, "{}: the extension '{}' is not known; known are {}", path,
                shown(extension), extensions_read());
}

} // namespace scanout::io
