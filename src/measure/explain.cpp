#include "measure/explain.h"

#include "frame/catalogue.h"
#include "frame/plan/bytes.h"
#include "frame/plan/ignored_options.h"
#include "image/compare.h"
#include "image/dither.h"
#include "image/flip.h"
#include "measure/median.h"
#include "raster/screen/primitive.h"
#include "rows.h"

#include <algorithm>

namespace scanout::measure {
namespace {

// The material that a primitive has, as an index into frame::MaterialSet.
std::size_t material_of(const geom::Mesh& mesh, std::uint32_t id, std::size_t none) {
    const std::size_t triangles = mesh.triangles(), lines = mesh.lines();
    std::int32_t material = -1;
    if (id < triangles)
        material = mesh.material[id];
    else if (id - triangles < lines)
        material = mesh.line_material[id - triangles];
    else if (id - triangles - lines < mesh.points())
        material = mesh.point_material[id - triangles - lines];
    return material < 0 ? none : static_cast<std::size_t>(material);
}

// The technique that does least: of rungs the cheapest, which stands first. Empty for axes on which
// no technique is less than the others.
std::string_view plainest_on(std::string_view axis) {
    for (const Technique* technique : frame::techniques())
        if (technique->axis == axis && (technique->kind == Kind::rung || technique->least))
            return technique->name;
    return {};
}

Change change_between(const image::Image& reference, const image::Image& other) {
    const image::Difference d = image::compare(reference, other);
    const bool same = d.differing_pixels == 0; // then there is nothing to look at
    return {d.differing_pixels, d.max_difference,
            same ? 0.0 : double{image::mean_flip(reference, other)}};
}

} // namespace

Explainer::Explainer(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
                     const frame::FrameOptions& options, Jobs& jobs, const ExplainOptions& how)
    : scene_(scene), view_(view), options_(options), facts_(std::move(facts)), how_(how),
      renderers_(scene, view_, jobs) {}

Result<std::unique_ptr<Explainer>>
Explainer::create(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
                  const frame::FrameOptions& options, Jobs& jobs, const ExplainOptions& how) {
    std::unique_ptr<Explainer> made(
        new Explainer(scene, std::move(facts), view, options, jobs, how));
    TRY_VOID(made->begin());
    return made;
}

Result<void> Explainer::begin() {
    TRY(plan_, frame::plan(options_, facts_, view_));
    picture_ = shown(renderers_.a().render(scene_, view_, plan_), plan_);
    so_far_.width = options_.width;
    so_far_.height = options_.height;
    so_far_.techniques = plan_.techniques;
    so_far_.ignored_options = frame::ignored_options(plan_);
    TRY_VOID(count_pixels());
    TRY(so_far_.special, special_rows());
    frame::EffectBytes bytes = frame::bytes_by_effect(scene_, plan_);
    // How many maps, polygons and blended fragments there are depends on the view.
    const frame::FrameStats& stats = renderers_.a().stats();
    if (stats.shadow_bytes > 0) bytes["shadow"] = stats.shadow_bytes;
    if (stats.occlusion_bytes > 0) bytes["ambient_occlusion"] = stats.occlusion_bytes;
    if (stats.blend_list_bytes > 0) bytes["blending"] = stats.blend_list_bytes;
    if (stats.splat_bytes > 0) bytes["aa"] = stats.splat_bytes;
    for (const frame::Decision& decision : plan_.decisions) {
        EffectRow row;
        row.decision = decision;
        if (const auto fraction = shares_.find(decision.effect); fraction != shares_.end())
            row.pixel_share = fraction->second;
        if (decision.effect == "two_sided" && decision.on()) row.faces_away = faces_away_;
        if (const auto held = bytes.find(decision.effect); held != bytes.end())
            row.bytes = held->second;
        so_far_.rows.push_back(std::move(row));
    }
    return {};
}

// Pixels by what their nearest surface calls for. Nothing that acts on materials runs for it: what
// is transparent or cut out counts as what it covers.
Result<void> Explainer::count_pixels() {
    frame::FrameOptions bare = options_;
    bare.samples = 1;
    bare.aa = "auto"; // then `samples` says it
    bare.render_scale = "full";
    bare.edges = "none"; // what is drawn over a surface hides it
    bare.annotations = {};
    for (const auto& [effect, materials] : facts_.materials_of)
        if (plan_.decision(effect) != nullptr) bare.effects[effect] = false;
    TRY(const frame::FramePlan plan, frame::plan(bare, facts_, view_));
    frame::Visibility visible;
    renderers_.b().render(scene_, view_, plan, &visible);
    const std::size_t none = scene_.materials.size();
    std::vector<std::int64_t> shown(none + 1, 0); // pixels of each material
    std::int64_t covered = 0;
    const std::vector<bool> away = frame::back_facing(scene_.mesh, view_);
    faces_away_ = {static_cast<std::size_t>(std::count(away.begin(), away.end(), true)),
                   away.size(), 0};
    for (const std::uint32_t id : visible.id) {
        if (id == raster::kNoPrimitive) continue;
        ++covered;
        faces_away_.pixels += id < away.size() && away[id] ? 1 : 0;
        ++shown[material_of(scene_.mesh, id, none)];
    }
    const double pixels = static_cast<double>(options_.width) * options_.height;
    so_far_.covered_share = static_cast<double>(covered) / pixels;
    for (const auto& [effect, by_default] : facts_.materials_of) {
        const frame::MaterialSet& materials = *frame::materials_calling(facts_, plan_, effect);
        std::int64_t calling = 0;
        for (std::size_t i = 0; i <= none; ++i)
            calling += materials[i] ? shown[i] : 0;
        shares_[effect] = static_cast<double>(calling) / pixels;
    }
    return {};
}

// What a grey triangle under the default lights gets is nothing special.
Result<int> Explainer::special_rows() const {
    frame::SceneFacts grey;
    grey.triangles = grey.topology.open_triangles = 1; // it may show its back
    TRY(const frame::FramePlan plain, frame::plan({}, grey));
    int special = 0;
    for (const frame::Decision& decision : plan_.decisions) {
        const frame::Decision* same = plain.decision(decision.effect);
        if (decision.choice) continue; // something always runs there
        special += decision.on() && (same == nullptr || !same->on()) ? 1 : 0;
    }
    return special;
}

// The options without what is asked for on an axis; nothing where nothing is.
std::optional<frame::FrameOptions> Explainer::automatic(std::string_view axis) const {
    frame::FrameOptions options = options_;
    if (frame::is_auto(frame::asked_for(options_, axis)) || !frame::ask(options, axis, "auto"))
        return std::nullopt;
    return options;
}

// The options with a row the other way round; nothing where there is no other way.
std::optional<frame::FrameOptions> Explainer::switched(EffectRow& row) const {
    frame::FrameOptions options = options_;
    const frame::Decision& d = row.decision;
    if (!d.choice) {
        options.effects[d.effect] = !d.on();
        return options;
    }
    if (const auto unasked = automatic(d.effect)) {
        const auto plan = frame::plan(*unasked, facts_, view_);
        if (plan && plan->decision(d.effect)->technique != d.technique) {
            row.compared_with = plan->decision(d.effect)->technique;
            return unasked;
        }
    }
    const std::string_view plainest = plainest_on(d.effect);
    if (!d.on() || plainest.empty() || d.technique == plainest ||
        !frame::ask(options, d.effect, plainest))
        return std::nullopt;
    row.compared_with = plainest;
    return options;
}

// A display of fewer than 8 bits dithers unless it is asked not to.
image::Image Explainer::shown(const image::Image& picture, const frame::FramePlan& plan) const {
    if (!how_.display) return picture;
    const bool dithered =
        row_or(image::dither::kRows, plan.options.dither, image::dither::bayer).ordered;
    return image::as_displayed(*how_.display,
                               dithered ? picture : image::without_dither(*how_.display, picture));
}

Change Explainer::change_to(const frame::FramePlan& other) {
    return change_between(picture_, shown(renderers_.b().render(scene_, view_, other), other));
}

void Explainer::time(const frame::FramePlan& other, std::optional<Price>& price,
                     bool other_costs_more) {
    if (!how_.times) return;
    if (frame::draws_alike(plan_, other)) {
        price = equal_by_construction();
        return;
    }
    timings_.push_back({other, &price, other_costs_more});
}

// Four frames, and those that make room.
void Explainer::step_timing() {
    Timing& timing = timings_.back();
    if (!timer_) timer_.emplace(renderers_.timer(plan_, timing.plan, how_.seconds_a_row));
    timer_->step();
    if (!timer_->finished()) return;
    const Price price = renderers_.finish(*timer_);
    *timing.price = timing.other_costs_more ? -price : price;
    so_far_.cost = renderers_.cost_of_a();
    timer_.reset();
    timings_.pop_back();
}

// Switches the row's effect: what changes. Its times are left to come.
void Explainer::compare_row() {
    EffectRow& row = so_far_.rows[rows_done_];
    const frame::Decision& d = row.decision;
    const auto options = switched(row);
    if (!options) return;
    const auto other = frame::plan(*options, facts_, view_);
    if (!other) {
        row.refusal = other.error().what;
        return;
    }
    row.change = change_to(*other);
    time(*other, row.price, !d.on() && !d.choice);
    if (d.choice || (!d.on() && d.forced)) return;
    const auto unasked = automatic(d.axis);
    if (!unasked) return;
    const auto own_choice = frame::plan(*unasked, facts_, view_);
    if (!own_choice) return;
    const std::string& technique = own_choice->decision(d.effect)->technique;
    if (technique == d.technique) return;
    row.automatic = Alternative{technique, change_to(*own_choice), {}};
    time(*own_choice, row.automatic->price);
}

void Explainer::step() {
    if (timings_.empty())
        compare_row();
    else
        step_timing();
    if (timings_.empty()) ++rows_done_;
}

Result<Explanation> explain(const scene::Scene& scene, const scene::View& view,
                            const frame::FrameOptions& options, Jobs& jobs,
                            const ExplainOptions& how) {
    TRY(const std::unique_ptr<Explainer> explainer,
        Explainer::create(scene, frame::facts(scene, options.shadow_plane), view, options, jobs,
                          how));
    while (!explainer->finished()) {
        if (how.progress)
            how.progress(static_cast<double>(explainer->rows_done()) /
                         static_cast<double>(explainer->so_far().rows.size()));
        explainer->step();
    }
    return explainer->so_far();
}

} // namespace scanout::measure
