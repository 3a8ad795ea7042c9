#include "io/obj/mtl.h"

#include "io/cursor.h"
#include "io/text.h"
#include "io/vertex_colours.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace {

using scene::Material;
using scene::TextureMap;

struct MapKeyword {
    std::string_view keyword; // lower case
    scene::MaterialMap Material::*map;
    std::string_view name; // as messages name it
    bool drawn = true;
};

constexpr std::array kMaps = {
    MapKeyword{"map_kd", &Material::map_diffuse, "map_Kd"},
    MapKeyword{"map_ka", &Material::map_ambient, "map_Ka", false},
    MapKeyword{"map_ks", &Material::map_specular, "map_Ks"},
    MapKeyword{"map_ns", &Material::map_shininess, "map_Ns"},
    MapKeyword{"map_pr", &Material::map_roughness, "map_Pr"},
    MapKeyword{"map_pm", &Material::map_metalness, "map_Pm"},
    MapKeyword{"map_d", &Material::map_opacity, "map_d"},
    MapKeyword{"map_opacity", &Material::map_opacity, "map_d"},
    MapKeyword{"map_ke", &Material::map_emission, "map_Ke"},
    MapKeyword{"map_bump", &Material::map_bump, "map_bump"},
    MapKeyword{"bump", &Material::map_bump, "map_bump"},
    MapKeyword{"norm", &Material::map_normal, "norm"},
    MapKeyword{"map_norm", &Material::map_normal, "norm"},
    MapKeyword{"map_kn", &Material::map_normal, "norm"},
    MapKeyword{"disp", &Material::map_displacement, "disp", false},
    MapKeyword{"map_disp", &Material::map_displacement, "disp", false},
    MapKeyword{"decal", &Material::map_decal, "decal", false},
    MapKeyword{"map_decal", &Material::map_decal, "decal", false},
    MapKeyword{"refl", &Material::map_reflection, "refl", false},
    MapKeyword{"map_refl", &Material::map_reflection, "refl", false},
};

// Physically based values and other additions that have no place in scene::Material.
constexpr std::array<std::string_view, 12> kNotKept = {"Kt",      "Ps",      "Pc",        "Pcr",
                                                       "aniso",   "anisor",  "map_Ps",    "map_aat",
                                                       "map_RMA", "map_ORM", "sharpness", "Km"};

constexpr double kMaxNumber = 1e6; // of colours, exponents and options
constexpr double kFarOff = 1e30;   // greater values are read as this

float clamped(double value, double low, double high) {
    return static_cast<float>(std::clamp(value, low, high));
}

class MtlReader {
public:
    MtlReader(std::string_view file, const std::string& path, Warnings& warnings)
        : path_(path), warnings_(warnings), at_(file) {}

    std::vector<MtlMaterial> read();

private:
    void statement();
    bool colour_statement(std::string_view key);
    bool number_statement(std::string_view key);
    bool map_statement(std::string_view key);
    void finish_material();

    std::optional<double> number();
    void colour(std::string_view name, Vec3& colour);
    template <class Number>
    Number between(std::string_view name, Number value, double least, double most);
    bool map_option(Cursor& at, TextureMap& map) const;
    bool map_options(Cursor& at, TextureMap& map) const;
    void map_file(TextureMap& map);
    bool skip_unknown_option();
    void limit_options(std::string_view name, TextureMap& map);
    void note_map_options(const Material& material);
    void not_drawn(std::string_view what);
    void note_ray_tracing(const Material& material);
    bool is_zero() const;

    void warn(std::string_view kind, std::string_view text) {
        if (warnings_.count(kind) > 0)
            warnings_.add_more(kind, 1);
        else
            warnings_.add(kind, fmt::format("{}:{}: {}", path_, at_.line, text));
    }

    const std::string& path_;
    Warnings& warnings_;
    Cursor at_;
    std::vector<MtlMaterial> out_;
    Material* now_ = nullptr;
    bool has_diffuse_ = false, has_specular_ = false, has_emission_ = false;
    std::optional<double> dissolve_, transparency_;
};

std::vector<MtlMaterial> MtlReader::read() {
    if (std::string_view(at_.at, static_cast<std::size_t>(at_.end - at_.at))
            .starts_with("\xef\xbb\xbf"))
        at_.at += 3;
    while (!at_.done()) {
        at_.skip_blanks();
        if (!at_.at_statement_end()) statement();
        at_.skip_to_line_end(static_cast<std::size_t>(at_.end - at_.at));
        at_.next_line();
    }
    finish_material();
    return std::move(out_);
}

