#include "app/options/colour_value.h"

#include "app/options/readers.h"
#include "app/options/values.h"
#include "app/picture/nearest.h"
#include "image/colour_models.h"

#include <algorithm>
#include <cmath>

namespace scanout::app {
namespace {

constexpr double kRounding = 0.02; // of a code: of the six places that are printed

// Six places and no more than there are: "0.5", not "0.500000"; no minus before nothing.
std::string number_text(double value) {
    std::string text = fmt::format("{:.6f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string value_of(const image::ColourModel& model, const DVec3& rgb) {
    const DVec3 values = model.of_rgb(rgb);
    return fmt::format("{}:{},{},{}", model.name, number_text(values.x), number_text(values.y),
                       number_text(values.z));
}

Result<void> check_range(const image::ColourModel& model, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const image::ColourComponent& c = model.components[i];
        if (values[i] < c.low || values[i] > c.high)
            return fail(Exit::usage, "{} of {} is {} to {}, not {}", c.name, model.name, c.low,
                        c.high, values[i]);
    }
    return {};
}

} // namespace

Result<DVec3> parse_colour_value(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) {
        const auto colour = parse_colour(text);
        if (!colour)
            return fail(Exit::usage, "a colour {}; or MODEL:A,B,C with {}", colour.error().what,
                        image::kColourModelNames);
        return DVec3(colour->r, colour->g, colour->b) / 255.0;
    }
    const std::string_view name = text.substr(0, colon);
    const image::ColourModel* const model = image::find_colour_model(name);
    if (model == nullptr)
        return fail(Exit::usage, "there is no model of colour '{}'{}; there is {}", name,
                    did_you_mean(name, words_in(image::kColourModelNames)),
                    image::kColourModelNames);
    const auto values = parse_list(text.substr(colon + 1), 3, 3);
    if (!values) return fail(Exit::usage, "{}: {}", name, values.error().what);
    TRY_VOID(check_range(*model, *values));
    return model->to_rgb(DVec3((*values)[0], (*values)[1], (*values)[2]));
}

std::vector<std::string> colour_lines(const DVec3& asked) {
    DVec3 rgb = asked; // within the codes where it is but for rounding
    std::array<int, 3> codes{};
    double beyond = 0; // codes
    for (int i = 0; i < 3; ++i) {
        const double inside = std::clamp(asked[i], 0.0, 1.0);
        codes[static_cast<std::size_t>(i)] = static_cast<int>(255 * inside + 0.5);
        beyond = std::max({beyond, 255 * (asked[i] - 1), -255 * asked[i]});
        rgb[i] = inside;
    }
    const bool has_it = beyond <= kRounding;
    if (!has_it) rgb = asked;
    std::vector<std::string> lines = {
        fmt::format("#{:02x}{:02x}{:02x}{}", codes[0], codes[1], codes[2],
                    has_it ? "" : "   the nearest: sRGB does not have the colour")};
    for (const image::ColourModel& model : image::colour_models())
        lines.push_back(fmt::format("{:<38} {}", value_of(model, rgb), model.blurb));
    return lines;
}

} // namespace scanout::app
