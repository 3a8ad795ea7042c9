#include "measure/hazard_pixels.h"

#include "base/chunks.h"
#include "frame/facts/facts.h"
#include "frame/facts/view_facts.h"
#include "frame/plan/plan.h"
#include "frame/renderer.h"
#include "measure/framed_views.h"
#include "raster/coverage/depth_rule.h"
#include "rows.h"
#include "scene/fit.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>

namespace scanout::measure {
namespace {

// The options of a frame that shows which triangle is nearest, and costs little else.
frame::FrameOptions bare_options(const frame::FrameOptions& asked, const frame::SceneFacts& facts) {
    frame::FrameOptions bare;
    bare.width = asked.width;
    bare.height = asked.height;
    bare.cull = asked.cull;
    bare.depth = asked.depth;
    bare.depth_test = asked.depth_test;
    bare.lights.clear();
    for (const auto& [effect, materials] : facts.materials_of)
        bare.effects[effect] = false;
    return bare;
}

// Longest edge of each triangle, in mesh units.
std::vector<float> longest_edges(const geom::Mesh& mesh, Jobs& jobs) {
    std::vector<float> longest(mesh.triangles());
    for_chunks(jobs, longest.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t t = begin; t < end; ++t) {
            const Vec3 a = mesh.position[mesh.index[3 * t]],
                       b = mesh.position[mesh.index[3 * t + 1]],
                       c = mesh.position[mesh.index[3 * t + 2]];
            longest[t] =
                std::sqrt(std::max({dot3(b - a, b - a), dot3(c - b, c - b), dot3(a - c, a - c)}));
        }
    });
    return longest;
}

// Draws one scene from many views.
class Camera {
public:
    Camera(const scene::Scene& scene, const HazardPixelsOptions& how, Jobs& jobs)
        : scene_(scene), facts_(frame::facts(scene)), renderer_(jobs),
          options_(bare_options(how.frame, facts_)) {}

    Result<scene::View> view_of(const scene::CameraOptions& camera,
                                const scene::ModelTransform& model) const {
        return scene::make_view(scene_.mesh, model, {}, camera, {}, options_.width,
                                options_.height);
    }
    Result<void> draw(const scene::View& view) {
        TRY(const frame::FramePlan plan, frame::plan(options_, facts_, view));
        renderer_.render(scene_, view, plan, &visible_);
        return {};
    }
    const frame::Visibility& visible() const { return visible_; }

private:
    const scene::Scene& scene_;
    frame::SceneFacts facts_;
    frame::Renderer renderer_;
    frame::FrameOptions options_;
    frame::Visibility visible_;
};

class PixelCounter {
public:
    PixelCounter(const scene::Scene& scene, const scene::Scene* mended,
                 const std::vector<geom::HazardMask>& marks, const HazardPixelsOptions& how,
                 Jobs& jobs)
        : mesh_(scene.mesh), marks_(marks), how_(how), jobs_(jobs), camera_(scene, how, jobs),
          longest_(longest_edges(scene.mesh, jobs)),
          any_mark_(std::any_of(marks.begin(), marks.end(), [](auto mask) { return mask != 0; })) {
        if (mended != nullptr) mended_.emplace(*mended, how, jobs);
    }

    Result<PixelsOfView> count(const scene::CameraOptions& camera,
                               const scene::ModelTransform& model, std::string name) {
        TRY(const scene::View view, camera_.view_of(camera, model));
        PixelsOfView pixels;
        pixels.view = std::move(name);
        pixels.small = small_triangles(view);
        if (!any_mark_) return pixels;
        TRY_VOID(camera_.draw(view));
        for (const std::uint32_t id : camera_.visible().id)
            if (id < mesh_.face.size()) add(marks_[mesh_.face[id]], pixels);
        if (mended_) {
            TRY_VOID(mended_->draw(view));
            compare(view, pixels);
        }
        return pixels;
    }

    Result<double> pixels_per_radius() const {
        TRY(const scene::View view, camera_.view_of(how_.camera, how_.model));
        return 1 / scene::world_units_per_pixel(view, how_.frame.height);
    }

private:
    static void add(geom::HazardMask mask, PixelsOfView& pixels) {
        for (; mask != 0; mask &= mask - 1)
            ++pixels.shown[static_cast<std::size_t>(std::countr_zero(mask))];
    }