void MtlReader::statement() {
    const std::string_view word = at_.word();
    if (word.size() > 32) return warn("MTL statement", "the statement is not known");
    const std::string key = lower_case(word);
    if (key == "newmtl") {
        finish_material();
        MtlMaterial& m = out_.emplace_back();
        m.line = at_.line;
        m.material.name = at_.rest();
        now_ = &m.material;
        has_diffuse_ = has_specular_ = has_emission_ = false;
        dissolve_ = transparency_ = std::nullopt;
        return;
    }
    if (now_ == nullptr) return warn("MTL statement", "a statement stands before the first newmtl");
    if (colour_statement(key) || number_statement(key) || map_statement(key)) return;
    for (const std::string_view known : kNotKept)
        if (key == lower_case(known)) return is_zero() ? void() : not_drawn(known);
    warn("MTL statement", "the statement is not known");
}

bool MtlReader::colour_statement(std::string_view key) {
    if (key == "kd") {
        has_diffuse_ = true;
        colour("Kd", now_->diffuse);
    } else if (key == "ka") {
        colour("Ka", now_->ambient);
    } else if (key == "ks") {
        has_specular_ = true;
        colour("Ks", now_->specular);
    } else if (key == "ke") {
        has_emission_ = true;
        colour("Ke", now_->emission);
    } else if (key == "tf") {
        colour("Tf", now_->transmission);
    } else {
        return false;
    }
    return true;
}

bool MtlReader::number_statement(std::string_view key) {
    const auto within = [&](std::string_view name, double least, double most) {
        const auto n = number();
        return n ? std::optional(between(name, *n, least, most)) : std::nullopt;
    };
    if (key == "ns") {
        if (const auto n = within("Ns", 0, kMaxNumber)) now_->shininess = static_cast<float>(*n);
    } else if (key == "pr") {
        if (const auto n = within("Pr", 0, 1)) now_->roughness = static_cast<float>(*n);
    } else if (key == "pm") {
        if (const auto n = within("Pm", 0, 1)) now_->metalness = static_cast<float>(*n);
    } else if (key == "ni") {
        if (const auto n = within("Ni", 0, kMaxNumber)) now_->refraction = static_cast<float>(*n);
    } else if (key == "illum") {
        if (const auto n = within("illum", 0, 10)) now_->illumination = static_cast<int>(*n);
    } else if (key == "d") {
        at_.skip_blanks();
        const Cursor before = at_;
        if (at_.word() != "-halo") at_ = before; // opacity by angle: its number is read as plain
        if (const auto n = within("d", 0, 1)) dissolve_ = *n;
    } else if (key == "tr") {
        if (const auto n = within("Tr", 0, 1)) transparency_ = *n;
    } else {
        return false;
    }
    return true;
}

bool MtlReader::map_statement(std::string_view key) {
    for (const MapKeyword& known : kMaps) {
        if (key != known.keyword) continue;
        TextureMap map;
        map_file(map);
        map.line = at_.line;
        limit_options(known.name, map);
        if (map.path.empty())
            warn("MTL map", fmt::format("{} names no file", known.name));
        else
            now_->*known.map = std::move(map);
        return true;
    }
    return false;
}

// The opacity from d and Tr; exporters disagree on Tr. By the rule Tr = 1 - d. If a file gives
// both, d wins whatever the order, because everybody reads d alike. Tr 1 alone would make a
// material invisible, which nobody exports; older MeshLab writes it for opaque ones. So Tr 1 alone
// means opaque, and every other Tr alone follows the rule. Exporters also write d 0 without a
// meaning, so it counts as opaque.
void MtlReader::finish_material() {
    if (now_ == nullptr) return;
    if (dissolve_ && *dissolve_ == 0)
        warn("MTL d 0", "d 0 would hide the material; it is drawn opaque");
    else if (dissolve_)
        now_->opacity = static_cast<float>(*dissolve_);
    else if (transparency_ && *transparency_ < 1)
        now_->opacity = static_cast<float>(1 - *transparency_);
    // A map is multiplied by its colour; if the material gives only the map, the colour is white.
    if (now_->map_diffuse.given() && !has_diffuse_) now_->diffuse = Vec3(1);
    MtlMaterial& material = out_.back();
    material.specular_by_map = now_->map_specular.given() && !has_specular_;
    material.emission_by_map = now_->map_emission.given() && !has_emission_;
    material.roughness_by_map = now_->map_roughness.given() && !now_->roughness;
    material.metalness_by_map = now_->map_metalness.given() && !now_->metalness;
    if (material.specular_by_map) now_->specular = Vec3(1);
    if (material.emission_by_map) now_->emission = Vec3(1);
    if (material.roughness_by_map) now_->roughness = 1.0F;
    if (material.metalness_by_map) now_->metalness = 1.0F;
    for (const MapKeyword& known : kMaps)
        if (!known.drawn && (now_->*known.map).given()) not_drawn(known.name);
    note_map_options(*now_);
    note_ray_tracing(*now_);
    now_ = nullptr;
}

