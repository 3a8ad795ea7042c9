// Plans the output, from surfaces and light to codes: depth test, tone mapping, anti-aliasing,
// encoding.
#include "base/check.h"
#include "frame/facts/brightness.h"
#include "frame/plan/planner.h"
#include "frame/render_scale.h"
#include "image/dither.h"
#include "math/transcendental.h"
#include "raster/culling/cull.h"
#include "rows.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// Light exceeds white when it is above 1 by enough to show in the row's two decimals. A smaller
// excess that a clamp cuts off is less than a code of 8 bits.
constexpr double kBright = 1.005;

// Can a pixel show more than one thing? Lines and points are seen at all samples of a pixel.
bool mixes_samples(const FramePlan& plan, const SceneFacts& facts) {
    const AntiAliasing& aa = *plan.aa;
    return aa.weight != nullptr || aa.scale > 1 ||
           ((aa.exact || aa.samples > 1) && facts.triangles > 0);
}

// Is all light darker than 1 by more than rounding? Then a shoulder that ends at 1 changes nothing.
bool nothing_bends(const FramePlan& plan, const SceneFacts& facts, double brightest) {
    const double plain = facts.lines + facts.points > 0 ? double{plan.exposure} : 0;
    return std::max(brightest, plain) < 1 - 0x1p-16 && !plan.decision("highlight")->on() &&
           !plan.decision("emission")->on();
}

} // namespace

// A section opens closed models, whose insides are then meant to be seen.
static bool is_cut_open(const SceneFacts& facts) {
    return facts.section && facts.section->cuts;
}

void plan_culling(FramePlan& plan, const SceneFacts& facts) {
    if (plan.options.cull != Cull::material) return;
    if (facts.one_sided_triangles == 0 || is_cut_open(facts))
        plan.options.cull = Cull::none;
    else if (facts.all_one_sided)
        plan.options.cull = Cull::back;
    else
        plan.one_sided = facts.one_sided;
}

static std::string why_culled(const SceneFacts& facts) {
    return facts.one_sided_triangles == 0 ? "no material is one-sided"
           : is_cut_open(facts)           ? "the section shows insides: backs are drawn"
           : facts.all_one_sided          ? "every material is one-sided"
                                 : fmt::format("{} of {} triangles have a one-sided material",
                                               facts.one_sided_triangles, facts.triangles);
}

Result<void> plan_merging(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                          const ViewFacts& view) {
    const FrameOptions& o = plan.options;
    const Technique& culling = raster::cull::kRows[static_cast<std::size_t>(o.cull)]->card;
    const std::string cull(culling.name);
    const std::string asked_culling = asked_for(planner.asked(), "cull");
    planner.choice("cull", cull, asked_culling,
                   facts.triangles == 0     ? "lines and points have no sides"
                   : is_auto(asked_culling) ? why_culled(facts)
                                            : "as asked",
                   facts.triangles > 0);
    if (o.cull != Cull::none) plan.techniques.push_back(&culling);
    TRY(const raster::DepthFormatRow* const format,
        choose(raster::depth::kRows, o.depth, raster::depth::reversed));
    TRY(const raster::DepthTestRow* const compare,
        choose(raster::depth_test::kRows, o.depth_test, raster::depth_test::less));
    TRY(const shade::Blend* const mix, choose(shade::blend::kRows, o.blend, shade::blend::over));
    const bool drawn = facts.triangles + facts.lines + facts.points > 0;
    const char* const nothing = "nothing is drawn that could be hidden";
    planner.choice("depth", format->card.name, o.depth,
                   drawn ? std::string(format->card.blurb) : nothing, drawn);
    planner.choice("depth_test", compare->card.name, o.depth_test,
                   drawn ? std::string(compare->card.blurb) : nothing, drawn);
    const bool blends = plan.transparency.blended != nullptr;
    const auto asked = o.effects.find("blending");
    const bool whole = facts.alpha.blended_triangles > 0 && blends_nothing(o) &&
                       (asked == o.effects.end() || asked->second);
    planner.choice("blend", blends || whole ? mix->card.name : "off", o.blend,
                   blends || whole ? std::string(mix->card.blurb) : "nothing is blended",
                   blends || whole);
    plan.depth_rule = {compare->test, format->standard, format->steps};
    plan.transparency.blend = mix;
    if (!plan.depth_rule.is_default())
        for (const Technique* card : {&format->card, &compare->card})
            plan.techniques.push_back(card);
    if (format->linear) plan.depth_rule.reach = view.reach;
    if (std::isfinite(view.farthest))
        plan.depth_rule.farthest = plan.depth_rule.stored(view.farthest);
    if (std::isfinite(view.nearest)) plan.depth_rule.nearest = plan.depth_rule.stored(view.nearest);
    if (blends) plan.techniques.push_back(&mix->card);
    return {};
}