    void compare(const scene::View& view, PixelsOfView& pixels) const {
        const frame::Visibility &now = camera_.visible(), &mended = mended_->visible();
        const bool perspective = view.projection == scene::Projection::perspective;
        for (std::size_t i = 0; i < now.id.size(); ++i) {
            if (mended.depth[i] <= 0) continue;
            const double a = now.depth[i], b = mended.depth[i];
            // Depth is near / distance, or falls along the model's depth.
            const bool behind = perspective ? a * (1 + kBehind) < b : a + kBehind < b;
            if (!behind) continue;
            ++pixels.through;
            pixels.background += a <= 0 ? 1 : 0;
        }
    }

    std::size_t small_triangles(const scene::View& view) const {
        // Scales the mesh's lengths to those of the view, at most.
        double scale = 0;
        for (int column = 0; column < 3; ++column)
            scale = std::max(scale, dot3(view.linear[column], view.linear[column]));
        scale = std::sqrt(scale);
        const double pixel = 2 * view.half_height / how_.frame.height; // at distance 1
        const bool perspective = view.projection == scene::Projection::perspective;
        std::atomic<std::size_t> all{0};
        for_chunks(jobs_, longest_.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
            std::size_t small = 0;
            for (std::size_t t = begin; t < end; ++t) {
                const Vec3& p = mesh_.position[mesh_.index[3 * t]];
                const double z = view.linear[0].z * double{p.x} + view.linear[1].z * double{p.y} +
                                 view.linear[2].z * double{p.z} + view.translation.z;
                const double distance = perspective ? -z : 1;
                const bool point = longest_[t] == 0; // no distance makes it larger
                small += !point && longest_[t] * scale < pixel * distance ? 1 : 0;
            }
            all.fetch_add(small, std::memory_order_relaxed);
        });
        return all;
    }

    const geom::Mesh& mesh_;
    const std::vector<geom::HazardMask>& marks_;
    const HazardPixelsOptions& how_;
    Jobs& jobs_;
    Camera camera_;
    std::optional<Camera> mended_;
    std::vector<float> longest_;
    bool any_mark_;
};

} // namespace

Result<HazardPixels> hazard_pixels(const scene::Scene& scene, const scene::Scene* mended,
                                   const std::vector<geom::HazardMask>& marks,
                                   const HazardPixelsOptions& how, Jobs& jobs) {
    PixelCounter counter(scene, mended, marks, how, jobs);
    HazardPixels out;
    TRY(out.pixels_per_radius, counter.pixels_per_radius());
    TRY(out.here, counter.count(how.camera, how.model, "here"));
    scene::ModelTransform framed = how.model;
    framed.translate = DVec3(0);
    const double aspect = static_cast<double>(how.frame.width) / how.frame.height;
    const std::vector<FramedView>& views = framed_views();
    for (const FramedView& view : views) {
        if (how.progress)
            how.progress(static_cast<double>(out.framed.size()) /
                         static_cast<double>(views.size()));
        const scene::CameraOptions camera = scene::fitted(
            scene.mesh, framed,
            scene::fitted_from(view.azimuth_degrees, view.elevation_degrees, how.camera), aspect);
        TRY(PixelsOfView pixels, counter.count(camera, framed, view.name));
        out.framed.push_back(std::move(pixels));
    }
    return out;
}

double depth_step(const scene::View& view, const frame::FrameOptions& options) {
    const raster::DepthFormatRow& format =
        row_or(raster::depth::kRows, options.depth, raster::depth::reversed);
    const double step = format.standard && format.steps > 0 ? 1 / format.steps : 0x1p-24;
    if (view.projection == scene::Projection::orthographic) return step / view.depth_scale;
    const double distance = std::max(view.centre_distance, view.near_distance);
    if (format.linear) return step * view.near_distance * (frame::depth_reach(view) - 1);
    // depth = near / distance; reversed it keeps 24 bits of any depth.
    return format.standard ? step * distance * distance / view.near_distance : distance * 0x1p-23;
}

} // namespace scanout::measure
