#include "io/ply/ply.h"

#include "base/chunks.h"
#include "geom/framing.h"
#include "io/ply/body.h"
#include "io/ply/columns.h"
#include "io/ply/header.h"
#include "io/points.h"
#include "io/text.h"
#include "io/vertex_colours.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace {

constexpr std::size_t kMaxPlyVertices = std::size_t{1} << 29; // a frame indexes as many
constexpr std::size_t kMaxPlyCorners = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t kReportRows = 65536;

class PlyReader {
public:
    PlyReader(std::string_view file, const PlyHeader& header, const std::string& path,
              Warnings& warnings, const std::function<bool(double)>& progress, Jobs& jobs,
              bool notes_lines)
        : header_(header), path_(path), warnings_(warnings), progress_(progress), jobs_(jobs),
          notes_lines_(notes_lines && header.encoding == PlyEncoding::ascii), size_(file.size()),
          body_(file, header) {
        out_.textures = header.textures;
    }

    Result<PlyFile> read();

private:
    Result<> element(const PlyElement& element);
    Result<> vertices(const PlyElement& element);
    void store_vertex(const PlyVertexColumns& columns, std::size_t vertex, const double* values);
    void make_vertices(const PlyVertexColumns& columns, std::size_t count);
    Result<> faces(const PlyElement& element);
    std::int32_t face_colour(const PlyColours& colour, const PlyRow& row);
    Result<> strips(const PlyElement& element);
    Result<> edges(const PlyElement& element);
    Result<> skip(const PlyElement& element);
    Result<> report();
    // Calls row(row's number, PlyRow) for the rows of an element that are good.
    template <class Function>
    Result<> each_row(const PlyElement& element, Function&& row, std::uint64_t first = 0);
    Result<std::uint64_t> equal_faces(const PlyElement& element, std::size_t indices);

    bool vertex_index(double value, std::int32_t& index) const;
    void bad_row(const PlyElement& element, std::size_t row, std::string_view fault);
    std::string place(const PlyElement& element, std::size_t row) const;
    std::uint32_t line() const { return static_cast<std::uint32_t>(body_.line()); }
    void drop_faces_without_vertices();
    Result<PlyFile> finish();

    const PlyHeader& header_;
    const std::string& path_;
    Warnings& warnings_;
    const std::function<bool(double)>& progress_;
    Jobs& jobs_;
    bool notes_lines_;
    std::size_t size_;
    PlyBody body_;
    PlyFile out_;
    std::uint64_t vertices_told_ = 0; // by the header: faces may stand before them
    bool has_normals_ = false, has_uvs_ = false;
    bool vertices_read_ = false;
    bool ended_ = false; // nothing behind can be read
};

Result<PlyFile> PlyReader::read() {
    for (const PlyElement& e : header_.elements)
        if (e.name == "vertex") {
            vertices_told_ = e.count;
            const auto columns = ply_vertex_columns(e);
            has_normals_ = columns && columns->normal;
            has_uvs_ = columns && columns->uv;
            break;
        }
    if (vertices_told_ > kMaxPlyVertices && size_ > kMaxPlyVertices)
        return fail(Exit::unreadable, "{}: has more than {} vertices: cut the model into parts",
                    path_, kMaxPlyVertices);
    for (const PlyElement& e : header_.elements) {
        if (ended_) break;
        TRY_VOID(element(e));
    }
    return finish();
}

Result<> PlyReader::element(const PlyElement& e) {
    if (e.properties.empty()) return {};
    if (e.name == "vertex" && !vertices_read_) return vertices(e); // the first of that name
    if (e.name == "face" && e.find(kPlyVertexLists)) return faces(e);
    if (e.name == "tristrips" && e.find(kPlyVertexLists)) return strips(e);
    if (e.name == "edge" && e.find(kPlyVertex1) && e.find(kPlyVertex2)) return edges(e);
    warnings_.add("ply element", fmt::format("{}: element '{}' has nothing to draw and is left out",
                                             path_, shown(e.name)));
    return skip(e);
}

Result<> PlyReader::report() {
    if (progress_ && !progress_(static_cast<double>(body_.position()) / static_cast<double>(size_)))
        return fail(Exit::unreadable, "{}: loading was cancelled", path_);
    return {};
}

