#include "measure/framed_views.h"

#include "scene/view.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

namespace scanout::measure {
namespace {

std::string name_of(double azimuth, double elevation) {
    for (const std::string_view name : {"front", "right", "back", "left", "top", "bottom"}) {
        const auto view = scene::named_view(name);
        if (view->azimuth_degrees == azimuth && view->elevation_degrees == elevation)
            return std::string(name);
    }
    return fmt::format("--camera {},{:.4g}", azimuth, elevation);
}

} // namespace

const std::vector<FramedView>& framed_views() {
    static const std::vector<FramedView> views = [] {
        std::vector<FramedView> made;
        const auto add = [&](double azimuth, double elevation) {
            made.push_back({name_of(azimuth, elevation), azimuth, elevation});
        };
        const double to_corner = scene::named_view("iso")->elevation_degrees;
        for (int eighth = 0; eighth < 8; ++eighth) {
            const double up = eighth % 2 == 0 ? 45 : to_corner;
            for (const double elevation : {0.0, up, -up})
                add(45.0 * eighth, elevation);
        }
        add(0, 90);
        add(0, -90);
        return made;
    }();
    return views;
}

} // namespace scanout::measure
