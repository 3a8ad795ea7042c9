// Textures: which maps are read, where their coordinates come from, and how they are filtered.
#include "base/check.h"
#include "frame/facts/map_facts.h"
#include "frame/plan/planner.h"
#include "rows.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// Do maps have coordinates? They have the model's uv, or a mapping that the user chooses. A model
// without uv gets no mapping by a guess, unless its texture is computed.
bool has_coordinates(const FramePlan& plan, const SceneFacts& facts) {
    const shade::Stage& own = shade::mapping::uv;
    const shade::Stage& asked = row_or(shade::mapping::kRows, plan.options.mapping, own);
    return facts.uv || plan.source != nullptr || asked.run != nullptr;
}

// Does some stage of the plan read the map, for colour or for alpha?
bool is_read(const TexturedSurface& surface, const FramePlan& plan) {
    if ((plan.attributes.maps & shade::bit_of(surface.map)) != 0) return true;
    const TransparencyPlan& t = plan.transparency;
    if (t.stages.empty() || t.alpha_modes[surface.material + 1] == raster::AlphaMode::opaque)
        return false;
    const shade::MaterialAlpha& alpha = t.alpha[surface.material + 1];
    return surface.map == shade::kDiffuseMap
               ? alpha.diffuse_map
               : surface.map == shade::kOpacityMap && alpha.opacity_map;
}

// Uses the filter for the stages that compute colours, for those that compute alpha, or for both.
void use(const shade::Filter& filter, bool colour, bool alpha, FramePlan& plan) {
    for (Decision& decision : plan.decisions)
        if (decision.effect == "texture" && decision.on()) decision.technique = filter.card.name;
    shade::Attributes needs = filter.needs;
    if (plan.mapped) needs.uv = false; // they are made, not fetched
    if (colour) {
        plan.filter = &filter;
        plan.attributes = plan.attributes | needs;
    }
    if (alpha) {
        plan.transparency.filter = &filter;
        plan.transparency.attributes = plan.transparency.attributes | needs;
    }
    const auto first_map = std::find_if(plan.techniques.begin(), plan.techniques.end(),
                                        [](const Technique* t) { return t->axis == "map"; });
    plan.techniques.insert(first_map, &filter.card); // in the order of techniques.h
}

// Wrap modes, beyond the edges of textures: the user's choice, else what each map says.
Result<void> plan_wrap(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const std::string& asked = plan.options.wrap;
    TRY(const shade::Wrapping* const chosen,
        choose(shade::wrap::kRows, asked, shade::wrap::repeat));
    std::size_t maps = 0, clamped = 0, mirrored = 0;
    std::array<bool, 3> used{}; // by shade::Wrap
    for (const TexturedSurface& surface : facts.textured_surfaces) {
        if (!is_read(surface, plan)) continue;
        ++maps;
        const auto has = [&](shade::Wrap wrap) {
            return surface.wrap_u == wrap || surface.wrap_v == wrap;
        };
        if (has(shade::Wrap::clamp)) ++clamped;
        if (has(shade::Wrap::mirror)) ++mirrored;
        used[static_cast<std::size_t>(surface.wrap_u)] = true;
        used[static_cast<std::size_t>(surface.wrap_v)] = true;
    }
    const bool automatic = is_auto(asked);
    if (!automatic && maps > 0) {
        plan.wrap = chosen->wrap;
        plan.techniques.push_back(&chosen->card);
    }
    std::string names;
    for (const shade::Wrapping* row : shade::wrap::kRows) {
        if (!automatic || !used[static_cast<std::size_t>(row->wrap)]) continue;
        plan.techniques.push_back(&row->card);
        names += fmt::format("{}{}", names.empty() ? "" : " and ", row->card.name);
    }
    planner.choice("wrap",
                   maps == 0 ? "off" : (automatic ? std::string_view(names) : chosen->card.name),
                   asked,
                   maps == 0      ? "no texture is read"
                   : mirrored > 0 ? fmt::format("{} of {} maps are clamped, {} mirrored", clamped,
                                                maps, mirrored)
                                  : fmt::format("{} of {} maps are clamped", clamped, maps),
                   maps > 0);
    return {};
}