template <class Function>
Result<> PlyReader::each_row(const PlyElement& e, Function&& row, std::uint64_t first) {
    PlyRow values;
    for (std::uint64_t i = first; i < e.count; ++i) {
        if (i % kReportRows == 0) TRY_VOID(report());
        const PlyRowState state = body_.next(e, values);
        if (state == PlyRowState::end) {
            warnings_.add("ply end",
                          fmt::format("{}: {} in {} {} of {}: what stands before is drawn", path_,
                                      body_.fault(), shown(e.name), i + 1, e.count));
            ended_ = true;
            return {};
        }
        if (state == PlyRowState::bad)
            bad_row(e, i, body_.fault());
        else
            TRY_VOID(row(i, values));
        if (body_.had_more_numbers())
            warnings_.add("ply more numbers",
                          fmt::format("{}: more numbers than the header tells; they are not read",
                                      place(e, i)));
    }
    return {};
}

Result<> PlyReader::skip(const PlyElement& e) {
    if (body_.is_binary() && !e.has_lists()) {
        const std::size_t rows =
            body_.each_of_fixed_size(e, jobs_, [](std::size_t, const std::vector<double>&) {});
        ended_ = rows < e.count;
        return {};
    }
    return each_row(e, [](std::size_t, const PlyRow&) -> Result<> { return {}; });
}

std::string PlyReader::place(const PlyElement& e, std::size_t row) const {
    return body_.is_binary() ? fmt::format("{}: {} {}", path_, shown(e.name), row + 1)
                             : fmt::format("{}:{}", path_, body_.line());
}

void PlyReader::bad_row(const PlyElement& e, std::size_t row, std::string_view fault) {
    ++out_.skipped;
    warnings_.add("ply " + e.name.substr(0, 40),
                  fmt::format("{}: {}; this {} is left out", place(e, row), fault, shown(e.name)));
}

// --- Vertices

void PlyReader::make_vertices(const PlyVertexColumns& columns, std::size_t count) {
    geom::PolygonMesh& m = out_.polygons;
    m.positions.resize(count, DVec3(std::numeric_limits<double>::quiet_NaN()));
    if (columns.normal) m.normals.resize(count, Vec3(0));
    if (columns.uv) m.uvs.resize(count, DVec2(0));
    if (columns.colour || columns.splat_colour) m.colours.resize(count, Vec3(1));
}

void PlyReader::store_vertex(const PlyVertexColumns& columns, std::size_t vertex,
                             const double* values) {
    constexpr double kHarmonic = 0.28209479177387814; // the constant spherical harmonic
    geom::PolygonMesh& m = out_.polygons;
    for (int i = 0; i < 3; ++i)
        m.positions[vertex][i] = values[columns.position[static_cast<std::size_t>(i)]];
    if (columns.normal)
        for (int i = 0; i < 3; ++i)
            m.normals[vertex][i] =
                static_cast<float>(values[(*columns.normal)[static_cast<std::size_t>(i)]]);
    if (columns.uv) m.uvs[vertex] = DVec2(values[(*columns.uv)[0]], values[(*columns.uv)[1]]);
    for (std::size_t i = 0; i < 3; ++i)
        if (columns.colour)
            m.colours[vertex][static_cast<int>(i)] =
                static_cast<float>(values[columns.colour->property[i]] * columns.colour->scale[i]);
        else if (columns.splat_colour)
            m.colours[vertex][static_cast<int>(i)] =
                static_cast<float>(0.5 + kHarmonic * values[(*columns.splat_colour)[i]]);
}

