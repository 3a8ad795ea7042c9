// Parts of an OBJ file, read in parallel and appended in order. Within a part, an index that counts
// from the file's end is stored with kBias added, since the number of elements before the part is
// not known yet; lasting statements (usemtl, s) store where in the part they begin.
#include "io/obj/reader.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace scanout::io {
namespace {

constexpr std::int64_t kBias = std::int64_t{1} << 30;
constexpr std::size_t kMaxVertices = std::size_t{1} << 29; // the limit of ObjReader::position
constexpr std::size_t kMaxSigned = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t kMaxUnsigned = std::numeric_limits<std::uint32_t>::max();

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

// Appends indices into another array, which itself was appended: adds `by` to each.
void append_moved(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from,
                  std::size_t by) {
    const std::size_t before = to.size();
    append(to, from);
    for (std::size_t i = before; i < to.size(); ++i)
        to[i] += static_cast<std::uint32_t>(by);
}

bool any_line(std::string_view) {
    return true;
}

} // namespace

bool ObjReader::read_parts() {
    if (bad_positions_ > 0) return false; // every later index must be checked
    const std::string_view rest(at_.at, static_cast<std::size_t>(at_.end - at_.at));
    const std::vector<std::string_view> texts = parts_.next(rest, any_line);
    if (texts.empty()) return false;
    Reading how;
    how.lines = notes_lines_;
    while (part_readers_.size() < texts.size())
        part_readers_.push_back(
            std::make_unique<ObjReader>(std::string_view(), path_, warnings_, progress_, how));
    parts_.jobs().for_each(static_cast<int>(texts.size()), [&](int i, int) {
        const auto at = static_cast<std::size_t>(i);
        part_readers_[at]->read_part(texts[at]);
    });
    std::size_t read_again = 0;
    for (std::size_t i = 0; i < texts.size() && !stop_; ++i) {
        const ObjReader& part = *part_readers_[i];
        if (at_.at == texts[i].data() && takes(part)) {
            take(part);
        } else {
            read_to(texts[i].data() + texts[i].size());
            ++read_again;
        }
        if (at_.at >= next_checkpoint_) checkpoint();
    }
    parts_.read_again(read_again, texts.size());
    return true;
}

void ObjReader::read_part(std::string_view text) {
    geom::PolygonMesh& m = out_.polygons;
    m.positions.clear();
    m.colours.clear();
    m.uvs.clear();
    m.normals.clear();
    m.corners.clear();
    m.face_begin.clear();
    m.face_material.clear();
    m.face_smoothing.clear();
    m.line_vertices.clear();
    m.line_begin.clear();
    m.line_material.clear();
    m.point_vertices.clear();
    m.point_material.clear();
    out_.materials.clear();
    out_.libraries.clear();
    out_.face_lines.clear();
    out_.position_lines.clear();
    material_ids_.clear();
    polypaint_.clear();
    material_ = -1;
    smoothing_ = geom::kSmoothingUnset;
    stop_.reset();
    file_ = text;
    at_ = Cursor(text);
    last_checkpoint_ = at_.at;
    next_checkpoint_ = at_.end;
    part_.emplace();
    read_to(at_.end);
    if (stop_ || at_.nul_line != 0) part_->plain = false;
}

std::int32_t ObjReader::resolve_in_part(std::int64_t index, std::size_t count, Named named) {
    ObjPart::Indices& seen = part_->indices[named];
    const auto n = static_cast<std::int64_t>(count);
    if (index == 0 || index > std::int64_t{kMaxSigned} || index < -kBias) return -1;
    if (index > 0) {
        seen.from_start = true;
        seen.ahead = std::max(seen.ahead, index - n);
        return static_cast<std::int32_t>(index - 1);
    }
    seen.from_end = true;
    seen.before = std::max(seen.before, -(n + index));
    return static_cast<std::int32_t>(n + index + kBias);
}

void ObjReader::note_material_in_part() {
    const geom::PolygonMesh& m = out_.polygons;
    if (!part_->before_material)
        part_->before_material = {m.faces(), m.line_begin.size(), m.point_vertices.size()};
}

bool ObjReader::takes(const ObjReader& part) const {
    const geom::PolygonMesh &m = out_.polygons, &p = part.out_.polygons;
    const std::size_t before[named_count] = {m.positions.size(), m.uvs.size(), m.normals.size()};
    bool holds = part.part_->plain && bad_positions_ == 0;
    for (std::size_t i = 0; i < named_count; ++i) {
        const ObjPart::Indices& seen = part.part_->indices[i];
        const auto there = static_cast<std::int64_t>(before[i]);
        holds = holds && seen.ahead <= there && seen.before <= there &&
                !(seen.from_start && seen.from_end);
    }
    return holds && m.positions.size() + p.positions.size() < kMaxVertices &&
           m.uvs.size() + p.uvs.size() < kMaxSigned &&
           m.normals.size() + p.normals.size() < kMaxSigned &&
           m.corners.size() + p.corners.size() < kMaxUnsigned &&
           m.line_vertices.size() + p.line_vertices.size() < kMaxUnsigned &&
           m.point_vertices.size() + p.point_vertices.size() < kMaxUnsigned;
}