// The mapping: the source of u and v.
Result<void> plan_mapping(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const std::string& asked = plan.options.mapping;
    const shade::Stage &own = shade::mapping::uv, &made = shade::mapping::box;
    TRY(const shade::Stage* mapping, choose(shade::mapping::kRows, asked, facts.uv ? own : made));
    const bool lacking = mapping->run == nullptr && !facts.uv;
    if (lacking) mapping = &made;
    TransparencyPlan& t = plan.transparency;
    const bool colour = plan.source != nullptr || plan.attributes.maps != 0;
    const bool read = colour || !t.stages.empty();
    plan.mapped = read && mapping->run != nullptr;
    planner.choice("mapping", read ? mapping->card.name : "off", lacking ? "auto" : asked,
                   !read       ? "nothing reads coordinates"
                   : !facts.uv ? "the model has no uv"
                               : "the model has uv",
                   read);
    if (!plan.mapped) return {};
    plan.techniques.push_back(&mapping->card);
    if (colour) {
        plan.stages.insert(plan.stages.begin() + 1, mapping);
        plan.attributes = plan.attributes | mapping->needs;
    }
    if (!t.stages.empty()) {
        t.stages.insert(t.stages.begin() + 1, mapping);
        t.attributes = t.attributes | mapping->needs;
    }
    return {};
}

} // namespace

Result<void> plan_texture(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const FrameOptions& options = plan.options;
    TRY(const shade::Source* const source,
        choose(shade::source::kRows, options.source, shade::source::image));
    const std::string_view name = source->card.name;
    if (source->sample != nullptr && facts.triangles > 0) plan.source = source;
    const std::size_t textured = facts.mapped_triangles[shade::kDiffuseMap];
    const bool coordinates = has_coordinates(plan, facts);
    plan.lacks_uv = !coordinates && facts.readable_maps != 0;
    const bool readable =
        textured > 0 || (facts.readable_maps & shade::bit_of(shade::kDiffuseMap)) != 0;
    const bool seen = some_light_shines(options) || facts.unlit_triangles > 0;
    const bool pictures = coordinates && textured > 0 && seen;
    const Technique& filter =
        row_or(shade::texture::kRows, options.texture, shade::texture::bilinear).card;
    const bool on = planner.effect(
        "texture", plan.source != nullptr ? name : filter.name, pictures || plan.source != nullptr,
        plan.source != nullptr ? fmt::format("--source {} for all triangles", name)
        : pictures
            ? fmt::format("{} of {} triangles have a readable map_Kd", textured, facts.triangles)
        : coordinates && textured > 0 ? kNoLight
        : coordinates && readable     ? "every readable map_Kd is white where Kd is not black"
                                      : "no triangle has a readable map_Kd and texture coordinates",
        plan.source != nullptr ? "" : filter.axis);
    if (!on) plan.source = nullptr;
    // Forced on, a picture that changes nothing is read.
    const bool runs = on && (plan.source != nullptr || (coordinates && readable));
    planner.choice("source", runs ? name : "off", options.source,
                   plan.source != nullptr ? "the user asks for it"
                   : runs                 ? "the materials name pictures"
                                          : "no texture is read",
                   runs);
    if (!runs) return {};
    planner.stage(shade::map::diffuse);
    if (plan.source == nullptr) return {};
    plan.attributes = plan.attributes | plan.source->needs;
    plan.attributes.maps = 0;
    plan.techniques.push_back(&plan.source->card);
    return {};
}

