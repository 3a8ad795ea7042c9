#include "io/gltf_draco.h"

// Draco's headers do not compile without warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

namespace scanout::io::gltf {
namespace {

// The packed head says how many there are, so no more is unpacked than may be taken.
template <class T>
Bytes values_of(const draco::PointCloud& cloud, const draco::PointAttribute& attribute, int rows) {
    const std::size_t element = sizeof(T) * static_cast<std::size_t>(rows);
    Bytes bytes(element * cloud.num_points());
    T value[4] = {};
    for (std::uint32_t i = 0; i < cloud.num_points(); ++i) {
        attribute.ConvertValue<T>(attribute.mapped_index(draco::PointIndex(i)),
                                  static_cast<std::int8_t>(rows), value);
        std::memcpy(bytes.data() + i * element, value, element);
    }
    return bytes;
}

} // namespace

const View* UnpackedDraco::find(std::string_view name) const {
    for (std::size_t i = 0; i < attributes.size(); ++i)
        if (attributes[i].first == name) return &views[i];
    return nullptr;
}

Result<UnpackedDraco> unpack_draco(ByteSpan bytes, const Primitive& primitive,
                                   const Document& document, Buffers& memory,
                                   const std::string& place) {
    const auto damaged = [&] {
        return fail(Exit::unreadable, "{}: its KHR_draco_mesh_compression is damaged", place);
    };
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!type.ok()) return damaged();
    draco::Decoder decoder;
    std::unique_ptr<draco::PointCloud> cloud;
    UnpackedDraco out;
    if (type.value() == draco::TRIANGULAR_MESH) {
        auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
        if (!mesh.ok()) return damaged();
        const draco::Mesh& m = *mesh.value();
        TRY_VOID(memory.take(std::uint64_t{12} * m.num_faces(), place));
        out.indices.reserve(std::size_t{3} * m.num_faces());
        for (std::uint32_t i = 0; i < m.num_faces(); ++i)
            for (const draco::PointIndex& corner : m.face(draco::FaceIndex(i)))
                out.indices.push_back(corner.value());
        cloud = std::move(mesh).value();
    } else {
        auto points = decoder.DecodePointCloudFromBuffer(&buffer);
        if (!points.ok()) return damaged();
        cloud = std::move(points).value();
    }
    out.vertices = cloud->num_points();
    for (const auto& packed : primitive.draco->attributes) {
        const std::string& name = packed.first;
        const Index index = gltf::find(primitive.attributes, name);
        const draco::PointAttribute* attribute = cloud->GetAttributeByUniqueId(packed.second);
        if (index < 0 || attribute == nullptr) continue;
        const Accessor& a = document.accessors[static_cast<std::size_t>(index)];
        const std::uint64_t element =
            static_cast<std::uint64_t>(a.rows) * static_cast<std::uint64_t>(bytes_of(a.component));
        if (a.columns != 1) continue;
        TRY_VOID(memory.take(out.vertices * element, place));
        with_type(a.component, [&](auto component) {
            out.attributes.emplace_back(name,
                                        values_of<decltype(component)>(*cloud, *attribute, a.rows));
        });
        out.views.push_back({nullptr, out.vertices, element, a.component, a.rows, a.normalized});
    }
    for (std::size_t i = 0; i < out.views.size(); ++i)
        out.views[i].data = out.attributes[i].second.data();
    return out;
}

} // namespace scanout::io::gltf
