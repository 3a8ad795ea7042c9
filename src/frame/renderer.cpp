#include "frame/renderer.h"

#include "base/memory.h"
#include "base/stopwatch.h"
#include "frame/cleared_tiles.h"
#include "frame/pass/ambient_occlusion.h"
#include "frame/pass/annotations.h"
#include "frame/pass/lights.h"
#include "frame/pass/shading_input.h"
#include "frame/pass/shadow_pass.h"
#include "frame/pass/stencil_marks.h"
#include "frame/pass/triangle_colours.h"
#include "image/enlarge.h"
#include "raster/stage/geometry.h"
#include "rows.h"
#include "shade/gather/gather.h"
#include "shade/shadow.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace scanout::frame {
// Buffers of one worker, for a tile.
struct TileWorker {
    raster::VisibilityTile visibility;
    raster::DeferredTriangles deferred; // scratch
    shade::Gatherer gatherer;
    shade::PictureSink picture_sink; // of these sinks a frame uses one
    shade::SumSink sum_sink;
    shade::SplatSink splat_sink;
    std::unique_ptr<shade::TransparencyPass> transparency; // made when a plan wants it
    std::uint64_t items = 0;
    int number = 0;               // among the workers
    raster::Geometry::ById by_id; // of counts
    // Empty but for the techniques of anti-aliasing that read them.
    raster::AreaTile areas;
    shade::LinearPicture drawn; // supersampled pixels of a tile
    shade::PixelSums sums;
};

namespace {

Visibility empty_visibility(int width, int height, int samples) {
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(samples);
    return {width, height, samples, std::vector<std::uint32_t>(count), std::vector<float>(count)};
}

// Copies a tile's samples out.
void copy_samples(const raster::VisibilityTile& tile, Visibility& out) {
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
    const auto row = [&](int y) {
        return out.row(y).subspan(static_cast<std::size_t>(area.x0),
                                  static_cast<std::size_t>(area.x1 - area.x0));
    };
    const auto first = row(area.y0);
    std::fill(first.begin(), first.end(), background);
    for (int y = area.y0 + 1; y < area.y1; ++y) // faster than a loop over pixels
        std::copy(first.begin(), first.end(), row(y).begin());
}

// Input of the tiles, after geometry stage and shadow pass.
struct FrameInput {
    const scene::Scene& scene;
    const scene::View& view;
    const FramePlan& plan;
    const raster::ScreenTransform& transform;
    const FrameLights& lights;
    ShadowPass* shadows; // null: none
    Visibility* visibility;
    shade::LinearPicture* linear;
    int tile_size;
};

struct Frame {
    const scene::Scene& scene;
    const FramePlan& plan;
    const shade::GatherInput& in;
    const shade::ReconstructionFilter* filter; // null: a pixel's own box
    Visibility* visibility;
    ShadowPass* shadows; // null: none
};

} // namespace

struct Renderer::State {
    explicit State(Jobs& j) : jobs(j), workers(static_cast<std::size_t>(j.threads())) {}
    Jobs& jobs;
    std::vector<TileWorker> workers;
    raster::Geometry geometry;
    raster::OcclusionHistory occlusion; // of the view
    shade::MipChains mips;
    image::Image back_buffer;
    ClearedTiles cleared;             // of it
    shade::SplatPicture splats;       // of filters that reach into neighbours
    std::vector<image::Plane> planes; // of a convolution
    image::Image enlarged;            // the back buffer at the picture's size, where that is larger
    image::Enlarger enlarger;

    void draw_tile(const Frame& frame, int tile, TileWorker& worker);
    void draw_marked_tile(const Frame& frame, int tile, TileWorker& worker);
    bool is_empty(int tile) const { // nothing may touch it
        return geometry.is_empty(tile) && (annotations == nullptr || !annotations->has_lines(tile));
    }
    void draw_frame(const FrameInput& input);
    void find_occlusion(const FrameInput& input, const shade::GatherInput& in);
    void count_frame(const FrameInput& input);
    void filter_tiles(const Frame& frame);
    image::Image& shown(const FramePlan& plan);
    void prepare_workers(bool transparent, bool areas);
    void count_work();
    std::unique_ptr<ShadowPass> shadows;           // while a plan runs them
    std::unique_ptr<StencilBuffer> marks;          // likewise
    std::unique_ptr<AmbientOcclusionPass> ambient; // likewise
    std::unique_ptr<AnnotationPass> annotations;   // likewise
    TriangleColours triangle_colours;              // empty but for frames that colour by a fact
    FrameStats stats;
};

