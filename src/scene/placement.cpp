#include "scene/placement.h"

namespace scanout::scene {

Placement placement_of(const ModelTransform& model, const geom::Mesh& mesh, UpAxis up) {
    Placement placed{rotation_xyz(model.rotate_degrees) * scaling(model.scale), model.translate};
    for (const TransformStep& step : model.steps) {
        const DVec3 c =
            step.about ? up_rotation(up) * radii_from_centre(mesh, *step.about) : DVec3(0);
        placed.offset = step.linear * (placed.offset - c) + c + step.offset;
        placed.linear = step.linear * placed.linear;
    }
    placed.offset += model.moved;
    return placed;
}

} // namespace scanout::scene
