#include "io/gltf/gltf.h"

#include "base/stopwatch.h"
#include "geom/framing.h"
#include "io/gltf/animation.h"
#include "io/gltf/flatten.h"
#include "io/gltf/json.h"
#include "io/gltf/material.h"
#include "io/gltf/morph.h"
#include "io/gltf/nodes.h"
#include "io/gltf/primitive.h"
#include "io/text.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace gltf {
namespace {

constexpr std::uint64_t kReportVertices = 65536;
constexpr std::size_t kReportPrimitives = 64;

class GltfReader {
public:
    GltfReader(std::string_view file, const std::string& path, Warnings& warnings,
               const std::function<bool(double)>& progress, const Reading& how)
        : file_(file), path_(path), warnings_(warnings), progress_(progress), how_(how) {}

    Result<GltfFile> read();

private:
    struct Part {
        std::size_t primitive;
        PrimitiveData data;
    };
    struct Mesh { // what of it is drawn, in each of its places
        std::vector<Part> parts;
        MeshSize size;
        std::size_t skipped = 0; // primitives
    };
    Result<> find_meshes(Primitives& primitives);
    Result<Mesh> find_mesh(Primitives& primitives, Index index);
    Result<> check_size(Budget& budget) const;
    Result<> report(std::uint64_t vertices) const;
    Result<> flatten(Flattener& flattener, const SceneNodes& nodes, Accessors& accessors,
                     bool reports);
    Result<> find_reach(const Clip& clip, Primitives& primitives, const Budget& budget,
                        GltfFile& out);
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
    std::vector<std::optional<Mesh>> meshes_; // as the document's
    std::optional<Error> first_fault_;
    MeshSize size_;
    std::size_t skipped_ = 0;
};

// One that cannot be found is told, and left out of every place, as is one without a corner.
Result<GltfReader::Mesh> GltfReader::find_mesh(Primitives& primitives, Index index) {
    Mesh mesh;
    const auto& all = document_.meshes[static_cast<std::size_t>(index)].primitives;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (k % kReportPrimitives == 0) TRY_VOID(report(0));
        auto data = primitives.find(index, k, uv_set_of(all[k].material));
        if (!data) {
            if (!first_fault_) first_fault_ = data.error();
            warnings_.add("glTF primitive", data.error().what);
            ++mesh.skipped;
        } else if (data->corners() > 0) {
            mesh.size.add(*data);
            mesh.parts.push_back({k, *std::move(data)});
        }
    }
    return mesh;
}

Result<> GltfReader::find_meshes(Primitives& primitives) {
    meshes_.resize(document_.meshes.size());
    for (const Draw& draw : draws_) {
        auto& mesh = meshes_[static_cast<std::size_t>(draw.mesh)];
        if (!mesh) {
            TRY(mesh, find_mesh(primitives, draw.mesh));
        }
        skipped_ += mesh->skipped;
        size_.add(mesh->size);
        if (!size_.fits())
            return fail(Exit::unreadable,
                        "{}: nodes[{}] brings its scene to more than {} vertices or {} corners of "
                        "triangles: cut the model into parts",
                        path_, draw.node, kMostVertices, kMostCorners);
    }
    return report(0);
}

// Building the mesh takes as much again as its source arrays (MemoryLimit::holds).
Result<> GltfReader::check_size(Budget& budget) const {
    const std::uint64_t bytes = 2 * size_.bytes();
    if (budget.try_take(bytes)) return {};
    return fail(Exit::unreadable,
                "{}: its scene has {} vertices and {} triangles, which take {} MB of memory, and "
                "{} MB are available: close other programs, or cut the model into parts",
                path_, size_.vertices, size_.faces, bytes / 1'000'000, budget.left() / 1'000'000);
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
                           [](const Primitive& p) { return !p.targets.empty(); });
    };
    note(!document_.animations.empty() && !how_.animation, "animations");
    note(std::any_of(draws_.begin(), draws_.end(),
                     [&](const Draw& draw) {
                         return document_.nodes[static_cast<std::size_t>(draw.node)].skin >= 0;
                     }),
         "skins");
    note(std::any_of(document_.meshes.begin(), document_.meshes.end(), morphs), "morph targets");
    if (!what.empty() && !how_.animation)
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

Result<> GltfReader::flatten(Flattener& flattener, const SceneNodes& nodes, Accessors& accessors,
                             bool reports) {
    Skins skins(document_, accessors, nodes.world, path_);
    MorphRoom room;
    std::uint64_t done = 0, told = 0;
    for (const Draw& draw : nodes.draws) {
        const std::vector<double>& weights =
            weights_of(document_, document_.nodes[static_cast<std::size_t>(draw.node)]);
        for (const Part& part : meshes_[static_cast<std::size_t>(draw.mesh)]->parts) {
            if (reports && done >= told) {
                TRY_VOID(report(done));
                told = done + kReportVertices;
            }
            done += part.data.positions.count;
            const Index material = part.data.material;
            const bool plain = material < 0;
            flattener.add(morphed(part.data, weights, room), {draw.matrix, palette_of(draw, skins)},
                          plain ? UvUse() : looks_.uv[static_cast<std::size_t>(material)],
                          plain ? -1 : looks_.of[static_cast<std::size_t>(material)],
                          {draw.mesh, part.primitive});
        }
    }
    return reports ? report(done) : Result<>();
}