Result<void> plan_tone(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                       FramePlan& plan) {
    if (!(options.exposure >= -kMaxStops && options.exposure <= kMaxStops))
        return fail(Exit::usage, "--exposure {}: choose {} to {} stops", options.exposure,
                    -kMaxStops, kMaxStops);
    const bool exposed = planner.effect(
        "exposure", "on", options.exposure != 0,
        options.exposure != 0 ? fmt::format("{:+} stops are asked for", options.exposure)
                              : "no exposure is asked for");
    plan.exposure = static_cast<float>(exposed ? exp2(options.exposure) : 1.0);
    const bool pictures =
        plan.source == nullptr && (plan.attributes.maps & shade::bit_of(shade::kDiffuseMap)) != 0;
    const double brightest = double{pictures ? facts.brightest_mapped : facts.brightest} *
                             greatest_light(plan.lights, facts.surroundings) *
                             double{plan.exposure};
    const bool bright = brightest > kBright && facts.triangles > 0;
    TRY(const shade::ToneStage* const tone,
        choose(shade::tone::kRows, options.tone,
               bright ? shade::tone::shoulder : shade::tone::clamp));
    plan.white = static_cast<float>(std::max(brightest, 1.0));
    const bool burns = !bright && plan.decision("highlight")->on();
    const bool lamps = std::any_of(plan.lights.begin(), plan.lights.end(), [](const auto& light) {
        return light.kind == scene::LightKind::point || light.kind == scene::LightKind::spot;
    });
    planner.choice("tone", tone->card.name, options.tone,
                   fmt::format("diffuse light is at most {:.2f}{}{}{}", brightest,
                               lamps ? " but close to a lamp" : "",
                               plan.decision("emission")->on() ? ", Ke comes on top of it" : "",
                               burns ? ", and highlights may burn out" : ""),
                   !(tone->exact_below_white && !lamps && nothing_bends(plan, facts, brightest)));
    if (exposed) planner.stage(shade::exposure::stops);
    if (tone->run != nullptr) planner.stage(*tone);
    return {};
}

Result<void> plan_size(Planner& planner, FramePlan& plan) {
    FrameOptions& o = plan.options;
    TRY(const RenderScale* const scale,
        choose(render_scale::kRows, o.render_scale, render_scale::full));
    plan.shown_width = o.width;
    plan.shown_height = o.height;
    o.width = scale->drawn(o.width);
    o.height = scale->drawn(o.height);
    planner.choice("render_scale", scale->card.name, o.render_scale,
                   plan.is_enlarged()
                       ? fmt::format("{}x{} pixels are drawn, {}x{} are shown", o.width, o.height,
                                     plan.shown_width, plan.shown_height)
                   : scale->is_full() ? "fewer pixels come only on request"
                                      : "a pixel is the least",
                   scale->is_full() || plan.is_enlarged());
    if (!scale->is_full()) plan.techniques.push_back(&scale->card);
    return {};
}

