#include "app/report/lists.h"

#include "app/options/options.h"
#include "app/options/text.h"
#include "app/picture/picture.h"
#include "app/report/json_text.h"
#include "app/view/actions.h"
#include "frame/catalogue.h"
#include "image/pixel_format.h"
#include "io/load.h"
#include "simd/targets.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace scanout::app {

using Json = nlohmann::ordered_json;

std::vector<const Technique*> techniques_of(const Settings& settings) {
    std::vector<const Technique*> found = frame::techniques();
    if (settings.arguments.size() < 2) return found;
    std::string axis = settings.arguments[1];
    std::replace(axis.begin(), axis.end(), '-', '_'); // as the options spell it
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const Technique* t) { return t->axis != axis; }),
                found.end());
    return found;
}

std::string techniques_json(const Settings& settings) {
    constexpr std::array<const char*, 3> kKinds = {"rung", "effect", "model"};
    Json cards = Json::array();
    for (const Technique* t : techniques_of(settings)) {
        const shade::Attributes reads = frame::reads(*t);
        Json names = Json::array();
        for (const auto& [read, name] :
             {std::pair(reads.normal, "normal"), std::pair(reads.uv, "texture coordinates"),
              std::pair(reads.colour, "vertex colour"), std::pair(reads.ray, "ray"),
              std::pair(reads.position, "position")})
            if (read) names.push_back(name);
        cards.push_back({{"axis", t->axis},
                         {"name", t->name},
                         {"kind", kKinds[static_cast<std::size_t>(t->kind)]},
                         {"blurb", t->blurb},
                         {"source", t->source},
                         {"reads", names},
                         {"may_err_more_than", t->may_err_more.than},
                         {"because", t->may_err_more.reason}});
    }
    return json_text(cards);
}

std::string formats_json(const Settings&) {
    Json rows = Json::array();
    for (const io::Format& format : io::formats())
        rows.push_back({{"kind", "model"},
                        {"name", format.name},
                        {"extension", format.extension},
                        {"description", format.description}});
    for (const std::string_view name : kPictureFormats)
        rows.push_back({{"kind", "picture"}, {"name", name}});
    for (const image::NamedPixelFormat& named : image::pixel_formats())
        rows.push_back({{"kind", "pixels"}, {"name", named.name}});
    return json_text(rows);
}

std::string targets_json(const Settings&) {
    Json rows = Json::array();
    for (const simd::Target& target : simd::targets())
        rows.push_back(
            {{"name", target.name}, {"supported", target.supported}, {"chosen", target.chosen}});
    return json_text(rows);
}

std::string keys_json(const Settings&) {
    Json rows = Json::array();
    for (const ActionRow& row : action_rows())
        rows.push_back({{"action", row.name}, {"keys", row.keys}, {"help", row.help}});
    return json_text(rows);
}

std::string options_json(const Settings&) {
    Json rows = Json::array();
    for (const Option& option : options()) {
        Json commands = Json::array();
        for (const NamedCommand& row : kCommands)
            if (belongs(option, row.command)) commands.push_back(row.name);
        rows.push_back({{"name", option.name},
                        {"letter", option.letter != 0 ? std::string(1, option.letter) : ""},
                        {"value", value_text(option)},
                        {"default", option.default_text},
                        {"commands", commands},
                        {"repeats", option.repeats},
                        {"help", option.help}});
        if (option.max > option.min) {
            rows.back()["min"] = option.min;
            rows.back()["max"] = option.max;
        }
    }
    return json_text(rows);
}

std::string renderers_json(const Settings&) {
    Json rows = Json::array();
    const auto add = [&](std::string_view part, const textbook::Method& method) {
        rows.push_back({{"part", part}, {"name", method.name}, {"blurb", method.blurb}});
    };
    for (const textbook::Method& renderer : textbook::renderers())
        add("renderer", renderer);
    for (const textbook::Part& part : textbook::parts())
        for (const textbook::Method& method : part.methods)
            add(part.name, method);
    return json_text(rows);
}

} // namespace scanout::app
