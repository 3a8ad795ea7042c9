#include "io/gltf/draco.h"

// Draco's headers do not compile without warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#pragma GCC diagnostic pop

namespace scanout::io::gltf {
namespace {

// What the head of a packed mesh says, which Draco believes before it has read a face.
struct Head {
    std::uint64_t faces = 0, points = 0;
};

// Draco's bitstream 2.2, 3 to 5. Nothing where it is no head of a mesh.
std::optional<Head> head_of(ByteSpan bytes) {
    draco::DecoderBuffer in;
    in.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&in, &header).ok() ||
        header.encoder_type != draco::TRIANGULAR_MESH)
        return std::nullopt;
    const int version = header.version_major * 256 + header.version_minor;
    draco::GeometryMetadata skipped;
    if ((header.flags & METADATA_FLAG_MASK) != 0 &&
        !draco::MetadataDecoder().DecodeGeometryMetadata(&in, &skipped))
        return std::nullopt;
    const bool breaks_edges = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
    const bool has_words = version < (breaks_edges ? 0x200 : 0x202); // later ones pack them
    const auto number = [&](std::uint64_t& to) {
        std::uint32_t word = 0;
        const bool there = has_words ? in.Decode(&word) : draco::DecodeVarint(&word, &in);
        to = word;
        return there;
    };
    Head head;
    if (!breaks_edges)
        return number(head.faces) && number(head.points) ? std::optional(head) : std::nullopt;
    std::uint8_t traversal = 0;
    std::uint64_t added = 0;
    if (!in.Decode(&traversal) || (version < 0x202 && !number(added)) || !number(head.points) ||
        !number(head.faces))
        return std::nullopt;
    head.points += added;
    return head;
}

// Memory of Draco's own while it decodes: 27 to 71 bytes a triangle are measured on a smooth
// surface with positions alone, by the encoder's speed.
constexpr std::uint64_t kFaceBytes = 64, kPointBytes = 32;

// Charged for as long as it lives.
struct Loan {
    Budget& budget;
    std::uint64_t bytes;
    ~Loan() { budget.give_back(bytes); }
};

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
                                   const Document& document, Budget& budget,
                                   const std::string& path, const std::string& what) {
    const auto damaged = [&] {
        return fail(Exit::unreadable, "{}: {}: its KHR_draco_mesh_compression is damaged", path,
                    what);
    };
    const auto head = head_of(bytes);
    if (!head) return damaged();
    const std::uint64_t lent = head->faces * kFaceBytes + head->points * kPointBytes;
    TRY_VOID(budget.take(lent, what));
    const Loan loan{budget, lent};
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) return damaged();
    const draco::Mesh& m = *mesh.value();
    UnpackedDraco out;
    TRY_VOID(budget.take(std::uint64_t{12} * m.num_faces(), what));
    out.indices.reserve(std::size_t{3} * m.num_faces());
    for (std::uint32_t i = 0; i < m.num_faces(); ++i)
        for (const draco::PointIndex& corner : m.face(draco::FaceIndex(i)))
            out.indices.push_back(corner.value());
    out.vertices = m.num_points();
    for (const auto& packed : primitive.draco->attributes) {
        const std::string& name = packed.first;
        const Index index = gltf::find(primitive.attributes, name);
        const draco::PointAttribute* attribute = m.GetAttributeByUniqueId(packed.second);
        if (index < 0 || attribute == nullptr) continue;
        const Accessor& a = document.accessors[static_cast<std::size_t>(index)];
        const std::uint64_t element =
            static_cast<std::uint64_t>(a.rows) * static_cast<std::uint64_t>(bytes_of(a.component));
        if (a.columns != 1 || !a.fault.empty()) continue;
        TRY_VOID(budget.take(out.vertices * element, what));
        with_type(a.component, [&](auto component) {
            out.attributes.emplace_back(name,
                                        values_of<decltype(component)>(m, *attribute, a.rows));
        });
        out.views.push_back({nullptr, out.vertices, element, a.component, a.rows, a.normalized});
    }
    for (std::size_t i = 0; i < out.views.size(); ++i)
        out.views[i].data = out.attributes[i].second.data();
    return out;
}

} // namespace scanout::io::gltf
