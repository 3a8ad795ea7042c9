// Builds small glTF files for tests: one buffer, views and accessors in it, in the GLB's chunk.
#pragma once

#include "io/gltf/gltf.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scanout::io::test {

inline std::string glb_of(std::string json, std::string chunk) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t n) {
        const auto w = static_cast<std::uint32_t>(n);
        return std::string(reinterpret_cast<const char*>(&w), 4);
    };
    return "glTF" + word(2) + word(28 + json.size() + chunk.size()) + word(json.size()) + "JSON" +
           json + word(chunk.size()) + std::string("BIN\0", 4) + chunk;
}

class GltfBuilder {
public:
    // Their numbers.
    int view(std::string_view bytes, const std::string& with = "") {
        chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
        views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})",
                                    chunk.size(), bytes.size(), with));
        chunk += bytes;
        return static_cast<int>(views.size()) - 1;
    }
    template <class T>
    int view(const std::vector<T>& values, const std::string& with = "") {
        return view(std::string_view(reinterpret_cast<const char*>(values.data()),
                                     values.size() * sizeof(T)),
                    with);
    }
    int accessor(int of_view, int component, std::string_view type, std::size_t count,
                 const std::string& with = "") {
        accessors.push_back(
            fmt::format(R"({{"bufferView":{},"componentType":{},"type":"{}","count":{}{}}})",
                        of_view, component, type, count, with));
        return static_cast<int>(accessors.size()) - 1;
    }
    template <class T>
    int accessor(const std::vector<T>& values, int component, std::string_view type,
                 std::size_t count, const std::string& with = "") {
        return accessor(view(values), component, type, count, with);
    }
    int floats(const std::vector<float>& values, std::string_view type) {
        const std::size_t rows = type == "VEC3" ? 3 : type == "VEC2" ? 2 : type == "VEC4" ? 4 : 1;
        return accessor(values, 5126, type, values.size() / rows);
    }
    int triangle() { return floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"); }
    void primitive(const std::string& text) { primitives.push_back("{" + text + "}"); }

    std::string json() const {
        return fmt::format(
            R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],"bufferViews":[{}],)"
            R"("accessors":[{}],"meshes":[{{"primitives":[{}]}}],"nodes":[{}],"scenes":[{}]{}}})",
            chunk.size(), fmt::join(views, ","), fmt::join(accessors, ","),
            fmt::join(primitives, ","), nodes, scenes, more);
    }
    std::string glb() const { return glb_of(json(), chunk); }

    std::string chunk, nodes = R"({"mesh":0})", scenes = R"({"nodes":[0]})", more;
    std::vector<std::string> views, accessors, primitives;
};

struct GltfRead {
    Result<GltfFile> result;
    std::string warnings;
    const geom::PolygonMesh& mesh() const { return result->polygons; }
    std::string error() const { return result ? "no error" : result.error().what; }
};

inline GltfRead read_gltf_file(const std::string& file, const std::string& path = "a.glb",
                               const Reading& how = {}) {
    Warnings warnings;
    auto result = read_gltf(file, path, warnings, nullptr, how);
    return {std::move(result), fmt::format("{}", fmt::join(warnings.lines(), "\n"))};
}

} // namespace scanout::io::test
