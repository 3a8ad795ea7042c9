#include "measure/ladder.h"

#include "frame/catalogue.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::measure {
namespace {

std::vector<std::string_view> rungs_on(std::string_view axis) {
    std::vector<std::string_view> names;
    for (const Technique* t : frame::techniques())
        if (t->axis == axis && t->kind == Kind::rung) names.push_back(t->name);
    return names;
}

bool is_rung(std::string_view axis, std::string_view technique) {
    const std::vector<std::string_view> rungs = rungs_on(axis);
    return std::find(rungs.begin(), rungs.end(), technique) != rungs.end();
}

} // namespace

bool Ladder::is_flat() const {
    return std::all_of(rungs.begin(), rungs.end(),
                       [&](const LadderRung& r) { return r.point == rungs.front().point; });
}

std::vector<std::string_view> ladder_axes() {
    std::vector<std::string_view> axes;
    for (const frame::AskedAxis& asked : frame::asked_axes())
        if (rungs_on(asked.axis).size() > 1) axes.push_back(asked.axis);
    return axes;
}

frame::FrameOptions without_rungs(const frame::FrameOptions& options) {
    frame::FrameOptions plain = options;
    for (const std::string_view axis : ladder_axes())
        if (axis != kOnRequest && is_rung(axis, frame::asked_for(options, axis)))
            frame::ask(plain, axis, "auto");
    return plain;
}

Ladder ladder_of(const Points& points, std::string_view axis) {
    Ladder made{axis, {}, {}};
    const std::string asked = frame::asked_for(points.options(), axis);
    if (!frame::is_auto(asked) && !is_rung(axis, asked)) {
        made.left_out = fmt::format("{} is a choice, and no rung draws its picture", asked);
        return made;
    }
    if (axis == kOnRequest && (frame::is_auto(asked) || asked == rungs_on(axis).front())) {
        made.left_out = fmt::format("it comes only on request, as by --{} {}",
                                    frame::option_of(axis), rungs_on(axis).back());
        return made;
    }
    for (const std::string_view technique : rungs_on(axis))
        made.rungs.push_back({technique, {}, {}});
    return made;
}

void draw(Points& points, std::string_view axis, LadderRung& rung) {
    if (const auto point = points.at({{axis, rung.technique}}))
        rung.point = *point;
    else
        rung.refusal = point.error().what;
}

} // namespace scanout::measure
