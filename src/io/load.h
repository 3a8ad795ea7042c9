// A model file -> Scene. The one door to this module: no other module knows a file format.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "base/warnings.h"
#include "geom/polygon_mesh.h"
#include "io/animation_moment.h"
#include "io/formats.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

// Where the time of load() went, milliseconds.
struct LoadTimes {
    double parse = 0;     // the model file's text or records
    double materials = 0; // libraries and textures
    double build = 0;     // the mesh
};

// What a file holds, beside the scene that was made of it.
struct ModelSource {
    geom::PolygonMesh polygons;         // materials are indices of the scene's
    std::vector<std::string> libraries; // paths of the material libraries that were read
    // Lines at which faces and positions stand; empty in formats where that is not known.
    std::vector<std::uint32_t> face_lines, position_lines;
};

struct LoadOptions {
    double crease_degrees = 60; // where the file has neither normals nor smoothing groups
    Jobs* jobs = nullptr; // null: on the calling thread alone. The scene does not depend on it
    // Called now and then, on the calling thread, with the share of the work that is done, 0 to 1.
    // Returning false cancels: load() then fails with Exit::unreadable, "path: loading was
    // cancelled".
    std::function<bool(double)> progress;
    LoadTimes* times = nullptr; // filled when given
    bool clamps = false; // the frame clamps all maps: texture coordinates stay as the file has them
    // Memory that a model may take while it is loaded; 0: what the machine has available. A model
    // that takes more is refused: else it would drive the machine into swapping.
    std::uint64_t memory_bytes = 0;
    // Vertices within other faces' open edges become corners of those faces, said in a line.
    bool split_t_vertices = true;
    bool allow_outside =
        false; // libraries and textures outside of the model's folder are read, too
    Vec3 unnamed_colour{scene::kUnnamedGrey}; // linear, of what the file gives no material
    ModelFormat* format_read = nullptr;       // filled when given
    ModelSource* source = nullptr;            // filled when given
    // Filled when given: paths of the material libraries that were read.
    std::vector<std::string>* libraries = nullptr;
    std::optional<AnimationMoment> animation{}; // none: the model at rest
    std::optional<ModelFormat> format;          // given: what the file is, whatever it looks like
};

// The format is told by the content and, where that says nothing, by the extension (any case);
// gzip is unpacked (io/formats.h); the path "-" is standard input. Errors are one
// line with the path, the reason and what to do: Exit::unreadable for a file that cannot be read,
// has an unknown extension, or holds nothing to draw. Everything less is a warning.
// Exit::internal where memory runs out.
Result<scene::Scene> load(const std::string& path, const LoadOptions& options, Warnings& warnings);

} // namespace scanout::io
