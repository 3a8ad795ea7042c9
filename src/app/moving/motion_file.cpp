#include "app/moving/motion_file.h"

#include "app/message.h"
#include "app/model_file.h"
#include "app/moving/moved_rows.h"
#include "app/options/values.h"
#include "app/picture/nearest.h"
#include "base/mapping.h"
#include "math/bits.h"
#include "math/quaternion.h"
#include "math/srgb.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include <toml++/toml.h>

namespace scanout::app {
namespace {

using scene::Easing;
using scene::Interpolation;
using scene::Moved;

constexpr double kLongest = 1e9; // seconds
constexpr std::array<std::string_view, 5> kWays = {"step", "linear", "slerp", "spline", "hermite"};
constexpr std::array<std::string_view, 4> kEasings = {"none", "in", "out", "in-out"};
constexpr std::array<std::string_view, 2> kEnds = {"hold", "loop"};

std::string joined(std::span<const std::string_view> names) {
    return fmt::format("{}", fmt::join(names, " "));
}

// Reads one file. Messages begin with the place of the node that they are about.
class MotionReader {
public:
    MotionReader(const std::string& path, const scene::CameraOptions& camera,
                 const std::vector<scene::Light>& lights, Warnings& warnings)
        : path_(path), camera_(camera), lights_(lights), warnings_(warnings) {}

    Result<scene::Motion> read(const toml::table& file) {
        TRY_VOID(check_names(file, {"duration", "end", "model", "camera", "light"}, "a motion"));
        TRY(motion_.loops, loops(file, false));
        double duration = 0;
        if (const toml::node* const node = file.get("duration")) {
            TRY(duration, number(*node, "duration"));
            if (!(duration > 0))
                return fault(*node, "duration is {} s: it must be above 0", duration);
        }
        for (const std::string_view group : {"model", "camera"})
            if (const toml::node* const node = file.get(group))
                TRY_VOID(read_group(*node, group, 0));
        if (const toml::node* const node = file.get("light")) TRY_VOID(read_lights(*node));
        if (waiting_.empty())
            return fail(
                Exit::unreadable,
                "{}: nothing moves: write a table such as [model.rotate] with "
                "keys = [{{ time = 0, value = [0, 0, 0] }}, {{ time = 2, value = [0, 90, 0] }}]",
                path_);
        TRY_VOID(check_together(file));
        motion_.duration = duration;
        if (duration == 0)
            for (const Waiting& one : waiting_)
                motion_.duration = std::max(motion_.duration, one.keys.times.back());
        TRY_VOID(make_tracks());
        return std::move(motion_);
    }

private:
    template <class... Args>
    tl::unexpected<Error> fault(const toml::node& node, fmt::format_string<Args...> format,
                                Args&&... args) const {
        return fail(Exit::unreadable, "{}:{}: {}", path_, node.source().begin.line,
                    fmt::format(format, std::forward<Args>(args)...));
    }

    Result<void> check_names(const toml::table& table, std::vector<std::string_view> known,
                             std::string_view whose) const {
        for (const auto& [key, node] : table)
            if (std::find(known.begin(), known.end(), key.str()) == known.end())
                return fail(Exit::unreadable, "{}:{}: there is no '{}'{}; {} has {}", path_,
                            key.source().begin.line, key.str(), did_you_mean(key.str(), known),
                            whose, joined(known));
        return {};
    }

    Result<const toml::table*> table_at(const toml::node& node, std::string_view name) const {
        if (const toml::table* const table = node.as_table()) return table;
        return fault(node, "{} must be a table", name);
    }

    Result<double> number(const toml::node& node, std::string_view name) const {
        const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
        if (value && magnitude(*value) < kInfinity) return *value;
        return fault(node, "{} wants a number", name);
    }

