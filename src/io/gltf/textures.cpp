#include "io/gltf/textures.h"

#include "image/codec.h"
#include "io/hidden_colours.h"
#include "io/text.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

constexpr std::size_t kTextureWarnings = 20; // told one by one, the rest together

} // namespace

std::string Textures::name_of(Index texture) const {
    const Index image = document_.textures[static_cast<std::size_t>(texture)].image;
    if (image < 0) return fmt::format("textures[{}]", texture);
    const std::string& uri = document_.images[static_cast<std::size_t>(image)].uri;
    return uri.empty() || is_data_uri(uri) ? fmt::format("images[{}]", image) : shown(uri);
}

Result<image::Image> Textures::decode(Index index, std::string& name) {
    const ImageSource& source = document_.images[static_cast<std::size_t>(index)];
    image::DecodeLimits limits;
    limits.max_pixels =
        std::min(limits.max_pixels, static_cast<std::int64_t>(room() / sizeof(image::Rgba8)));
    const std::string place = fmt::format("{}: images[{}]", path_, index);
    if (!source.fault.empty()) return fail(Exit::unreadable, "{}.{}", place, source.fault);
    if (source.view >= 0) {
        TRY(const ViewBytes bytes, buffers_.view(source.view));
        return image::decode(bytes.bytes, place, limits);
    }
    if (is_data_uri(source.uri)) {
        const auto data = data_of_uri(source.uri);
        if (!data) return fail(Exit::unreadable, "{}: its data URI cannot be read", place);
        return image::decode(*data, place, limits);
    }
    if (source.uri.empty())
        return fail(Exit::unreadable, "{} names neither a file nor a buffer view", place);
    auto path = buffers_.file_of_uri(source.uri);
    if (!path) return fail(Exit::unreadable, "{}: {}", place, path.error().what);
    name = *path;
    auto image = image::load(name, limits);
    if (!image) return fail(Exit::unreadable, "{}: {}", place, image.error().what);
    return image;
}

std::int32_t Textures::refuse(Index image, std::string_view why) {
    const bool alone = ++faults_ <= kTextureWarnings;
    warnings_.add(alone ? fmt::format("glTF image {}", image) : "more textures",
                  fmt::format("{}; drawn plain", why));
    return -1;
}

void Textures::charge(std::uint64_t bytes) {
    budget_.try_take(bytes);
    bytes_left_ -= bytes;
    bytes_ += bytes;
}

std::int32_t Textures::load(Index index) {
    std::string name = fmt::format("images[{}]", index);
    auto image = decode(index, name);
    if (!image) return refuse(index, image.error().what);
    charge(image->pixels().size_bytes());
    out_.push_back({name, *std::move(image)});
    return static_cast<std::int32_t>(out_.size()) - 1;
}

// A copy, where the role changes a texel.
std::int32_t Textures::made_of(std::int32_t plain, Role role) {
    const scene::Texture& given = out_[static_cast<std::size_t>(plain)];
    const auto pixels = given.image.pixels();
    const auto has_alpha = [&](bool (*is)(const image::Rgba8&)) {
        return std::any_of(pixels.begin(), pixels.end(), is);
    };
    const bool changes =
        role == Role::opaque ? has_alpha([](const image::Rgba8& p) { return p.a != 255; })
        : role == Role::cut  ? has_alpha([](const image::Rgba8& p) { return p.a == 0; })
                             : false;
    if (!changes) return plain;
    if (pixels.size_bytes() > room()) return -1;
    scene::Texture made = given;
    if (role == Role::opaque) {
        for (image::Rgba8& p : made.image.pixels())
            p.a = 255;
    } else if (!fill_hidden_colours(made.image)) {
        return plain;
    }
    charge(pixels.size_bytes());
    out_.push_back(std::move(made));
    return static_cast<std::int32_t>(out_.size()) - 1;
}

std::int32_t Textures::find(Index texture, Role role) {
    const Index image = document_.textures[static_cast<std::size_t>(texture)].image;
    if (image < 0) {
        warnings_.add(fmt::format("glTF texture {}", texture),
                      fmt::format("{}: textures[{}] names no image that is read; drawn plain",
                                  path_, texture));
        return -1;
    }
    const auto [plain, first] = known_.try_emplace({image, Role::plain}, -1);
    if (first) plain->second = load(image);
    const std::int32_t loaded = plain->second;
    if (loaded < 0) return -1;
    const auto [known, is_new] = known_.try_emplace({image, role}, loaded);
    if (is_new) {
        known->second = made_of(loaded, role);
        if (known->second < 0)
            refuse(image,
                   fmt::format("{}: images[{}] takes more memory than textures may", path_, image));
    }
    return known->second;
}

} // namespace scanout::io::gltf
