#include "app/frontier/key.h"

#include "app/machine.h"
#include "app/message.h"
#include "image/hash.h"
#include "simd/targets.h"

#include <iterator>

#include <fmt/format.h>

namespace scanout::app {
namespace {

std::string text_of(const DVec3& v) {
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}
std::string text_of(const DMat3& m) {
    return fmt::format("{} {} {}", text_of(m[0]), text_of(m[1]), text_of(m[2]));
}

std::string text_of(const scene::Light& l) {
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(l.kind),
                       static_cast<int>(l.frame), text_of(l.towards), text_of(l.position),
                       l.target ? text_of(*l.target) : "centre", l.inner_degrees, l.outer_degrees,
                       text_of(DVec3(l.colour)), text_of(DVec3(l.ground)), l.power, l.size,
                       static_cast<int>(l.shape), l.casts, escaped(l.name));
}

std::string text_of(const scene::View& v) {
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", text_of(v.linear),
                       text_of(v.translation), text_of(v.normal), v.mirrored,
                       static_cast<int>(v.projection), v.half_width, v.half_height, v.middle.x,
                       v.middle.y, v.cut_near, v.cut_far, v.near_distance, v.target_distance,
                       v.depth_origin, v.depth_scale, v.centre_distance, text_of(v.world_axes),
                       text_of(v.world_origin));
}

void add_options(const frame::FrameOptions& o, std::string& key) {
    const auto line = [&](std::string_view name, const auto& value) {
        fmt::format_to(std::back_inserter(key), "{} {}\n", name, value);
    };
    line("size", fmt::format("{}x{}", o.width, o.height));
    for (const frame::AskedAxis& axis : frame::asked_axes())
        line(axis.axis, escaped(frame::asked_for(o, axis.axis)));
    line("cull", static_cast<int>(o.cull));
    line("background", fmt::format("{},{},{},{}", o.background.r, o.background.g, o.background.b,
                                   o.background.a));
    line("shadow_map", fmt::format("{} {}", o.shadow_size, o.shadow_filter));
    if (o.shadow_plane)
        line("shadow_plane",
             fmt::format("{} {}", text_of(o.shadow_plane->normal), o.shadow_plane->offset));
    for (const scene::Light& light : o.lights)
        line("light", text_of(light));
    line("alpha_cut", o.alpha_cut);
    line("max_fragments", o.max_fragments);
    line("bits", o.bits);
    line("exposure", o.exposure);
    line("annotations", frame::to_string(o.annotations));
    line("lines", fmt::format("{} {} {}", o.edge_angle, o.line_width, o.point_size));
    for (const auto& [effect, on] : o.effects)
        line("effect", fmt::format("{} {}", escaped(effect), on));
}

} // namespace

std::string frontier_key(std::uint64_t scene_content, const scene::View& view,
                         const frame::FrameOptions& options, const std::vector<std::string>& axes,
                         int threads) {
    std::string key = fmt::format("scene {}\n", image::hash_text(scene_content));
    add_options(options, key);
    key += fmt::format("view {}\naxes {}\nthreads {}\ntarget {}\nprocessor {}\nprogram {}\n",
                       text_of(view), fmt::join(axes, " "), threads, simd::chosen_target(),
                       escaped(machine_name()), program_identity());
    return key;
}

} // namespace scanout::app
