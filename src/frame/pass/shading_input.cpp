#include "frame/pass/shading_input.h"

namespace scanout::frame {

shade::FrameState frame_state(const scene::View& view, const FramePlan& plan,
                              const FrameLights& lights) {
    shade::FrameState frame;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            frame.normal_matrix[r][c] = static_cast<float>(view.normal[c][r]);
    frame.orthographic = view.projection == scene::Projection::orthographic;
    frame.attributes = plan.attributes;
    frame.filter = plan.filter;
    frame.reflection = plan.reflection;
    frame.matt = plan.matt;
    frame.sides = plan.sides;
    frame.vertex_normals = plan.vertex_normals;
    frame.vertex_lights = plan.vertex_lights;
    frame.shadow_filter = plan.options.shadow_filter;
    frame.source = plan.source;
    frame.mapped = plan.mapped;
    lights.describe(frame);
    frame.exposure = plan.exposure;
    frame.white = plan.white;
    frame.per_item_setup = !shade::reads_primitives(plan.attributes) && !plan.vertex_normals;
    return frame;
}

shade::GatherInput gather_input(const scene::Scene& scene, const scene::View& view,
                                const FramePlan& plan, const raster::Geometry& geometry,
                                const raster::ScreenTransform& transform,
                                const shade::FrameState& frame, const shade::MipChains& mips) {
    shade::GatherInput in;
    in.mesh = &scene.mesh;
    in.keys = {&scene.mesh, plan.only_material};
    in.geometry = &geometry;
    in.transform = &transform;
    in.set_view(view);
    in.materials = scene.materials;
    in.textures = scene.textures;
    in.mips = &mips;
    in.wrap = plan.wrap;
    in.stages = plan.stages;
    in.frame = &frame;
    in.mirrored = view.mirrored;
    in.background = plan.options.background;
    in.output = plan.output;
    if (frame.orthographic) return in; // every ray is the same; the extent may be no float
    const int scale = plan.aa->scale;
    in.rays.scale_x = static_cast<float>(2 * view.half_width / (plan.options.width * scale));
    in.rays.offset_x = static_cast<float>(-view.half_width);
    in.rays.scale_y = static_cast<float>(-2 * view.half_height / (plan.options.height * scale));
    in.rays.offset_y = static_cast<float>(view.half_height);
    return in;
}

shade::TransparencyInput transparency_input(const FramePlan& plan, const shade::FrameState& frame) {
    const TransparencyPlan& t = plan.transparency;
    shade::TransparencyInput in;
    in.cut_out = t.cut_out;
    in.blended = t.blended;
    in.blend = t.blend;
    in.opaque_blended = t.opaque_blended;
    in.alpha = t.alpha;
    in.stages = t.stages;
    in.frame = frame;
    in.frame.attributes = t.attributes;
    in.frame.filter = t.filter;
    in.frame.steps = nullptr; // alpha is always exact
    in.frame.source = nullptr;
    in.cut = static_cast<float>(plan.options.alpha_cut);
    in.max_fragments = static_cast<std::size_t>(plan.options.max_fragments);
    return in;
}

} // namespace scanout::frame
