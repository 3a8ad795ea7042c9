// Which materials let light through, and how their maps are read.
#include "base/check.h"
#include "frame/planner.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// How much of the scene is of one kind: "3 of 14 materials (120 of 900 triangles)".
std::string part(std::size_t materials, std::size_t triangles, const SceneFacts& facts) {
    return fmt::format("{} of {} materials ({} of {} triangles)", materials, facts.alpha.materials,
                       triangles, facts.triangles);
}

// Does some stage of the plan read the map, for colour or for alpha?
bool is_read(const TexturedSurface& surface, const FramePlan& plan) {
    if ((plan.attributes.maps & shade::bit_of(surface.map)) != 0) return true;
    const TransparencyPlan& t = plan.transparency;
    if (t.stages.empty() || t.layers[surface.material + 1] == raster::Layer::opaque) return false;
    const shade::MaterialAlpha& alpha = t.alpha[surface.material + 1];
    return surface.map == shade::kDiffuseMap
               ? alpha.diffuse_map
               : surface.map == shade::kOpacityMap && alpha.opacity_map;
}

} // namespace

Result<void> plan_transparency(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const FrameOptions& o = plan.options;
    const AlphaFacts& a = facts.alpha;
    TRY(const std::string cut_name, choose("transparency", o.transparency, "cut_out"));
    TRY(const std::string blend_name, choose("transparency", o.transparency, "exact"));
    if (!(o.alpha_cut >= 0 && o.alpha_cut <= 1))
        return fail(Exit::usage, "--alpha-cut {}: choose 0 to 1", o.alpha_cut);
    const bool cuts = a.cut_out_triangles + a.unseen_triangles > 0;
    const bool blends = a.blended_triangles > 0;
    const bool cut =
        planner.effect("cut_out", cut_name, cuts,
                       cuts ? fmt::format("{} have alpha 0 in places, and else 1",
                                          part(a.cut_out_materials + a.unseen_materials,
                                               a.cut_out_triangles + a.unseen_triangles, facts))
                            : "no triangle has alpha 0 in places, and else 1");
    const bool blend = planner.effect(
        "blending", blend_name, blends,
        blends ? fmt::format("{} have alpha between 0 and 1, d from {}",
                             part(a.blended_materials, a.blended_triangles, facts), a.least_d)
               : "no triangle's alpha is between 0 and 1");
    if (facts.triangles == 0 || !(cut || blend)) return {};
    TransparencyPlan& t = plan.transparency;
    const auto layer_by = [&](const std::string& name) {
        const shade::Transparency* found = shade::find_transparency(name);
        CHECK(found != nullptr);
        (found->cuts ? t.cut_out : t.blended) = found;
        return found->cuts ? raster::Layer::cut_out : raster::Layer::blended;
    };
    const raster::Layer cut_layer = cut ? layer_by(cut_name) : raster::Layer::opaque;
    const raster::Layer blend_layer = blend ? layer_by(blend_name) : raster::Layer::opaque;
    // Forced on where nothing calls for it: opaque triangles take that way, and look the same.
    t.opaque_blended = blend && !blends && blend_layer == raster::Layer::blended;
    const raster::Layer opaque_layer =
        blend && !blends ? blend_layer : (cut && !cuts ? cut_layer : raster::Layer::opaque);
    const raster::Layer layer_of_class[] = {opaque_layer, cut_layer, blend_layer,
                                            cut ? raster::Layer::nothing : raster::Layer::opaque};
    for (const AlphaClass c : a.of_material)
        t.layers.push_back(layer_of_class[static_cast<std::size_t>(c)]);
    t.alpha = a.maps;
    for (const shade::Transparency* technique : {t.cut_out, t.blended})
        if (technique != nullptr) plan.techniques.push_back(&technique->card);
    const bool mapped = std::any_of(a.maps.begin(), a.maps.end(), [](const auto& maps) {
        return maps.diffuse_map || maps.opacity_map;
    });
    if (!mapped) return {};
    for (const auto& [axis, name] : {std::pair("interpolate", "perspective"), {"map", "opacity"}}) {
        t.stages.push_back(shade::find_stage(axis, name));
        CHECK(t.stages.back() != nullptr);
        t.attributes = t.attributes | t.stages.back()->needs;
    }
    plan.techniques.push_back(&t.stages.back()->card);
    return {};
}

Result<void> plan_filter(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                         const scene::View& view) {
    const FrameOptions& options = plan.options;
    TRY(const std::string name, choose("texture", options.texture, "trilinear"));
    const shade::Filter* filter = shade::find_filter(name);
    CHECK(filter != nullptr);
    const bool automatic = options.texture == "auto";
    const bool colour = plan.attributes.maps != 0, alpha = !plan.transparency.stages.empty();
    double most = 0; // texels a pixel
    for (const TexturedSurface& surface : facts.textured_surfaces) {
        if (!is_read(surface, plan)) continue;
        const double texels = texels_per_pixel(surface, view, options.width * plan.aa->scale,
                                               options.height * plan.aa->scale);
        most = std::max(most, texels);
        // A filter that the user names is drawn as it is; else what is not minified has no
        // mipmaps, though its rim may show a few texels a pixel.
        if (automatic && texels * kMostSlant <= 1) continue;
        if (std::find(plan.mips.begin(), plan.mips.end(), surface.texture) == plan.mips.end())
            plan.mips.push_back(surface.texture);
    }
    const bool mipmaps = planner.effect(
        "mipmaps", "on", filter->needs.footprint && !plan.mips.empty(),
        colour || alpha
            ? fmt::format("textures show up to {:.3g} texels a pixel, {:.3g} where they slant",
                          most, most * kMostSlant)
            : "no texture is read");
    if (!mipmaps || !filter->needs.footprint) plan.mips.clear();
    if (filter->needs.footprint && plan.mips.empty()) filter = shade::find_filter("bilinear");
    if (colour || alpha) planner.filter(*filter, colour, alpha);
    return {};
}

Result<void> plan_wrap(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const std::string& asked = plan.options.wrap;
    TRY(const std::string name, choose("wrap", asked, "repeat"));
    std::size_t maps = 0, clamped = 0;
    for (const TexturedSurface& surface : facts.textured_surfaces) {
        if (!is_read(surface, plan)) continue;
        ++maps;
        if (surface.clamp) ++clamped;
    }
    const auto use = [&](std::string_view wrapping) {
        plan.techniques.push_back(&shade::find_wrapping(wrapping)->card);
        return shade::find_wrapping(wrapping)->wrap;
    };
    if (asked != "auto" && maps > 0) plan.wrap = use(name);
    if (asked == "auto" && clamped < maps) use("repeat");
    if (asked == "auto" && clamped > 0) use("clamp");
    planner.choice("wrap",
                   maps == 0         ? "off"
                   : asked != "auto" ? name
                   : clamped == 0    ? "repeat"
                   : clamped == maps ? "clamp"
                                     : "repeat and clamp",
                   asked,
                   maps == 0 ? "no texture is read"
                             : fmt::format("{} of {} maps say -clamp on", clamped, maps),
                   maps > 0);
    return {};
}

} // namespace scanout::frame
