#include "io/gltf_textures.h"

#include "image/codec.h"
#include "io/hidden_colours.h"
#include "io/text.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

constexpr std::size_t kTextureWarnings = 20; // told one by one, the rest together

void lean(image::Image& image, double scale) {
    const auto scaled = [&](std::uint8_t code) {
        const double leant = 128 + (code - 128.0) * scale;
        return static_cast<std::uint8_t>(std::clamp(leant, 0.0, 255.0) + 0.5);
    };
    for (image::Rgba8& p : image.pixels()) {
        p.r = scaled(p.r);
        p.g = scaled(p.g);
    }
}

bool is_opaque(const image::Image& image) {
    const auto pixels = image.pixels();
    return std::all_of(pixels.begin(), pixels.end(),
                       [](const image::Rgba8& p) { return p.a == 255; });
}

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
        std::min(limits.max_pixels, static_cast<std::int64_t>(bytes_left_ / sizeof(image::Rgba8)));
    const std::string place = fmt::format("{}: images[{}]", path_, index);
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
        return fail(Exit::unreadable, "{} has neither a uri nor a buffer view", place);
    auto path = buffers_.file_of_uri(source.uri);
    if (!path) return fail(Exit::unreadable, "{}: {}", place, path.error().what);
    name = *path;
    auto image = image::load(name, limits);
    if (!image) return fail(Exit::unreadable, "{}: {}", place, image.error().what);
    return image;
}

std::int32_t Textures::load(Index index) {
    std::string name = fmt::format("images[{}]", index);
    auto image = decode(index, name);
    if (!image) {
        const bool alone = ++faults_ <= kTextureWarnings;
        warnings_.add(alone ? fmt::format("glTF image {}", index) : "more textures",
                      fmt::format("{}; drawn plain", image.error().what));
        return -1;
    }
    const std::uint64_t bytes = image->pixels().size_bytes();
    bytes_left_ -= std::min(bytes, bytes_left_);
    bytes_ += bytes;
    out_.push_back({name, *std::move(image)});
    return static_cast<std::int32_t>(out_.size()) - 1;
}

std::int32_t Textures::made_of(std::int32_t plain, Role role, double scale) {
    const scene::Texture& given = out_[static_cast<std::size_t>(plain)];
    if (role == Role::plain || (role == Role::leaning && scale == 1)) return plain;
    if (role == Role::opaque && is_opaque(given.image)) return plain;
    scene::Texture made = given;
    if (role == Role::opaque)
        for (image::Rgba8& p : made.image.pixels())
            p.a = 255;
    else if (role == Role::leaning)
        lean(made.image, scale);
    else if (!fill_hidden_colours(made.image))
        return plain;
    out_.push_back(std::move(made));
    return static_cast<std::int32_t>(out_.size()) - 1;
}

std::int32_t Textures::find(Index texture, Role role, double scale) {
    const Index image = document_.textures[static_cast<std::size_t>(texture)].image;
    if (image < 0) {
        warnings_.add(fmt::format("glTF texture {}", texture),
                      fmt::format("{}: textures[{}] names no image that is read; drawn plain",
                                  path_, texture));
        return -1;
    }
    const auto [plain, first] = known_.try_emplace({image, Role::plain, 1}, -1);
    if (first) plain->second = load(image);
    const std::int32_t loaded = plain->second;
    if (loaded < 0) return -1;
    const auto [known, is_new] = known_.try_emplace({image, role, scale}, loaded);
    if (is_new) known->second = made_of(loaded, role, scale);
    return known->second;
}

} // namespace scanout::io::gltf
