#include "app/options/readers.h"

#include "app/options/light_spec.h"
#include "app/options/values.h"
#include "app/picture/nearest.h"
#include "math/rotation.h"
#include "math/srgb.h"
#include "simd/targets.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::app {

std::vector<std::string_view> words_in(std::string_view text) {
    std::vector<std::string_view> found;
    while (!text.empty()) {
        const std::size_t space = std::min(text.find(' '), text.size());
        if (space > 0) found.push_back(text.substr(0, space));
        text.remove_prefix(std::min(space + 1, text.size()));
    }
    return found;
}

Result<void> read_size(Settings& s, std::string_view text) {
    TRY(const Size size, parse_size(text));
    s.frame.width = size.width;
    s.frame.height = size.height;
    return {};
}

Result<void> read_camera(Settings& s, std::string_view text) {
    TRY(const std::vector<double> numbers, parse_list(text, 2, 3));
    if (numbers.size() == 3 && numbers[2] <= 0)
        return fail(Exit::usage, "the distance must be above 0, not {}", numbers[2]);
    if (numbers[1] < -90 || numbers[1] > 90)
        return fail(Exit::usage, "the elevation must be -90 to 90 degrees, not {}", numbers[1]);
    s.camera.azimuth_degrees = numbers[0];
    s.camera.elevation_degrees = numbers[1];
    s.camera.distance = numbers.size() == 3 ? numbers[2] : 0;
    s.camera_given = true;
    return {};
}

Result<void> read_shift(Settings& s, std::string_view text) {
    TRY(const std::vector<double> numbers, parse_list(text, 2, 2));
    s.camera.shift = {numbers[0], numbers[1]};
    return {};
}

Result<void> read_eye(Settings& s, std::string_view text) {
    TRY(s.camera.eye, parse_vector(text));
    return {};
}

Result<void> read_look_at(Settings& s, std::string_view text) {
    TRY(s.camera.target, parse_vector(text));
    return {};
}

// --target is the point that the camera looks at when it has commas, else a SIMD target.
Result<void> read_target(Settings& s, std::string_view text) {
    if (text.find(',') != std::string_view::npos) return read_look_at(s, text);
    const std::vector<simd::Target> targets = simd::targets();
    std::vector<std::string_view> known = {"auto"};
    for (const simd::Target& target : targets) {
        known.push_back(target.name);
        if (target.name == text && !target.supported)
            return fail(Exit::usage,
                        "{}: this processor lacks it; `scanout list targets` prints its own", text);
    }
    if (std::find(known.begin(), known.end(), text) == known.end())
        return fail(Exit::usage, "there is no '{}'{}; `scanout list targets` prints this program's",
                    text, did_you_mean(text, known));
    s.target = text;
    return {};
}

static void add_step(Settings& s, const DMat3& linear, const DVec3& offset = DVec3(0)) {
    s.model.steps.push_back({linear, offset, s.order.about});
    s.order.given = 4;
}
// Is it the transform's own? Then it has come now.
static bool is_next(Settings& s, int part) {
    if (s.order.given >= part || s.order.about) return false;
    s.order.given = part;
    return true;
}

Result<void> read_about(Settings& s, std::string_view text) {
    s.order.about.reset();
    if (text == "centre") return {};
    TRY(s.order.about, parse_vector(text));
    return {};
}

Result<void> read_rotate_axis(Settings& s, std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const auto axis = parse_vector(text.substr(0, colon));
    const auto angle = parse_real(text.substr(std::min(colon + 1, text.size())));
    if (!axis || !angle)
        return fail(Exit::usage, "wants an axis and degrees, as in 1,1,0:30; not '{}'", text);
    if (*axis == DVec3(0)) return fail(Exit::usage, "the axis must not be 0,0,0: '{}'", text);
    add_step(s, rotation_about(normalized(*axis), *angle));
    return {};
}

Result<void> read_shear(Settings& s, std::string_view text) {
    const bool named = text.size() > 2 && text[1] == ':';
    const std::size_t axis = named ? std::string_view("xyz").find(text[0]) : 3;
    const auto shares = parse_list(named ? text.substr(2) : "", 2, 2);
    if (axis > 2 || !shares)
        return fail(Exit::usage,
                    "wants x, y or z and by how much of the other two it moves, as in x:0.5,0; not "
                    "'{}'",
                    text);
    add_step(s, scene::shear(static_cast<int>(axis), (*shares)[0], (*shares)[1]));
    return {};
}

