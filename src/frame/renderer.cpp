#include "frame/renderer.h"

#include "base/stopwatch.h"
#include "frame/lights.h"
#include "raster/geometry.h"
#include "shade/gather.h"
#include "shade/layers.h"

#include <algorithm>
#include <vector>

namespace scanout::frame {
namespace {

// What one worker needs for a tile.
struct Worker {
    raster::VisibilityTile visibility;
    shade::Gatherer gatherer;
    std::unique_ptr<shade::Layers> layers; // made when a plan wants it
    std::uint64_t lanes = 0;
};

raster::Facing kept(Cull cull) {
    switch (cull) {
    case Cull::back:
        return raster::Facing::front;
    case Cull::front:
        return raster::Facing::back;
    case Cull::none:
        break;
    }
    return raster::Facing::any;
}

// Copies a tile's samples out.
void keep(const raster::VisibilityTile& tile, Visibility& out) {
    const image::Rect& area = tile.area();
    for (int s = 0; s < tile.samples(); ++s) {
        for (int y = area.y0; y < area.y1; ++y) {
            for (int x = area.x0; x < area.x1; ++x) {
                const std::size_t at =
                    (static_cast<std::size_t>(s) * static_cast<std::size_t>(out.height) +
                     static_cast<std::size_t>(y)) *
                        static_cast<std::size_t>(out.width) +
                    static_cast<std::size_t>(x);
                out.id[at] = tile.id(x, y, s);
                out.depth[at] = tile.depth(x, y, s);
            }
        }
    }
}

void clear(const image::Rect& area, const image::Rgba8& background, image::Image& out) {
    for (int y = area.y0; y < area.y1; ++y) {
        const auto row = out.row(y).subspan(static_cast<std::size_t>(area.x0),
                                            static_cast<std::size_t>(area.x1 - area.x0));
        std::fill(row.begin(), row.end(), background);
    }
}

} // namespace

struct Renderer::State {
    explicit State(Jobs& j) : jobs(j), workers(static_cast<std::size_t>(j.threads())) {}
    Jobs& jobs;
    std::vector<Worker> workers;
    raster::Geometry geometry;
    shade::MipChains mips;
    image::Image back_buffer;
    FrameStats stats;
};

Renderer::Renderer(Jobs& jobs) : state_(std::make_unique<State>(jobs)) {}
Renderer::~Renderer() = default;
const FrameStats& Renderer::stats() const {
    return state_->stats;
}

static shade::FrameState frame_state(const scene::View& view, const FramePlan& plan,
                                     const FrameLights& lights) {
    shade::FrameState frame;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            frame.normal_matrix[r][c] = static_cast<float>(view.normal[c][r]);
    frame.orthographic = view.projection == scene::Projection::orthographic;
    frame.attributes = plan.attributes;
    frame.filter = plan.filter;
    frame.reflection = plan.reflection;
    frame.sides = plan.sides;
    frame.corner_normals = plan.corner_normals;
    frame.corner_lights = plan.corner_lights;
    lights.describe(frame);
    return frame;
}

static shade::GatherInput gather_input(const scene::Scene& scene, const scene::View& view,
                                       const FramePlan& plan, const raster::Geometry& geometry,
                                       const raster::ScreenTransform& transform,
                                       const shade::FrameState& frame,
                                       const shade::MipChains& mips) {
    shade::GatherInput in;
    in.mesh = &scene.mesh;
    in.geometry = &geometry;
    in.transform = &transform;
    in.view = &view;
    in.materials = scene.materials;
    in.textures = scene.textures;
    in.mips = &mips;
    in.wrap = plan.wrap;
    in.stages = plan.stages;
    in.frame = &frame;
    in.mirrored = view.mirrored;
    in.background = plan.options.background;
    if (frame.orthographic) return in; // every ray is the same; the extent may be no float
    in.rays.scale_x = static_cast<float>(2 * view.half_width / plan.options.width);
    in.rays.offset_x = static_cast<float>(-view.half_width);
    in.rays.scale_y = static_cast<float>(-2 * view.half_height / plan.options.height);
    in.rays.offset_y = static_cast<float>(view.half_height);
    return in;
}

static shade::LayerInput layer_input(const FramePlan& plan, const shade::FrameState& frame) {
    const TransparencyPlan& t = plan.transparency;
    shade::LayerInput in;
    in.cut_out = t.cut_out;
    in.blended = t.blended;
    in.opaque_blended = t.opaque_blended;
    in.alpha = t.alpha;
    in.stages = t.stages;
    in.frame = frame;
    in.frame.attributes = t.attributes;
    in.frame.filter = t.filter;
    in.cut = static_cast<float>(plan.options.alpha_cut);
    in.most_fragments = static_cast<std::size_t>(plan.options.most_fragments);
    return in;
}

const image::Image& Renderer::render(const scene::Scene& scene, const scene::View& view,
                                     const FramePlan& plan, Visibility* visibility, int tile_size,
                                     shade::LinearPicture* linear) {
    State& s = *state_;
    const FrameOptions& o = plan.options;
    if (s.back_buffer.width() != o.width || s.back_buffer.height() != o.height)
        s.back_buffer = image::Image(o.width, o.height);
    const Stopwatch total;
    s.mips.update(scene, plan.mips, s.jobs);
    const raster::ScreenTransform transform(view, o.width, o.height);
    s.geometry.run(s.jobs, scene.mesh, transform,
                   {o.width, o.height, kept(o.cull), view.mirrored, o.samples, tile_size,
                    plan.transparency.layers});
    const double geometry_ms = total.milliseconds();

    const FrameLights lights(plan, view, scene.mesh);
    const shade::FrameState frame = frame_state(view, plan, lights);
    shade::GatherInput in = gather_input(scene, view, plan, s.geometry, transform, frame, s.mips);
    if (linear != nullptr) *linear = shade::LinearPicture(o.width, o.height);
    in.linear = linear;
    const bool layered = !plan.transparency.layers.empty();
    const shade::LayerInput layers = layered ? layer_input(plan, frame) : shade::LayerInput();
    if (layered) in.layers = &layers;
    for (Worker& worker : s.workers) {
        worker.lanes = 0;
        if (!layered)
            worker.layers.reset();
        else if (worker.layers == nullptr)
            worker.layers = std::make_unique<shade::Layers>();
        else
            worker.layers->begin_frame();
    }
    if (visibility != nullptr) {
        const std::size_t samples = static_cast<std::size_t>(o.width) *
                                    static_cast<std::size_t>(o.height) *
                                    static_cast<std::size_t>(o.samples);
        *visibility = {o.width, o.height, o.samples, std::vector<std::uint32_t>(samples),
                       std::vector<float>(samples)};
    }
    s.jobs.for_each(s.geometry.tiles(), [&](int tile, int number) {
        Worker& worker = s.workers[static_cast<std::size_t>(number)];
        const image::Rect area = s.geometry.tile_area(tile);
        worker.visibility.reset(area, o.samples);
        s.geometry.draw_triangles(tile, worker.visibility);
        if (layers.cut_out != nullptr)
            worker.layers->cut_out(s.geometry, tile, in, worker.visibility);
        const bool elsewhere = layers.opaque_blended; // what lines lie on
        s.geometry.draw_on_ground(tile,
                                  elsewhere
                                      ? worker.layers->ground(s.geometry, tile, worker.visibility)
                                      : worker.visibility,
                                  worker.visibility);
        if (visibility != nullptr) keep(worker.visibility, *visibility);
        clear(area, o.background, s.back_buffer);
        if (layers.blended != nullptr)
            worker.lanes += worker.layers->shade(s.geometry, tile, in, worker.visibility,
                                                 worker.gatherer, s.back_buffer);
        else if (!worker.visibility.empty())
            worker.lanes += worker.gatherer.shade(worker.visibility, in, s.back_buffer);
    });
    s.stats = {total.milliseconds(),
               geometry_ms,
               total.milliseconds() - geometry_ms,
               scene.mesh.triangles(),
               s.geometry.triangles_drawn(),
               0,
               0,
               0,
               s.mips.bytes()};
    for (const Worker& worker : s.workers) {
        s.stats.lanes_shaded += worker.lanes;
        if (worker.layers == nullptr) continue;
        s.stats.fragments_blended += worker.layers->fragments();
        s.stats.layer_bytes += worker.layers->bytes();
    }
    return s.back_buffer;
}

} // namespace scanout::frame
