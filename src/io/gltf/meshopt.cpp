#include "io/gltf/meshopt.h"

#include "io/text.h"

#include <meshoptimizer.h>

namespace scanout::io::gltf {
namespace {

bool are_indices(const Meshopt& packed) {
    return packed.mode == "TRIANGLES" || packed.mode == "INDICES";
}

} // namespace

Result<std::uint64_t> meshopt_size(const Meshopt& packed, const std::string& place) {
    const std::uint64_t stride = packed.stride;
    const bool vertices = packed.mode == "ATTRIBUTES";
    if (!vertices && !are_indices(packed))
        return fail(Exit::unreadable, "{}: '{}' is no mode of EXT_meshopt_compression", place,
                    shown(packed.mode));
    const bool fits =
        vertices ? stride > 0 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!fits || (packed.mode == "TRIANGLES" && packed.count % 3 != 0))
        return fail(Exit::unreadable, "{}: {} packed elements of {} bytes each cannot be {}", place,
                    packed.count, stride, packed.mode);
    const std::string& filter = packed.filter;
    const bool none = filter.empty() || filter == "NONE";
    const bool known = none ||
                       (vertices && filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                       (vertices && filter == "QUATERNION" && stride == 8) ||
                       (vertices && filter == "EXPONENTIAL");
    if (!known)
        return fail(Exit::unreadable, "{}: '{}' is no filter for elements of {} bytes", place,
                    shown(filter), stride);
    // The packed form has at least a byte for sixteen vertices or a triangle: more is made up.
    if (packed.count > (packed.bytes + 1) * 4096)
        return fail(Exit::unreadable, "{}: {} bytes cannot hold {} elements", place, packed.bytes,
                    packed.count);
    return packed.count * stride;
}

Result<Bytes> unpack_meshopt(std::span<const std::uint8_t> bytes, const Meshopt& packed,
                             std::uint64_t size, const std::string& place) {
    Bytes out(size);
    const std::size_t count = packed.count, stride = packed.stride;
    const int status =
        packed.mode == "ATTRIBUTES"
            ? meshopt_decodeVertexBuffer(out.data(), count, stride, bytes.data(), bytes.size())
        : packed.mode == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(out.data(), count, stride, bytes.data(), bytes.size())
            : meshopt_decodeIndexSequence(out.data(), count, stride, bytes.data(), bytes.size());
    if (status != 0)
        return fail(Exit::unreadable,
                    "{}: its meshopt compression is damaged, or of a newer version than is read",
                    place);
    undo_meshopt_filter(packed, out);
    return out;
}

} // namespace scanout::io::gltf
