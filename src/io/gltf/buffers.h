// The bytes of a glTF file: of its GLB chunk, of data URIs and of files beside it, whole or as
// buffer views. Nothing is read before it is asked for.
#pragma once

#include "base/mapping.h"
#include "base/result.h"
#include "base/warnings.h"
#include "io/find_file.h"
#include "io/gltf/budget.h"
#include "io/gltf/document.h"
#include "io/gltf/uri.h"
#include "io/text_parts.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io::gltf {

using ByteSpan = std::span<const std::uint8_t>;

// A GLB file in its parts (Khronos 2021, 4); text alone is all JSON. An error names the byte.
struct Container {
    std::string_view json;
    ByteSpan chunk; // the first binary one
    bool has_chunk = false;
};
Result<Container> open_container(std::string_view file, const std::string& path,
                                 Warnings& warnings);

// A buffer view: its bytes, unpacked where they were packed, and the distance of its elements; 0:
// they follow each other.
struct ViewBytes {
    ByteSpan bytes;
    std::uint64_t stride = 0;
};

class Buffers {
public:
    // What is read into memory or unpacked there is charged to the budget.
    Buffers(const Document& document, const Container& container, const std::string& path,
            Warnings& warnings, const Reading& how, Budget& budget);

    // Errors (Exit::unreadable) name the buffer or the view, and its bytes.
    Result<ByteSpan> buffer(Index index);
    Result<ViewBytes> view(Index index);

    // The file that a URI names, by the rules of every model's companions: percent-encoding is
    // undone, names outside of the model's folder are refused. An error's line lacks path and
    // place.
    Result<std::string> file_of_uri(const std::string& uri);

    std::uint64_t bytes_of_files() const { return bytes_of_files_; }

private:
    struct Loaded {
        bool tried = false;
        Mapping file;
        Bytes own;
        ByteSpan bytes;
        std::string fault;
    };
    Result<> load(Index index, Loaded& loaded);
    Result<ByteSpan> part(Index view, Index index, std::uint64_t offset, std::uint64_t size);

    const Document& document_;
    const Container& container_;
    const std::string& path_;
    std::string folder_;
    Warnings& warnings_;
    FileFinder finder_;
    Budget& budget_;
    std::uint64_t bytes_of_files_ = 0;
    std::vector<Loaded> buffers_;
    std::vector<std::optional<Bytes>> unpacked_; // of views with EXT_meshopt_compression
};

} // namespace scanout::io::gltf
