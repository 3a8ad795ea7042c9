#include "frame/pass/shading_input.h"

#include "frame/pass/triangle_colours.h"
#include "frame/plan/step_limits.h"
#include "scene/uv_step.h"

namespace scanout::frame {

ShadingInput::ShadingInput(const ShadingSource& from) {
    set_frame(from);
    set_gather(from);
    if (from.plan.transparency.alpha_modes.empty()) return;
    set_transparency(from.plan);
    gather_.transparency = &transparency_;
}

void ShadingInput::set_frame(const ShadingSource& from) {
    const FramePlan& plan = from.plan;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            frame_.normal_matrix[r][c] = static_cast<float>(from.view.normal[c][r]);
    frame_.orthographic = from.view.projection == scene::Projection::orthographic;
    frame_.attributes = plan.attributes;
    frame_.filter = plan.filter;
    frame_.reflection = plan.reflection;
    frame_.matt = plan.matt;
    frame_.sides = plan.sides;
    frame_.vertex_normals = plan.vertex_normals;
    frame_.vertex_lights = plan.vertex_lights;
    frame_.shadows = from.shadows;
    frame_.occlusion = from.occlusion;
    const std::vector<raster::AlphaMode>& modes = plan.transparency.alpha_modes;
    const bool some = from.occlusion != nullptr && !plan.transparency.opaque_blended;
    for (std::size_t i = 0; i < modes.size() && some; ++i)
        blends_.push_back(modes[(i + 1) % modes.size()] == raster::AlphaMode::blended ? 1 : 0);
    frame_.blends = blends_;
    frame_.shadow_filter = plan.options.shadow_filter;
    frame_.source = plan.source;
    frame_.triangle_colours = from.triangle_colours;
    if (plan.colours != nullptr && plan.colours->of == shade::ColourByTraits::Of::depth) {
        const DepthRange range = depth_range(from.scene.mesh, from.view);
        const double unit = scene::to_floats(from.view), extent = range.farthest - range.nearest;
        frame_.farthest = static_cast<float>(range.farthest * unit);
        frame_.codes_a_unit = extent > 0 ? static_cast<float>(255 / (extent * unit)) : 0;
    }
    frame_.mapped = plan.mapped;
    from.lights.describe(frame_);
    frame_.exposure = plan.exposure;
    frame_.white = plan.white;
    frame_.exact_uv = !from.scene.mesh.exact_uv.empty() && !plan.mapped;
    if (frame_.exact_uv) uv_steps_ = scene::uv_steps(from.scene.materials);
    frame_.per_item_setup = !shade::reads_primitives(plan.attributes) && !plan.vertex_normals &&
                            !(frame_.exact_uv && plan.attributes.uv);
    if (!plan.attributes.steps) return;
    steps_ = step_limits(from.scene, plan);
    frame_.steps = &*steps_;
}

void ShadingInput::set_gather(const ShadingSource& from) {
    const FramePlan& plan = from.plan;
    const scene::View& view = from.view;
    shade::GatherInput& in = gather_;
    in.mesh = &from.scene.mesh;
    in.keys = {&from.scene.mesh, plan.annotations.any() ? std::nullopt : plan.only_material};
    in.added = from.added;
    in.geometry = &from.geometry;
    in.transform = &from.transform;
    in.set_view(view);
    in.materials = from.scene.materials;
    in.unnamed = &from.scene.unnamed;
    in.textures = from.scene.textures;
    in.mips = &from.mips;
    in.wrap = plan.wrap;
    in.uv_steps = uv_steps_;
    in.stages = plan.stages;
    in.frame = &frame_;
    in.mirrored = view.mirrored;
    in.background = plan.options.background;
    in.output = plan.output;
    in.linear = from.linear;
    if (frame_.orthographic) return; // every ray is the same; the extent may be no float
    const int scale = plan.aa->scale;
    in.rays.scale_x = static_cast<float>(2 * view.half_width / (plan.options.width * scale));
    in.rays.offset_x = static_cast<float>(view.middle.x - view.half_width);
    in.rays.scale_y = static_cast<float>(-2 * view.half_height / (plan.options.height * scale));
    in.rays.offset_y = static_cast<float>(view.middle.y + view.half_height);
}

// The alpha stages' frame is that of the opaque surfaces, but for what they read.
void ShadingInput::set_transparency(const FramePlan& plan) {
    const TransparencyPlan& t = plan.transparency;
    shade::TransparencyInput& in = transparency_;
    in.cut_out = t.cut_out;
    in.blended = t.blended;
    in.blend = t.blend;
    in.opaque_blended = t.opaque_blended;
    in.alpha = t.alpha;
    in.stages = t.stages;
    in.frame = frame_;
    in.frame.attributes = t.attributes;
    in.frame.filter = t.filter;
    in.frame.steps = nullptr; // alpha is always exact
    in.frame.source = nullptr;
    in.cut = static_cast<float>(plan.options.alpha_cut);
    in.max_fragments = static_cast<std::size_t>(plan.options.max_fragments);
}

} // namespace scanout::frame
