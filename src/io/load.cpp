#include "io/load.h"

#include "base/available_memory.h"
#include "base/mapping.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "geom/build.h"
#include "io/materials.h"
#include "io/obj.h"
#include "io/stl.h"
#include "io/text.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <malloc.h>

namespace scanout::io {
namespace {

constexpr std::array kFormats = {
    Format{".obj", "Wavefront OBJ with MTL materials: polygons, lines, points"},
    Format{".stl", "STL, binary and ASCII: triangles"},
};

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

constexpr std::uint64_t kMegabyte = 1'000'000;

// The least that a facet of a binary STL file takes at the peak of loading: 90 bytes are measured
// on a smooth surface of two million, 114 on one that is all edges.
constexpr std::uint64_t kBytesPerFacet = 80;

// What loading may take, told in advance where the file's header is enough, and watched.
class MemoryLimit {
public:
    explicit MemoryLimit(std::uint64_t bytes)
        : before_(resident_bytes()), limit_(bytes != 0 ? bytes : available_bytes()) {}

    // An OBJ file says nothing in advance: megabytes of comments or zeros take no memory at all.
    Result<> admit_stl(std::string_view head, std::uint64_t size, const std::string& path) const {
        const std::uint64_t facets = stl_facets_told(head, size);
        if (facets * kBytesPerFacet <= limit_) return {};
        return fail(Exit::unreadable,
                    "{}: its {} triangles take at least {} MB of memory to load, and {} MB are "
                    "available: close other programs, or cut the model into parts",
                    path, facets, facets * kBytesPerFacet / kMegabyte, limit_ / kMegabyte);
    }

