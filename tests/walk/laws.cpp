#include "walk/laws.h"

#include "app/options/command_line.h"
#include "frame/renderer.h"
#include "image/hash.h"
#include "scene/fit.h"
#include "simd/targets.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace scanout::test {
namespace {

constexpr int kEffectsAtATime = 4;

struct Drawn {
    image::Image picture;
    shade::LinearPicture light;
    frame::Visibility visible;
    friend bool operator==(const Drawn& a, const Drawn& b) {
        return a.picture == b.picture && a.light == b.light && a.visible.id == b.visible.id &&
               a.visible.depth == b.visible.depth;
    }
};

struct How {
    int threads = 1, tile_size = 64;
    std::string target = "auto";
};

std::vector<std::string> targets_here() {
    std::vector<std::string> names;
    for (const simd::Target& target : simd::targets())
        if (target.supported) names.push_back(target.name);
    return names;
}

class Frame {
public:
    Frame(const app::Settings& settings, const WalkModel& model, scene::View view)
        : settings_(settings), model_(model), view_(view),
          facts_(frame::facts(model.scene, settings.frame.shadow_plane)) {}

    using Effects = std::map<std::string, bool, std::less<>>;
    Result<frame::FramePlan> plan(const Effects& forced = {}) const {
        frame::FrameOptions options = settings_.frame;
        for (const auto& [effect, on] : forced)
            options.effects[effect] = on;
        return frame::plan(options, facts_, view_);
    }
    Drawn draw(const frame::FramePlan& plan, const How& how = {}) const {
        simd::choose_target(how.target);
        Jobs jobs(how.threads);
        frame::Renderer renderer(jobs);
        Drawn drawn;
        drawn.picture =
            renderer.render(model_.scene, view_, plan, &drawn.visible, how.tile_size, &drawn.light);
        simd::choose_target("auto");
        return drawn;
    }

private:
    const app::Settings& settings_;
    const WalkModel& model_;
    scene::View view_;
    frame::SceneFacts facts_;
};

bool is_finite(const shade::LinearPicture& light) {
    return std::all_of(light.pixel.begin(), light.pixel.end(), [](const auto& pixel) {
        return std::all_of(pixel.begin(), pixel.end(), [](float c) { return std::isfinite(c); });
    });
}

std::string differs(const Drawn& a, const Drawn& b) {
    if (a == b) return {};
    int pixels = 0, most = 0;
    for (int y = 0; y < a.picture.height(); ++y)
        for (int x = 0; x < a.picture.width(); ++x) {
            const image::Rgba8 p = a.picture.at(x, y), q = b.picture.at(x, y);
            const int by = std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b),
                                     std::abs(p.a - q.a)});
            most = std::max(most, by);
            pixels += by > 0 ? 1 : 0;
        }
    return fmt::format("{} pixels differ by up to {} codes{}{}", pixels, most,
                       a.light == b.light ? "" : ", light differs",
                       a.visible.id == b.visible.id ? "" : ", what is seen differs");
}

How other_way(Random& random) {
    static const std::vector<std::string> targets = targets_here();
    const auto target =
        static_cast<std::size_t>(random.whole(0, static_cast<int>(targets.size()) - 1));
    return {random.whole(1, 4), 8 << random.whole(0, 3), targets[target]};
}

void check_effects(const Frame& frame, const frame::FramePlan& plan, const Drawn& whole,
                   Random& random, std::vector<std::string>& faults) {
    const auto same = [&](const Frame::Effects& forced, const std::string& what) {
        const auto other = frame.plan(forced);
        if (!other) return; // what is forced may need a technique that is not asked for
        Drawn drawn = frame.draw(*other);
        // What is drawn as blended or cut out leaves no id of its own behind.
        if (forced.contains("blending") || forced.contains("cut_out"))
            drawn.visible = whole.visible;
        if (const std::string by = differs(whole, drawn); !by.empty())
            faults.push_back(fmt::format("Z7: {}: {}", what, by));
    };
    std::vector<frame::Decision> effects;
    Frame::Effects all;
    for (const frame::Decision& d : plan.decisions) {
        if (d.choice || d.forced) continue;
        effects.push_back(d);
        all[d.effect] = true;
    }
    for (int i = 0; i < kEffectsAtATime && !effects.empty(); ++i) {
        const auto at = random.whole(0, static_cast<int>(effects.size()) - 1);
        const frame::Decision d = effects[static_cast<std::size_t>(at)];
        effects.erase(effects.begin() + at);
        const std::string said = fmt::format("{} is {} ({})", d.effect, d.technique, d.because);
        same({{d.effect, true}}, said + "; forced on");
        if (!d.needed) same({{d.effect, false}}, said + "; forced off");
    }
    same(all, "all effects forced on");
}

} // namespace

Verdict judge(const std::vector<std::string>& arguments, const WalkModel& model, Random& random) {
    const auto refused = [](const Error& error) {
        Verdict verdict{Outcome::refused, {}};
        if (error.what.empty() || error.what.find('\n') != std::string::npos)
            verdict = {Outcome::broken, {"refused without one clear line: '" + error.what + "'"}};
        return verdict;
    };
    const auto line = app::parse_command_line(arguments);
    if (!line) return refused(line.error());
    const app::Settings& s = line->settings;
    const double aspect = static_cast<double>(s.frame.width) / s.frame.height;
    const auto view = scene::make_view(model.scene.mesh, s.model, {},
                                       scene::fitted(model.scene.mesh, s.model, s.camera, aspect),
                                       {}, s.frame.width, s.frame.height);
    if (!view) return refused(view.error());
    const Frame frame(s, model, *view);
    const auto plan = frame.plan();
    if (!plan) return refused(plan.error());
    Verdict verdict;
    const Drawn whole = frame.draw(*plan);
    if (!is_finite(whole.light)) verdict.faults.emplace_back("some light is not finite");
    const How how = other_way(random);
    if (const std::string by = differs(whole, frame.draw(*plan, how)); !by.empty())
        verdict.faults.push_back(fmt::format("P8: --target {} --threads {} with tiles of {}: {}",
                                             how.target, how.threads, how.tile_size, by));
    check_effects(frame, *plan, whole, random, verdict.faults);
    if (!verdict.faults.empty()) verdict.outcome = Outcome::broken;
    return verdict;
}

} // namespace scanout::test
