#include "io/off.h"

#include "geom/framing.h"
#include "io/cursor.h"
#include "io/points.h"
#include "io/text.h"
#include "io/vertex_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace scanout::io {
namespace {

constexpr std::size_t kMaxOffVertices = std::size_t{1} << 29; // a frame indexes as many
constexpr std::size_t kMaxOffCorners = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t kReportLines = 65536;

// What stands before "OFF": which values each vertex has behind its position, in this order.
struct Keyword {
    bool texture = false, colour = false, normal = false, four = false, n_dimensions = false;
};

// The keyword that `word` is; nothing for any other word.
std::optional<Keyword> keyword_of(std::string_view word) {
    Keyword keyword;
    const auto take = [&](std::string_view prefix) {
        const bool there = word.starts_with(prefix) && word != "OFF";
        if (there) word.remove_prefix(prefix.size());
        return there;
    };
    keyword.texture = take("ST");
    keyword.colour = take("C");
    keyword.normal = take("N");
    keyword.four = take("4");
    keyword.n_dimensions = take("n");
    return word == "OFF" ? std::optional(keyword) : std::nullopt;
}

class OffReader {
public:
    OffReader(std::string_view file, const std::string& path, Warnings& warnings,
              const std::function<bool(double)>& progress, bool notes_lines)
        : begin_(file.data()), size_(file.size()), path_(path), warnings_(warnings),
          progress_(progress), notes_lines_(notes_lines), at_(file) {}

    Result<OffFile> read();

private:
    template <class... Args>
    tl::unexpected<Error> fault(fmt::format_string<Args...> format, Args&&... args) const {
        return fail(Exit::unreadable, "{}:{}: {}", path_, at_.line,
                    fmt::format(format, std::forward<Args>(args)...));
    }
    Result<> head();
    Result<> vertices();
    Result<> faces();
    void vertex();
    void face();
    std::int32_t face_colour(std::span<const double> values);
    bool next_statement();
    void end_statement();
    bool number(double& value);
    void rest_of_numbers();
    void note_line(std::vector<std::uint32_t>& lines) const {
        if (notes_lines_) lines.push_back(static_cast<std::uint32_t>(at_.line));
    }
    void bad(std::string_view what, std::string_view fault);
    Result<> report() const;
    Result<OffFile> finish();

