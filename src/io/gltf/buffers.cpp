#include "io/gltf/buffers.h"

#include "io/file_name.h"
#include "io/gltf/meshopt.h"
#include "io/text.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::io::gltf {

Buffers::Buffers(const Document& document, const Container& container, const std::string& path,
                 Warnings& warnings, const Reading& how, Budget& budget)
    : document_(document), container_(container), path_(path), folder_(folder_of(path)),
      warnings_(warnings), finder_(how.allow_outside ? FileFinder() : FileFinder(folder_)),
      budget_(budget), buffers_(document.buffers.size()), unpacked_(document.views.size()) {}

Result<std::string> Buffers::file_of_uri(const std::string& uri) {
    if (has_scheme(uri))
        return fail(Exit::unreadable, "'{}' is no file beside the model, and nothing else is read",
                    shown(uri));
    const std::string name = percent_decoded(uri);
    for (const std::string* spelling : {&name, &uri})
        if (auto path = finder_.find_anywhere(folder_, folder_, *spelling)) return *path;
    return fail(Exit::unreadable, "'{}' {}", shown(name),
                finder_.is_outside(folder_, name)
                    ? "lies outside of the model's folder (--allow-outside reads it)"
                    : "is not there");
}

Result<> Buffers::load(Index index, Loaded& loaded) {
    const Buffer& buffer = document_.buffers[static_cast<std::size_t>(index)];
    const std::string name = fmt::format("buffers[{}]", index);
    const auto place = [&] { return fmt::format("{}: {}", path_, name); };
    if (!buffer.has_uri) {
        if (index != 0 || !container_.has_chunk)
            return fail(Exit::unreadable, "{} has neither a uri nor a chunk of a GLB file",
                        place());
        loaded.bytes = container_.chunk;
    } else if (buffer.uri.empty()) {
        return fail(Exit::unreadable, "{} has an empty uri", place());
    } else if (is_data_uri(buffer.uri)) {
        auto data = data_of_uri(buffer.uri);
        if (!data) return fail(Exit::unreadable, "{}: its data URI cannot be read", place());
        TRY_VOID(budget_.take(data->size(), name));
        loaded.own = *std::move(data);
        loaded.bytes = loaded.own;
    } else {
        auto path = file_of_uri(buffer.uri);
        if (!path) return fail(Exit::unreadable, "{}: {}", place(), path.error().what);
        auto file = Mapping::open(
            *path, [&](std::string_view, std::uint64_t size) { return budget_.take(size, name); });
        if (!file) return fail(Exit::unreadable, "{}: {}", place(), file.error().what);
        loaded.file = *std::move(file);
        const std::string_view text = loaded.file.text();
        loaded.bytes = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
        bytes_of_files_ += text.size();
    }
    if (loaded.bytes.size() < buffer.bytes)
        warnings_.add("glTF buffer", fmt::format("{}: byteLength is {}, and it has {} bytes",
                                                 place(), buffer.bytes, loaded.bytes.size()));
    else
        loaded.bytes = loaded.bytes.first(buffer.bytes);
    return {};
}

Result<ByteSpan> Buffers::buffer(Index index) {
    Loaded& loaded = buffers_[static_cast<std::size_t>(index)];
    if (!std::exchange(loaded.tried, true))
        if (auto done = load(index, loaded); !done) loaded.fault = done.error().what;
    if (!loaded.fault.empty()) return fail(Exit::unreadable, "{}", loaded.fault);
    return loaded.bytes;
}

// Bytes [offset, offset + size) of a buffer: 64-bit numbers below 2^53 do not overflow.
Result<ByteSpan> Buffers::part(Index view, Index index, std::uint64_t offset, std::uint64_t size) {
    if (index < 0)
        return fail(Exit::unreadable, "{}: bufferViews[{}] names no buffer", path_, view);
    TRY(const ByteSpan all, buffer(index));
    if (offset > all.size() || size > all.size() - offset)
        return fail(Exit::unreadable,
                    "{}: bufferViews[{}]: {} bytes from byte {} on reach beyond the {} of "
                    "buffers[{}]",
                    path_, view, size, offset, all.size(), index);
    return all.subspan(offset, size);
}

Result<ViewBytes> Buffers::view(Index index) {
    const auto number = static_cast<std::size_t>(index);
    const BufferView& view = document_.views[number];
    const std::string& fault = view.meshopt ? view.meshopt->fault : view.fault;
    if (!fault.empty())
        return fail(Exit::unreadable, "{}: bufferViews[{}].{}", path_, index, fault);
    if (!view.meshopt) {
        TRY(const ByteSpan bytes, part(index, view.buffer, view.offset, view.bytes));
        return ViewBytes{bytes, view.stride};
    }
    const Meshopt& packed = *view.meshopt;
    if (!unpacked_[number]) {
        TRY(const ByteSpan bytes, part(index, packed.buffer, packed.offset, packed.bytes));
        const std::string place = fmt::format("{}: bufferViews[{}]", path_, index);
        TRY(const std::uint64_t size, meshopt_size(packed, place));
        TRY_VOID(budget_.take(size, fmt::format("bufferViews[{}]", index)));
        TRY(unpacked_[number], unpack_meshopt(bytes, packed, size, place));
    }
    return ViewBytes{*unpacked_[number], packed.stride};
}

} // namespace scanout::io::gltf