    // Which of the words the table says under a name; none: `otherwise`.
    Result<std::size_t> word(const toml::table& table, std::string_view name,
                             std::span<const std::string_view> words, std::size_t otherwise) const {
        const toml::node* const node = table.get(name);
        if (node == nullptr) return otherwise;
        const std::string text = node->value<std::string>().value_or("");
        const auto found = std::find(words.begin(), words.end(), text);
        if (node->is_string() && found != words.end())
            return static_cast<std::size_t>(found - words.begin());
        return fault(*node, "{} wants one of {}, in quotes; not '{}'{}", name, joined(words), text,
                     did_you_mean(text, words));
    }
    Result<bool> loops(const toml::table& table, bool otherwise) const {
        TRY(const std::size_t end, word(table, "end", kEnds, otherwise ? 1 : 0));
        return end == 1;
    }

    Result<void> read_lights(const toml::node& node) {
        TRY(const toml::table* const lights, table_at(node, "light"));
        for (const auto& named : *lights) {
            const toml::key& key = named.first;
            const auto found =
                std::find_if(lights_.begin(), lights_.end(),
                             [&](const scene::Light& known) { return known.name == key.str(); });
            if (found == lights_.end()) {
                std::vector<std::string_view> names;
                for (const scene::Light& known : lights_)
                    names.push_back(known.name);
                return fail(Exit::unreadable,
                            "{}:{}: there is no light '{}'{}; there are: {} (--light SPEC:name={} "
                            "makes one)",
                            path_, key.source().begin.line, key.str(),
                            did_you_mean(key.str(), names), joined(names), key.str());
            }
            TRY_VOID(read_group(named.second, "light",
                                static_cast<std::size_t>(found - lights_.begin())));
        }
        return {};
    }

    // The tables of what moves of the model, of the camera or of a light.
    Result<void> read_group(const toml::node& node, std::string_view group, std::size_t light) {
        TRY(const toml::table* const table, table_at(node, group));
        std::vector<std::string_view> names;
        for (const MovedRow& row : moved_rows())
            if (row.group == group && (group != "light" || has(row, light)))
                names.push_back(row.name);
        const std::string whose = group == "light"
                                      ? fmt::format("{} (a light of kind {})", lights_[light].name,
                                                    scene::name_of(lights_[light].kind))
                                      : std::string(group);
        TRY_VOID(check_names(*table, names, whose));
        for (const auto& [key, track] : *table)
            for (const MovedRow& row : moved_rows())
                if (row.group == group && row.name == key.str()) {
                    name_ = fmt::format("{}.{}", group == "light" ? lights_[light].name : group,
                                        row.name);
                    TRY_VOID(read_track(track, row, light));
                }
        return {};
    }
    bool has(const MovedRow& row, std::size_t light) const {
        return (row.lights >> static_cast<unsigned>(lights_[light].kind) & 1U) != 0;
    }

    Result<void> read_track(const toml::node& node, const MovedRow& row, std::size_t light) {
        TRY(const toml::table* const table, table_at(node, name_));
        TRY_VOID(check_names(*table, {"by", "ease", "end", "keys"}, name_));
        const bool turns = row.moved == Moved::turn;
        scene::TrackKeys keys;
        keys.width = row.width;
        TRY(const std::size_t way, word(*table, "by", kWays, turns ? 2 : 1));
        keys.by = static_cast<Interpolation>(way);
        const bool slerp = keys.by == Interpolation::slerp;
        if (slerp && !turns && row.moved != Moved::rotate)
            return fault(*table->get("by"),
                         "slerp is of rotations: {} takes step, linear, spline or hermite", name_);
        TRY(const std::size_t ease, word(*table, "ease", kEasings, 0));
        TRY(keys.loops, loops(*table, false));
        const toml::node* const list = table->get("keys");
        const toml::array* const array = list != nullptr ? list->as_array() : nullptr;
        if (array == nullptr || array->empty())
            return fault(list != nullptr ? *list : node,
                         "{} has no keys: write keys = [{{ time = 0, value = {} }}]", name_,
                         row.value);
        bool eases = ease != 0;
        for (const toml::node& key : *array) {
            TRY_VOID(read_key(key, row, ease, keys));
            eases = eases || keys.easings.back() != Easing::none;
        }
        if (eases && (keys.by == Interpolation::step || keys.by == Interpolation::hermite))
            return fault(node, "{}: by = \"{}\" says how it moves already: leave ease out", name_,
                         kWays[way]);
        if (!eases) keys.easings.clear();
        Moved moved = row.moved;
        if (slerp && !turns) {
            to_quaternions(keys);
            moved = Moved::turn;
        }
        keys.quaternions = moved == Moved::turn;
        waiting_.push_back({name_, node, moved, light, std::move(keys)});
        return {};
    }