Renderer::Renderer(Jobs& jobs) : state_(std::make_unique<State>(jobs)) {}
Renderer::~Renderer() = default;
const FrameStats& Renderer::stats() const {
    return state_->stats;
}

// Makes the frame's shadows, or frees the shadows of an earlier frame.
static ShadowPass* shadow_pass(std::unique_ptr<ShadowPass>& pass, const ShadowScene& in,
                               const raster::ScreenTransform& transform, int tile_size,
                               FrameLights& lights) {
    if (in.plan.shadow.stage == nullptr) {
        pass.reset();
        return nullptr;
    }
    const FrameOptions& o = in.plan.options;
    const AntiAliasing& aa = *in.plan.aa;
    if (pass == nullptr) pass = std::make_unique<ShadowPass>(in.jobs.threads());
    pass->run(in, transform,
              {o.width * aa.scale, o.height * aa.scale, tile_size, aa.samples, aa.exact}, lights);
    return pass.get();
}

// Shades by areas: the visible primitive at a pixel's centre decides only for lines and points.
static void shade_areas(const raster::Geometry& geometry, int tile, std::size_t triangles,
                        const shade::GatherInput& in, TileWorker& worker, shade::PixelSink& sink) {
    const image::Rect& area = worker.visibility.area();
    worker.areas.reset(area);
    geometry.draw(tile, worker.areas);
    if (worker.areas.empty() && worker.visibility.empty()) return;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            const std::uint32_t id = worker.visibility.id(x, y);
            if (id >= triangles && id != raster::kNoPrimitive) worker.areas.fill(x, y, id);
        }
    worker.items += worker.gatherer.shade(worker.areas, in, sink);
}

// Shades by samples, and the fragments that blend over them.
static void shade_samples(const raster::Geometry& geometry, int tile, const shade::GatherInput& in,
                          TileWorker& worker, shade::PixelSink& sink) {
    if (in.transparency != nullptr && in.transparency->blended != nullptr)
        worker.items += worker.transparency->shade(geometry, tile, in, worker.visibility,
                                                   worker.gatherer, sink);
    else if (!worker.visibility.empty())
        worker.items += worker.gatherer.shade(worker.visibility, in, sink);
}

// Resolves every pixel of the area from scale x scale of the tile's pixels.
static void shade_larger(const raster::Geometry& geometry, int tile, const image::Rect& area,
                         int scale, const shade::GatherInput& in, TileWorker& worker,
                         image::Image& picture) {
    const image::Rect& larger = worker.visibility.area();
    worker.drawn.reset(larger.width(), larger.height());
    worker.drawn.x0 = larger.x0;
    worker.drawn.y0 = larger.y0;
    worker.sum_sink.set(worker.drawn);
    shade_samples(geometry, tile, in, worker, worker.sum_sink);
    worker.sums.reset(static_cast<std::size_t>(area.width()) *
                      static_cast<std::size_t>(area.height()));
    if (shade::mean_of_boxes(worker.drawn, scale, area, worker.sums))
        shade::resolve_area(worker.sums, in.output, in.background, area, picture);
}

// Visibility at a tile's samples: opaque and alpha-tested triangles, then lines: the mesh's, and
// annotations, where there are any.
static void draw_samples(raster::Geometry& geometry, const AnnotationPass* annotations, int tile,
                         const shade::GatherInput& in, TileWorker& worker) {
    geometry.draw_triangles(tile, worker.visibility, &worker.deferred);
    const shade::TransparencyInput* transparency = in.transparency;
    if (transparency != nullptr && transparency->cut_out != nullptr)
        worker.transparency->cut_out(geometry, tile, in, worker.visibility);
    const bool elsewhere =
        transparency != nullptr && transparency->opaque_blended; // lines lie on opaque_base
    const raster::VisibilityTile& base =
        elsewhere ? worker.transparency->opaque_base(geometry, tile, worker.visibility)
                  : worker.visibility;
    const bool own = geometry.has_lines(tile);
    const bool added = annotations != nullptr && annotations->has_lines(tile);
    if (!own && !added) return;
    worker.visibility.keep_support(base);
    if (own) geometry.draw_lines(tile, geometry.line_support(), worker.visibility);
    if (added) annotations->draw(tile, geometry, worker.visibility);
}