void ObjReader::take(const ObjReader& part) {
    for (const NameAtLine& library : part.out_.libraries)
        out_.libraries.push_back({library.name, library.line + at_.line - 1});
    take_elements(part); // first, since it depends on the state before the part
    take_vertices(part);
    append(polypaint_, part.polypaint_);
    append_moved(out_.face_lines, part.out_.face_lines, at_.line - 1);
    append_moved(out_.position_lines, part.out_.position_lines, at_.line - 1);
    at_.at = part.at_.at;
    at_.line += part.at_.line - 1;
}

void ObjReader::take_vertices(const ObjReader& part) {
    geom::PolygonMesh& m = out_.polygons;
    const geom::PolygonMesh& p = part.out_.polygons;
    if (!m.colours.empty() || !p.colours.empty()) {
        m.colours.resize(m.positions.size(), Vec3(1));
        append(m.colours, p.colours);
        m.colours.resize(m.positions.size() + p.positions.size(), Vec3(1));
    }
    append(m.positions, p.positions);
    append(m.uvs, p.uvs);
    append(m.normals, p.normals);
}

void ObjReader::take_elements(const ObjReader& part) {
    geom::PolygonMesh& m = out_.polygons;
    const geom::PolygonMesh& p = part.out_.polygons;
    const auto moved_by = [&](Named named, std::size_t before) {
        return part.part_->indices[named].from_end ? static_cast<std::int64_t>(before) - kBias : 0;
    };
    const std::int64_t by[named_count] = {moved_by(named_position, m.positions.size()),
                                          moved_by(named_uv, m.uvs.size()),
                                          moved_by(named_normal, m.normals.size())};
    const auto move = [&](std::int32_t& index, Named named) {
        if (index >= 0) index = static_cast<std::int32_t>(index + by[named]);
    };
    take_smoothing(part);
    append_moved(m.face_begin, p.face_begin, m.corners.size());
    append_moved(m.line_begin, p.line_begin, m.line_vertices.size());
    const std::size_t corners = m.corners.size();
    append(m.corners, p.corners);
    for (std::size_t c = corners; c < m.corners.size(); ++c) {
        move(m.corners[c].position, named_position);
        move(m.corners[c].uv, named_uv);
        move(m.corners[c].normal, named_normal);
    }
    append_moved(m.line_vertices, p.line_vertices, static_cast<std::size_t>(by[named_position]));
    append_moved(m.point_vertices, p.point_vertices, static_cast<std::size_t>(by[named_position]));

    std::vector<std::int32_t> ids; // of the part's materials
    for (const NameAtLine& material : part.out_.materials) {
        const auto next = static_cast<std::int32_t>(out_.materials.size());
        const auto [entry, is_new] = material_ids_.try_emplace(material.name, next);
        if (is_new) out_.materials.push_back({material.name, material.line + at_.line - 1});
        ids.push_back(entry->second);
    }
    const auto id_of = [&](std::int32_t id) {
        return id < 0 ? -1 : ids[static_cast<std::size_t>(id)];
    };
    constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
    const auto before = part.part_->before_material.value_or(std::array{kAll, kAll, kAll});
    const auto take_materials = [&](std::vector<std::int32_t>& to,
                                    const std::vector<std::int32_t>& from, std::size_t inherit) {
        for (std::size_t i = 0; i < from.size(); ++i)
            to.push_back(i < inherit ? material_ : id_of(from[i]));
    };
    take_materials(m.face_material, p.face_material, before[0]);
    take_materials(m.line_material, p.line_material, before[1]);
    take_materials(m.point_material, p.point_material, before[2]);
    if (part.part_->before_material) material_ = id_of(part.material_);
}

// Call before the part's faces are taken.
void ObjReader::take_smoothing(const ObjReader& part) {
    geom::PolygonMesh& m = out_.polygons;
    const geom::PolygonMesh& p = part.out_.polygons;
    const std::optional<std::size_t>& inherit = part.part_->before_smoothing;
    if (inherit) m.face_smoothing.resize(m.faces(), geom::kSmoothingUnset);
    if (smoothing_ != geom::kSmoothingUnset || inherit)
        m.face_smoothing.insert(m.face_smoothing.end(), inherit.value_or(p.faces()), smoothing_);
    if (!inherit) return;
    m.face_smoothing.insert(m.face_smoothing.end(),
                            p.face_smoothing.begin() + static_cast<std::ptrdiff_t>(*inherit),
                            p.face_smoothing.end());
    smoothing_ = part.smoothing_;
}

} // namespace scanout::io
