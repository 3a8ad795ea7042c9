#include "io/gltf/buffers.h"
#include "io/little_endian.h"

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

} // namespace

Result<Container> open_container(std::string_view file, const std::string& path,
                                 Warnings& warnings) {
    Container out;
    if (!file.starts_with("glTF")) {
        out.json = file;
        return out;
    }
    const auto cut = [&](std::uint64_t bytes) {
        return fail(Exit::unreadable, "{}: the GLB file is cut short: its {} bytes hold no chunk",
                    path, bytes);
    };
    if (file.size() < kHeader) return cut(file.size());
    if (const std::uint32_t version = little_endian(file.data() + 4); version != 2)
        return fail(Exit::unreadable, "{}: GLB of version {} is not read: export it as glTF 2.0",
                    path, version);
    std::uint64_t size = little_endian(file.data() + 8);
    if (size > file.size()) {
        warnings.add("GLB length", fmt::format("{}: its header says {} bytes, the file has {}",
                                               path, size, file.size()));
        size = file.size();
    }
    for (std::size_t at = kHeader, number = 0; at + kChunkHeader <= size; ++number) {
        const std::uint64_t bytes = little_endian(file.data() + at);
        const std::uint32_t type = little_endian(file.data() + at + 4);
        const std::size_t begin = at + kChunkHeader;
        if (bytes > file.size() - begin)
            return fail(Exit::unreadable,
                        "{}: chunk {} of the GLB file, {} bytes from byte {} on, reaches beyond "
                        "its {} bytes",
                        path, number, bytes, begin, file.size());
        if (number == 0 && type != kJsonChunk)
            return fail(Exit::unreadable, "{}: the GLB file's first chunk is no JSON", path);
        const std::string_view chunk = file.substr(begin, bytes);
        if (number == 0) out.json = chunk;
        if (type == kBinaryChunk && !out.has_chunk) {
            out.has_chunk = true;
            out.chunk = {reinterpret_cast<const std::uint8_t*>(chunk.data()), chunk.size()};
        }
        at = begin + bytes;
    }
    if (out.json.data() == nullptr) return cut(size);
    return out;
}

} // namespace scanout::io::gltf