Result<> PlyReader::vertices(const PlyElement& e) {
    vertices_read_ = true;
    const auto columns = ply_vertex_columns(e);
    if (!columns)
        return fail(Exit::unreadable, "{}: its vertices have no x, y and z: nothing to draw",
                    path_);
    if (columns->splat_colour)
        warnings_.add("splats",
                      fmt::format("{}: Gaussian splats are shown as their points", path_));
    if (body_.is_binary() && !e.has_lists()) {
        const std::uint64_t rows = size_ / e.least_row_bytes();
        make_vertices(*columns, static_cast<std::size_t>(std::min(e.count, rows)));
        const std::size_t read = body_.each_of_fixed_size(
            e, jobs_, [&](std::size_t i, const std::vector<double>& values) {
                store_vertex(*columns, i, values.data());
            });
        make_vertices(*columns, read);
        if (read < e.count) {
            ended_ = true;
            warnings_.add("ply end",
                          fmt::format("{}: the file ends in vertex {} of {}: what stands before is "
                                      "drawn",
                                      path_, read + 1, e.count));
        }
        return {};
    }
    std::vector<double> first_of_each;
    TRY_VOID(each_row(e, [&](std::size_t i, const PlyRow& row) -> Result<> {
        if (i >= kMaxPlyVertices)
            return fail(Exit::unreadable, "{}: has more than {} vertices: cut the model into parts",
                        path_, kMaxPlyVertices);
        first_of_each.assign(e.properties.size(), 0);
        for (std::size_t p = 0; p < e.properties.size(); ++p)
            if (!row.list(p).empty()) first_of_each[p] = row.list(p)[0];
        make_vertices(*columns, i + 1); // rows with a fault between are vertices that are missing
        store_vertex(*columns, i, first_of_each.data());
        if (notes_lines_) {
            out_.position_lines.resize(i, line());
            out_.position_lines.push_back(line());
        }
        return {};
    }));
    if (!ended_) make_vertices(*columns, std::min<std::uint64_t>(e.count, size_));
    return {};
}

// --- Faces, strips, edges

bool PlyReader::vertex_index(double value, std::int32_t& index) const {
    if (!(value >= 0 && value < static_cast<double>(std::min<std::uint64_t>(
                                    vertices_told_, std::numeric_limits<std::int32_t>::max()))))
        return false;
    index = static_cast<std::int32_t>(value);
    return index == value;
}

// Most files' faces all have as many corners, so that it is known where each row stands and all
// cores read them: 8 times as fast. Returns how many were read; ends before the first row that
// differs or has a fault.
Result<std::uint64_t> PlyReader::equal_faces(const PlyElement& e, std::size_t indices) {
    constexpr std::size_t kBatch = std::size_t{1} << 18, kChunk = 4096, kMostCorners = 64;
    geom::PolygonMesh& m = out_.polygons;
    const PlyType type = e.properties[indices].type;
    const std::int32_t material = out_.textures.size() == 1 && has_uvs_ ? 0 : -1;
    std::uint64_t done = 0;
    for (bool whole = true; whole && done < e.count;) {
        TRY_VOID(report());
        const auto wanted =
            static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, e.count - done));
        const PlyBody::EqualRows rows = body_.equal_rows(e, wanted, jobs_);
        const std::size_t corners = m.corners.size(), faces = m.faces();
        const std::size_t n = rows.count > 0 ? rows.length[indices] : 0;
        if (n < 3 || n > kMostCorners || rows.count > (kMaxPlyCorners - corners) / n) break;
        if (done == 0) { // as many as there may be
            const std::uint64_t all = std::min<std::uint64_t>(e.count, size_ / rows.row_bytes);
            m.corners.reserve(std::min<std::uint64_t>(all * n, kMaxPlyCorners));
            m.face_begin.reserve(all);
            m.face_material.reserve(all);
        }
        m.corners.resize(corners + rows.count * n);
        m.face_begin.resize(faces + rows.count);
        std::atomic<std::size_t> good{rows.count};
        for_chunks(jobs_, rows.count, kChunk, [&](std::size_t begin, std::size_t end, int) {
            std::array<double, kMostCorners> values;
            for (std::size_t i = begin; i < end; ++i) {
                decode_ply(type, body_.is_big_endian(),
                           rows.first + i * rows.row_bytes + rows.offset[indices], n,
                           values.data());
                m.face_begin[faces + i] = static_cast<std::uint32_t>(corners + i * n);
                for (std::size_t k = 0; k < n; ++k) {
                    geom::Corner& corner = m.corners[corners + i * n + k];
                    if (!vertex_index(values[k], corner.position)) return keep_least(good, i);
                    if (has_normals_) corner.normal = corner.position;
                    if (has_uvs_) corner.uv = corner.position;
                }
            }
        });
        whole = good == wanted;
        m.corners.resize(corners + good * n);
        m.face_begin.resize(faces + good);
        m.face_material.resize(faces + good, material);
        body_.skip_rows(rows, good);
        done += good;
    }
    return done;
}

