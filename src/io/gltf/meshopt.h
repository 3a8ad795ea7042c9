// EXT_meshopt_compression: buffer views that meshoptimizer packed (Kapoulkine 2021).
#pragma once

#include "base/result.h"
#include "io/gltf/document.h"
#include "io/gltf/uri.h"

#include <cstdint>
#include <span>
#include <string>

namespace scanout::io::gltf {

// How many bytes they unpack to; an error (Exit::unreadable) for a mode, filter, stride or count
// that the format does not have. place: stands before messages.
Result<std::uint64_t> meshopt_size(const Meshopt& packed, const std::string& place);

// `size`: of meshopt_size(), which may be taken.
Result<Bytes> unpack_meshopt(std::span<const std::uint8_t> bytes, const Meshopt& packed,
                             std::uint64_t size, const std::string& place);

// What the encoder did before it packed them, undone in place.
void undo_meshopt_filter(const Meshopt& packed, Bytes& bytes);

} // namespace scanout::io::gltf
