#include "io/gltf/animation.h"

#include "io/gltf/json.h"
#include "io/text.h"
#include "math/quaternion.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

using scene::Interpolation;

constexpr std::size_t kMostNamed = 32; // animations in a message

std::string names_of(const Document& d) {
    std::string names;
    for (std::size_t i = 0; i < d.animations.size(); ++i) {
        if (i == kMostNamed) return names + fmt::format(" and {} more", d.animations.size() - i);
        const std::string& name = d.animations[i].name;
        names += fmt::format("{}{}{}", i > 0 ? ", " : "", i,
                             name.empty() ? "" : fmt::format(" '{}'", shown(name)));
    }
    return names;
}

// Reads the channels of one animation.
class ClipReader {
public:
    ClipReader(const Document& document, Accessors& accessors, Budget& budget)
        : d_(document), accessors_(accessors), budget_(budget) {}

    // How many numbers a key of the channel has; 0: it moves nothing that is drawn.
    std::size_t width_of(const AnimationChannel& channel) const {
        if (channel.node < 0) return 0;
        const Node& node = d_.nodes[static_cast<std::size_t>(channel.node)];
        switch (channel.path) {
        case AnimationPath::translation:
        case AnimationPath::scale:
            return 3;
        case AnimationPath::rotation:
            return 4;
        case AnimationPath::weights:
            return weights_of(d_, node).size();
        case AnimationPath::other:
            break;
        }
        return 0;
    }

    Result<scene::Track> read(const AnimationSampler& sampler, const AnimationChannel& channel,
                              std::size_t width) {
        if (!sampler.fault.empty()) return fail(Exit::unreadable, "{}", sampler.fault);
        if (sampler.input < 0 || sampler.output < 0)
            return fail(Exit::unreadable, "lacks input or output");
        const bool weights = channel.path == AnimationPath::weights;
        const bool cubic = sampler.by == Interpolation::hermite;
        scene::TrackKeys keys;
        keys.by = sampler.by;
        keys.width = width;
        keys.quaternions = channel.path == AnimationPath::rotation;
        TRY(keys.times, numbers(sampler.input, 1));
        TRY(std::vector<double> all, numbers(sampler.output, weights ? 1 : width));
        const std::size_t wanted = keys.times.size() * width * (cubic ? 3 : 1);
        if (all.size() != wanted)
            return fail(Exit::unreadable,
                        "accessors[{}] has {} numbers, and {} keys of accessors[{}] want {}",
                        sampler.output, all.size(), keys.times.size(), sampler.input, wanted);
        if (!cubic) {
            keys.values = std::move(all);
        } else {
            for (std::size_t key = 0; key < keys.times.size(); ++key) { // in, value, out
                const auto at = all.begin() + static_cast<std::ptrdiff_t>(3 * key * width);
                const auto step = static_cast<std::ptrdiff_t>(width);
                keys.in.insert(keys.in.end(), at, at + step);
                keys.values.insert(keys.values.end(), at + step, at + 2 * step);
                keys.out.insert(keys.out.end(), at + 2 * step, at + 3 * step);
            }
        }
        zero_quaternion_ = keys.quaternions && has_zero(keys.values);
        auto track = scene::Track::create(std::move(keys));
        if (!track)
            return fail(Exit::unreadable, "accessors[{}] {}", sampler.input, track.error().what);
        return track;
    }
    bool saw_zero_quaternion() const { return zero_quaternion_; } // in the last one

private:
    static bool has_zero(const std::vector<double>& values) {
        for (std::size_t i = 0; i + 3 < values.size(); i += 4)
            if (values[i] == 0 && values[i + 1] == 0 && values[i + 2] == 0 && values[i + 3] == 0)
                return true;
        return false;
    }

    Result<std::vector<double>> numbers(Index accessor, std::size_t rows) {
        const Accessor& a = d_.accessors[static_cast<std::size_t>(accessor)];
        if (static_cast<std::size_t>(a.rows) != rows || a.columns != 1)
            return fail(Exit::unreadable, "accessors[{}] has {} numbers an element, {} are wanted",
                        accessor, a.rows * a.columns, rows);
        TRY(const View view, accessors_.view(accessor));
        TRY_VOID(budget_.take(view.count * rows * sizeof(double) * 4, "an animation"));
        std::vector<double> out;
        out.reserve(view.count * rows);
        const auto take = [&](std::uint64_t, const auto* element) {
            for (std::size_t i = 0; i < rows; ++i)
                out.push_back(static_cast<double>(element[i]));
        };
        if (rows == 1) for_elements<1>(view, take);
        if (rows == 3) for_elements<3>(view, take);
        if (rows == 4) for_elements<4>(view, take);
        return out;
    }

