// What there is to know about a model's file before it is drawn.
#pragma once

#include "app/model_file.h"
#include "scene/placement.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

// A texture map of a material, as the file names it.
struct MapInfo {
    std::string material, kind, path; // kind: map_Kd ...
    std::size_t line = 0;             // of the material library
    bool drawn = false;               // a map that scanout draws; of others nothing more is known
    bool missing = false;             // it would be drawn, but could not be read
    std::string found;                // the file that was read; empty: none, nothing would show it
    int width = 0, height = 0;        // texels
};

struct ModelInfo {
    std::string path;
    io::ModelFormat format{};
    scene::UpAxis up{};
    scene::ModelCounts counts;
    bool normals = false, uvs = false, colours = false; // the file has them, one a vertex
    bool face_colours = false;
    DVec3 box_min{0}, box_max{0}; // file units
    // Of the triangles; nothing where there are none, or where they have no area.
    bool has_area = false;
    bool closed = false;           // no edge is open
    bool encloses = false;         // closed, and wound consistently: it has a volume
    std::size_t inside_out = 0;    // triangles of closed components that enclose less than nothing
    std::size_t mixed_winding = 0; // edges whose faces wind against each other
    std::size_t open_edges = 0, non_manifold_edges = 0;
    std::optional<double> area;         // file units squared; nothing where no number holds it
    std::optional<double> volume;       // cubed, of what encloses one; nothing likewise
    std::vector<std::string> materials; // that have a name
    std::vector<MapInfo> maps;
    std::optional<scene::Placement> transform; // by options; nothing where none is given
    std::vector<std::string> cameras;          // of the file, one line each
    std::vector<std::string> animations;       // their names
    std::vector<std::string> warnings;
    double load_ms = 0;
};

ModelInfo model_info(const LoadedModel& model, const io::ModelSource& source, Jobs& jobs);

} // namespace scanout::app
