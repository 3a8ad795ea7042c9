#include "frame/plan.h"

#include "frame/brightness.h"
#include "frame/planner.h"
#include "frame/techniques.h"
#include "image/dither.h"
#include "math/transcendental.h"
#include "raster/sample_pattern.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {

// The command line's name of an axis.
static std::string option_of(std::string_view axis) {
    std::string name(axis);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

Result<std::string> choose(std::string_view axis, const std::string& asked,
                           std::string_view automatic) {
    const std::string_view name = asked == "auto" ? automatic : std::string_view(asked);
    for (const Technique* technique : techniques())
        if (technique->axis == axis && technique->name == name) return std::string(name);
    return fail(Exit::usage, "--{} {}: there is no such technique; choose auto{}", option_of(axis),
                asked, names_of(axis));
}

namespace {

Result<void> check_numbers(const FrameOptions& o) {
    if (o.width < 1 || o.height < 1 || o.width > kMaxSide || o.height > kMaxSide)
        return fail(Exit::usage,
                    "a picture of {}x{} pixels is not possible: each side must be 1 to {}", o.width,
                    o.height, kMaxSide);
    if (raster::sample_pattern(o.samples).empty())
        return fail(Exit::usage, "--samples {}: choose 1, 2, 4, 8 or 16", o.samples);
    if (o.lights.size() > scene::kMostLights)
        return fail(Exit::usage, "--light: {} lights; there may be {}", o.lights.size(),
                    scene::kMostLights);
    return {};
}

} // namespace

const Decision* FramePlan::decision(std::string_view effect) const {
    const auto found = std::find_if(decisions.begin(), decisions.end(),
                                    [&](const Decision& d) { return d.effect == effect; });
    return found == decisions.end() ? nullptr : &*found;
}

std::string to_string(const Decision& d) {
    return fmt::format("{} {}: {}{}", d.effect, d.technique, d.because,
                       d.forced ? " (forced)" : "");
}

namespace {

// One row for each kind of light: on where one shines that is not black, and something is lit.
void plan_lights(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                 const shade::Stage& shading) {
    const FrameOptions& options = plan.options;
    for (const auto kind : {scene::LightKind::ambient, scene::LightKind::directional,
                            scene::LightKind::point, scene::LightKind::spot}) {
        std::string names;
        std::vector<scene::Light> shining;
        for (const scene::Light& light : options.lights) {
            if (light.kind != kind || is_black(light)) continue;
            names += (names.empty() ? "" : ", ") + light.name;
            shining.push_back(light);
        }
        const bool lit = facts.triangles > 0;
        const std::string because = shining.empty()
                                        ? fmt::format("there is no {} light", name_of(kind))
                                    : !lit ? "nothing is lit: there are no triangles"
                                           : fmt::format("{} light{}: {}", shining.size(),
                                                         shining.size() == 1 ? "" : "s", names);
        const bool on = planner.effect(fmt::format("{}_light", name_of(kind)), "on",
                                       lit && !shining.empty(), because);
        if (!on || !lit || shining.empty()) continue;
        plan.lights.insert(plan.lights.end(), shining.begin(), shining.end());
        // A directional light is the same in all lanes: there is nothing to write.
        if (kind == scene::LightKind::directional) continue;
        if (shading.needs.corners)
            plan.corner_lights.push_back(planner.called("light", name_of(kind), {}));
        else
            planner.stage("light", name_of(kind));
    }
}

// Which model reflects on each kind of surface.
Result<void> plan_reflection(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                             const shade::Stage& shading) {
    const std::string& asked = plan.options.reflection;
    TRY(const std::string glossy, choose("reflection", asked, "blinn_phong"));
    TRY(const std::string physical, choose("reflection", asked, "ggx"));
    const std::size_t shiny = facts.specular_triangles, rough = facts.physical_triangles;
    const bool highlight = planner.effect(
        "highlight",
        rough == 0 || glossy == physical ? glossy
        : rough == shiny                 ? physical
                                         : glossy + " and " + physical,
        shiny > 0 && glossy != "lambert",
        fmt::format("{} of {} triangles have a highlight (Ks not black, Ns above 0{})", shiny,
                    facts.triangles,
                    rough > 0 ? fmt::format("; {} say Pr or Pm", rough) : std::string()));
    // Each model that some surface has, once; lines and points go the way of the matt ones.
    const auto use = [&](scene::Surface surface, const std::string& name, bool used) {
        const shade::Stage*& model = plan.reflection[static_cast<std::size_t>(surface)];
        model = shade::find_stage("reflection", name);
        CHECK(model != nullptr);
        const auto& ran = plan.techniques;
        if (!used || std::find(ran.begin(), ran.end(), &model->card) != ran.end()) return;
        planner.called("reflection", name,
                       shading.needs.corners ? shade::Attributes{} : model->needs);
    };
    use(scene::Surface::matt, "lambert", shiny < facts.triangles || facts.triangles == 0);
    use(scene::Surface::glossy, highlight ? glossy : "lambert", shiny > rough);
    use(scene::Surface::physical, highlight ? physical : "lambert", rough > 0);
    return {};
}

// Which side of the faces is lit. Where no back can be seen, the side that the normals point to is
// the one that the eye sees.
void plan_sides(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const MeshSides& sides = facts.sides;
    const Cull cull = plan.options.cull;
    bool needed = facts.triangles > 0;
    std::string because;
    if (!needed) {
        because = "nothing is lit: there are no triangles";
    } else if (sides.leaning > 0) {
        because = fmt::format("{} of {} triangles have a normal that leans to their back",
                              sides.leaning, facts.triangles);
    } else if (cull == Cull::front) {
        because = "backs alone are drawn (--cull front)";
    } else if (cull == Cull::back) {
        needed = false;
        because = "backs are left out (--cull back)";
    } else if (facts.alpha.see_through_triangles() > 0) {
        because = fmt::format("backs show through {} of {} triangles that are not opaque",
                              facts.alpha.see_through_triangles(), facts.triangles);
    } else if (!sides.closed) {
        because = "the mesh has open edges: backs can be seen";
    } else if (!sides.outward) {
        because = "the mesh is closed, but wound inside out";
    } else {
        needed = false;
        because = "the mesh is closed and its normals point outwards: no back can be seen";
    }
    const bool on = planner.effect("two_sided", "on", needed, std::move(because));
    plan.sides = needed && !on       ? shade::Sides::file
                 : sides.leaning > 0 ? shade::Sides::eye
                                     : shade::Sides::face;
}

// Lights, sides, reflection, and how often they are evaluated.
Result<void> plan_light(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const std::string& asked = plan.options.shading;
    TRY(const std::string name, choose("shading", asked, "per_pixel"));
    const shade::Stage* shading = shade::find_stage("shading", name);
    CHECK(shading != nullptr);
    plan_lights(planner, plan, facts, *shading);
    plan_sides(planner, plan, facts);
    TRY_VOID(plan_reflection(planner, plan, facts, *shading));
    planner.choice("shading", facts.triangles > 0 ? name : "off", asked,
                   facts.triangles > 0 ? fmt::format("{} triangles are lit", facts.triangles)
                                       : "nothing is lit: there are no triangles",
                   facts.triangles > 0);
    planner.stage("shading", name);
    plan.corner_normals = name == "gouraud" || name == "per_pixel_raw";
    return {};
}

// Maps change what light falls on, so they come before it; what a surface gives off by itself is
// added to what it reflects.
void put_in_order(std::vector<const shade::Stage*>& stages) {
    constexpr std::string_view kOrder[] = {"interpolate", "mapping",  "map", "light",
                                           "shading",     "emission", "tone"};
    const auto place = [&](const shade::Stage* stage) {
        const Technique& card = stage->card;
        const std::string_view row = card.name == "emission" ? card.name : card.axis;
        return std::find(std::begin(kOrder), std::end(kOrder), row) - std::begin(kOrder);
    };
    std::stable_sort(stages.begin(), stages.end(),
                     [&](const auto* a, const auto* b) { return place(a) < place(b); });
}

// Effects that the user names must exist.
Result<void> check_effects(const FrameOptions& options, const FramePlan& plan) {
    for (const auto& [name, on] : options.effects) {
        const Decision* row = plan.decision(name);
        if (row != nullptr && !row->choice) continue;
        if (row != nullptr)
            return fail(Exit::usage, "--effect {0}={1}: {0} is no effect; say --{0} NAME", name,
                        on ? "on" : "off");
        std::string known;
        for (const Decision& d : plan.decisions)
            if (!d.choice) known += " " + d.effect;
        return fail(Exit::usage, "--effect {}={}: there is no such effect; choose one of{}", name,
                    on ? "on" : "off", known);
    }
    return {};
}

// How much of the scene is of one kind: "3 of 14 materials (120 of 900 triangles)".
std::string part(std::size_t materials, std::size_t triangles, const SceneFacts& facts) {
    return fmt::format("{} of {} materials ({} of {} triangles)", materials, facts.alpha.materials,
                       triangles, facts.triangles);
}

// Which materials are cut out or blended, and how alpha is found.
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

// Which surfaces are seen, and how they are mixed: choices of the user's.
Result<void> plan_merging(Planner& planner, FramePlan& plan) {
    const FrameOptions& o = plan.options;
    constexpr std::string_view kSides[] = {"none", "back", "front"};
    const std::string cull(kSides[static_cast<std::size_t>(o.cull)]);
    planner.choice("cull", cull, o.cull == Cull::none ? "auto" : cull,
                   o.cull == Cull::none
                       ? "files do not say whether their backs are meant to be seen"
                       : "as asked");
    TRY(const std::string depth, choose("depth", o.depth, "reversed"));
    TRY(const std::string test, choose("depth_test", o.depth_test, "greater"));
    TRY(const std::string blend, choose("blend", o.blend, "over"));
    const auto* format = raster::find_depth_format(depth);
    const auto* compare = raster::find_depth_test(test);
    const auto* mix = shade::find_blend(blend);
    CHECK(format != nullptr && compare != nullptr && mix != nullptr);
    planner.choice("depth", depth, o.depth, std::string(format->card.blurb));
    planner.choice("depth_test", test, o.depth_test, std::string(compare->card.blurb));
    const bool blends = plan.transparency.blended != nullptr;
    planner.choice("blend", blends ? blend : "off", o.blend,
                   blends ? std::string(mix->card.blurb) : "nothing is blended", blends);
    plan.visible = {compare->test, format->standard, format->steps};
    plan.transparency.blend = mix;
    if (!plan.visible.usual())
        for (const Technique* card : {&format->card, &compare->card})
            plan.techniques.push_back(card);
    if (blends) plan.techniques.push_back(&mix->card);
    return {};
}

// Is there light above 1, and what becomes of it? Highlights alone do not count: MTL means them to
// burn out, and a curve would dim all else for their sake.
Result<void> plan_tone(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                       FramePlan& plan) {
    if (!(options.exposure >= -kMostStops && options.exposure <= kMostStops))
        return fail(Exit::usage, "--exposure {}: choose {} to {} stops", options.exposure,
                    -kMostStops, kMostStops);
    const bool exposed = planner.effect(
        "exposure", "on", options.exposure != 0,
        options.exposure != 0 ? fmt::format("{:+} stops are asked for", options.exposure)
                              : "no exposure is asked for");
    plan.exposure = static_cast<float>(exposed ? exp2(options.exposure) : 1.0);
    const double brightest =
        double{facts.brightest} * greatest_light(plan.lights) * double{plan.exposure};
    const bool bright = brightest > 1 && facts.triangles > 0;
    TRY(const std::string tone, choose("tone", options.tone, bright ? "filmic" : "clamp"));
    planner.choice("tone", tone, options.tone,
                   fmt::format("diffuse light is at most {:.2f}{}", brightest,
                               bright ? "" : ", and highlights may burn out"));
    // Codes end at 1 anyway.
    if (tone != "clamp" || exposed) planner.stage("tone", tone);
    return {};
}

// How edges are smoothed.
Result<void> plan_edges(const FrameOptions& options, Planner& planner, FramePlan& plan) {
    const bool by_number = options.aa == "auto";
    if (!by_number && options.samples != 1)
        return fail(Exit::usage, "--aa {} and --samples {}: give one of them", options.aa,
                    options.samples);
    const std::string number =
        options.samples == 1 ? "none" : fmt::format("samples_{}", options.samples);
    TRY(std::string name, choose("aa", options.aa, number));
    std::string because(find_anti_aliasing(name)->card.blurb);
    if (name == "none" && by_number)
        because = "smoother edges are a matter of taste: nobody asked for them";
    if (find_anti_aliasing(name)->exact && !plan.transparency.layers.empty()) {
        name = "samples_16";
        because = "areas know no transparency, which this scene has";
    } else if (find_anti_aliasing(name)->exact && !plan.visible.usual()) {
        name = "samples_16";
        because = "areas know the nearest surface alone, in exact depth";
    }
    plan.aa = find_anti_aliasing(name);
    CHECK(plan.aa != nullptr);
    plan.options.samples = plan.aa->samples;
    if (plan.aa->scale * std::max(options.width, options.height) > kMaxSide)
        return fail(Exit::usage, "--aa {}: a side of the picture may have {} pixels at most", name,
                    kMaxSide / plan.aa->scale);
    planner.choice("aa", name, by_number && options.samples == 1 ? "auto" : name,
                   std::move(because));
    plan.techniques.push_back(&plan.aa->card);
    return {};
}

// From light to codes.
Result<void> plan_output(const FrameOptions& options, Planner& planner, FramePlan& plan) {
    const bool mixed = plan.aa->card.name != "none";
    TRY(const std::string space, choose("blend_space", options.blend_space, "linear"));
    planner.choice("blend_space", space, options.blend_space,
                   mixed ? fmt::format("{} mixes what a pixel shows", plan.aa->card.name)
                         : "one sample a pixel: nothing is mixed");
    TRY(const std::string encoding, choose("encode", options.encode, "srgb"));
    planner.choice("encode", encoding, options.encode, "displays and files take sRGB codes");
    plan.output.blend_space = shade::find_blend_space(space);
    plan.output.encoding = shade::find_encoding(encoding);
    CHECK(plan.output.blend_space != nullptr && plan.output.encoding != nullptr);
    if (mixed) plan.techniques.push_back(&plan.output.blend_space->card);
    plan.techniques.push_back(&plan.output.encoding->card);
    if (options.convolution != "auto") {
        TRY(const std::string name, choose("convolution", options.convolution, ""));
        plan.convolution = image::find_convolution(name);
        CHECK(plan.convolution != nullptr);
    }
    const bool filtered = plan.convolution != nullptr;
    planner.choice("convolution", filtered ? options.convolution : "off", options.convolution,
                   filtered ? "the finished picture is filtered, as asked"
                            : "nobody asked for a filter over the finished picture",
                   filtered);
    if (filtered) plan.techniques.push_back(&plan.convolution->card);
    TRY(const std::string dither, choose("dither", options.dither, "none"));
    planner.choice("dither", dither, options.dither,
                   "8 bits hide their steps; displays of fewer are always dithered");
    const image::Dither* found = image::find_dither(dither);
    CHECK(found != nullptr);
    plan.output.dither = found->ordered;
    if (found->ordered) plan.techniques.push_back(&found->card);
    return {};
}

} // namespace

Result<FramePlan> plan(const FrameOptions& options, const SceneFacts& facts,
                       const scene::View& view) {
    TRY_VOID(check_numbers(options));
    FramePlan plan;
    plan.options = options;
    Planner planner(options, plan);
    TRY(const std::string steps, choose("interpolate", options.interpolate, "perspective"));
    planner.choice("interpolate", steps, options.interpolate,
                   "a division a pixel is exact at any ratio of distances");
    planner.stage("interpolate", steps);

    TRY_VOID(plan_texture(planner, plan, facts));
    TRY_VOID(plan_light(planner, plan, facts));
    plan_maps(planner, plan, facts);

    if (planner.effect("vertex_colours", "on", facts.vertex_colours,
                       facts.vertex_colours ? "the file gives them" : "the file gives none"))
        plan.attributes.colour = facts.vertex_colours;
    TRY_VOID(plan_transparency(planner, plan, facts));
    TRY_VOID(plan_merging(planner, plan));
    TRY_VOID(plan_tone(options, facts, planner, plan));
    TRY_VOID(plan_edges(options, planner, plan));
    TRY_VOID(plan_output(options, planner, plan));
    TRY_VOID(plan_sampling(planner, plan, facts, view));
    put_in_order(plan.stages);
    if (facts.triangles == 0)
        plan.attributes = {.colour = plan.attributes.colour}; // lines and points are unlit
    TRY_VOID(check_effects(options, plan));
    return plan;
}

} // namespace scanout::frame