    // A track that lasts as long as a file that loops is a loop: its spline closes.
    Result<void> make_tracks() {
        for (Waiting& one : waiting_) {
            if (motion_.loops && one.keys.times.back() == motion_.duration) one.keys.loops = true;
            Result<scene::Track> track = scene::Track::create(std::move(one.keys));
            if (!track) return fault(one.node, "{} {}", one.name, track.error().what);
            motion_.tracks.push_back({one.moved, one.light, *std::move(track)});
        }
        return {};
    }

    Result<void> read_key(const toml::node& node, const MovedRow& row, std::size_t ease,
                          scene::TrackKeys& keys) {
        TRY(const toml::table* const key, table_at(node, "a key"));
        TRY_VOID(check_names(*key, {"time", "value", "ease", "in", "out"}, "a key"));
        const toml::node* const time = key->get("time");
        const toml::node* const value = key->get("value");
        if (time == nullptr || value == nullptr)
            return fault(node,
                         "{}: a key wants a time and a value, as in {{ time = 0, value = {} }}",
                         name_, row.value);
        TRY(const double seconds, number(*time, "time"));
        if (seconds < 0 || seconds > kLongest)
            return fault(*time, "{}: time is {} s: it must be 0 to {}", name_, seconds, kLongest);
        if (!keys.times.empty() && seconds < keys.times.back())
            return fault(*time,
                         "{}: time is {} s, after a key at {} s: put the keys in order of "
                         "time",
                         name_, seconds, keys.times.back());
        keys.times.push_back(seconds);
        TRY_VOID(read_numbers(*value, row, keys.values));
        for (std::size_t i = keys.values.size() - row.width; i < keys.values.size(); ++i)
            if (keys.values[i] < row.min || keys.values[i] > row.max)
                return fault(*value, "{} is {}: it must be {} to {}", name_, keys.values[i],
                             row.min, row.max);
        if (row.moved == Moved::turn &&
            std::all_of(keys.values.end() - 4, keys.values.end(), [](double x) { return x == 0; }))
            warnings_.add("quaternion", fmt::format("{}:{}: {}: a quaternion of length 0 turns "
                                                    "nothing",
                                                    path_, value->source().begin.line, name_));
        TRY(const std::size_t own, word(*key, "ease", kEasings, ease));
        keys.easings.push_back(static_cast<Easing>(own));
        TRY_VOID(read_tangent(*key, "in", row, keys, keys.in));
        return read_tangent(*key, "out", row, keys, keys.out);
    }

    // 0 where the key says none.
    Result<void> read_tangent(const toml::table& key, std::string_view name, const MovedRow& row,
                              const scene::TrackKeys& keys, std::vector<double>& to) {
        const toml::node* const node = key.get(name);
        if (node == nullptr) {
            to.resize(to.size() + row.width, 0);
            return {};
        }
        if (keys.by != Interpolation::hermite)
            return fault(*node, "{}: in and out are tangents of by = \"hermite\", not of \"{}\"",
                         name_, kWays[static_cast<std::size_t>(keys.by)]);
        return read_numbers(*node, row, to);
    }