    // False from the moment on when too much is taken. The mesh takes as much again as the arrays
    // that it is built of, while what is left of the file leaves memory before.
    bool holds(std::uint64_t left_of_file) {
        const std::uint64_t now = resident_bytes();
        const std::uint64_t taken = now > before_ ? now - before_ : 0;
        const std::uint64_t arrays = taken > left_of_file ? taken - left_of_file : 0;
        exceeded_ = exceeded_ || std::max(taken, 2 * arrays) > limit_;
        return !exceeded_;
    }
    bool was_exceeded() const { return exceeded_; }
    std::uint64_t megabytes() const { return limit_ / kMegabyte; }

private:
    std::uint64_t before_, limit_;
    bool exceeded_ = false;
};

// Of the time that loading takes on one core, in models of a million triangles: how far it is when
// the file is read.
constexpr double kReadOfStl = 0.35, kReadOfObj = 0.25;

// What every reader hands on to the common end.
struct Parts {
    geom::PolygonMesh polygons;
    Materials materials;
    scene::ModelCounts counts;
    LoadTimes times;
    double crease_limit_degrees = 180; // no crease angle above makes sense in this format
    double done = 0;                   // of all, when this is read
};

std::string extension_of(const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? "" : lower_case(std::string_view(name).substr(dot));
}

std::string known_extensions() {
    std::string text;
    for (const Format& format : kFormats)
        text += fmt::format(" {}", format.extension);
    return text;
}

void use_materials(geom::PolygonMesh& polygons, const std::vector<std::int32_t>& of_name) {
    for (auto* materials :
         {&polygons.face_material, &polygons.line_material, &polygons.point_material})
        for (std::int32_t& material : *materials)
            if (material >= 0) material = of_name[static_cast<std::size_t>(material)];
}

Result<Parts> read_obj_parts(std::string_view file, const std::string& path, Warnings& warnings,
                             const std::function<bool(double)>& progress, const Reading& how) {
    Stopwatch watch;
    TRY(ObjFile obj, read_obj(file, path, warnings, progress, how));
    Parts parts;
    parts.times.parse = watch.milliseconds();
    watch.restart();
    parts.materials = load_materials(obj, path, warnings);
    parts.times.materials = watch.milliseconds();
    use_materials(obj.polygons, parts.materials.of_name);
    parts.counts.vertices = obj.polygons.positions.size();
    parts.counts.faces = obj.polygons.faces();
    parts.counts.lines = obj.polygons.line_begin.size();
    parts.counts.points = obj.polygons.point_vertices.size();
    parts.counts.skipped = obj.skipped;
    parts.polygons = std::move(obj.polygons);
    return parts;
}

Result<Parts> read_stl_parts(std::string_view file, const std::string& path, Warnings& warnings,
                             const std::function<bool(double)>& progress, const Reading& how) {
    const Stopwatch watch;
    TRY(StlResult stl, read_stl(file, path, warnings, progress, how));
    Parts parts;
    parts.times.parse = watch.milliseconds();
    parts.counts.vertices = stl.facets * 3;
    parts.counts.faces = stl.polygons.faces();
    parts.counts.skipped = stl.skipped;
    parts.crease_limit_degrees = kStlCreaseDegrees;
    parts.polygons = std::move(stl.polygons);
    return parts;
}

Result<Parts> read(const std::string& path, const LoadOptions& options, Warnings& warnings) {
    const std::string extension = extension_of(path);
    const auto known = std::find_if(kFormats.begin(), kFormats.end(),
                                    [&](const Format& f) { return f.extension == extension; });
    MemoryLimit memory(options.memory_bytes);
    TRY(Mapping file, Mapping::open(path, [&](std::string_view head, std::uint64_t size) {
            return extension == ".stl" ? memory.admit_stl(head, size, path) : Result<>();
        }));
    if (known == kFormats.end()) {
        if (const auto reason = not_a_text_model(file.text()))
            return fail(Exit::unreadable, "{}: {}", path, *reason);
        return fail(Exit::unreadable, "{}: the extension '{}' is not known; known are{}", path,
                    shown(extension), known_extensions());
    }
    const bool stl = extension == ".stl";
    const double all = stl ? kReadOfStl : kReadOfObj;
    // What is read leaves memory at once: the file never stands beside its mesh.
    const std::function<bool(double)> progress = [&](double share) {
        const auto done = static_cast<std::size_t>(share * static_cast<double>(file.size()));
        file.drop_before(done);
        return memory.holds(file.size() - done) &&
               (!options.progress || options.progress(share * all));
    };
    const auto reader = stl ? read_stl_parts : read_obj_parts;
    auto parts = reader(file.text(), path, warnings, progress, {.jobs = options.jobs});
    if (memory.was_exceeded())
        return fail(Exit::unreadable,
                    "{}: needs more memory than the {} MB that are available: close other "
                    "programs, or cut the model into parts",
                    path, memory.megabytes());
    if (!parts) return parts;
    parts->counts.bytes = file.size() + parts->materials.bytes;
    parts->done = all;
    return parts;
}

Result<scene::Scene> load_or_throw(const std::string& path, const LoadOptions& options,
                                   Warnings& warnings) {
    TRY(Parts parts, read(path, options, warnings));
    const Stopwatch watch;
    geom::BuildOptions build{options.crease_degrees, options.jobs, {}};
    if (options.progress)
        build.progress = [&](double share) {
            return options.progress(parts.done + share * (1 - parts.done));
        };
    geom::BuildResult built = geom::build_mesh(std::move(parts.polygons), build, path, warnings);
    parts.times.build = watch.milliseconds();
    if (built.stopped || (options.progress && !options.progress(1)))
        return fail(Exit::unreadable, "{}: loading was cancelled", path);
    if (options.times != nullptr) *options.times = parts.times;
    static std::atomic<std::uint64_t> loaded{0};
    scene::Scene scene;
    scene.path = path;
    scene.revision = ++loaded;
    scene.mesh = std::move(built.mesh);
    scene.materials = std::move(parts.materials.materials);
    scene.textures = std::move(parts.materials.textures);
    scene.counts = parts.counts;
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
        return fail(Exit::unreadable, "{}: is too large for this machine's memory", path);
    } catch (const std::exception& error) {
        return fail(Exit::internal, "{}: {}", path, error.what());
    }
}

std::span<const Format> formats() {
    return kFormats;
}

} // namespace scanout::io