void plan_maps(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const bool directed = facts.triangles == 0 || normals_matter(plan);
    const bool pixels = !plan.attributes.vertices && directed,
               coordinates = has_coordinates(plan, facts);
    const Decision* highlight = plan.decision("highlight");
    const bool shiny = highlight != nullptr && highlight->on() && pixels;
    const bool physical = shiny && !by_ks_alone(plan);
    const char* const unlit = directed ? "light is not evaluated at pixels" : kNoDirection;
    const char* const matt = pixels ? "no highlight is drawn" : unlit;
    const char* const dull = pixels ? "no physical material reflects as one" : unlit;
    const struct {
        shade::Map map;
        const shade::Stage& stage;
        std::string_view what;
        bool shown;
        const char* hidden;
    } rows[] = {
        {shade::kNormalMap, shade::map::normal, "a norm that is not flat", pixels, unlit},
        {shade::kBumpMap, shade::map::bump, "a map_bump of more than one height", pixels, unlit},
        {shade::kSpecularMap, shade::map::specular, "a highlight and a map_Ks that is not white",
         shiny, matt},
        {shade::kShininessMap, shade::map::gloss, "a highlight and a map_Ns that is not white",
         shiny, matt},
        {shade::kRoughnessMap, shade::map::roughness, "Pr above 0 and a map_Pr that is not white",
         physical, dull},
        {shade::kMetalnessMap, shade::map::metalness, "Pm above 0 and a map_Pm that is not white",
         physical, dull}};
    const auto mapped = [&](shade::Map map) {
        const bool by_ks = by_ks_alone(plan);
        return by_ks && map == shade::kSpecularMap    ? facts.by_ks.specular_maps
               : by_ks && map == shade::kShininessMap ? facts.by_ks.gloss_maps
                                                      : facts.mapped_triangles[map];
    };
    for (const auto& row : rows) {
        const std::size_t triangles = coordinates ? mapped(row.map) : 0;
        const bool on =
            planner.effect(std::string(map_effect(row.map)), "on", triangles > 0 && row.shown,
                           !coordinates && mapped(row.map) > 0 ? "there are no texture coordinates"
                           : row.shown ? fmt::format("{} of {} triangles have {}", triangles,
                                                     facts.triangles, row.what)
                                       : row.hidden);
        if (on && row.shown && coordinates && facts.triangles > 0 &&
            (facts.readable_maps & shade::bit_of(row.map)) != 0)
            planner.stage(row.stage);
    }
    const bool emission = planner.effect(
        "emission", "on", facts.emitting_triangles > 0,
        fmt::format("{} of {} triangles have Ke above 0, with map_Ke{}", facts.emitting_triangles,
                    facts.triangles, facts.unlit_triangles > 0 ? ", or are unlit" : ""));
    if (!emission || facts.emitting_triangles == 0) return;
    planner.stage(shade::map::emission);
    if (coordinates && facts.mapped_triangles[shade::kEmissionMap] > 0)
        plan.attributes = plan.attributes |
                          shade::Attributes{.uv = true, .maps = shade::bit_of(shade::kEmissionMap)};
}

Result<void> plan_sampling(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    TRY_VOID(plan_mapping(planner, plan, facts));
    TRY_VOID(choose(shade::texture::kRows, plan.options.texture, shade::texture::trilinear));
    planner.effect("mipmaps", "on", false, "no texture is read"); // plan_filter may replace this
    TRY_VOID(plan_wrap(planner, plan, facts));
    // A mapping stage computes the coordinates for all that read them: none are fetched.
    if (plan.mapped) plan.attributes.uv = plan.transparency.attributes.uv = false;
    return {};
}

void plan_filter(FramePlan& plan, const SceneFacts& facts, const scene::View& view) {
    const bool colour = plan.attributes.maps != 0, alpha = !plan.transparency.stages.empty();
    if (!colour && !alpha) return;
    const FrameOptions& options = plan.options;
    const bool automatic = is_auto(options.texture);
    const shade::Filter* filter =
        &row_or(shade::texture::kRows, options.texture, shade::texture::trilinear);
    Minification most;
    std::optional<bool> plain; // whether each texture that is read is of one colour
    for (const TexturedSurface& surface : facts.textured_surfaces) {
        if (!is_read(surface, plan)) continue;
        plain = plain.value_or(true) && surface.constant;
        if (automatic && surface.constant) continue; // the same at every size
        const Minification texels = texels_per_pixel(surface, view, options.width * plan.aa->scale,
                                                     options.height * plan.aa->scale, plan.mapped);
        most = {std::max(most.facing, texels.facing), std::max(most.slanted, texels.slanted)};
        // A filter that the user names is used as it is, with its mip levels; the automatic one
        // makes none for a texture that is not minified, though a curved surface's rim may show a
        // few texels a pixel.
        if (automatic && texels.slanted <= 1) continue;
        if (std::find(plan.mips.begin(), plan.mips.end(), surface.texture) == plan.mips.end())
            plan.mips.push_back(surface.texture);
    }
    const auto row = std::find_if(plan.decisions.begin(), plan.decisions.end(),
                                  [](const Decision& d) { return d.effect == "mipmaps"; });
    CHECK(row != plan.decisions.end());
    row->because.clear(); // keeps its memory
    if (plain.value_or(false))
        row->because = "each texture that is read is of one colour";
    else
        fmt::format_to(std::back_inserter(row->because),
                       "textures show up to {:.3g} texels a pixel, {:.3g} where they slant",
                       most.facing, most.slanted);
    const bool mipmaps = decide(*row, options, "on", filter->needs.footprint && !plan.mips.empty());
    if (!mipmaps || !filter->needs.footprint) plan.mips.clear();
    if (filter->needs.footprint && plan.mips.empty())
        filter = automatic && plain.value_or(false) ? &shade::texture::nearest
                                                    : &shade::texture::bilinear;
    use(*filter, colour, alpha, plan);
}

} // namespace scanout::frame
