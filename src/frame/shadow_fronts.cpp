#include "frame/shadow_fronts.h"

#include "frame/eye.h"
#include "frame/light_view.h"

namespace scanout::frame {

bool meets_fronts_first(const geom::MeshTopology& topology, const scene::ViewLight& light,
                        const scene::View& view) {
    if (!topology.fronts_hide_backs() || !eye_of(view)) return false; // of a flat picture: either
    if (light.kind == scene::LightKind::directional) return true;
    return is_known(view) && !may_be_inside(topology, view_about(light, view));
}

} // namespace scanout::frame