Result<void> read_matrix(Settings& s, std::string_view text) {
    TRY(const std::vector<double> m, parse_list(text, 16, 16));
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
        return fail(Exit::usage,
                    "the last row must be 0,0,0,1, not {},{},{},{}: a model is moved by no "
                    "projection; --frustum gives one",
                    m[12], m[13], m[14], m[15]);
    const DMat3 linear(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]);
    if (!scene::is_invertible(linear))
        return fail(
            Exit::usage,
            "is singular (determinant {}): it flattens the model, and nothing undoes it; give one "
            "that can be inverted",
            determinant(linear));
    add_step(s, linear, {m[3], m[7], m[11]});
    return {};
}

Result<void> read_near(Settings& s, std::string_view text) {
    TRY(s.camera.near, parse_real(text));
    return {};
}

Result<void> read_far(Settings& s, std::string_view text) {
    TRY(s.camera.far, parse_real(text));
    return {};
}

static Result<void> read_window(Settings& s, std::string_view text, scene::Projection projection) {
    TRY(const std::vector<double> n, parse_list(text, 6, 6));
    s.camera.projection = projection;
    s.camera.window = scene::Window{projection, n[0], n[1], n[2], n[3]};
    s.camera.near = n[4];
    s.camera.far = n[5];
    return {};
}

Result<void> read_frustum(Settings& s, std::string_view text) {
    return read_window(s, text, scene::Projection::perspective);
}

Result<void> read_ortho(Settings& s, std::string_view text) {
    return read_window(s, text, scene::Projection::orthographic);
}

Result<void> read_scale(Settings& s, std::string_view text) {
    TRY(const std::vector<double> numbers, parse_list(text, 1, 3));
    if (numbers.size() == 2) return fail(Exit::usage, "wants one number, or three; not '{}'", text);
    const bool one = numbers.size() == 1;
    const DVec3 factors(numbers[0], numbers[one ? 0 : 1], numbers[one ? 0 : 2]);
    if (is_next(s, 1))
        s.model.scale = factors;
    else
        add_step(s, scene::scaling(factors));
    return {};
}

Result<void> read_rotate(Settings& s, std::string_view text) {
    TRY(const DVec3 degrees, parse_vector(text));
    if (is_next(s, 2))
        s.model.rotate_degrees = degrees;
    else
        add_step(s, scene::rotation_xyz(degrees));
    return {};
}

Result<void> read_translate(Settings& s, std::string_view text) {
    TRY(const DVec3 way, parse_vector(text));
    if (is_next(s, 3))
        s.model.translate = way;
    else
        add_step(s, DMat3(1), way);
    return {};
}

Result<void> read_section(Settings& s, std::string_view text) {
    s.section.reset();
    if (text == "none") return {};
    scene::SectionSpec spec;
    std::string_view axis = text.substr(0, text.find(':'));
    if (axis.size() < text.size()) {
        const auto share = parse_real(text.substr(axis.size() + 1));
        spec.low = axis.starts_with('-');
        if (spec.low) axis.remove_prefix(1);
        const std::size_t named = std::string_view("xyz").find(axis);
        if (axis.size() != 1 || named > 2 || !share || *share < 0 || *share > 1)
            return fail(Exit::usage,
                        "wants x, y or z, or -x, -y or -z, and a share of the model's box from 0 "
                        "to 1, as in x:0.5; not '{}'",
                        text);
        spec.axis = static_cast<scene::SectionAxis>(named);
        spec.share = *share;
    } else {
        const auto numbers = parse_list(text, 4, 4);
        if (!numbers)
            return fail(Exit::usage, "wants x:0.5, -x:0.5, or four numbers NX,NY,NZ,D; not '{}'",
                        text);
        spec.normal = DVec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
        spec.offset = (*numbers)[3];
        if (spec.normal == DVec3(0))
            return fail(Exit::usage, "the plane's normal NX,NY,NZ must not be 0,0,0: '{}'", text);
    }
    s.section = spec;
    return {};
}

Result<void> read_annotate(Settings& s, std::string_view text) {
    s.frame.annotations = {};
    if (text == "none") return {};
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view name = text.substr(begin, end - begin);
        const auto found = frame::annotation_named(name);
        if (!found)
            return fail(Exit::usage, "wants none, or some of {} with commas between; not '{}'{}",
                        fmt::join(frame::kAnnotationNames, " "), text,
                        did_you_mean(name, frame::kAnnotationNames));
        if (!s.frame.annotations.has(*found)) s.frame.annotations.toggle(*found);
        begin = end + 1;
    }
    return {};
}

Result<void> read_background(Settings& s, std::string_view text) {
    TRY(s.frame.background, parse_colour(text));
    return {};
}