// The renderer draws -o, -s and -clamp, and -imfchan of the map that has one channel.
void MtlReader::note_map_options(const Material& material) {
    const TextureMap &kd = material.map_diffuse, &d = material.map_opacity, plain;
    const auto note = [&](auto&& differs, std::string_view in_kd, std::string_view in_d) {
        if (differs(kd)) not_drawn(in_kd);
        if (differs(d)) not_drawn(in_d);
    };
    using Map = const TextureMap&;
    note([&](Map m) { return m.turbulence != plain.turbulence; }, "map_Kd -t", "map_d -t");
    note([&](Map m) { return m.base != plain.base || m.gain != plain.gain; }, "map_Kd -mm",
         "map_d -mm");
    note([&](Map m) { return m.boost != plain.boost; }, "map_Kd -boost", "map_d -boost");
    note([](Map m) { return m.colour_correction; }, "map_Kd -cc", "map_d -cc");
    note([](Map m) { return !m.blend_u; }, "map_Kd -blendu off", "map_d -blendu off");
    note([](Map m) { return !m.blend_v; }, "map_Kd -blendv off", "map_d -blendv off");
    note([](Map m) { return m.resolution != 0; }, "map_Kd -texres", "map_d -texres");
    note([](Map m) { return !m.reflection_type.empty(); }, "map_Kd -type", "map_d -type");
    if (kd.channel != 0) not_drawn("map_Kd -imfchan");
}

// What a ray tracer would draw of the illumination models 3 to 9 (Wavefront 1995): reflections,
// where Ks is above 0, and light that shines through, coloured by Tf.
void MtlReader::note_ray_tracing(const Material& material) {
    constexpr std::array<std::string_view, 7> kNames = {"illum 3", "illum 4", "illum 5", "illum 6",
                                                        "illum 7", "illum 8", "illum 9"};
    const int model = material.illumination;
    if (model < 3 || model > 9) return;
    const bool refracts = model == 6 || model == 7;
    const bool clear = refracts || ((model == 4 || model == 9) && material.opacity < 1);
    const bool coloured = material.transmission != Vec3(1);
    const bool shiny = has_specular_ && material.specular != Vec3(0);
    if (clear && coloured) not_drawn("Tf");
    if (refracts || shiny) not_drawn(kNames[static_cast<std::size_t>(model - 3)]);
}

// The statement's number is 0: what it asks for is nothing.
bool MtlReader::is_zero() const {
    Cursor ahead = at_;
    ahead.skip_blanks();
    double value = 1;
    return ahead.number(value) == NumberFault::none && value == 0;
}

void MtlReader::not_drawn(std::string_view what) {
    auto& list = out_.back().not_drawn;
    if (std::find(list.begin(), list.end(), what) == list.end()) list.push_back(what);
}

std::optional<double> MtlReader::number() {
    at_.skip_blanks();
    double value = 0;
    if (!at_.at_statement_end() && at_.number(value) == NumberFault::none) return value;
    warn("MTL number", "a finite number is missing; the default stays");
    return std::nullopt;
}

// Clamps values to the range that a material can have, with one warning a name, and counts them.
template <class Number>
Number MtlReader::between(std::string_view name, Number value, double least, double most) {
    const Number taken = std::clamp(value, static_cast<Number>(least), static_cast<Number>(most));
    if (taken != value)
        warn(fmt::format("MTL {}", name),
             fmt::format("{} is {}, which is not between {} and {}; {} is taken", name, value,
                         least, most, taken));
    return taken;
}

// "r g b", or "r" alone for grey. Spectral curves and CIE XYZ are not read: the default stays.
void MtlReader::colour(std::string_view name, Vec3& colour) {
    at_.skip_blanks();
    const std::string_view word = Cursor(at_).word();
    if (word == "spectral" || word == "xyz")
        return warn("MTL colour",
                    fmt::format("'{}' colours are not supported; the default stays", word));
    const auto r = number();
    if (!r) return;
    at_.skip_blanks();
    double g = *r, b = *r;
    if (!at_.at_statement_end()) {
        const auto given_g = number();
        const auto given_b = given_g ? number() : std::nullopt;
        if (!given_b) return;
        g = *given_g;
        b = *given_b;
    }
    for (int c = 0; c < 3; ++c) {
        const double value = between(name, c == 0 ? *r : c == 1 ? g : b, 0, kMaxNumber);
        colour[c] = value < kDarkest ? 0 : static_cast<float>(value);
    }
}

