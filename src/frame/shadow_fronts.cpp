#include "frame/shadow_fronts.h"

#include "frame/light_view.h"
#include "frame/planes.h"

namespace scanout::frame {

bool meets_fronts_first(const MeshSides& sides, const scene::ViewLight& light,
                        const scene::View& view) {
    if (!sides.fronts_hide_backs() || !eye_of(view)) return false; // of a flat picture: either
    if (light.kind == scene::LightKind::directional) return true;
    return is_known(view) && !may_be_inside(sides, view_about(light, view));
}

} // namespace scanout::frame