void Renderer::State::draw_tile(const Frame& f, int tile, TileWorker& worker) {
    const AntiAliasing& aa = *f.plan.aa;
    const image::Rect samples = geometry.tile_area(tile);
    const image::Rect area = {samples.x0 / aa.scale, samples.y0 / aa.scale, samples.x1 / aa.scale,
                              samples.y1 / aa.scale};
    const bool empty = f.visibility == nullptr && is_empty(tile);
    if (!empty || !cleared.is_cleared(tile)) clear(area, f.plan.options.background, back_buffer);
    cleared.set_cleared(tile, empty);
    if (empty) return;
    worker.visibility.reset(samples, aa.samples, f.plan.depth_rule);
    draw_samples(geometry, annotations.get(), tile, f.in, worker);
    if (f.visibility != nullptr) copy_samples(worker.visibility, *f.visibility);
    const bool blends = f.in.transparency != nullptr && f.in.transparency->blended != nullptr;
    if (f.shadows != nullptr && (blends || aa.exact || !worker.visibility.empty()))
        worker.gatherer.set_shadow(f.shadows->count(tile, worker.number, worker.visibility));
    worker.picture_sink.set(back_buffer);
    if (aa.exact)
        return shade_areas(geometry, tile, f.scene.mesh.triangles(), f.in, worker,
                           worker.picture_sink);
    if (aa.scale > 1)
        return shade_larger(geometry, tile, area, aa.scale, f.in, worker, back_buffer);
    if (f.filter == nullptr)
        return shade_samples(geometry, tile, f.in, worker, worker.picture_sink);
    worker.splat_sink.set(*f.filter, splats);
    shade_samples(geometry, tile, f.in, worker, worker.splat_sink);
}

// The same, and marks the pixels that show something in the stencil buffer.
void Renderer::State::draw_marked_tile(const Frame& f, int tile, TileWorker& worker) {
    shade::TransparencyPass::Pixels blended{};
    if (worker.transparency != nullptr) worker.transparency->note_pixels(&blended);
    draw_tile(f, tile, worker);
    if (worker.transparency != nullptr) worker.transparency->note_pixels(nullptr);
    if (is_empty(tile)) return;
    if (f.plan.aa->exact)
        mark_visible(worker.areas, *marks);
    else
        mark_visible(worker.visibility, worker.transparency != nullptr ? &blended : nullptr,
                     f.plan.aa->scale, *marks);
}

void Renderer::State::count_work() {
    for (const TileWorker& worker : workers) {
        stats.items_shaded += worker.items;
        if (worker.transparency == nullptr) continue;
        stats.fragments_blended += worker.transparency->fragments();
        stats.transparency_bytes += worker.transparency->bytes();
        stats.blend_list_bytes =
            std::max(stats.blend_list_bytes, worker.transparency->list_bytes());
    }
}

// Frees the buffers that the frame does not need.
void Renderer::State::prepare_workers(bool transparent, bool areas) {
    for (std::size_t i = 0; i < workers.size(); ++i) {
        TileWorker& worker = workers[i];
        worker.number = static_cast<int>(i);
        worker.items = 0;
        worker.gatherer.set_shadow(nullptr);
        if (!areas) worker.areas = {};
        if (!transparent)
            worker.transparency.reset();
        else if (worker.transparency == nullptr)
            worker.transparency = std::make_unique<shade::TransparencyPass>();
        else
            worker.transparency->begin_frame();
    }
}

// Reconstruction filter: resolves pixels from the splats that tiles gave to each other.
void Renderer::State::filter_tiles(const Frame& f) {
    jobs.for_each(geometry.tiles(), [&](int tile, int number) {
        shade::PixelSums& sums = workers[static_cast<std::size_t>(number)].sums;
        const image::Rect area = geometry.tile_area(tile);
        sums.reset(static_cast<std::size_t>(area.width()) *
                   static_cast<std::size_t>(area.height()));
        if (shade::filter_area(*f.filter, splats, area, sums))
            shade::resolve_area(sums, f.in.output, f.plan.options.background, area, back_buffer);
    });
}

// The picture, from the back buffer.
image::Image& Renderer::State::shown(const FramePlan& plan) {
    if (!plan.is_enlarged()) {
        if (!enlarged.empty()) enlarged = {};
        return back_buffer;
    }
    if (enlarged.width() != plan.shown_width || enlarged.height() != plan.shown_height)
        enlarged = image::Image::unwritten(plan.shown_width, plan.shown_height);
    enlarger.run(back_buffer, enlarged, jobs);
    return enlarged;
}