Result<> PlyReader::faces(const PlyElement& e) {
    geom::PolygonMesh& m = out_.polygons;
    const std::size_t indices = *e.find(kPlyVertexLists);
    PlyColumn uv = e.find(kPlyTexcoord), texture = e.find(kPlyTexnumber);
    if (uv && (has_uvs_ || !e.properties[*uv].list_length_type)) uv.reset();
    if (texture && e.properties[*texture].list_length_type) texture.reset();
    const auto colour = PlyColours::find(e);
    const bool one_texture = out_.textures.size() == 1 && (uv || has_uvs_);
    std::uint64_t read = 0;
    if (body_.is_binary() && !uv && !texture && !colour) {
        TRY(read, equal_faces(e, indices));
    }
    return each_row(
        e,
        [&](std::size_t i, const PlyRow& row) -> Result<> {
            const std::span<const double> corners = row.list(indices);
            if (corners.size() < 3) {
                bad_row(e, i, fmt::format("a face of {} corners", corners.size()));
                return {};
            }
            if (m.corners.size() + corners.size() > kMaxPlyCorners)
                return fail(Exit::unreadable,
                            "{}: has more than {} corners: cut the model into parts", path_,
                            kMaxPlyCorners);
            const std::size_t begin = m.corners.size();
            const bool has_uv = uv && row.list(*uv).size() == 2 * corners.size();
            for (std::size_t k = 0; k < corners.size(); ++k) {
                geom::Corner corner;
                if (!vertex_index(corners[k], corner.position)) {
                    m.corners.resize(begin);
                    bad_row(e, i,
                            fmt::format("there is no vertex {} (the header tells of {})",
                                        corners[k], vertices_told_));
                    return {};
                }
                if (has_normals_) corner.normal = corner.position;
                if (has_uvs_) corner.uv = corner.position;
                if (has_uv) {
                    corner.uv = static_cast<std::int32_t>(m.uvs.size());
                    m.uvs.push_back(DVec2(row.list(*uv)[2 * k], row.list(*uv)[2 * k + 1]));
                }
                m.corners.push_back(corner);
            }
            m.face_begin.push_back(static_cast<std::uint32_t>(begin));
            if (notes_lines_) out_.face_lines.push_back(line());
            std::int32_t material = one_texture ? 0 : -1;
            if (texture && row.scalar(*texture) >= 0 &&
                row.scalar(*texture) < static_cast<double>(out_.textures.size()))
                material = static_cast<std::int32_t>(row.scalar(*texture));
            else if (colour && material < 0)
                material = face_colour(*colour, row);
            m.face_material.push_back(material);
            return {};
        },
        read);
}

std::int32_t PlyReader::face_colour(const PlyColours& colour, const PlyRow& row) {
    const auto code = [&](std::size_t i) {
        const double value = row.scalar(colour.property[i]) * colour.scale[i];
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
    };
    return static_cast<std::int32_t>(out_.textures.size()) +
           out_.face_colours.number(code(0), code(1), code(2));
}

// Every vertex from the third on makes a triangle with the two before it, turned the other way
// each time; -1 begins a new strip.
Result<> PlyReader::strips(const PlyElement& e) {
    geom::PolygonMesh& m = out_.polygons;
    const std::size_t indices = *e.find(kPlyVertexLists);
    return each_row(e, [&](std::size_t i, const PlyRow& row) -> Result<> {
        std::int32_t before[2] = {-1, -1}, vertex = -1;
        std::size_t length = 0;
        for (const double value : row.list(indices)) {
            if (value == -1) {
                length = 0;
                continue;
            }
            if (!vertex_index(value, vertex)) {
                bad_row(e, i,
                        fmt::format("there is no vertex {} (the header tells of {})", value,
                                    vertices_told_));
                return {};
            }
            if (length >= 2 && before[0] != before[1] && before[1] != vertex &&
                before[0] != vertex) {
                if (m.corners.size() + 3 > kMaxPlyCorners)
                    return fail(Exit::unreadable,
                                "{}: has more than {} corners: cut the model into parts", path_,
                                kMaxPlyCorners);
                m.face_begin.push_back(static_cast<std::uint32_t>(m.corners.size()));
                if (notes_lines_) out_.face_lines.push_back(line());
                m.face_material.push_back(out_.textures.size() == 1 && has_uvs_ ? 0 : -1);
                const bool turned = length % 2 == 1;
                for (const std::int32_t v :
                     {before[turned ? 1 : 0], before[turned ? 0 : 1], vertex})
                    m.corners.push_back({v, has_uvs_ ? v : -1, has_normals_ ? v : -1});
            }
            before[0] = before[1];
            before[1] = vertex;
            ++length;
        }
        return {};
    });
}

