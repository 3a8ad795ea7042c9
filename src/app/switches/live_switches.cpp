#include "app/switches/live_switches.h"

#include "app/options/readers.h"
#include "app/options/values.h"
#include "frame/catalogue.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace scanout::app {
namespace {

using Asked = std::string frame::FrameOptions::*;
constexpr std::array<Asked, kSwitchedAxes.size()> kAsked = {
    &frame::FrameOptions::shading, &frame::FrameOptions::aa,
    &frame::FrameOptions::texture, &frame::FrameOptions::shadow,
    &frame::FrameOptions::tone,    &frame::FrameOptions::ambient_occlusion};

struct NamedBackground {
    std::string_view name;
    image::Rgba8 colour;
};
std::vector<NamedBackground> backgrounds() {
    std::vector<NamedBackground> all;
    for (const std::string_view name : words_in(colour_names()))
        if (const auto colour = parse_colour(name)) all.push_back({name, *colour});
    return all;
}

// Around `size` places; from none of them (place == size) to the first or the last.
std::size_t around(std::size_t place, std::size_t size, int by) {
    if (by > 0) return place + 1 >= size ? 0 : place + 1;
    return place == 0 ? size - 1 : place - 1;
}

} // namespace

Rendering rendering_of(const frame::FrameOptions& options) {
    Rendering rendering;
    for (std::size_t i = 0; i < kAsked.size(); ++i)
        rendering.asked[i] = options.*kAsked[i];
    rendering.exposure = options.exposure;
    rendering.background = options.background;
    return rendering;
}

void put(const Rendering& rendering, frame::FrameOptions& out) {
    out.exposure = rendering.exposure;
    out.background = rendering.background;
    for (std::size_t i = 0; i < kAsked.size(); ++i) {
        const std::string& asked = rendering.asked[i];
        if (asked == out.*kAsked[i]) continue;
        if (frame::is_auto(asked))
            out.*kAsked[i] = asked;
        else
            frame::ask(out, kSwitchedAxes[i], asked);
    }
}

std::string stepped(std::string_view axis, std::string_view now, int by) {
    std::vector<std::string_view> names = frame::names_on(axis);
    names.insert(names.begin(), "auto");
    const auto place =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), now) - names.begin());
    return std::string(names[around(place, names.size(), by)]);
}

double stepped_exposure(double stops, int by) {
    constexpr double kStepsPerStop = 2;
    const double steps = stops * kStepsPerStop;
    const double next = by > 0 ? std::floor(steps) + 1 : std::ceil(steps) - 1;
    return std::clamp(next / kStepsPerStop, -frame::kMaxStops, frame::kMaxStops);
}

image::Rgba8 stepped_background(image::Rgba8 now, int by) {
    const std::vector<NamedBackground> all = backgrounds();
    const auto here = std::find_if(all.begin(), all.end(),
                                   [&](const NamedBackground& b) { return b.colour == now; });
    return all[around(static_cast<std::size_t>(here - all.begin()), all.size(), by)].colour;
}

std::string exposure_text(double stops) {
    return fmt::format("{:+g} stops", stops == 0 ? 0.0 : stops);
}

std::string background_text(image::Rgba8 colour) {
    for (const NamedBackground& named : backgrounds())
        if (named.colour == colour) return std::string(named.name);
    return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

bool counts_before_rung(const Rendering& rendering, std::string_view axis) {
    const auto place = std::find(kSwitchedAxes.begin(), kSwitchedAxes.end(), axis);
    return place != kSwitchedAxes.end() &&
           (rendering.over_rungs >> (place - kSwitchedAxes.begin()) & 1U) != 0;
}

} // namespace scanout::app
