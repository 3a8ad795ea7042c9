// Transparency: which materials are alpha-tested or blended, and by which technique.
#include "frame/plan/planner.h"
#include "rows.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// The share of the scene that is of one kind: "3 of 14 materials (120 of 900 triangles)".
std::string part(std::size_t materials, std::size_t triangles, const SceneFacts& facts) {
    return fmt::format("{} of {} materials ({} of {} triangles)", materials, facts.alpha.materials,
                       triangles, facts.triangles);
}

// Where a blended material's alpha comes from: its d, or the texels of its maps.
std::string alpha_from(const AlphaFacts& a) {
    if (a.blended_by_maps == a.blended_materials) return "in maps";
    const std::string d = fmt::format("d from {}", a.min_opacity);
    return a.blended_by_maps == 0 ? d : fmt::format("{}, and {} in maps", d, a.blended_by_maps);
}

const shade::Blend& blend_of(const FrameOptions& o) {
    return row_or(shade::blend::kRows, o.blend, shade::blend::over);
}
const shade::Transparency& transparency_of(const FrameOptions& o) {
    return row_or(shade::transparency::kRows, o.transparency, shade::transparency::exact);
}

// The depth test keeps the nearest surface, and the filter of a pixel is its own box.
bool nearest_alone(const FrameOptions& o) {
    return row_or(raster::depth_test::kRows, o.depth_test, raster::depth_test::less).test ==
               raster::DepthTest::less &&
           row_or(aa::kRows, o.aa, aa::none).weight == nullptr;
}

// Forced on without need, an effect draws opaque triangles as cut-out or blended ones, and the
// picture must stay the same. As cut-outs it does where pixels are made of samples, not of areas...
bool opaque_may_be_cut(const FrameOptions& o) {
    return !row_or(aa::kRows, o.aa, aa::none).exact;
}
// ...and as blended ones where, in addition, the nearest surface hides all behind it in any order.
bool opaque_may_blend(const FrameOptions& o) {
    return opaque_may_be_cut(o) && nearest_alone(o) &&
           blend_of(o).hides == shade::Hides::by_alpha &&
           transparency_of(o).sort_triangles == nullptr;
}

} // namespace

bool blends_nothing(const FrameOptions& o) {
    return blend_of(o).hides == shade::Hides::always && transparency_of(o).sort_sample != nullptr &&
           nearest_alone(o);
}

Result<void> plan_transparency(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const FrameOptions& o = plan.options;
    const AlphaFacts& a = facts.alpha;
    TRY(const shade::Transparency* const cuts_by,
        choose(shade::transparency::kRows, o.transparency, shade::transparency::cut_out));
    TRY(const shade::Transparency* const blends_by,
        choose(shade::transparency::kRows, o.transparency, shade::transparency::exact));
    if (!(o.alpha_cut >= 0 && o.alpha_cut <= 1))
        return fail(Exit::usage, "--alpha-cut {}: choose 0 to 1", o.alpha_cut);
    const bool cuts = a.cut_out_triangles + a.unseen_triangles > 0;
    const bool whole = blends_nothing(o) && a.blended_triangles > 0;
    const bool blends = a.blended_triangles > 0 && !whole;
    // An effect forced on without need must not change the surfaces that really blend.
    const bool may_blend = opaque_may_blend(o), cuts_by_blending = !cuts_by->cuts;
    const bool cut_for_nothing =
        !cuts && (cuts_by_blending ? may_blend && !blends : opaque_may_be_cut(o));
    const bool blend_for_nothing = !blends && may_blend && !(cuts && cuts_by_blending);
    const std::string as_it_is = "; opaque triangles stay as they are";
    bool cut = planner.effect(
        "cut_out", cuts_by->card.name, cuts,
        cuts ? fmt::format("{} have alpha 0 in places, and else 1",
                           part(a.cut_out_materials + a.unseen_materials,
                                a.cut_out_triangles + a.unseen_triangles, facts))
             : "no triangle has alpha 0 in places, and else 1" + (cut_for_nothing ? "" : as_it_is),
        cuts_by->card.axis);
    bool blend = planner.effect(
        "blending", blends_by->card.name, blends,
        blends  ? fmt::format("{} have alpha between 0 and 1, {}",
                              part(a.blended_materials, a.blended_triangles, facts), alpha_from(a))
        : whole ? "--blend none shows the nearest surface whole"
                : "no triangle's alpha is between 0 and 1" + (blend_for_nothing ? "" : as_it_is),
        blends_by->card.axis);
    cut = cut && (cuts || cut_for_nothing);
    blend = blend && (blends || blend_for_nothing);
    if (facts.triangles == 0 || !(cut || blend)) return {};
    TransparencyPlan& t = plan.transparency;
    const auto alpha_mode_by = [&](const shade::Transparency* by) {
        (by->cuts ? t.cut_out : t.blended) = by;
        return by->cuts ? raster::AlphaMode::cut_out : raster::AlphaMode::blended;
    };
    const raster::AlphaMode cut_mode = cut ? alpha_mode_by(cuts_by) : raster::AlphaMode::opaque;
    const raster::AlphaMode blend_mode =
        blend ? alpha_mode_by(blends_by) : raster::AlphaMode::opaque;
    t.opaque_blended = (blend && !blends && blend_mode == raster::AlphaMode::blended) ||
                       (cut && !cuts && cut_mode == raster::AlphaMode::blended);
    const raster::AlphaMode opaque_mode =
        blend && !blends ? blend_mode : (cut && !cuts ? cut_mode : raster::AlphaMode::opaque);
    const raster::AlphaMode alpha_mode_of_class[] = {opaque_mode, cut_mode, blend_mode,
                                                     cut ? raster::AlphaMode::nothing
                                                         : raster::AlphaMode::opaque};
    for (const AlphaClass c : a.of_material)
        t.alpha_modes.push_back(alpha_mode_of_class[static_cast<std::size_t>(c)]);
    t.alpha = a.maps;
    for (const shade::Transparency* technique : {t.cut_out, t.blended})
        if (technique != nullptr) plan.techniques.push_back(&technique->card);
    const bool mapped = std::any_of(a.maps.begin(), a.maps.end(), [](const auto& maps) {
        return maps.diffuse_map || maps.opacity_map;
    });
    if (!mapped) return {};
    for (const shade::Stage* stage : {&shade::interpolate::perspective, &shade::map::opacity}) {
        t.stages.push_back(stage);
        t.attributes = t.attributes | stage->needs;
        const Technique* const card = &stage->card; // colours may be interpolated so, too
        if (std::find(plan.techniques.begin(), plan.techniques.end(), card) ==
            plan.techniques.end())
            plan.techniques.push_back(card);
    }
    return {};
}

} // namespace scanout::frame