static Vec3 linear(const image::Rgba8& code) {
    return {srgb_decode(code.r), srgb_decode(code.g), srgb_decode(code.b)};
}

Result<void> read_colour(Settings& s, std::string_view text) {
    s.colour.reset();
    if (text == "auto") return {};
    if (text.find(',') == std::string_view::npos) {
        TRY(const image::Rgba8 code, parse_colour(text));
        s.colour = linear(code);
        return {};
    }
    const auto codes = parse_list(text, 3, 3);
    const auto is_code = [](double c) { return c >= 0 && c <= 255 && c == std::floor(c); };
    if (!codes || !std::all_of(codes->begin(), codes->end(), is_code))
        return fail(Exit::usage, "wants R,G,B from 0 to 255, #rrggbb, a name, or auto; not '{}'",
                    text);
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>((*codes)[i]); };
    s.colour = linear({byte(0), byte(1), byte(2), 255});
    return {};
}

Result<void> read_opacity(Settings& s, std::string_view text) {
    s.opacity.reset();
    if (text == "auto") return {};
    TRY(const double opacity, parse_real(text));
    if (opacity < 0 || opacity > 1) return fail(Exit::usage, "must be 0 to 1, not {}", text);
    s.opacity = opacity;
    return {};
}

Result<void> read_measure(Settings& s, std::string_view text) {
    s.measured.clear();
    if (text == "none") return {};
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        const auto point = parse_vector(text.substr(begin, end - begin));
        if (!point || s.measured.size() == 3)
            return fail(Exit::usage,
                        "wants two points or three, X,Y,Z:X,Y,Z[:X,Y,Z], in the file's "
                        "coordinates; not '{}'",
                        text);
        s.measured.push_back(*point);
        begin = end + 1;
    }
    if (s.measured.size() < 2)
        return fail(Exit::usage, "wants a second point, as in X,Y,Z:X,Y,Z; not '{}'", text);
    return {};
}

Result<void> read_base_colour(Settings& s, std::string_view text) {
    if (const Result<double> grey = parse_real(text)) {
        if (*grey < 0 || *grey > 1)
            return fail(Exit::usage, "wants a linear grey from 0 to 1, not {}", text);
        s.unnamed_colour = Vec3(static_cast<float>(*grey));
        return {};
    }
    TRY(const image::Rgba8 code, parse_colour(text));
    s.unnamed_colour = linear(code);
    return {};
}

Result<void> read_effect(Settings& s, std::string_view text) {
    const std::size_t equals = text.find('=');
    const std::string_view state = equals == std::string_view::npos ? "" : text.substr(equals + 1);
    if (state != "on" && state != "off" && state != "auto")
        return fail(Exit::usage, "wants NAME=on, NAME=off or NAME=auto, not '{}'", text);
    const std::string name(text.substr(0, equals));
    if (state == "auto")
        s.frame.effects.erase(name);
    else
        s.frame.effects[name] = state == "on";
    return {};
}

Result<void> read_shadow_plane(Settings& s, std::string_view text) {
    s.frame.shadow_plane.reset();
    if (text == "ground") return {};
    const auto numbers = parse_list(text, 4, 4);
    if (!numbers)
        return fail(Exit::usage, "wants ground or four numbers NX,NY,NZ,D, not '{}'", text);
    const std::vector<double>& n = *numbers;
    if (n[0] == 0 && n[1] == 0 && n[2] == 0)
        return fail(Exit::usage, "the plane's normal NX,NY,NZ must not be 0,0,0: '{}'", text);
    s.frame.shadow_plane = {DVec3(n[0], n[1], n[2]), n[3]};
    return {};
}

Result<void> read_model_format(Settings& s, std::string_view text) {
    TRY(s.model_format, io::format_named(text));
    return {};
}

Result<void> read_light(Settings& s, std::string_view text) {
    TRY_VOID(add_light(s.frame.lights, !s.light_given, text));
    s.light_given = true;
    return {};
}

Result<void> read_pixel_format(Settings& s, std::string_view text) {
    TRY(s.pixel_format, image::pixel_format(text));
    s.pixel_format_name = text;
    s.frame.bits = image::min_bits(*s.pixel_format);
    return {};
}

Result<void> read_json(Settings& s, std::string_view text) {
    s.json = text.empty() ? "-" : std::string(text);
    return {};
}

Result<void> read_axis(Settings& s, std::string_view text) {
    std::string axis(text);
    std::replace(axis.begin(), axis.end(), '-', '_'); // as the options spell it
    s.axes.push_back(std::move(axis));
    return {};
}

