#include "io/load.h"

#include "base/mapping.h"
#include "base/stopwatch.h"
#include "geom/build.h"
#include "geom/diagnose/diagnose.h"
#include "geom/mend_seams.h"
#include "io/gltf/gltf.h"
#include "io/gzip.h"
#include "io/materials.h"
#include "io/memory_limit.h"
#include "io/obj/obj.h"
#include "io/off.h"
#include "io/ply/ply.h"
#include "io/stl/stl.h"
#include "scene/uv_step.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <iterator>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

namespace scanout::io {
namespace {

// A model's arrays are large and short-lived. glibc takes the first that is freed as a sign to put
// the following ones into the heap, where holes between them stay resident: 3.3 times the file at
// the peak instead of 2.9. While this lives, large blocks are mapped, so that what is freed leaves
// the process; afterwards blocks up to 32 MB, such as frame buffers, are kept for reuse again.
class LargeBlocksMapped {
public:
    LargeBlocksMapped() { ::mallopt(M_MMAP_THRESHOLD, 256 * 1024); }
    ~LargeBlocksMapped() {
        ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
        ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
    }
    LargeBlocksMapped(const LargeBlocksMapped&) = delete;
    LargeBlocksMapped& operator=(const LargeBlocksMapped&) = delete;
};

const std::string kStandardInput = "standard input";

// What every reader hands on to the common end.
struct ReadModel {
    geom::PolygonMesh polygons;
    Materials materials;
    scene::ModelCounts counts;
    LoadTimes times;
    double crease_limit_degrees = 180; // no crease angle above makes sense in this format
    double done = 0;                   // of all, when this is read
    std::vector<std::uint32_t> face_lines, position_lines; // of ModelSource
    std::vector<std::string> cameras;                      // of the scene
    bool unnamed_one_sided = false;      // what the file gives no material shows no back
    std::vector<std::string> animations; // likewise
    std::optional<Reach> reach;          // of an animation
};

using Reader = Result<ReadModel> (*)(std::string_view file, const std::string& path,
                                     Warnings& warnings,
                                     const std::function<bool(double)>& progress,
                                     const Reading& how);

void use_materials(geom::PolygonMesh& polygons, const Materials& used) {
    for (auto* materials :
         {&polygons.face_material, &polygons.line_material, &polygons.point_material})
        for (std::int32_t& material : *materials)
            material =
                material >= 0 ? used.of_name[static_cast<std::size_t>(material)] : used.of_rest;
}

void count(ReadModel& model, geom::PolygonMesh&& polygons, std::size_t skipped) {
    model.counts.vertices = polygons.positions.size();
    model.counts.faces = polygons.faces();
    model.counts.lines = polygons.line_begin.size();
    model.counts.points = polygons.point_vertices.size();
    model.counts.skipped = skipped;
    model.polygons = std::move(polygons);
}

Result<ReadModel> read_obj_model(std::string_view file, const std::string& path, Warnings& warnings,
                                 const std::function<bool(double)>& progress, const Reading& how) {
    Stopwatch watch;
    TRY(ObjFile obj, read_obj(file, path, warnings, progress, how));
    ReadModel model;
    model.times.parse = watch.milliseconds();
    watch.restart();
    model.materials = load_materials(obj, path, warnings, how);
    model.times.materials = watch.milliseconds();
    use_materials(obj.polygons, model.materials);
    count(model, std::move(obj.polygons), obj.skipped);
    model.face_lines = std::move(obj.face_lines);
    model.position_lines = std::move(obj.position_lines);
    return model;
}

// Appends the materials of faces' colours, which stand behind `materials`.
void append(Materials& materials, const ColourMaterials& colours) {
    std::vector<scene::Material> more = colours.materials();
    std::move(more.begin(), more.end(), std::back_inserter(materials.materials));
}

Result<ReadModel> read_stl_model(std::string_view file, const std::string& path, Warnings& warnings,
                                 const std::function<bool(double)>& progress, const Reading& how) {
    const Stopwatch watch;
    TRY(StlResult stl, read_stl(file, path, warnings, progress, how));
    ReadModel model;
    model.times.parse = watch.milliseconds();
    model.crease_limit_degrees = kStlCreaseDegrees;
    append(model.materials, stl.colours);
    const std::size_t vertices = stl.facets * 3;
    count(model, std::move(stl.polygons), stl.skipped);
    model.counts.vertices = vertices;
    return model;
}

Result<ReadModel> read_ply_model(std::string_view file, const std::string& path, Warnings& warnings,
                                 const std::function<bool(double)>& progress, const Reading& how) {
    Stopwatch watch;
    TRY(PlyFile ply, read_ply(file, path, warnings, progress, how));
    ReadModel model;
    model.times.parse = watch.milliseconds();
    watch.restart();
    model.materials = load_texture_materials(ply.textures, path, warnings, how);
    append(model.materials, ply.face_colours);
    model.times.materials = watch.milliseconds();
    count(model, std::move(ply.polygons), ply.skipped);
    model.face_lines = std::move(ply.face_lines);
    model.position_lines = std::move(ply.position_lines);
    return model;
}

Result<ReadModel> read_off_model(std::string_view file, const std::string& path, Warnings& warnings,
                                 const std::function<bool(double)>& progress, const Reading& how) {
    const Stopwatch watch;
    TRY(OffFile off, read_off(file, path, warnings, progress, how));
    ReadModel model;
    model.times.parse = watch.milliseconds();
    append(model.materials, off.face_colours);
    count(model, std::move(off.polygons), off.skipped);
    model.face_lines = std::move(off.face_lines);
    model.position_lines = std::move(off.position_lines);
    return model;
}

Result<ReadModel> read_gltf_model(std::string_view file, const std::string& path,
                                  Warnings& warnings, const std::function<bool(double)>& progress,
                                  const Reading& how) {
    TRY(GltfFile gltf, read_gltf(file, path, warnings, progress, how));
    ReadModel model;
    model.times.parse = gltf.parse_ms;
    model.times.materials = gltf.material_ms;
    model.materials.materials = std::move(gltf.materials);
    model.materials.textures = std::move(gltf.textures);
    model.materials.bytes = gltf.bytes;
    model.cameras = std::move(gltf.cameras);
    model.unnamed_one_sided = true; // as glTF's default material
    model.animations = std::move(gltf.animations);
    model.reach = gltf.reach;
    count(model, std::move(gltf.polygons), gltf.skipped);
    return model;
}

struct FormatReader {
    ModelFormat format;
    Reader read;
    double fraction; // of the time that loading takes on one core, in models of a million triangles
    bool in_order = true; // it reads the file from begin to end, once
};
constexpr std::array kReaders = {
    FormatReader{ModelFormat::obj, read_obj_model, 0.25},
    FormatReader{ModelFormat::stl, read_stl_model, 0.35},
    FormatReader{ModelFormat::ply, read_ply_model, 0.2},
    FormatReader{ModelFormat::off, read_off_model, 0.25},
    FormatReader{ModelFormat::gltf, read_gltf_model, 0.1, false},
};

// gzip packs text to a tenth and bytes of one value to a thousandth: what unpacks to more than this
// many times its size is made to fill memory.
constexpr std::uint64_t kGzipFactor = 200, kGzipSmall = 64 << 20;

// The bytes of the model: of a file, or of standard input; unpacked where they are packed.
Result<Mapping> read_bytes(const std::string& path, const MemoryLimit& memory) {
    const auto admit = [&](std::string_view head, std::uint64_t size) {
        return memory.admit_stl(head, size, path);
    };
    TRY(Mapping file, path == "-" ? Mapping::read_all(STDIN_FILENO, memory.bytes(), kStandardInput)
                                  : Mapping::open(path, admit));
    if (!is_gzip(file.text())) return file;
    const std::uint64_t most = std::max(kGzipSmall, kGzipFactor * file.size());
    return gunzip(file.text(), path, std::min(memory.bytes(), most));
}

Result<ReadModel> read(const std::string& path, const LoadOptions& options, Warnings& warnings) {
    MemoryLimit memory(options.memory_bytes);
    const std::string name = path == "-" ? kStandardInput : path;
    TRY(Mapping file, read_bytes(path, memory));
    TRY_VOID(memory.admit_stl(file.text(), file.size(), name)); // now that it is unpacked
    TRY(const ModelFormat format, options.format ? Result<ModelFormat>(*options.format)
                                                 : tell_format(file.text(), file.size(), name));
    if (options.format_read != nullptr) *options.format_read = format;
    if (options.animation && format != ModelFormat::gltf)
        return fail(Exit::usage, "{}: has no animations: leave --animation out", name);
    const FormatReader& reader = *std::find_if(kReaders.begin(), kReaders.end(),
                                               [&](const auto& r) { return r.format == format; });
    // What is read leaves memory at once: the file never stands beside its mesh.
    const std::function<bool(double)> progress = [&](double fraction) {
        const auto done =
            reader.in_order ? static_cast<std::size_t>(fraction * static_cast<double>(file.size()))
                            : 0;
        file.drop_before(done);
        return memory.holds(file.size() - done) &&
               (!options.progress || options.progress(fraction * reader.fraction));
    };
    Reading how{.jobs = options.jobs, .allow_outside = options.allow_outside};
    how.lines = options.source != nullptr;
    how.animation = options.animation;
    how.memory_bytes = memory.bytes();
    how.texture_bytes = std::min(how.texture_bytes, memory.bytes());
    auto model = reader.read(file.text(), name, warnings, progress, how);
    if (memory.was_exceeded())
        return fail(Exit::unreadable,
                    "{}: needs more memory than the {} MB that are available: close other "
                    "programs, or cut the model into parts",
                    name, memory.megabytes());
    if (!model) return model;
    model->counts.bytes = file.size() + model->materials.bytes;
    model->done = reader.fraction;
    return model;
}

// The colours of vertices are all there is to see where there is no material: nothing dims them.
void light_vertex_colours_whole(ReadModel& model) {
    geom::PolygonMesh& m = model.polygons;
    if (m.colours.empty()) return;
    const auto white = static_cast<std::int32_t>(model.materials.materials.size());
    bool used = false;
    for (auto* materials : {&m.face_material, &m.line_material, &m.point_material})
        for (std::int32_t& material : *materials)
            if (material < 0) {
                material = white;
                used = true;
            }
    if (!used) return;
    model.materials.materials.push_back(scene::unnamed_material(Vec3(1)));
    model.materials.materials.back().one_sided = model.unnamed_one_sided;
}

// Rounding to a few decimals moves vertices off the edges that they lie in, and the background
// shows between.
void close_seams(geom::PolygonMesh& polygons, const std::string& path, Jobs* jobs,
                 Warnings& warnings) {
    std::optional<Jobs> alone;
    if (jobs == nullptr) jobs = &alone.emplace(1);
    const geom::SplitEdges split = geom::split_t_vertices(
        *jobs, polygons, geom::DiagnoseOptions().tolerance, geom::TVertices::seams);
    if (split.unsearched > 0 && split.crowded)
        warnings.add("open edges",
                     fmt::format("{}: its {} open edges lie too close together to look for "
                                 "T-vertices: they are left as the file has them",
                                 path, split.unsearched));
    else if (split.unsearched > 0)
        warnings.add("open edges",
                     fmt::format("{}: its {} open edges are too many to look for T-vertices while "
                                 "it is loaded; scanout doctor tells whether there are any",
                                 path, split.unsearched));
    if (split.corners == 0) return;
    const bool one = split.corners == 1;
    warnings.add("T-vertices",
                 fmt::format("{}: {} {} within {}, at most {:.3g} off: {}, so that no background "
                             "shows between; --t-vertices keep leaves {}",
                             path, split.corners, one ? "vertex lies" : "vertices lie",
                             one ? "another face's edge" : "other faces' edges", split.farthest,
                             one ? "it is made a corner of that face"
                                 : "they are made corners of those faces",
                             one ? "it" : "them"));
}

Result<scene::Scene> load_or_throw(const std::string& path, const LoadOptions& options,
                                   Warnings& warnings) {
    TRY(ReadModel model, read(path, options, warnings));
    if (options.libraries != nullptr) *options.libraries = model.materials.libraries;
    if (options.source != nullptr)
        *options.source = {model.polygons, std::move(model.materials.libraries),
                           std::move(model.face_lines), std::move(model.position_lines)};
    light_vertex_colours_whole(model);
    const Stopwatch watch;
    if (options.split_t_vertices) close_seams(model.polygons, path, options.jobs, warnings);
    geom::BuildOptions build{
        std::min(options.crease_degrees, model.crease_limit_degrees), options.jobs, {}, {}};
    build.uv_step = options.clamps ? std::vector(model.materials.materials.size(), DVec2(0))
                                   : scene::uv_steps(model.materials.materials);
    build.reach = model.reach;
    if (options.progress)
        build.progress = [&](double fraction) {
            return options.progress(model.done + fraction * (1 - model.done));
        };
    geom::BuildResult built = geom::build_mesh(std::move(model.polygons), build, path, warnings);
    model.times.build = watch.milliseconds();
    if (built.stopped || (options.progress && !options.progress(1)))
        return fail(Exit::unreadable, "{}: loading was cancelled", path);
    if (options.times != nullptr) *options.times = model.times;
    static std::atomic<std::uint64_t> loaded{0};
    scene::Scene scene;
    scene.path = path;
    scene.revision = ++loaded;
    scene.mesh = std::move(built.mesh);
    scene.materials = std::move(model.materials.materials);
    scene.unnamed = scene::unnamed_material(options.unnamed_colour);
    scene.unnamed.one_sided = model.unnamed_one_sided;
    scene.textures = std::move(model.materials.textures);
    scene.cameras = std::move(model.cameras);
    scene.animations = std::move(model.animations);
    scene.animated = model.reach.has_value();
    scene.counts = model.counts;
    scene.counts.faces -= built.skipped_faces;
    scene.counts.lines -= built.skipped_lines;
    scene.counts.points -= built.skipped_points;
    scene.counts.skipped += built.skipped_faces + built.skipped_lines + built.skipped_points;
    scene.counts.triangles = scene.mesh.triangles();
    if (scene.mesh.position.empty())
        return fail(Exit::unreadable, "{}: holds nothing that can be drawn", path);
    return scene;
}

} // namespace

Result<scene::Scene> load(const std::string& path, const LoadOptions& options, Warnings& warnings) {
    const LargeBlocksMapped mapped;
    try {
        return load_or_throw(path, options, warnings);
    } catch (const std::bad_alloc&) {
        return fail(Exit::internal,
                    "{}: memory ran out while it was loaded: close other programs, or cut the "
                    "model into parts",
                    path);
    } catch (const std::exception& error) {
        return fail(Exit::internal, "{}: {}", path, error.what());
    }
}

} // namespace scanout::io
