#include "io/gltf.h"

#include "base/stopwatch.h"
#include "io/gltf_flatten.h"
#include "io/gltf_json.h"
#include "io/gltf_material.h"
#include "io/gltf_nodes.h"
#include "io/gltf_primitive.h"
#include "io/text.h"
#include "math/transcendental.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace gltf {
namespace {

constexpr std::uint64_t kReportVertices = 65536;

class GltfReader {
public:
    GltfReader(std::string_view file, const std::string& path, Warnings& warnings,
               const std::function<bool(double)>& progress, const Reading& how)
        : file_(file), path_(path), warnings_(warnings), progress_(progress), how_(how) {}

    Result<GltfFile> read();

private:
    struct Part { // a primitive in a place
        std::size_t draw, primitive;
        const PrimitiveData* data;
    };
    Result<> find_parts(Primitives& primitives);
    Result<> check_size();
    Result<> report(std::uint64_t vertices) const;
    const Palette* palette_of(const Draw& draw, Skins& skins);
    tl::unexpected<Error> nothing() const;
    void note_what_moves() const;
    std::vector<std::string> cameras() const;
    int uv_set_of(Index material) const {
        return material < 0 ? 0 : looks_.uv[static_cast<std::size_t>(material)].set;
    }

    std::string_view file_;
    const std::string& path_;
    Warnings& warnings_;
    const std::function<bool(double)>& progress_;
    Reading how_;
    Document document_;
    std::vector<Draw> draws_;
    Looks looks_;
    std::vector<Part> parts_;
    std::map<std::pair<Index, std::size_t>, std::optional<PrimitiveData>> found_;
    std::optional<Error> first_fault_;
    MeshSize size_;
    std::size_t skipped_ = 0;
};

// Each primitive is found once; one that cannot be is told, and left out of every place.
Result<> GltfReader::find_parts(Primitives& primitives) {
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        const Index mesh = draws_[i].mesh;
        const auto& all = document_.meshes[static_cast<std::size_t>(mesh)].primitives;
        for (std::size_t k = 0; k < all.size(); ++k) {
            const auto [known, is_new] = found_.try_emplace({mesh, k});
            if (is_new) {
                auto data = primitives.find(mesh, k, uv_set_of(all[k].material));
                if (data) {
                    known->second = *data;
                } else {
                    if (!first_fault_) first_fault_ = data.error();
                    warnings_.add("glTF primitive", data.error().what);
                }
            }
            if (!known->second) {
                ++skipped_;
                continue;
            }
            size_.add(*known->second);
            if (!size_.fits())
                return fail(Exit::unreadable,
                            "{}: nodes[{}] brings its scene to more than {} vertices or {} corners "
                            "of triangles: cut the model into parts",
                            path_, draws_[i].node, kMostVertices, kMostCorners);
            parts_.push_back({i, k, &*known->second});
        }
    }
    return {};
}

Result<> GltfReader::check_size() {
    if (size_.bytes() <= how_.memory_bytes) return {};
    return fail(Exit::unreadable,
                "{}: its scene has {} vertices and {} triangles, which take {} MB of memory, and "
                "{} MB are available: close other programs, or cut the model into parts",
                path_, size_.vertices, size_.faces, size_.bytes() / 1'000'000,
                how_.memory_bytes / 1'000'000);
}

Result<> GltfReader::report(std::uint64_t vertices) const {
    const double all = static_cast<double>(std::max(size_.vertices, std::uint64_t{1}));
    if (progress_ && !progress_(static_cast<double>(vertices) / all))
        return fail(Exit::unreadable, "{}: loading was cancelled", path_);
    return {};
}

// Null where the node has no skin, or one that cannot be used: then the node places its mesh.
const Palette* GltfReader::palette_of(const Draw& draw, Skins& skins) {
    const Index skin = document_.nodes[static_cast<std::size_t>(draw.node)].skin;
    if (skin < 0) return nullptr;
    const auto palette = skins.palette(skin);
    if (palette) return *palette;
    warnings_.add("glTF skin", fmt::format("{}; drawn without it", palette.error().what));
    return nullptr;
}

void GltfReader::note_what_moves() const {
    std::string what;
    const auto note = [&](bool there, std::string_view name) {
        if (there) what += fmt::format("{}{}", what.empty() ? "" : ", ", name);
    };
    const auto morphs = [](const MeshInfo& mesh) {
        return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                           [](const Primitive& p) { return p.morphs; });
    };
    note(document_.animations > 0, "animations");
    note(!document_.skins.empty(), "skins");
    note(std::any_of(document_.meshes.begin(), document_.meshes.end(), morphs), "morph targets");
    if (!what.empty())
        warnings_.add("glTF motion", fmt::format("{}: has {}: shown at rest", path_, what));
}