    const char* begin_;
    std::size_t size_;
    const std::string& path_;
    Warnings& warnings_;
    const std::function<bool(double)>& progress_;
    bool notes_lines_; // Reading::lines
    Cursor at_;
    Keyword keyword_;
    std::uint64_t vertices_told_ = 0, faces_told_ = 0;
    std::vector<double> numbers_; // of the statement
    OffFile out_;
};

// Moves over empty lines and comments; false at the end of the file.
bool OffReader::next_statement() {
    for (at_.skip_blanks(); !at_.done() && at_.at_statement_end(); at_.skip_blanks()) {
        at_.skip_to_line_end(size_);
        at_.next_line();
    }
    return !at_.done();
}

void OffReader::end_statement() {
    at_.skip_to_line_end(size_);
    at_.next_line();
}

bool OffReader::number(double& value) {
    at_.skip_blanks();
    return !at_.at_statement_end() && at_.number(value) == NumberFault::none;
}

void OffReader::rest_of_numbers() {
    numbers_.clear();
    for (double value = 0; number(value);)
        numbers_.push_back(value);
}

void OffReader::bad(std::string_view what, std::string_view fault) {
    ++out_.skipped;
    warnings_.add(fmt::format("off {}", what),
                  fmt::format("{}:{}: {}; this {} is left out", path_, at_.line, fault, what));
}

Result<> OffReader::report() const {
    if (progress_ && !progress_(static_cast<double>(at_.at - begin_) / static_cast<double>(size_)))
        return fail(Exit::unreadable, "{}: loading was cancelled", path_);
    return {};
}

// The keyword may stand alone, before the counts on their line, or be left out.
Result<> OffReader::head() {
    if (!next_statement()) return fail(Exit::unreadable, "{}: the file is empty", path_);
    const Cursor before = at_;
    const std::string_view word = at_.word();
    if (const auto keyword = keyword_of(word))
        keyword_ = *keyword;
    else
        at_ = before;
    if (keyword_.four || keyword_.n_dimensions)
        return fault("a model of more than three dimensions cannot be drawn");
    at_.skip_blanks();
    const Cursor counts = at_;
    if (at_.word() == "BINARY") return fault("binary OFF is not read: save it as text, or as PLY");
    at_ = counts;
    if (!next_statement()) return fault("the counts of vertices and faces are missing");
    double vertices = 0, faces = 0;
    const auto is_count = [](double n) { return n >= 0 && n == std::floor(n) && n < 1e15; };
    if (!number(vertices) || !number(faces) || !is_count(vertices) || !is_count(faces))
        return fault("here the counts of vertices and faces belong, two whole numbers");
    vertices_told_ = static_cast<std::uint64_t>(vertices);
    faces_told_ = static_cast<std::uint64_t>(faces);
    end_statement();
    return {};
}

// --- Vertices

Result<> OffReader::vertices() {
    for (std::uint64_t i = 0; i < vertices_told_; ++i) {
        if (i % kReportLines == 0) TRY_VOID(report());
        if (!next_statement()) {
            warnings_.add("off end", fmt::format("{}: the file ends after {} of {} vertices", path_,
                                                 i, vertices_told_));
            return {};
        }
        if (out_.polygons.positions.size() == kMaxOffVertices)
            return fail(Exit::unreadable, "{}: has more than {} vertices: cut the model into parts",
                        path_, kMaxOffVertices);
        rest_of_numbers();
        vertex();
        end_statement();
    }
    return {};
}

void OffReader::vertex() {
    geom::PolygonMesh& m = out_.polygons;
    note_line(out_.position_lines);
    std::span<const double> left(numbers_);
    const auto take = [&](std::size_t count) {
        const auto taken = left.first(count);
        left = left.subspan(count);
        return taken;
    };
    if (left.size() < 3) {
        bad("vertex", "a vertex needs three numbers");
        m.positions.push_back(DVec3(std::numeric_limits<double>::quiet_NaN()));
    } else {
        const auto p = take(3);
        m.positions.push_back(DVec3(p[0], p[1], p[2]));
    }
    if (keyword_.normal) {
        const auto n = left.size() >= 3 ? take(3) : std::span<const double>();
        m.normals.push_back(n.empty() ? Vec3(0) : Vec3(DVec3(n[0], n[1], n[2])));
    }
    // Many files with colours have the keyword of those without.
    const std::size_t uv = keyword_.texture ? 2 : 0;
    if (left.size() >= 3 + uv) {
        const auto c = take(left.size() - uv);
        m.colours.resize(m.positions.size() - 1, Vec3(1));
        m.colours.push_back(Vec3(DVec3(c[0], c[1], c[2])));
    } else if (!m.colours.empty()) {
        m.colours.push_back(Vec3(1));
    }
    if (keyword_.texture)
        m.uvs.push_back(left.size() >= 2 ? DVec2(left[left.size() - 2], left[left.size() - 1])
                                         : DVec2(0));
}

// --- Faces

Result<> OffReader::faces() {
    for (std::uint64_t i = 0; i < faces_told_; ++i) {
        if (i % kReportLines == 0) TRY_VOID(report());
        if (!next_statement()) {
            warnings_.add("off end", fmt::format("{}: the file ends after {} of {} faces", path_, i,
                                                 faces_told_));
            return {};
        }
        rest_of_numbers();
        if (out_.polygons.corners.size() + numbers_.size() > kMaxOffCorners)
            return fail(Exit::unreadable, "{}: has more than {} corners: cut the model into parts",
                        path_, kMaxOffCorners);
        face();
        end_statement();
    }
    return {};
}

void OffReader::face() {
    geom::PolygonMesh& m = out_.polygons;
    const double count = numbers_.empty() ? 0 : numbers_[0];
    const std::span<const double> behind = std::span(numbers_).subspan(numbers_.empty() ? 0 : 1);
    if (!(count >= 1 && count <= static_cast<double>(behind.size())))
        return bad("face",
                   fmt::format("a face of {} corners with {} numbers", count, behind.size()));
    const auto corners = behind.first(static_cast<std::size_t>(count));
    for (const double v : corners)
        if (!(v >= 0 && v == std::floor(v) && v < static_cast<double>(m.positions.size())))
            return bad("face",
                       fmt::format("there is no vertex {} (there are {})", v, m.positions.size()));
    const auto index = [&](std::size_t k) { return static_cast<std::int32_t>(corners[k]); };
    if (corners.size() == 1) {
        m.point_vertices.push_back(static_cast<std::uint32_t>(index(0)));
        m.point_material.push_back(-1);
        return;
    }
    if (corners.size() == 2) {
        m.line_begin.push_back(static_cast<std::uint32_t>(m.line_vertices.size()));
        for (std::size_t k = 0; k < 2; ++k)
            m.line_vertices.push_back(static_cast<std::uint32_t>(index(k)));
        m.line_material.push_back(-1);
        return;
    }
    note_line(out_.face_lines);
    m.face_begin.push_back(static_cast<std::uint32_t>(m.corners.size()));
    m.face_material.push_back(face_colour(behind.subspan(corners.size())));
    for (std::size_t k = 0; k < corners.size(); ++k)
        m.corners.push_back(
            {index(k), keyword_.texture ? index(k) : -1, keyword_.normal ? index(k) : -1});
}

// Three or four numbers, bytes or shares; one number would be a row of a colour map that no file
// brings along.
std::int32_t OffReader::face_colour(std::span<const double> values) {
    if (values.size() < 3) return -1;
    const bool bytes =
        std::any_of(values.begin(), values.begin() + 3, [](double v) { return v > 1; });
    const auto code = [&](double value) {
        return static_cast<std::uint8_t>(
            std::lround(std::clamp(bytes ? value / 255 : value, 0.0, 1.0) * 255));
    };
    return out_.face_colours.number(code(values[0]), code(values[1]), code(values[2]));
}

Result<OffFile> OffReader::finish() {
    geom::PolygonMesh& m = out_.polygons;
    if (std::none_of(m.positions.begin(), m.positions.end(), geom::is_finite))
        return fail(Exit::unreadable, "{}: an OFF file without vertices: nothing to draw", path_);
    if (!m.colours.empty()) decode_vertex_colours(m.colours, path_, warnings_);
    show_lone_vertices(m);
    return std::move(out_);
}

Result<OffFile> OffReader::read() {
    TRY_VOID(head());
    TRY_VOID(vertices());
    TRY_VOID(faces());
    return finish();
}

} // namespace

bool is_off(std::string_view file) {
    Cursor at(file.substr(0, 4096));
    at.skip_blanks();
    while (!at.done() && at.at_statement_end()) {
        at.skip_to_line_end(4096);
        at.next_line();
        at.skip_blanks();
    }
    return keyword_of(at.word()).has_value();
}

Result<OffFile> read_off(std::string_view file, const std::string& path, Warnings& warnings,
                         const std::function<bool(double)>& progress, const Reading& how) {
    if (const auto reason = not_a_text_model(file))
        return fail(Exit::unreadable, "{}: {}", path, *reason);
    return OffReader(file, path, warnings, progress, how.lines).read();
}

} // namespace scanout::io