// What the centres of all pixels show, and the light from everywhere that reaches them.
void Renderer::State::find_occlusion(const FrameInput& input, const shade::GatherInput& in) {
    const int scale = input.plan.aa->scale;
    ambient->begin(jobs, input.scene, input.view, input.plan.options.width * scale,
                   input.plan.options.height * scale);
    jobs.for_each(geometry.tiles(), [&](int tile, int number) {
        const image::Rect area = geometry.tile_area(tile);
        if (geometry.is_empty(tile)) return ambient->take_empty(area);
        TileWorker& worker = workers[static_cast<std::size_t>(number)];
        worker.visibility.reset(area, 1);
        geometry.draw_triangles(tile, worker.visibility, &worker.deferred);
        if (in.transparency != nullptr && in.transparency->cut_out != nullptr)
            worker.transparency->cut_out(geometry, tile, in, worker.visibility);
        const bool elsewhere = in.transparency != nullptr && in.transparency->opaque_blended;
        ambient->take(elsewhere
                          ? worker.transparency->opaque_base(geometry, tile, worker.visibility)
                          : worker.visibility);
    });
    geometry.draw_again();
    ambient->find(jobs, *input.plan.occlusion);
}

void Renderer::State::draw_frame(const FrameInput& input) {
    const FramePlan& plan = input.plan;
    const AntiAliasing& aa = *plan.aa;
    const ShadingInput shading(
        {input.scene, input.view, plan, input.lights, geometry, input.transform, mips,
         annotations != nullptr ? &annotations->lines() : nullptr,
         triangle_colours.of(input.scene, input.view,
                             plan.colours != nullptr ? plan.colours->of
                                                     : shade::ColourByTraits::Of::light),
         input.shadows != nullptr ? input.shadows->lights().data() : nullptr,
         ambient != nullptr ? &ambient->image() : nullptr, input.linear});
    prepare_workers(!plan.transparency.alpha_modes.empty(), aa.exact);
    if (ambient != nullptr) find_occlusion(input, shading.gather());
    std::optional<shade::ReconstructionFilter> filter;
    if (aa.weight != nullptr) {
        filter.emplace(raster::sample_pattern(aa.samples), aa.weight);
        splats.reset(plan.options.width * aa.scale, plan.options.height * aa.scale, input.tile_size,
                     geometry.tiles_across(), geometry.tiles());
    }
    const Frame f{input.scene,      plan,         shading.gather(), filter ? &*filter : nullptr,
                  input.visibility, input.shadows};
    cleared.begin({plan.options.width, plan.options.height, input.tile_size / aa.scale,
                   geometry.tiles(), plan.options.background});
    jobs.for_each(geometry.tiles(), [&](int tile, int number) {
        TileWorker& worker = workers[static_cast<std::size_t>(number)];
        if (marks == nullptr)
            draw_tile(f, tile, worker);
        else
            draw_marked_tile(f, tile, worker);
    });
    if (filter)
        filter_tiles(f);
    else if (splats.tiles_across > 0)
        splats = {};
}

// Overdraw: counts triangles, shades nothing, and finds visibility only where the caller wants it.
void Renderer::State::count_frame(const FrameInput& input) {
    prepare_workers(false, false);
    splats = {};
    std::fill(back_buffer.pixels().begin(), back_buffer.pixels().end(),
              input.plan.options.background);
    jobs.for_each(geometry.tiles(), [&](int tile, int number) {
        TileWorker& worker = workers[static_cast<std::size_t>(number)];
        raster::VisibilityTile& visible = worker.visibility;
        if (!geometry.is_empty(tile))
            count_covering(geometry, tile, visible, input.plan.depth_rule, worker.by_id, *marks);
        if (input.visibility == nullptr) return;
        visible.reset(geometry.tile_area(tile), 1, input.plan.depth_rule);
        geometry.draw(tile, visible);
        copy_samples(visible, *input.visibility);
    });
}