std::vector<std::string> GltfReader::cameras() const {
    std::vector<std::string> lines;
    for (const CameraInfo& camera : document_.cameras) {
        if (lines.size() == 64) break;
        const std::string name =
            camera.name.empty() ? "" : fmt::format(" '{}'", shown(camera.name));
        lines.push_back(camera.orthographic ? fmt::format("orthographic{}", name)
                                            : fmt::format("perspective{}, {:.4g} degrees", name,
                                                          scanout::degrees(camera.y_fov)));
    }
    return lines;
}

// The reason, where nothing is left to show.
tl::unexpected<Error> GltfReader::nothing() const {
    if (first_fault_) return tl::unexpected<Error>(*first_fault_);
    return fail(Exit::unreadable, "{}: holds nothing that can be drawn{}", path_,
                draws_.empty() ? ": no node of its scene has a mesh" : "");
}

Result<GltfFile> GltfReader::read() {
    Stopwatch watch;
    TRY(const Container container, open_container(file_, path_, warnings_));
    TRY(document_, read_document(container.json, path_, warnings_));
    Buffers buffers(document_, container, path_, warnings_, how_);
    Primitives primitives(document_, buffers, path_, warnings_);
    TRY(SceneNodes nodes, walk_nodes(document_, primitives.accessors(), buffers, path_, warnings_));
    draws_ = std::move(nodes.draws);
    Skins skins(document_, primitives.accessors(), nodes.world, path_);
    GltfFile out;
    out.parse_ms = watch.milliseconds();
    watch.restart();
    std::vector<bool> used(document_.materials.size(), false);
    for (const Draw& draw : draws_)
        for (const Primitive& p : document_.meshes[static_cast<std::size_t>(draw.mesh)].primitives)
            if (p.material >= 0) used[static_cast<std::size_t>(p.material)] = true;
    looks_ = read_looks(document_, used, buffers, path_, warnings_, how_);
    out.material_ms = watch.milliseconds();
    watch.restart();
    TRY_VOID(find_parts(primitives));
    TRY_VOID(check_size());
    note_what_moves();
    Flattener flattener(path_, warnings_);
    flattener.reserve(size_);
    std::uint64_t done = 0, told = 0;
    for (const Part& part : parts_) {
        if (done >= told) {
            TRY_VOID(report(done));
            told = done + kReportVertices;
        }
        done += part.data->positions.count;
        const Draw& draw = draws_[part.draw];
        const Index material = part.data->material;
        const bool plain = material < 0;
        flattener.add(*part.data, {draw.matrix, palette_of(draw, skins)},
                      plain ? UvUse() : looks_.uv[static_cast<std::size_t>(material)],
                      plain ? -1 : looks_.of[static_cast<std::size_t>(material)],
                      {draw.mesh, part.primitive});
    }
    out.skipped = skipped_ + flattener.skipped();
    out.polygons = flattener.take();
    const geom::PolygonMesh& m = out.polygons;
    if (m.faces() == 0 && m.line_begin.empty() && m.point_vertices.empty()) return nothing();
    if (flattener.saw_colour_alpha())
        warnings_.add("glTF vertex alpha",
                      fmt::format("{}: COLOR_0 has alphas below 1, which are not drawn", path_));
    out.materials = std::move(looks_.materials);
    out.textures = std::move(looks_.textures);
    out.cameras = cameras();
    out.bytes = buffers.bytes_of_files() + looks_.bytes;
    out.parse_ms += watch.milliseconds();
    return out;
}

} // namespace
} // namespace gltf

bool is_gltf(std::string_view file) {
    if (file.starts_with("glTF")) return true;
    if (file.starts_with("\xef\xbb\xbf")) file.remove_prefix(3);
    file.remove_prefix(std::min(file.find_first_not_of(" \t\r\n"), file.size()));
    return file.starts_with('{') && file.find("\"asset\"") != std::string_view::npos;
}

Result<GltfFile> read_gltf(std::string_view file, const std::string& path, Warnings& warnings,
                           const std::function<bool(double)>& progress, const Reading& how) {
    return gltf::GltfReader(file, path, warnings, progress, how).read();
}

} // namespace scanout::io