// Reads one "-option arguments" at the cursor. Returns false, and stays, when there is none.
bool MtlReader::map_option(Cursor& at, TextureMap& map) const {
    const Cursor before = at;
    const std::string option = lower_case(at.word().substr(0, 32));
    const auto word = [&] {
        at.skip_blanks();
        return at.word().substr(0, 32);
    };
    const auto number = [&](float& value) {
        Cursor ahead = at;
        ahead.skip_blanks();
        double n = 0;
        if (ahead.number(n) != NumberFault::none) return false;
        value = clamped(n, -kFarOff, kFarOff);
        at = ahead;
        return true;
    };
    const auto vector = [&](Vec3& v) {
        return number(v.x) && (!number(v.y) || !number(v.z) || true); // one to three numbers
    };
    bool good = true;
    if (option == "-blendu")
        map.blend_u = word() != "off";
    else if (option == "-blendv")
        map.blend_v = word() != "off";
    else if (option == "-cc")
        map.colour_correction = word() == "on";
    else if (option == "-clamp")
        map.wrap_u = map.wrap_v = word() == "on" ? scene::Wrap::clamp : scene::Wrap::repeat;
    else if (option == "-boost")
        good = number(map.boost);
    else if (option == "-mm")
        good = number(map.base) && number(map.gain);
    else if (option == "-o")
        good = vector(map.offset);
    else if (option == "-s")
        good = vector(map.scale);
    else if (option == "-t")
        good = vector(map.turbulence);
    else if (option == "-bm")
        good = number(map.bump_multiplier);
    else if (option == "-type")
        map.reflection_type = word();
    else if (option == "-colorspace")
        word(); // map_Kd is sRGB, the others are linear
    else if (option == "-imfchan") {
        const std::string_view channel = word();
        map.channel = channel.empty() ? '\0' : channel.front();
    } else if (option == "-texres") {
        float texels = 0;
        good = number(texels);
        constexpr float kMaxTexels = 65536; // of a texture's side; beyond it, or not a number: that
        const bool fits = -kMaxTexels <= texels && texels <= kMaxTexels;
        map.resolution = static_cast<int>(fits ? texels : kMaxTexels);
    } else
        good = false;
    if (!good) at = before;
    return good;
}

bool MtlReader::map_options(Cursor& at, TextureMap& map) const {
    bool any = false;
    for (at.skip_blanks(); !at.done() && *at.at == '-' && map_option(at, map); at.skip_blanks())
        any = true;
    return any;
}

// Skips an unknown option and the numbers behind it, unless that is all there is: then it is the
// file's name. Returns whether there was an option.
bool MtlReader::skip_unknown_option() {
    Cursor ahead = at_;
    const std::string_view option = ahead.word();
    if (option.size() < 2 || option[0] != '-') return false;
    double number = 0;
    do
        ahead.skip_blanks();
    while (!ahead.at_statement_end() && ahead.number(number) == NumberFault::none);
    if (ahead.at_statement_end()) return false;
    warn("MTL map option", "an option of a map is not known; it is left out");
    at_ = ahead;
    return true;
}

void MtlReader::limit_options(std::string_view name, TextureMap& map) {
    const auto limit = [&](std::string_view option, float& value) {
        value = between(fmt::format("{} {}", name, option), value, -kMaxNumber, kMaxNumber);
    };
    limit("-bm", map.bump_multiplier);
    limit("-boost", map.boost);
    limit("-mm", map.base);
    limit("-mm", map.gain);
    for (int c = 0; c < 3; ++c) {
        limit("-o", map.offset[c]);
        limit("-s", map.scale[c]);
        limit("-t", map.turbulence[c]);
    }
}

// "[options] file name [options]": the name may hold blanks, and some exporters write options
// behind it.
void MtlReader::map_file(TextureMap& map) {
    do
        map_options(at_, map);
    while (skip_unknown_option());
    std::string name = at_.rest();
    for (std::size_t i = name.find(" -"); i != std::string::npos; i = name.find(" -", i + 1)) {
        Cursor tail(std::string_view(name).substr(i));
        TextureMap with_tail = map;
        if (!map_options(tail, with_tail) || !tail.done()) continue;
        map = with_tail;
        name.resize(name.find_last_not_of(" \t", i) + 1);
        break;
    }
    if (name.size() > 1 && name.front() == '"' && name.back() == '"')
        name = name.substr(1, name.size() - 2);
    map.path = std::move(name);
}

} // namespace

std::vector<MtlMaterial> read_mtl(std::string_view file, const std::string& path,
                                  Warnings& warnings) {
    // Faults in files that mtllib names but that are no MTL are not reported.
    const auto same = [](char a, char b) { return (a | ' ') == b; };
    constexpr std::string_view kMark = "newmtl";
    if (std::search(file.begin(), file.end(), kMark.begin(), kMark.end(), same) == file.end())
        return {};
    return MtlReader(file, path, warnings).read();
}

} // namespace scanout::io