    const Document& d_;
    Accessors& accessors_;
    Budget& budget_;
    bool zero_quaternion_ = false;
};

} // namespace

Result<Index> find_animation(const Document& d, std::string_view name, const std::string& path) {
    if (d.animations.empty())
        return fail(Exit::usage, "{}: has no animations: leave --animation out", path);
    for (std::size_t i = 0; i < d.animations.size(); ++i)
        if (d.animations[i].name == name) return static_cast<Index>(i);
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc() && end == name.data() + name.size() && number < d.animations.size())
        return static_cast<Index>(number);
    return fail(Exit::usage, "{}: there is no animation '{}'; there are: {}", path, shown(name),
                names_of(d));
}

const std::vector<double>& weights_of(const Document& d, const Node& node) {
    static const std::vector<double> none;
    if (node.mesh < 0) return none;
    if (!node.weights.empty()) return node.weights;
    return d.meshes[static_cast<std::size_t>(node.mesh)].weights;
}

bool weighs_targets(const Document& d) {
    const auto weighs = [](const auto& one) {
        return std::any_of(one.weights.begin(), one.weights.end(),
                           [](double weight) { return weight != 0; });
    };
    return std::any_of(d.nodes.begin(), d.nodes.end(), weighs) ||
           std::any_of(d.meshes.begin(), d.meshes.end(), weighs);
}

Result<Clip> Clip::read(const Document& d, Accessors& accessors, Index index,
                        const std::string& path, Budget& budget, Warnings& warnings) {
    const AnimationInfo& animation = d.animations[static_cast<std::size_t>(index)];
    ClipReader reader(d, accessors, budget);
    Clip clip;
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
        const AnimationChannel& channel = animation.channels[i];
        const auto place = [&] {
            return fmt::format("{}: animations[{}].channels[{}]", path, index, i);
        };
        if (!channel.fault.empty()) {
            warnings.add("glTF channel", fmt::format("{}.{}; left out", place(), channel.fault));
            continue;
        }
        if (channel.path == AnimationPath::other) {
            warnings.add("glTF path",
                         fmt::format("{} moves neither a node nor weights: left out", place()));
            continue;
        }
        const std::size_t width = reader.width_of(channel);
        if (width == 0 || channel.sampler < 0) continue;
        auto track = reader.read(animation.samplers[static_cast<std::size_t>(channel.sampler)],
                                 channel, width);
        if (!track) {
            warnings.add("glTF channel",
                         fmt::format("{}: {}; left out", place(), track.error().what));
            continue;
        }
        if (reader.saw_zero_quaternion())
            warnings.add(
                "glTF quaternion",
                fmt::format("{} has a quaternion of length 0, which turns nothing", place()));
        clip.duration_ = std::max(clip.duration_, track->end());
        clip.moving_.push_back({channel.node, channel.path, *std::move(track)});
    }
    if (clip.moving_.empty())
        warnings.add("glTF animation",
                     fmt::format("{}: animations[{}] moves nothing", path, index));
    return clip;
}

void Clip::pose(double seconds, Document& d) const {
    if (seconds > duration_) seconds = scene::wrapped_time(seconds, duration_);
    for (const Moving& moving : moving_) {
        Node& node = d.nodes[static_cast<std::size_t>(moving.node)];
        switch (moving.path) {
        case AnimationPath::translation:
            moving.track.at(seconds, {&node.translation.x, 3});
            break;
        case AnimationPath::scale:
            moving.track.at(seconds, {&node.scale.x, 3});
            break;
        case AnimationPath::rotation:
            moving.track.at(seconds, node.rotation);
            break;
        case AnimationPath::weights:
            node.weights.resize(moving.track.width());
            moving.track.at(seconds, node.weights);
            continue;
        case AnimationPath::other:
            continue;
        }
        node.matrix = trs_matrix(node.translation, node.rotation.data(), node.scale);
    }
}

} // namespace scanout::io::gltf
