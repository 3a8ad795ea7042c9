#include "app/report/model_info.h"

#include "geom/diagnose/diagnose.h"
#include "geom/extent.h"
#include "geom/topology.h"

namespace scanout::app {
namespace {

std::vector<MapInfo> maps_of(const scene::Scene& scene) {
    std::vector<MapInfo> maps;
    for (const scene::Material& material : scene.materials)
        for (const scene::NamedMap& row : scene::kTextureMaps) {
            const scene::TextureMap& map = material.*row.map;
            if (!map.given()) continue;
            MapInfo info{material.name,
                         std::string(row.name),
                         map.path,
                         map.line,
                         row.drawn,
                         map.missing,
                         "",
                         0,
                         0};
            if (map.texture >= 0) {
                const scene::Texture& read = scene.textures[static_cast<std::size_t>(map.texture)];
                info.found = read.path;
                info.width = read.image.width();
                info.height = read.image.height();
            }
            maps.push_back(std::move(info));
        }
    return maps;
}

} // namespace

ModelInfo model_info(const LoadedModel& model, const io::ModelSource& source, Jobs& jobs) {
    const scene::Scene& scene = model.scene;
    ModelInfo info;
    info.path = scene.path;
    info.format = model.format;
    info.up = model.up;
    info.counts = scene.counts;
    info.normals = !source.polygons.normals.empty();
    info.uvs = !source.polygons.uvs.empty();
    info.colours = !source.polygons.colours.empty();
    info.box_min = scene.mesh.box_min;
    info.box_max = scene.mesh.box_max;
    info.cameras = scene.cameras;
    info.animations = scene.animations;
    for (const scene::Material& material : scene.materials) // a nameless one is a face's colour
        if (!material.name.empty()) info.materials.push_back(material.name);
    info.face_colours = info.materials.size() < scene.materials.size() && !info.colours;
    info.maps = maps_of(scene);
    info.warnings = model.warnings;
    info.load_ms = model.load_ms;
    if (scene.mesh.triangles() == 0) return info;
    geom::DiagnoseOptions how;
    how.search = false;
    const geom::Diagnosis diagnosis = geom::diagnose(jobs, source.polygons, how);
    info.open_edges = diagnosis.count(geom::Hazard::open_edges);
    info.non_manifold_edges = diagnosis.count(geom::Hazard::non_manifold_edges);
    info.mixed_winding = diagnosis.count(geom::Hazard::mixed_winding);
    const geom::Extent extent = geom::extent_of(scene.mesh);
    info.has_area = extent.has_area;
    info.area = extent.area;
    const geom::MeshTopology topology = geom::topology(scene.mesh);
    info.closed = info.has_area && (topology.closed || info.open_edges == 0);
    info.inside_out = topology.inside_out;
    info.encloses = info.closed && topology.closed;
    if (info.encloses) info.volume = extent.volume;
    return info;
}

} // namespace scanout::app