const image::Image& Renderer::render(const scene::Scene& scene, const scene::View& view,
                                     const FramePlan& plan, Visibility* visibility, int tile_size,
                                     shade::LinearPicture* linear) {
    State& s = *state_;
    const FrameOptions& o = plan.options;
    if (s.back_buffer.width() != o.width || s.back_buffer.height() != o.height) {
        s.back_buffer = image::Image::unwritten(o.width, o.height);
        s.cleared.forget();
    }
    const Stopwatch total;
    s.mips.update(scene, plan.mips, s.jobs);
    const AntiAliasing& aa = *plan.aa;
    const int width = o.width * aa.scale, height = o.height * aa.scale;
    const raster::ScreenTransform transform(view, width, height);
    raster::GeometryOptions options{width,
                                    height,
                                    raster::cull::kRows[static_cast<std::size_t>(o.cull)]->keep,
                                    view.mirrored,
                                    aa.samples,
                                    aa.exact,
                                    tile_size,
                                    plan.transparency.alpha_modes,
                                    plan.one_sided};
    // Occlusion culling needs triangles that all occlude by the default depth rule.
    const bool occludes = plan.transparency.alpha_modes.empty() && plan.one_sided.empty() &&
                          !aa.exact && plan.depth_rule.is_default() && plan.stencil == nullptr;
    if (occludes) options.occlusion = &s.occlusion;
    options.all_vertices = plan.annotations.any();
    options.centres = plan.occlusion != nullptr;
    options.line_width = o.line_width > 1 ? o.line_width * aa.scale : 1;
    options.point_size = o.point_size > 1 ? o.point_size * aa.scale : 1;
    s.geometry.run(s.jobs, scene.mesh, transform, options);
    if (!plan.annotations.any())
        s.annotations.reset();
    else if (s.annotations == nullptr)
        s.annotations = std::make_unique<AnnotationPass>();
    if (s.annotations != nullptr)
        s.annotations->run(s.jobs, scene, plan, view.up, transform, options, aa.scale);
    if (plan.occlusion == nullptr)
        s.ambient.reset();
    else if (s.ambient == nullptr)
        s.ambient = std::make_unique<AmbientOcclusionPass>();
    FrameLights lights(plan, view, scene.mesh);
    const double before_shadows_ms = total.milliseconds();
    ShadowPass* const shadows =
        shadow_pass(s.shadows, {s.jobs, scene, view, plan, s.mips}, transform, tile_size, lights);
    const double geometry_ms = total.milliseconds();

    if (visibility != nullptr) *visibility = empty_visibility(width, height, aa.samples);
    if (linear != nullptr) *linear = shade::LinearPicture(width, height);
    if (plan.stencil == nullptr)
        s.marks.reset();
    else if (s.marks == nullptr)
        s.marks = std::make_unique<StencilBuffer>(o.width, o.height);
    else
        s.marks->reset(o.width, o.height);
    const FrameInput input{scene,   view,       plan,   transform, lights,
                           shadows, visibility, linear, tile_size};
    if (plan.stencil != nullptr && plan.stencil->marks == Stencil::Marks::covering)
        s.count_frame(input);
    else
        s.draw_frame(input);
    if (plan.stencil != nullptr) show_marks(s.jobs, *plan.stencil, *s.marks, s.back_buffer);
    image::Image& picture = s.shown(plan);
    if (plan.convolution != nullptr)
        plan.convolution->run(picture, s.planes);
    else
        release(s.planes);
    if (plan.stencil != nullptr || plan.convolution != nullptr || aa.weight != nullptr)
        s.cleared.forget(); // these write beside the tiles that show something
    s.stats = {};
    s.stats.total_ms = total.milliseconds();
    s.stats.geometry_ms = geometry_ms;
    s.stats.tiles_ms = s.stats.total_ms - geometry_ms;
    s.stats.triangles_submitted = scene.mesh.triangles();
    s.stats.triangles_drawn = s.geometry.triangles_drawn();
    if (shadows != nullptr) {
        s.stats.shadow_ms = geometry_ms - before_shadows_ms;
        s.stats.shadow_bytes = shadows->bytes();
    }
    s.count_work();
    s.stats.stencil_bytes = s.marks != nullptr ? s.marks->bytes() : 0;
    s.stats.occlusion_bytes = s.ambient != nullptr ? s.ambient->bytes() : 0;
    s.stats.annotation_bytes = s.annotations != nullptr ? s.annotations->bytes() : 0;
    s.stats.mipmap_bytes = s.mips.bytes();
    s.stats.splat_bytes = s.splats.bytes();
    return picture;
}

} // namespace scanout::frame
