// The statements that name vertices: f, l, p. Indices count from 1; negative ones count back from
// the last vertex before the statement (-1), so they are resolved where they stand. Arithmetic is
// in int64 and every index is checked: below 1 here, beyond the end when the file's end is known.
#include "geom/framing.h"
#include "io/obj/reader.h"
#include "io/text.h"

#include <algorithm>
#include <limits>

namespace scanout::io {
namespace {

// Removes the elements at `places` (ascending).
template <class T>
void erase_at(std::vector<T>& values, const std::vector<std::uint32_t>& places) {
    if (values.empty() || places.empty()) return;
    auto next = places.begin();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (next != places.end() && *next == i)
            ++next;
        else
            values[kept++] = values[i];
    }
    values.resize(kept);
}

// The same for runs of items: run i is items[begin[i]] up to the next run's begin.
template <class Item>
void erase_runs(std::vector<std::uint32_t>& begin, std::vector<Item>& items,
                const std::vector<std::uint32_t>& places) {
    auto next = places.begin();
    std::size_t kept_runs = 0, kept_items = 0;
    const std::size_t runs = begin.size();
    for (std::size_t i = 0; i < runs; ++i) {
        const std::size_t first = begin[i], last = i + 1 < runs ? begin[i + 1] : items.size();
        if (next != places.end() && *next == i) {
            ++next;
            continue;
        }
        begin[kept_runs++] = static_cast<std::uint32_t>(kept_items);
        for (std::size_t k = first; k < last; ++k)
            items[kept_items++] = items[k];
    }
    begin.resize(kept_runs);
    items.resize(kept_items);
}

} // namespace

std::int32_t ObjReader::resolve(std::int64_t index, std::size_t count, Named named) {
    if (part_) return resolve_in_part(index, count, named);
    const auto n = static_cast<std::int64_t>(count);
    if (index < 0) return n + index >= 0 ? static_cast<std::int32_t>(n + index) : -1;
    if (index == 0 || index > std::numeric_limits<std::int32_t>::max()) return -1;
    if (index > n) doubtful_ = true;
    return static_cast<std::int32_t>(index - 1);
}

std::int32_t ObjReader::resolve_optional(std::int64_t index, std::size_t count, Named named) {
    const std::int32_t resolved = resolve(index, count, named);
    const std::string_view what = named == named_uv ? "texture coordinate" : "normal";
    if (resolved < 0)
        warn(what, at_.line,
             "{} {} does not exist, the file has {} so far; the face is drawn without", what, index,
             count);
    return resolved;
}

// v, v/vt, v//vn or v/vt/vn; a slash with nothing behind it is forgiven. A texture coordinate or
// normal that does not exist is left away: the face can still be shown.
bool ObjReader::corner(geom::Corner& corner) {
    const geom::PolygonMesh& m = out_.polygons;
    std::int64_t index = 0;
    if (!read_integer(at_.at, at_.end, index)) return false;
    corner.position = resolve(index, m.positions.size(), named_position);
    if (corner.position < 0) return false;
    const auto position = static_cast<std::size_t>(corner.position);
    if (bad_positions_ > 0 && position < m.positions.size() &&
        !geom::is_finite(m.positions[position]))
        doubtful_ = true;
    if (at_.done() || *at_.at != '/') return at_.at_word_end();
    ++at_.at;
    if (read_integer(at_.at, at_.end, index))
        corner.uv = resolve_optional(index, m.uvs.size(), named_uv);
    if (at_.done() || *at_.at != '/') return at_.at_word_end();
    ++at_.at;
    if (read_integer(at_.at, at_.end, index))
        corner.normal = resolve_optional(index, m.normals.size(), named_normal);
    return at_.at_word_end();
}

void ObjReader::face() {
    geom::PolygonMesh& m = out_.polygons;
    const std::size_t begin = m.corners.size(), line = at_.line;
    doubtful_ = false;
    bool good = true;
    for (at_.skip_blanks(); good && !at_.at_statement_end(); at_.skip_blanks()) {
        const char* word = at_.at;
        geom::Corner c;
        good = corner(c);
        if (!good) {
            at_.at = word;
            warn("face", at_.line,
                 "'{}' names no vertex (the file has {} so far); the face is skipped", word_here(),
                 m.positions.size());
            break;
        }
        m.corners.push_back(c);
        if (at_.at >= next_checkpoint_) checkpoint();
    }
    const std::size_t corners = m.corners.size() - begin;
    if (good && corners < 3)
        warn("face corners", line, "a face needs 3 corners, this one has {}; skipped", corners);
    if (!good || corners < 3) {
        m.corners.resize(begin);
        ++out_.skipped;
        return;
    }
    if (m.corners.size() > std::numeric_limits<std::uint32_t>::max())
        return stop("has more than 4294967295 face corners");
    if (doubtful_) doubtful_faces_.push_back({static_cast<std::uint32_t>(m.faces()), line});
    m.face_begin.push_back(static_cast<std::uint32_t>(begin));
    m.face_material.push_back(material_);
    note_line(out_.face_lines, line);
    if (smoothing_ != geom::kSmoothingUnset) m.face_smoothing.push_back(smoothing_);
}

