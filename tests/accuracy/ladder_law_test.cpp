// Errors against the reference do not grow up the ladder of any axis, on the axis's own scene and
// on shipped models, but for what the cards of techniques except; and what they except does happen.
#include "accuracy/referenced.h"
#include "frame/catalogue.h"
#include "measure/points.h"
#include "support/scenes.h"

#include <cmath>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace scanout::measure {
namespace {

using test::Shot;

constexpr double kAllowed = 1.05;       // of the error of a lower rung
constexpr std::uint32_t kSamples = 256; // of the reference

// Pictures of one subject. One alone may favour a rung by chance: an edge along the pixels' rows
// meets a sample of a pattern, or misses it.
struct Subject {
    std::string name, axis; // whose own scene it is; "": a model, for all axes
    std::vector<Shot> shots;
};

Subject turned(const Shot& s, std::string axis) {
    Subject subject{s.name, std::move(axis), {}};
    for (const double degrees : {0.0, 7.0, 16.0}) {
        if (subject.axis.empty() && degrees == 7) continue; // models take longer
        subject.shots.push_back(s);
        subject.shots.back().camera.azimuth_degrees += degrees;
        subject.shots.back().camera.elevation_degrees += degrees / 2;
    }
    return subject;
}

Shot spot() {
    Shot s = test::shipped("spot/spot.obj", 80, 60);
    s.camera.azimuth_degrees = 150;
    s.camera.elevation_degrees = 20;
    return s;
}

std::vector<Subject> subjects() {
    std::vector<Subject> all;
    for (const auto& [axis, shot] :
         {std::pair{"interpolate", test::wall("a wall")},
          std::pair{"texture", test::noisy_floor("a floor", "auto")},
          std::pair{"shadow", test::shadowed("shadows", "auto")},
          std::pair{"shading", test::ball("a ball")},
          std::pair{"transparency", test::panes("panes", "auto")},
          std::pair{"render_scale", test::ball("a ball")}, std::pair{"aa", test::star("a star")},
          std::pair{"blend_space", test::star("a star")}})
        all.push_back(turned(shot, axis));
    Shot dark = test::glossy("a dark ball", "auto");
    dark.options.exposure = -4;
    for (const char* const axis : {"encode", "dither"})
        all.push_back({dark.name, axis, {dark}});
    Shot folds = test::shipped("suzanne/suzanne.obj", 120, 90);
    folds.options.lights = {test::light_of(scene::LightKind::ambient, 0.8)};
    folds.options.ambient_occlusion = "gtao_16";
    all.push_back(turned(folds, "ambient_occlusion"));
    all.push_back({"crossing planes", "depth", {test::depth_kept("", "auto")}});
    all.push_back(turned(spot(), ""));
    all.push_back(turned(test::shipped("suzanne/suzanne.obj", 80, 60), ""));
    Shot bent = test::shipped("suzanne/suzanne.obj", 120, 90); // quads that are not flat
    bent.camera.azimuth_degrees = 30;
    bent.camera.elevation_degrees = 20;
    bent.options.lights = {test::light_of(scene::LightKind::directional, 1.0)};
    bent.options.lights[0].casts = true;
    bent.options.lights[0].towards = {2, 3, -2};
    all.push_back(turned(bent, "shadow"));
    for (const double light_size : {0.0, 60.0})
        all.push_back(turned(test::cornell_box(72, light_size), ""));
    return all;
}

// Errors at edges would hide those of other axes. Edges of shadows are smoothed by more shaded
// samples alone.
std::string_view smooth_edges(std::string_view axis) {
    return axis == "aa" ? "auto" : axis == "shadow" ? "supersampling_4" : "area";
}

// Of a rung: the mean square over all pictures of a subject, codes; NaN where it is refused.
struct RungError {
    std::string_view rung;
    double square = 0;
};
// None where all rungs draw the same.
std::vector<RungError> errors_of(const std::vector<Shot>& shots,
                                 const std::vector<image::Image>& references,
                                 std::string_view axis) {
    Jobs jobs(2);
    std::vector<RungError> errors;
    for (std::size_t i = 0; i < shots.size(); ++i) {
        Shot s = shots[i];
        s.options.aa = smooth_edges(axis);
        const auto points = *Points::create(s.scene, frame::facts(s.scene), test::view_of(s),
                                            s.options, jobs, references[i]);
        Ladder made = ladder_of(*points, axis);
        for (LadderRung& rung : made.rungs)
            draw(*points, axis, rung);
        if (made.is_flat()) return {};
        errors.resize(made.rungs.size());
        for (std::size_t k = 0; k < errors.size(); ++k) {
            const auto point = made.rungs[k].point;
            const double error = point ? (*points)[*point].error.rmse_codes : NAN;
            errors[k].rung = made.rungs[k].technique;
            errors[k].square += error * error / static_cast<double>(shots.size());
        }
    }
    return errors;
}

// Axis, rung, and the lower one that may err less.
using Exceptions = std::set<std::tuple<std::string_view, std::string_view, std::string_view>>;
Exceptions exceptions_of_cards() {
    Exceptions all;
    for (const Technique* t : frame::techniques()) {
        std::string_view than = t->may_err_more.than;
        while (!than.empty()) {
            const std::string_view name = than.substr(0, than.find(' '));
            than.remove_prefix(std::min(name.size() + 1, than.size()));
            all.emplace(t->axis, t->name, name);
        }
    }
    return all;
}

TEST(LadderLaw, ErrorsDoNotGrow) {
    const Exceptions may_grow = exceptions_of_cards();
    Exceptions grew;
    std::set<std::string_view> own_scenes, axes_of_models;
    for (const Subject& subject : subjects()) {
        std::vector<image::Image> references;
        double noise = 0; // mean square
        for (const Shot& s : subject.shots) {
            trace::Reference made = test::reference_of(s, {kSamples});
            noise += made.noise * made.noise / static_cast<double>(subject.shots.size());
            references.push_back(std::move(made.image));
        }
        for (const std::string_view axis : ladder_axes()) {
            if (!subject.axis.empty() && axis != subject.axis) continue;
            const std::vector<RungError> errors = errors_of(subject.shots, references, axis);
            if (!errors.empty()) (subject.axis.empty() ? axes_of_models : own_scenes).insert(axis);
            for (std::size_t k = 0; k < errors.size(); ++k)
                for (std::size_t j = 0; j < k; ++j) {
                    if (!(errors[k].square > kAllowed * kAllowed * errors[j].square + noise))
                        continue;
                    grew.emplace(axis, errors[k].rung, errors[j].rung);
                    EXPECT_TRUE(may_grow.contains({axis, errors[k].rung, errors[j].rung}))
                        << subject.name << ": " << axis << " " << errors[k].rung << " errs "
                        << std::sqrt(errors[k].square) << " codes, " << errors[j].rung << " "
                        << std::sqrt(errors[j].square);
                }
        }
    }
    for (const auto& [axis, rung, lower] : may_grow)
        EXPECT_TRUE(grew.contains({axis, rung, lower}))
            << axis << " " << rung << " errs no more than " << lower << " in any picture here";
    for (const std::string_view axis : ladder_axes())
        EXPECT_TRUE(own_scenes.contains(axis)) << axis << " has no scene of its own here";
    EXPECT_GE(axes_of_models.size(), 8U);
}

} // namespace
} // namespace scanout::measure