Result<> PlyReader::edges(const PlyElement& e) {
    geom::PolygonMesh& m = out_.polygons;
    const std::size_t first = *e.find(kPlyVertex1), second = *e.find(kPlyVertex2);
    return each_row(e, [&](std::size_t i, const PlyRow& row) -> Result<> {
        std::int32_t a = -1, b = -1;
        const auto has = [&](std::size_t p, std::int32_t& v) {
            return row.list(p).size() == 1 && vertex_index(row.scalar(p), v);
        };
        if (!has(first, a) || !has(second, b)) {
            bad_row(
                e, i,
                fmt::format("its vertices are not there (the header tells of {})", vertices_told_));
            return {};
        }
        m.line_begin.push_back(static_cast<std::uint32_t>(m.line_vertices.size()));
        m.line_vertices.push_back(static_cast<std::uint32_t>(a));
        m.line_vertices.push_back(static_cast<std::uint32_t>(b));
        m.line_material.push_back(-1);
        return {};
    });
}

// --- The whole

// Where the file ends before the vertices that its header tells of.
void PlyReader::drop_faces_without_vertices() {
    geom::PolygonMesh& m = out_.polygons;
    const auto count = static_cast<std::int64_t>(m.positions.size());
    std::size_t corners = 0, kept = 0;
    for (std::size_t f = 0; f < m.faces(); ++f) {
        const std::size_t begin = m.face_begin[f], end = m.face_end(f);
        if (std::any_of(m.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                        m.corners.begin() + static_cast<std::ptrdiff_t>(end),
                        [&](const geom::Corner& c) { return c.position >= count; }))
            continue;
        const std::size_t to = corners;
        for (std::size_t c = begin; c < end; ++c)
            m.corners[corners++] = m.corners[c];
        m.face_begin[kept] = static_cast<std::uint32_t>(to);
        if (notes_lines_) out_.face_lines[kept] = out_.face_lines[f];
        m.face_material[kept++] = m.face_material[f];
    }
    out_.skipped += m.faces() - kept;
    m.corners.resize(corners);
    m.face_begin.resize(kept);
    m.face_material.resize(kept);
    if (notes_lines_) out_.face_lines.resize(kept);
    std::vector<std::uint32_t> ends;
    for (std::size_t i = 0; i + 1 < m.line_vertices.size(); i += 2)
        if (m.line_vertices[i] < m.positions.size() && m.line_vertices[i + 1] < m.positions.size())
            ends.insert(ends.end(), {m.line_vertices[i], m.line_vertices[i + 1]});
    m.line_vertices = std::move(ends);
    m.line_begin.resize(m.line_vertices.size() / 2);
    for (std::size_t i = 0; i < m.line_begin.size(); ++i)
        m.line_begin[i] = static_cast<std::uint32_t>(2 * i);
    m.line_material.assign(m.line_begin.size(), -1);
}

Result<PlyFile> PlyReader::finish() {
    geom::PolygonMesh& m = out_.polygons;
    if (m.positions.size() < vertices_told_) drop_faces_without_vertices();
    if (std::none_of(m.positions.begin(), m.positions.end(), geom::is_finite))
        return fail(Exit::unreadable, "{}: a PLY file without vertices: nothing to draw", path_);
    if (!m.colours.empty()) decode_vertex_colours(m.colours, path_, warnings_);
    show_lone_vertices(m);
    return std::move(out_);
}

} // namespace

Result<PlyFile> read_ply(std::string_view file, const std::string& path, Warnings& warnings,
                         const std::function<bool(double)>& progress, const Reading& how) {
    std::optional<Jobs> alone;
    Jobs& jobs = how.jobs != nullptr ? *how.jobs : alone.emplace(1);
    TRY(const PlyHeader header, read_ply_header(file, path, warnings));
    return PlyReader(file, header, path, warnings, progress, jobs, how.lines).read();
}

} // namespace scanout::io
