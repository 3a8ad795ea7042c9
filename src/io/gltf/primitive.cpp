#include "io/gltf/primitive.h"

#include "io/text.h"

#include <fmt/format.h>

namespace scanout::io::gltf {

static constexpr int kMostSets = 4; // of four joints each

Result<const UnpackedDraco*> Primitives::draco(Index mesh, std::size_t number) {
    const Primitive& p = document_.meshes[static_cast<std::size_t>(mesh)].primitives[number];
    if (!p.draco) return nullptr;
    const std::string what = fmt::format("meshes[{}].primitives[{}]", mesh, number);
    if (p.draco->view < 0)
        return fail(Exit::unreadable, "{}: {}: its Draco data names no buffer view", path_, what);
    TRY(const ViewBytes bytes, buffers_.view(p.draco->view));
    TRY(UnpackedDraco unpacked, unpack_draco(bytes.bytes, p, document_, budget_, path_, what));
    return &unpacked_.emplace_back(std::move(unpacked));
}

std::optional<View> Primitives::attribute(const Attributes& attributes, const UnpackedDraco* packed,
                                          std::string_view name, int least_rows,
                                          std::uint64_t count, const std::string& place) {
    const Index index = gltf::find(attributes, name);
    if (index < 0) return std::nullopt;
    const auto without = [&](std::string_view why) -> std::optional<View> {
        warnings_.add(fmt::format("glTF {}", name),
                      fmt::format("{}; drawn without {}", why, shown(name)));
        return std::nullopt;
    };
    const View* unpacked = packed != nullptr ? packed->find(name) : nullptr;
    Result<View> view = unpacked != nullptr ? Result<View>(*unpacked) : accessors_.view(index);
    if (!view) return without(view.error().what);
    const Accessor& a = document_.accessors[static_cast<std::size_t>(index)];
    if (view->rows < least_rows || a.columns != 1)
        return without(fmt::format("{}: accessors[{}] has {} numbers an element, {} are needed",
                                   place, index, view->rows * a.columns, least_rows));
    if (view->count < count)
        return without(fmt::format("{}: accessors[{}] has {} elements for {} vertices", place,
                                   index, view->count, count));
    view->count = count;
    return *view;
}

Result<PrimitiveData> Primitives::find(Index mesh, std::size_t number, int uv_set) {
    const Primitive& p = document_.meshes[static_cast<std::size_t>(mesh)].primitives[number];
    const std::string place = fmt::format("{}: meshes[{}].primitives[{}]", path_, mesh, number);
    if (!p.fault.empty()) return fail(Exit::unreadable, "{}.{}: left out", place, p.fault);
    if (p.mode > 6)
        return fail(Exit::unreadable, "{}: mode {} is none of glTF's: left out", place, p.mode);
    const Index positions = gltf::find(p.attributes, "POSITION");
    if (positions < 0) return fail(Exit::unreadable, "{} has no POSITION: left out", place);
    auto found = draco(mesh, number);
    // A file may hold plain data beside what is packed.
    if (!found && document_.accessors[static_cast<std::size_t>(positions)].view < 0)
        return tl::unexpected<Error>(found.error());
    const UnpackedDraco* packed = found ? *found : nullptr;
    PrimitiveData data;
    data.mode = static_cast<Mode>(p.mode);
    data.material = p.material;
    const View* unpacked = packed != nullptr ? packed->find("POSITION") : nullptr;
    if (unpacked != nullptr) {
        data.positions = *unpacked;
    } else {
        TRY(data.positions, accessors_.view(positions));
    }
    if (data.positions.rows != 3 ||
        document_.accessors[static_cast<std::size_t>(positions)].columns != 1)
        return fail(Exit::unreadable,
                    "{}: accessors[{}] gives no three numbers a position: left out", place,
                    positions);
    const std::uint64_t count = data.positions.count;
    if (packed != nullptr && !packed->indices.empty()) {
        if (data.mode == Mode::triangle_strip) data.mode = Mode::triangles; // unpacked as such
        data.indices = View{reinterpret_cast<const std::uint8_t*>(packed->indices.data()),
                            packed->indices.size(),
                            4,
                            Component::u32,
                            1,
                            false};
    } else if (p.indices >= 0) {
        TRY(const View indices, accessors_.view(p.indices));
        if (indices.rows != 1 || !is_index(indices.component))
            return fail(Exit::unreadable,
                        "{}: accessors[{}] holds no unsigned whole numbers, as indices are: left "
                        "out",
                        place, p.indices);
        data.indices = indices;
    }
    data.normals = attribute(p.attributes, packed, "NORMAL", 3, count, place);
    data.colours = attribute(p.attributes, packed, "COLOR_0", 3, count, place);
    data.uvs = attribute(p.attributes, packed, fmt::format("TEXCOORD_{}", uv_set), 2, count, place);
    for (int set = 0; set < kMostSets; ++set) {
        const auto joints =
            attribute(p.attributes, packed, fmt::format("JOINTS_{}", set), 4, count, place);
        const auto weights =
            attribute(p.attributes, packed, fmt::format("WEIGHTS_{}", set), 4, count, place);
        if (!joints || !weights) break;
        data.influences.push_back({*joints, *weights});
    }
    for (std::size_t i = 0; targets_ && i < p.targets.size(); ++i) {
        const Attributes& target = p.targets[i];
        data.targets.push_back({attribute(target, nullptr, "POSITION", 3, count, place),
                                attribute(target, nullptr, "NORMAL", 3, count, place)});
    }
    return data;
}

} // namespace scanout::io::gltf
