#include "walk/command.h"

#include "app/options/command_line.h"
#include "frame/catalogue.h"
#include "frame/plan/plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scanout::test {
namespace {

using Words = std::vector<std::string>;

bool is_option(const std::string& option, const std::string& value) {
    return app::parse_command_line({"render", "model.obj", "--hash", option, value}).has_value();
}

bool chance(Random& random, double share) {
    return random.unit() < share;
}
template <class T>
const T& one_of(const std::vector<T>& from, Random& random) {
    return from[static_cast<std::size_t>(random.whole(0, static_cast<int>(from.size()) - 1))];
}
// As many small ones as large ones.
double in_scale(Random& random, double low, double high) {
    return low * std::exp2(random.unit() * std::log2(high / low));
}
std::string vector_text(const DVec3& v) {
    return fmt::format("{:.6g},{:.6g},{:.6g}", v.x, v.y, v.z);
}
void say(Words& words, std::string option, std::string value) {
    words.push_back(std::move(option));
    words.push_back(std::move(value));
}

// In the model, at it, or far away.
DVec3 place_about(const ModelPlace& model, Random& random) {
    const double reach = model.radius * in_scale(random, 0.05, 20);
    return model.centre + random.in_cube(reach);
}

void add_size(Words& words, Random& random) {
    if (chance(random, 0.15)) return say(words, "--size", "1x1");
    if (chance(random, 0.15))
        return say(words, "--size", fmt::format("{}x{}", random.whole(1, 4), random.whole(1, 130)));
    say(words, "--size", fmt::format("{}x{}", random.whole(5, 130), random.whole(5, 80)));
}

void add_camera(Words& words, const ModelPlace& model, Random& random) {
    if (chance(random, 0.1)) {
        say(words, "--eye", vector_text(place_about(model, random)));
        say(words, "--look-at", vector_text(place_about(model, random)));
    } else if (chance(random, 0.9)) {
        std::string camera = fmt::format("{:.4g},{:.4g}", random.in(-180, 180), random.in(-90, 90));
        if (chance(random, 0.8)) camera += fmt::format(",{:.4g}", in_scale(random, 0.02, 40));
        say(words, "--camera", camera);
    }
    if (chance(random, 0.15)) say(words, "--fov", fmt::format("{:.4g}", random.in(1, 170)));
    if (chance(random, 0.25)) say(words, "--projection", "orthographic");
    if (chance(random, 0.1)) say(words, "--up", one_of(Words{"-y", "z", "-x"}, random));
}

void add_model_move(Words& words, Random& random) {
    if (chance(random, 0.15))
        say(words, "--scale",
            chance(random, 0.3)
                ? fmt::format("{:.4g}", in_scale(random, 0.01, 100))
                : vector_text(DVec3(random.in(-2, 2), random.in(0.1, 2), random.in(0.1, 3))));
    if (chance(random, 0.15)) say(words, "--rotate", vector_text(random.in_cube(180)));
    if (chance(random, 0.05)) say(words, "--translate", vector_text(random.in_cube(1.5)));
}

void add_numbers(Words& words, Random& random) {
    if (chance(random, 0.1)) say(words, "--exposure", fmt::format("{:.3g}", random.in(-6, 6)));
    if (chance(random, 0.1)) say(words, "--alpha-cut", fmt::format("{:.3g}", random.unit()));
    if (chance(random, 0.1))
        say(words, "--background", one_of(Words{"transparent", "black", "white"}, random));
    if (chance(random, 0.5)) say(words, "--shadow-size", fmt::to_string(1 << random.whole(6, 9)));
    if (chance(random, 0.1)) say(words, "--shadow-filter", fmt::to_string(random.whole(1, 9)));
}

} // namespace

CommandMaker::CommandMaker() {
    for (const Technique* t : frame::techniques()) {
        const std::string axis(t->axis), name(t->name);
        if (axis == "light") light_kinds_.push_back(name);
        std::string option = "--" + axis;
        std::replace(option.begin(), option.end(), '_', '-');
        if (!is_option(option, name)) continue;
        if (axes_.empty() || axes_.back().option != option) axes_.push_back({option, {}});
        axes_.back().names.push_back(name);
    }
    const auto plan = frame::plan({}, frame::SceneFacts());
    for (const frame::Decision& d : plan->decisions)
        if (!d.choice && is_option("--effect", d.effect + "=on")) effects_.push_back(d.effect);
}

std::vector<std::string> CommandMaker::make(const ModelPlace& model, Random& random) const {
    Words words = {"render", model.path, "--hash"};
    add_size(words, random);
    add_camera(words, model, random);
    const double asked = random.in(0, 0.3); // of all axes
    for (const Axis& axis : axes_)
        if (chance(random, asked)) say(words, axis.option, one_of(axis.names, random));
    const double forced = random.in(0, 0.15);
    for (const std::string& effect : effects_)
        if (chance(random, forced))
            say(words, "--effect", effect + (chance(random, 0.5) ? "=on" : "=off"));
    for (int lights = chance(random, 0.3) ? 0 : random.whole(1, 3); lights > 0; --lights) {
        const std::string& kind = one_of(light_kinds_, random);
        std::string light = kind + ":";
        if (kind == "ambient")
            light += fmt::format("{:.3g}", random.unit());
        else if (kind == "directional" || kind == "hemisphere")
            light += vector_text(random.in_cube(1));
        else
            light += vector_text(place_about(model, random));
        if (kind == "spot")
            light += fmt::format(":cone={:.3g},{:.3g}", random.in(0, 30), random.in(30, 89));
        if (kind != "ambient" && kind != "hemisphere" && chance(random, 0.2))
            light += fmt::format(":size={:.3g}", kind == "directional"
                                                     ? random.in(0, 20)
                                                     : model.radius * random.in(0, 0.3));
        say(words, "--light", light);
    }
    add_model_move(words, random);
    add_numbers(words, random);
    return words;
}

std::string shell_line(const std::vector<std::string>& arguments) {
    std::string line = "scanout";
    for (const std::string& word : arguments)
        line += ' ' + (word.find_first_of(" '#") == std::string::npos ? word : '"' + word + '"');
    return line;
}

} // namespace scanout::test
