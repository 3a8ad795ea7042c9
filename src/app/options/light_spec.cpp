#include "app/options/light_spec.h"

#include "app/options/values.h"
#include "app/picture/nearest.h"
#include "math/srgb.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace scanout::app {
namespace {

using scene::Light;
using scene::LightFrame;
using scene::LightKind;

constexpr std::string_view kExample = "as in point:1,2,3 (`scanout render --help` lists them)";

std::string_view take(std::string_view& text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view part = text.substr(0, colon);
    text.remove_prefix(std::min(colon + 1, text.size()));
    return part;
}

Result<bool> either(std::string_view text, std::string_view no, std::string_view yes) {
    if (text == no || text == yes) return text == yes;
    return fail(Exit::usage, "wants {} or {}, not '{}'", no, yes, text);
}

Result<double> number_between(std::string_view text, double least, double most) {
    TRY(const double value, parse_real(text));
    if (value >= least && value <= most) return value;
    return fail(Exit::usage, "wants {} to {}, not {}", least, most, text);
}

Result<DVec3> direction(std::string_view text) {
    TRY(const DVec3 towards, parse_vector(text));
    if (towards == DVec3(0)) return fail(Exit::usage, "0,0,0 is no direction");
    return towards;
}

Result<void> set_colour(Light& light, std::string_view text) {
    TRY(const image::Rgba8 code, parse_colour(text));
    light.colour = {srgb_decode(code.r), srgb_decode(code.g), srgb_decode(code.b)};
    return {};
}
Result<void> set_ground(Light& light, std::string_view text) {
    TRY(const image::Rgba8 code, parse_colour(text));
    light.ground = {srgb_decode(code.r), srgb_decode(code.g), srgb_decode(code.b)};
    return {};
}
Result<void> set_power(Light& light, std::string_view text) {
    TRY(light.power, number_between(text, 0, scene::kMaxPower));
    return {};
}
Result<void> set_size(Light& light, std::string_view text) {
    const bool degrees = light.kind == LightKind::directional;
    TRY(light.size, number_between(text, 0, degrees ? scene::kMaxRimDegrees : 1e300));
    return {};
}
Result<void> set_shape(Light& light, std::string_view text) {
    TRY(const bool square, either(text, "sphere", "square"));
    light.shape = square ? scene::LightShape::square : scene::LightShape::sphere;
    return {};
}
Result<void> set_shadow(Light& light, std::string_view text) {
    TRY(light.casts, either(text, "off", "on"));
    return {};
}
Result<void> set_frame(Light& light, std::string_view text) {
    TRY(const bool camera, either(text, "world", "camera"));
    light.frame = camera ? LightFrame::camera : LightFrame::world;
    return {};
}
Result<void> set_name(Light& light, std::string_view text) {
    if (text.empty() || text.size() > 40) return fail(Exit::usage, "wants 1 to 40 letters");
    light.name = text;
    return {};
}
Result<void> set_target(Light& light, std::string_view text) {
    TRY(const DVec3 target, parse_vector(text));
    light.target = target;
    return {};
}
Result<void> set_cone(Light& light, std::string_view text) {
    TRY(const std::vector<double> angles, parse_list(text, 2, 2));
    if (!(angles[0] >= 0 && angles[0] <= angles[1] && angles[1] <= 180))
        return fail(Exit::usage,
                    "wants INNER,OUTER with 0 <= INNER <= OUTER <= 180 degrees, not "
                    "'{}'",
                    text);
    light.inner_degrees = angles[0];
    light.outer_degrees = angles[1];
    return {};
}

enum class Lights : std::uint8_t { all, hemispheres, turned, directed, spots };
struct Field {
    std::string_view name;
    Result<void> (*read)(Light&, std::string_view);
    Lights of = Lights::directed;
    bool is_of(LightKind kind) const {
        switch (of) {
        case Lights::all:
            return true;
        case Lights::hemispheres:
            return kind == LightKind::hemisphere;
        case Lights::turned:
            return kind != LightKind::ambient;
        case Lights::directed:
            return !is_ambient(kind);
        case Lights::spots:
            break;
        }
        return kind == LightKind::spot;
    }
};
constexpr auto kFields = std::to_array<Field>({{"colour", set_colour, Lights::all},
                                               {"color", set_colour, Lights::all},
                                               {"power", set_power, Lights::all},
                                               {"name", set_name, Lights::all},
                                               {"size", set_size},
                                               {"shape", set_shape},
                                               {"shadow", set_shadow},
                                               {"frame", set_frame, Lights::turned},
                                               {"ground", set_ground, Lights::hemispheres},
                                               {"to", set_target, Lights::spots},
                                               {"cone", set_cone, Lights::spots}});

Result<void> set_field(Light& light, std::string_view part) {
    const std::size_t equals = part.find('=');
    std::vector<std::string_view> known;
    for (const Field& field : kFields) {
        if (!field.is_of(light.kind)) continue;
        known.push_back(field.name);
        if (equals == std::string_view::npos || part.substr(0, equals) != field.name) continue;
        const Result<void> read = field.read(light, part.substr(equals + 1));
        if (!read) return fail(read.error().exit, "{} {}", field.name, read.error().what);
        return {};
    }
    return fail(Exit::usage, "'{}' is not NAME=VALUE{}; {} lights have {}", part,
                did_you_mean(part.substr(0, equals), known), name_of(light.kind),
                fmt::join(known, " "));
}

// Reads the kind, and the first value behind its colon, which has no name.
Result<Light> read_kind(std::string_view word, std::string_view value) {
    Light light;
    light.name = word;
    if (word == "ambient") {
        light.kind = LightKind::ambient;
        light.casts = false;
        light.power = scene::kAmbient;
        if (!value.empty()) TRY_VOID(set_power(light, value));
        return light;
    }
    if (word == "hemisphere") {
        light.kind = LightKind::hemisphere;
        light.casts = false;
        light.power = scene::default_lights().back().power;
        TRY(light.towards, direction(value));
        return light;
    }
    if (word == "camera") {
        light.frame = LightFrame::camera;
        light.casts = false;
        if (!value.empty()) {
            TRY(light.towards, direction(value));
        }
        return light;
    }
    for (const LightKind kind : {LightKind::directional, LightKind::point, LightKind::spot})
        if (word == name_of(kind)) light.kind = kind;
    if (word != name_of(light.kind)) {
        const std::array<std::string_view, 9> known = {"none",    "key",        "fill",
                                                       "ambient", "hemisphere", "directional",
                                                       "point",   "spot",       "camera"};
        return fail(Exit::usage, "there is no light '{}'{}; choose one of {}", word,
                    did_you_mean(word, known), fmt::join(known, " "));
    }
    if (value.empty()) return fail(Exit::usage, "{} wants X,Y,Z, {}", word, kExample);
    if (light.kind == LightKind::directional) {
        TRY(light.towards, direction(value));
    } else {
        TRY(light.position, parse_vector(value));
    }
    return light;
}

Result<Light> light_of_spec(std::string_view spec) {
    std::string_view rest = spec;
    const std::string_view word = take(rest);
    const bool has_value =
        !rest.empty() && rest.substr(0, rest.find(':')).find('=') == std::string_view::npos;
    for (const Light& known : scene::default_lights()) {
        if (known.name != word || (has_value && known.kind == LightKind::hemisphere)) continue;
        Light light = known;
        while (!rest.empty())
            TRY_VOID(set_field(light, take(rest)));
        return light;
    }
    const std::string_view value = has_value ? take(rest) : "";
    TRY(Light light, read_kind(word, value));
    while (!rest.empty())
        TRY_VOID(set_field(light, take(rest)));
    if (light.kind == LightKind::spot && light.target && *light.target == light.position)
        return fail(Exit::usage, "spot points at the place where it stands; move `to`");
    return light;
}

// Names tell lights apart: the second point is "point 2".
void number_name(Light& light, const std::vector<Light>& others) {
    const std::string name = light.name;
    const auto taken = [&] {
        return std::any_of(others.begin(), others.end(),
                           [&](const Light& other) { return other.name == light.name; });
    };
    for (int number = 2; taken(); ++number)
        light.name = fmt::format("{} {}", name, number);
}

} // namespace

Result<void> add_light(std::vector<Light>& lights, bool first, std::string_view spec) {
    const auto is_ambient = [](const Light& light) { return scene::is_ambient(light.kind); };
    if (spec == "none") {
        lights.clear();
        return {};
    }
    TRY(Light light, light_of_spec(spec));
    if (first)
        lights.erase(std::remove_if(lights.begin(), lights.end(), std::not_fn(is_ambient)),
                     lights.end());
    if (is_ambient(light)) // replaces the one that is always there
        lights.erase(std::remove_if(lights.begin(), lights.end(), is_ambient), lights.end());
    if (lights.size() >= scene::kMaxLights)
        return fail(Exit::usage, "{}: there may be {} lights", spec, scene::kMaxLights);
    number_name(light, lights);
    lights.push_back(std::move(light));
    return {};
}

} // namespace scanout::app
