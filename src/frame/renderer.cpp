#include "frame/renderer.h"

#include "base/stopwatch.h"
#include "math/srgb.h"
#include "raster/geometry.h"
#include "shade/gather.h"

#include <vector>

namespace scanout::frame {
namespace {

// What one worker needs for a tile.
struct Worker {
    raster::VisibilityTile visibility;
    shade::Gatherer gatherer;
    shade::TileColour colour;
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

// Tile colours over the background, encoded once, into the back buffer.
void resolve(const image::Rect& area, int samples, const shade::TileColour& colour,
             const image::Rgba8& background, image::Image& out) {
    const float back[3] = {srgb_decode(background.r), srgb_decode(background.g),
                           srgb_decode(background.b)};
    const float share = 1.0F / static_cast<float>(samples);
    for (int y = area.y0; y < area.y1; ++y) {
        const auto row = out.row(y);
        std::size_t pixel = static_cast<std::size_t>(y - area.y0) * raster::kTileSize;
        for (int x = area.x0; x < area.x1; ++x, ++pixel) {
            image::Rgba8& target = row[static_cast<std::size_t>(x)];
            const int uncovered = samples - colour.covered[pixel];
            if (uncovered == samples) {
                target = background;
                continue;
            }
            const float rest = static_cast<float>(uncovered) * share;
            const int alpha = (samples - uncovered) * 255 + uncovered * background.a;
            // Where the background lets through, PNG and PAM want the colour undiluted by it.
            const float back_share = rest * static_cast<float>(background.a) / 255.0F;
            const float whole = 255.0F * static_cast<float>(samples) / static_cast<float>(alpha);
            target = {srgb_encode((colour.red[pixel] + back[0] * back_share) * whole),
                      srgb_encode((colour.green[pixel] + back[1] * back_share) * whole),
                      srgb_encode((colour.blue[pixel] + back[2] * back_share) * whole),
                      static_cast<std::uint8_t>(alpha / samples)};
        }
    }
}

void clear(const image::Rect& area, const image::Rgba8& background, image::Image& out) {
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            out.at(x, y) = background;
}

} // namespace

struct Renderer::State {
    explicit State(Jobs& j) : jobs(j), workers(static_cast<std::size_t>(j.threads())) {}
    Jobs& jobs;
    std::vector<Worker> workers;
    raster::Geometry geometry;
    image::Image back_buffer;
    FrameStats stats;
};

Renderer::Renderer(Jobs& jobs) : state_(std::make_unique<State>(jobs)) {}
Renderer::~Renderer() = default;
const FrameStats& Renderer::stats() const {
    return state_->stats;
}

static shade::FrameState frame_state(const scene::Scene& scene, const scene::View& view,
                                     const FramePlan& plan) {
    shade::FrameState frame;
    frame.normal = scene.mesh.normal;
    frame.uv = scene.mesh.uv;
    frame.colour = scene.mesh.colour;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            frame.normal_matrix[r][c] = static_cast<float>(view.normal[c][r]);
    frame.orthographic = view.projection == scene::Projection::orthographic;
    frame.attributes = plan.attributes;
    frame.lights = scene::default_lights();
    return frame;
}

static shade::GatherInput gather_input(const scene::Scene& scene, const scene::View& view,
                                       const FramePlan& plan, const raster::Geometry& geometry,
                                       const raster::ScreenTransform& transform,
                                       const shade::FrameState& frame) {
    shade::GatherInput in;
    in.mesh = &scene.mesh;
    in.geometry = &geometry;
    in.transform = &transform;
    in.materials = scene.materials;
    in.textures = scene.textures;
    in.stages = plan.stages;
    in.frame = &frame;
    in.mirrored = view.mirrored;
    in.ray_scale_x = static_cast<float>(2 * view.half_width / plan.options.width);
    in.ray_offset_x = static_cast<float>(-view.half_width);
    in.ray_scale_y = static_cast<float>(-2 * view.half_height / plan.options.height);
    in.ray_offset_y = static_cast<float>(view.half_height);
    return in;
}

const image::Image& Renderer::render(const scene::Scene& scene, const scene::View& view,
                                     const FramePlan& plan) {
    State& s = *state_;
    const FrameOptions& o = plan.options;
    if (s.back_buffer.width() != o.width || s.back_buffer.height() != o.height)
        s.back_buffer = image::Image(o.width, o.height);
    const Stopwatch total;
    const raster::ScreenTransform transform(view, o.width, o.height);
    s.geometry.run(s.jobs, scene.mesh, transform,
                   {o.width, o.height, kept(o.cull), view.mirrored, o.samples});
    const double geometry_ms = total.milliseconds();

    const shade::FrameState frame = frame_state(scene, view, plan);
    const shade::GatherInput in = gather_input(scene, view, plan, s.geometry, transform, frame);
    for (Worker& worker : s.workers)
        worker.lanes = 0;
    s.jobs.for_each(s.geometry.tiles(), [&](int tile, int number) {
        Worker& worker = s.workers[static_cast<std::size_t>(number)];
        const image::Rect area = s.geometry.tile_area(tile);
        worker.visibility.reset(area, o.samples);
        s.geometry.draw(tile, worker.visibility);
        if (worker.visibility.empty()) return clear(area, o.background, s.back_buffer);
        worker.lanes += worker.gatherer.shade(worker.visibility, in, worker.colour);
        resolve(area, o.samples, worker.colour, o.background, s.back_buffer);
    });
    s.stats = {total.milliseconds(),
               geometry_ms,
               total.milliseconds() - geometry_ms,
               scene.mesh.triangles(),
               s.geometry.triangles_drawn(),
               0};
    for (const Worker& worker : s.workers)
        s.stats.lanes_shaded += worker.lanes;
    return s.back_buffer;
}

} // namespace scanout::frame