Result<void> read_budget(Settings& s, std::string_view text) {
    s.limits.wall_ms.reset();
    s.holds_budget = text != "none";
    if (!s.holds_budget) return {};
    TRY(s.limits.wall_ms, parse_time(text));
    return {};
}

Result<void> read_max_error(Settings& s, std::string_view text) {
    TRY(const double codes, parse_real(text));
    if (codes < 0 || codes > 255) return fail(Exit::usage, "must be 0 to 255, not {}", text);
    s.limits.error = codes;
    return {};
}

// Two whole numbers with a mark between them: "4x3", "1/8".
static Result<std::pair<int, int>> two_numbers(std::string_view text, char mark, int most) {
    const std::size_t at = text.find(mark);
    if (at != std::string_view::npos) {
        const auto first = parse_integer(text.substr(0, at)),
                   second = parse_integer(text.substr(at + 1));
        if (first && second && *first >= 1 && *second >= 1 && *first <= most && *second <= most)
            return std::pair(static_cast<int>(*first), static_cast<int>(*second));
    }
    return fail(Exit::usage, "wants two numbers from 1 to {} with {} between them, not '{}'", most,
                mark, text);
}

Result<void> read_sheet(Settings& s, std::string_view text) {
    TRY(const auto cells, two_numbers(text, 'x', 1000));
    s.sheet = SheetGrid{cells.first, cells.second};
    return {};
}

Result<void> read_shard(Settings& s, std::string_view text) {
    TRY(const auto part, two_numbers(text, '/', 1'000'000));
    if (part.first > part.second)
        return fail(Exit::usage, "wants I/N with I from 1 to N, not '{}'", text);
    s.shard = Shard{part.first - 1, part.second};
    return {};
}

Result<void> read_time(Settings& s, std::string_view text) {
    constexpr double kLongest = 1e9;
    TRY(const double seconds, parse_real(text));
    if (seconds < 0 || seconds > kLongest)
        return fail(Exit::usage, "must be 0 to {} seconds, not {}", kLongest, text);
    s.time = seconds;
    return {};
}

Result<void> read_frames(Settings& s, std::string_view text) {
    constexpr std::int64_t kMost = 100'000, kLastFrame = 1'000'000'000;
    const std::size_t dots = text.find("..");
    if (dots == std::string_view::npos) {
        TRY(const std::int64_t count, parse_integer(text));
        if (count < 1 || count > kMost)
            return fail(Exit::usage, "must be 1 to {}, not {}", kMost, text);
        s.frames = static_cast<int>(count);
        s.range.reset();
        return {};
    }
    const auto first = parse_integer(text.substr(0, dots)),
               last = parse_integer(text.substr(dots + 2));
    if (!first || !last || *first < 0 || *last < *first || *last > kLastFrame)
        return fail(Exit::usage, "wants the first and the last frame, as in 0..47; not '{}'", text);
    if (*last - *first >= kMost)
        return fail(Exit::usage, "{}: {} frames; there may be {}", text, *last - *first + 1, kMost);
    s.range = FrameRange{static_cast<int>(*first), static_cast<int>(*last)};
    s.frames = 1;
    return {};
}

Result<void> read_limit(Settings& s, std::string_view text) {
    TRY(s.limit, parse_real(text));
    return {};
}

Result<void> read_made_size(Settings& s, std::string_view text) {
    TRY(const Size size, parse_size(text));
    s.made_size = {size.width, size.height};
    return {};
}

Result<void> read_keep(Settings& s, std::string_view text) {
    const std::size_t dots = text.find("..");
    if (dots == std::string_view::npos || text.size() == 2)
        return fail(Exit::usage, "wants LOW..HIGH, ..HIGH or LOW.. such as 0..0.5, not '{}'", text);
    signal::Band band;
    const std::string_view low = text.substr(0, dots), high = text.substr(dots + 2);
    if (!low.empty()) {
        TRY(band.low, parse_real(low));
    }
    if (!high.empty()) {
        TRY(band.high, parse_real(high));
    }
    if (band.low < 0 || band.high < band.low)
        return fail(Exit::usage, "goes up from 0, such as 0..0.5, not '{}'", text);
    s.keep = band;
    return {};
}

void choose_view(Settings& s, std::size_t index) {
    s.named_view = words_in(kViews)[index];
    const std::optional<scene::NamedView> view = scene::named_view(s.named_view);
    s.camera.azimuth_degrees = view->azimuth_degrees;
    s.camera.elevation_degrees = view->elevation_degrees;
}

} // namespace scanout::app