Result<void> plan_edges(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                        FramePlan& plan) {
    const bool by_number = is_auto(options.aa);
    if (!by_number && options.samples != 1)
        return fail(Exit::usage, "--aa {} and --samples {}: give one of them", options.aa,
                    options.samples);
    const auto numbered =
        std::find_if(std::begin(aa::kRows), std::end(aa::kRows), [&](const AntiAliasing* by) {
            return by->is_counted() && by->samples == options.samples;
        });
    CHECK(numbered != std::end(aa::kRows));
    TRY(const AntiAliasing* by, choose(aa::kRows, options.aa, **numbered));
    std::string because(by->card.blurb);
    if (by->takes_one() && by_number)
        because = "smoother edges are a matter of taste: only on request";
    const char* const why_not =
        !by->exact ? nullptr
        : !plan.transparency.alpha_modes.empty()
            ? "areas know no transparency, which this scene has"
        : plan.depth_rule.cuts() ? "areas know no far plane, and no near one without perspective"
        : !plan.depth_rule.is_default() ? "areas know the nearest surface alone, in exact depth"
        : plan.shadow.stage != nullptr && plan.shadow.stage->by == shade::ShadowBy::volumes
            ? "areas know no stencil, which shadow volumes count in"
            : nullptr;
    if (why_not != nullptr) {
        by = &aa::samples_16;
        because = why_not;
    }
    plan.aa = by;
    plan.options.samples = by->samples;
    if (by->scale * std::max(plan.options.width, plan.options.height) > kMaxSide)
        return fail(Exit::usage, "--aa {}: a side of the picture may have {} pixels at most",
                    by->card.name, kMaxSide / by->scale);
    const bool mixes = mixes_samples(plan, facts);
    if (!by->takes_one() && !mixes) because = "lines and points fill whole pixels";
    const std::string name(by->card.name);
    planner.choice("aa", name, by_number && options.samples == 1 ? "auto" : name,
                   std::move(because), by->takes_one() || mixes);
    plan.techniques.push_back(&plan.aa->card);
    return {};
}

Result<void> plan_output(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                         FramePlan& plan) {
    const bool smooth = mixes_samples(plan, facts);
    const bool mixed = smooth || plan.transparency.blended != nullptr;
    TRY(const shade::BlendSpace* const space,
        choose(shade::blend_space::kRows, options.blend_space, shade::blend_space::linear));
    planner.choice("blend_space", space->card.name, options.blend_space,
                   smooth  ? fmt::format("{} mixes what a pixel shows", plan.aa->card.name)
                   : mixed ? "blended surfaces are mixed in it"
                   : plan.aa->takes_one() ? "one sample a pixel: nothing is mixed"
                                          : "lines and points fill whole pixels: nothing is mixed",
                   mixed);
    TRY(const shade::Encoding* const encoding,
        choose(shade::encode::kRows, options.encode, shade::encode::srgb));
    planner.choice("encode", encoding->card.name, options.encode,
                   "displays and files take sRGB codes");
    plan.output.blend_space = space;
    plan.output.encoding = encoding;
    if (mixed) plan.techniques.push_back(&plan.output.blend_space->card);
    plan.techniques.push_back(&plan.output.encoding->card);
    if (!is_auto(options.convolution)) {
        plan.convolution = find_row(image::convolution::kRows, options.convolution);
        if (plan.convolution == nullptr)
            return tl::unexpected(no_such_technique("convolution", options.convolution));
    }
    const bool filtered = plan.convolution != nullptr;
    planner.choice("convolution", filtered ? options.convolution : "off", options.convolution,
                   filtered ? "the finished picture is filtered, as asked"
                            : "a filter over the finished picture comes only on request",
                   filtered);
    if (filtered) plan.techniques.push_back(&plan.convolution->card);
    const bool narrow = options.bits < 8;
    TRY(const image::Dither* const dither,
        choose(image::dither::kRows, options.dither,
               narrow ? image::dither::bayer : image::dither::none));
    planner.choice("dither", dither->card.name, options.dither,
                   narrow ? fmt::format("{} bits show their steps", options.bits)
                          : "8 bits hide their steps");
    // Dithers only once, where the display's codes are made: fewer bits are made from whole 8-bit
    // codes.
    plan.output.dither = dither->ordered && !narrow;
    if (dither->ordered) plan.techniques.push_back(&dither->card);
    return {};
}

} // namespace scanout::frame