// l v1/vt1 v2/vt2 ...; a line's texture coordinates have no use and are read over.
void ObjReader::polyline() {
    geom::PolygonMesh& m = out_.polygons;
    const std::size_t begin = m.line_vertices.size(), line = at_.line;
    doubtful_ = false;
    bool good = true;
    for (at_.skip_blanks(); good && !at_.at_statement_end(); at_.skip_blanks()) {
        const char* word = at_.at;
        geom::Corner c;
        good = corner(c);
        if (good)
            m.line_vertices.push_back(static_cast<std::uint32_t>(c.position));
        else
            at_.at = word;
        if (at_.at >= next_checkpoint_) checkpoint();
    }
    const std::size_t vertices = m.line_vertices.size() - begin;
    if (!good)
        warn("line", at_.line, "'{}' names no vertex (the file has {} so far); the line is skipped",
             word_here(), m.positions.size());
    else if (vertices < 2)
        warn("line", line, "a line needs 2 vertices, this one has {}; skipped", vertices);
    if (!good || vertices < 2) {
        m.line_vertices.resize(begin);
        ++out_.skipped;
        return;
    }
    if (m.line_vertices.size() > std::numeric_limits<std::uint32_t>::max())
        return stop("has more than 4294967295 line vertices");
    if (doubtful_)
        doubtful_lines_.push_back({static_cast<std::uint32_t>(m.line_begin.size()), line});
    m.line_begin.push_back(static_cast<std::uint32_t>(begin));
    m.line_material.push_back(material_);
}

std::size_t ObjReader::line_end(std::size_t line) const {
    const geom::PolygonMesh& m = out_.polygons;
    return line + 1 < m.line_begin.size() ? m.line_begin[line + 1] : m.line_vertices.size();
}

void ObjReader::points() {
    geom::PolygonMesh& m = out_.polygons;
    for (at_.skip_blanks(); !at_.at_statement_end(); at_.skip_blanks()) {
        const char* word = at_.at;
        geom::Corner c;
        doubtful_ = false;
        if (!corner(c)) {
            at_.at = word;
            ++out_.skipped;
            warn("point", at_.line, "'{}' names no vertex (the file has {} so far); skipped",
                 word_here(), m.positions.size());
            at_.word();
            continue;
        }
        if (m.point_vertices.size() >= std::numeric_limits<std::uint32_t>::max())
            return stop("has more than 4294967295 points");
        if (doubtful_)
            doubtful_points_.push_back(
                {static_cast<std::uint32_t>(m.point_vertices.size()), at_.line});
        m.point_vertices.push_back(static_cast<std::uint32_t>(c.position));
        m.point_material.push_back(material_);
        if (at_.at >= next_checkpoint_) checkpoint();
    }
}

bool ObjReader::check_vertex(std::int64_t vertex, std::string_view what, std::size_t line) {
    const std::vector<DVec3>& positions = out_.polygons.positions;
    if (vertex >= static_cast<std::int64_t>(positions.size())) {
        warn(what, line, "the {} wants vertex {}, the file has {}; skipped", what, vertex + 1,
             positions.size());
        return false;
    }
    if (geom::is_finite(positions[static_cast<std::size_t>(vertex)])) return true;
    const std::string_view kind = what == "face"   ? "face with a bad vertex"
                                  : what == "line" ? "line with a bad vertex"
                                                   : "point with a bad vertex";
    warn(kind, line, "the {} uses vertex {}, which is not three finite numbers; skipped", what,
         vertex + 1);
    return false;
}

bool ObjReader::check_doubtful_face(std::size_t face, std::size_t line) {
    geom::PolygonMesh& m = out_.polygons;
    const auto missing = [](std::int32_t index, std::size_t count) {
        return index >= 0 && static_cast<std::size_t>(index) >= count;
    };
    bool complete = true;
    for (std::size_t i = m.face_begin[face]; i < m.face_end(face); ++i) {
        geom::Corner& c = m.corners[i];
        if (!check_vertex(c.position, "face", line)) return false;
        for (auto [index, count] : {std::pair(&c.uv, m.uvs.size()), {&c.normal, m.normals.size()}})
            if (missing(*index, count)) {
                *index = -1;
                complete = false;
            }
    }
    if (!complete)
        warn("face attributes", line,
             "the face wants texture coordinates or normals that the file does not have; drawn "
             "without");
    return true;
}

void ObjReader::check_doubtful() {
    geom::PolygonMesh& m = out_.polygons;
    std::vector<std::uint32_t> faces, lines, points;
    for (const Doubtful& d : doubtful_faces_)
        if (!check_doubtful_face(d.element, d.line)) faces.push_back(d.element);
    for (const Doubtful& d : doubtful_lines_) {
        const auto begin = m.line_vertices.begin();
        if (!std::all_of(begin + m.line_begin[d.element],
                         begin + static_cast<std::ptrdiff_t>(line_end(d.element)),
                         [&](std::uint32_t v) { return check_vertex(v, "line", d.line); }))
            lines.push_back(d.element);
    }
    for (const Doubtful& d : doubtful_points_)
        if (!check_vertex(m.point_vertices[d.element], "point", d.line))
            points.push_back(d.element);
    out_.skipped += faces.size() + lines.size() + points.size();
    if (!faces.empty()) erase_runs(m.face_begin, m.corners, faces);
    erase_at(m.face_material, faces);
    erase_at(m.face_smoothing, faces);
    erase_at(out_.face_lines, faces);
    if (!lines.empty()) erase_runs(m.line_begin, m.line_vertices, lines);
    erase_at(m.line_material, lines);
    erase_at(m.point_vertices, points);
    erase_at(m.point_material, points);
}

} // namespace scanout::io