// The box of the model at sixteen moments of the animation, and a little more for what lies between
// them: every moment is framed alike.
Result<> GltfReader::find_reach(const Clip& clip, Primitives& primitives, const Budget& budget,
                                GltfFile& out) {
    constexpr int kMoments = 16;
    constexpr double kMargin = 0x1p-5; // of the box
    Reach box(DVec3(INFINITY), DVec3(-INFINITY));
    for (int i = 0; i < kMoments; ++i) {
        TRY_VOID(report(0));
        Warnings heard; // of the moment that is drawn
        Budget room = budget;
        clip.pose(clip.duration() * i / kMoments, document_);
        TRY(const SceneNodes nodes,
            walk_nodes(document_, primitives.accessors(), room, path_, heard));
        Flattener flattener(path_, heard);
        TRY_VOID(flatten(flattener, nodes, primitives.accessors(), false));
        for (const DVec3& at : flattener.take().positions)
            for (int axis = 0; geom::is_finite(at) && axis < 3; ++axis) {
                box.first[axis] = std::min(box.first[axis], at[axis]);
                box.second[axis] = std::max(box.second[axis], at[axis]);
            }
    }
    if (!geom::is_finite(box.first)) return {};
    const DVec3 margin = (box.second - box.first) * kMargin;
    out.reach = Reach(box.first - margin, box.second + margin);
    return {};
}

Result<GltfFile> GltfReader::read() {
    Stopwatch watch;
    TRY(const Container container, open_container(file_, path_, warnings_));
    TRY(document_, read_document(container.json, path_, warnings_, how_.animation.has_value()));
    Budget budget(how_.memory_bytes, path_);
    Buffers buffers(document_, container, path_, warnings_, how_, budget);
    Primitives primitives(document_, buffers, path_, warnings_, budget);
    if (how_.animation || weighs_targets(document_)) primitives.find_targets();
    std::optional<Clip> clip;
    if (how_.animation) {
        TRY(const Index index, find_animation(document_, how_.animation->name, path_));
        TRY(clip, Clip::read(document_, primitives.accessors(), index, path_, budget, warnings_));
        clip->pose(how_.animation->seconds, document_);
    }
    TRY(const SceneNodes nodes,
        walk_nodes(document_, primitives.accessors(), budget, path_, warnings_));
    draws_ = nodes.draws;
    GltfFile out;
    out.parse_ms = watch.milliseconds();
    watch.restart();
    std::vector<bool> used(document_.materials.size(), false);
    for (const Draw& draw : draws_)
        for (const Primitive& p : document_.meshes[static_cast<std::size_t>(draw.mesh)].primitives)
            if (p.material >= 0) used[static_cast<std::size_t>(p.material)] = true;
    looks_ = read_looks(document_, used, buffers, path_, warnings_, how_, budget);
    out.material_ms = watch.milliseconds();
    watch.restart();
    TRY_VOID(find_meshes(primitives));
    TRY_VOID(check_size(budget));
    note_what_moves();
    Flattener flattener(path_, warnings_);
    flattener.reserve(size_);
    TRY_VOID(flatten(flattener, nodes, primitives.accessors(), true));
    if (clip) out.reach = how_.animation->reach;
    if (clip && !out.reach) TRY_VOID(find_reach(*clip, primitives, budget, out));
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
    for (const AnimationInfo& animation : document_.animations)
        out.animations.push_back(shown(animation.name));
    out.bytes = buffers.bytes_of_files() + looks_.bytes;
    out.parse_ms += watch.milliseconds();
    return out;
}

} // namespace
} // namespace gltf

// The asset may stand behind all else.
bool is_gltf(std::string_view file) {
    constexpr std::size_t kHeadBytes = 65536;
    if (file.starts_with("glTF")) return true;
    if (file.starts_with("\xef\xbb\xbf")) file.remove_prefix(3);
    file.remove_prefix(std::min(file.find_first_not_of(" \t\r\n"), file.size()));
    if (!file.starts_with('{')) return false;
    constexpr std::string_view kNames[] = {"\"asset\"", "\"accessors\"", "\"bufferViews\"",
                                           "\"meshes\""};
    file = file.substr(0, kHeadBytes);
    return std::any_of(std::begin(kNames), std::end(kNames), [&](std::string_view name) {
        return file.find(name) != std::string_view::npos;
    });
}

Result<GltfFile> read_gltf(std::string_view file, const std::string& path, Warnings& warnings,
                           const std::function<bool(double)>& progress, const Reading& how) {
    return gltf::GltfReader(file, path, warnings, progress, how).read();
}

} // namespace scanout::io