    // Appends a row's numbers: one, a list, a colour; of a scale one stands for three.
    Result<void> read_numbers(const toml::node& node, const MovedRow& row,
                              std::vector<double>& to) {
        const bool colour = row.moved == Moved::colour || row.moved == Moved::ground;
        if (const auto text = node.value<std::string>(); text && node.is_string() && colour) {
            const Result<image::Rgba8> code = parse_colour(*text);
            if (!code) return fault(node, "{} {}", name_, code.error().what);
            for (const std::uint8_t channel : {code->r, code->g, code->b})
                to.push_back(static_cast<double>(srgb_decode(channel)));
            return {};
        }
        if (node.is_number() && (row.width == 1 || row.moved == Moved::scale)) {
            TRY(const double value, number(node, name_));
            to.insert(to.end(), row.width, value);
            return {};
        }
        const toml::array* const list = node.as_array();
        if (list == nullptr || list->size() != row.width || row.width == 1)
            return fault(node, "{} wants {} number{}, as in value = {}", name_, row.width,
                         row.width == 1 ? "" : "s", row.value);
        for (const toml::node& element : *list) {
            TRY(const double value, number(element, name_));
            to.push_back(value);
        }
        return {};
    }

    static void to_quaternions(scene::TrackKeys& keys) {
        std::vector<double> turns;
        for (std::size_t i = 0; i < keys.values.size(); i += 3) {
            const DVec4 q =
                quaternion_of_degrees({keys.values[i], keys.values[i + 1], keys.values[i + 2]});
            turns.insert(turns.end(), {q.x, q.y, q.z, q.w});
        }
        keys.values = std::move(turns);
        keys.width = 4;
    }

    bool moves(Moved moved) const {
        return std::any_of(waiting_.begin(), waiting_.end(),
                           [&](const Waiting& one) { return one.moved == moved; });
    }

    Result<void> check_together(const toml::table& file) const {
        const auto node = [&](std::string_view group, std::string_view name) -> const toml::node& {
            return *file.get_as<toml::table>(group)->get(name);
        };
        const bool both = file["model"]["rotate"] && file["model"]["turn"];
        if (both)
            return fault(node("model", "turn"),
                         "model.rotate and model.turn both turn it: leave one out");
        const bool eye = moves(Moved::eye), look_at = moves(Moved::look_at);
        if (eye && !look_at && !camera_.target)
            return fault(node("camera", "eye"),
                         "camera.eye wants camera.look-at as well, or --look-at X,Y,Z");
        if (look_at && !eye && !camera_.eye)
            return fault(node("camera", "look-at"),
                         "camera.look-at wants camera.eye as well, or --eye X,Y,Z");
        for (const std::string_view name : {"azimuth", "elevation", "distance"})
            if (eye && file["camera"][name])
                return fault(node("camera", name),
                             "camera.{} and camera.eye each place the camera: leave one out", name);
        return {};
    }

    const std::string& path_;
    const scene::CameraOptions& camera_;
    const std::vector<scene::Light>& lights_;
    Warnings& warnings_;
    scene::Motion motion_;
    // Tracks as they were read: how long the motion is, all of them say.
    struct Waiting {
        std::string name;
        const toml::node& node;
        Moved moved;
        std::size_t light;
        scene::TrackKeys keys;
    };
    std::vector<Waiting> waiting_;
    std::string name_; // of the track that is read: model.rotate
};

} // namespace

Result<scene::Motion> parse_motion(std::string_view text, const std::string& path,
                                   const scene::CameraOptions& camera,
                                   const std::vector<scene::Light>& lights, Warnings& warnings) {
    try {
        const toml::table file = toml::parse(text, path);
        return MotionReader(path, camera, lights, warnings).read(file);
    } catch (const toml::parse_error& error) {
        return fail(Exit::unreadable, "{}:{}: {}", path, error.source().begin.line,
                    error.description());
    } catch (const std::bad_alloc&) {
        return fail(Exit::unreadable, "{}: too large for the memory that is there", path);
    }
}

Result<void> read_motion(Settings& settings) {
    if (settings.motion_file.empty()) return {};
    TRY(const Mapping file, Mapping::open(settings.motion_file));
    Warnings warnings;
    TRY(settings.motion, parse_motion(file.text(), settings.motion_file, settings.camera,
                                      settings.frame.lights, warnings));
    print_warnings(warnings.lines(), settings);
    return {};
}

} // namespace scanout::app
