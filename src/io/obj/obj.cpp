#include "io/obj/obj.h"

#include "io/obj/reader.h"
#include "io/points.h"
#include "io/text.h"
#include "io/vertex_colours.h"
#include "math/srgb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>

namespace scanout::io {
namespace {

constexpr std::ptrdiff_t kFirstInterval = std::ptrdiff_t{64} * 1024;
constexpr std::ptrdiff_t kInterval = std::ptrdiff_t{1024} * 1024;

constexpr std::array<std::string_view, 24> kFreeForm = {
    "vp",    "cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",
    "parm",  "trim",   "hole", "scrv", "sp",   "end",  "con",   "ctech",
    "stech", "bzp",    "bsp",  "cdc",  "cdp",  "res",  "cdcp",  "rat"};

// Statements that name parts or say how another program should draw them: nothing is lost without.
constexpr std::array<std::string_view, 11> kWithoutEffect = {
    "o",   "g",          "mg",        "bevel",  "c_interp", "d_interp",
    "lod", "shadow_obj", "trace_obj", "usemap", "maplib"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// What a file repeats it will go on repeating: makes room for the rest of the file at the rate of
// the last interval. Doubling would hold the old and the new copy at once, late, when they are
// large; room that is never written costs no memory.
template <class T>
void reserve_at_rate(std::vector<T>& values, std::size_t& before, double intervals_left) {
    const std::size_t rate = values.size() > before ? values.size() - before : 0;
    before = values.size();
    const double expected = static_cast<double>(rate) * intervals_left;
    if (static_cast<double>(values.capacity() - values.size()) >= expected) return;
    try {
        values.reserve(values.size() + static_cast<std::size_t>(1.25 * expected) + rate);
    } catch (const std::exception&) {
        return; // so much address space is not to be had: the vector grows by itself
    }
}

float clamped_colour(double value) {
    return static_cast<float>(std::clamp(value, 0.0, 1e6));
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

} // namespace

Result<ObjFile> read_obj(std::string_view file, const std::string& path, Warnings& warnings,
                         const std::function<bool(double)>& progress, const Reading& how) {
    if (file.empty()) return fail(Exit::unreadable, "{}: the file is empty", path);
    if (const auto reason = not_a_text_model(file))
        return fail(Exit::unreadable, "{}: {}", path, *reason);
    return ObjReader(file, path, warnings, progress, how).read();
}

Result<ObjFile> ObjReader::read() {
    if (file_.starts_with("\xef\xbb\xbf")) at_.at += 3; // UTF-8 byte-order mark
    last_checkpoint_ = at_.at;
    next_checkpoint_ = at_.end - at_.at > kFirstInterval ? at_.at + kFirstInterval : at_.end;
    while (!at_.done() && !stop_) {
        const auto left = static_cast<std::size_t>(at_.end - at_.at);
        if (!read_parts()) read_to(at_.at + std::min(left, parts_.part_bytes()));
    }
    if (stop_) {
        tell_faults();
        return tl::unexpected(*std::move(stop_));
    }
    TRY_VOID(finish());
    return std::move(out_);
}

void ObjReader::read_to(const char* end) {
    while (at_.at < end && !stop_ && (!part_ || part_->plain)) {
        statement();
        finish_statement();
    }
}

void ObjReader::statement() {
    at_.skip_blanks();
    const char* p = at_.at;
    if (at_.end - p >= 3) {
        if (*p == 'v' && Cursor::is_blank(p[1])) {
            ++at_.at;
            return position();
        }
        if (*p == 'v' && Cursor::is_blank(p[2]) && (p[1] == 't' || p[1] == 'n')) {
            at_.at += 2;
            return p[1] == 't' ? texture_coordinate() : normal();
        }
        if (*p == 'f' && Cursor::is_blank(p[1])) {
            ++at_.at;
            return face();
        }
    }
    if (!at_.at_line_end()) other_statement();
}

void ObjReader::other_statement() {
    if (*at_.at == '#') return comment();
    const std::string_view keyword = at_.word();
    if (keyword == "v") return position(); // "v\" or an empty one
    if (keyword == "vt") return texture_coordinate();
    if (keyword == "vn") return normal();
    if (keyword == "f" || keyword == "fo") return face();
    if (keyword == "l") return polyline();
    if (keyword == "p") return points();
    if (keyword == "s") return smoothing();
    if (keyword == "usemtl") return use_material();
    const std::size_t line = at_.line;
    if (keyword == "mtllib") return out_.libraries.push_back({at_.rest(), line});
    if (contains(kWithoutEffect, keyword)) return;
    ++out_.skipped;
    if (contains(kFreeForm, keyword)) return free_form_statement(keyword);
    warn("statement", line, "'{}' is no statement that OBJ readers know; skipped", shown(keyword));
}

void ObjReader::free_form_statement(std::string_view keyword) {
    if (part_) part_->plain = false;
    if (free_form_line_ == 0) free_form_line_ = at_.line;
    if (std::find(free_form_keywords_.begin(), free_form_keywords_.end(), keyword) ==
        free_form_keywords_.end())
        free_form_keywords_.emplace_back(keyword);
    while (!at_.at_statement_end()) { // over continuation lines, whose numbers are no statements
        at_.word();
        at_.skip_blanks();
        if (at_.at >= next_checkpoint_) checkpoint();
    }
}

void ObjReader::finish_statement() {
    while (!at_.skip_to_line_end(kInterval) && !stop_)
        checkpoint();
    if (at_.at >= next_checkpoint_) checkpoint();
    at_.next_line();
    for (; !at_.done() && *at_.at == '\0' && !stop_; checkpoint())
        at_.skip_nuls(kInterval);
}

template <std::size_t N>
ObjReader::Numbers<N> ObjReader::numbers() {
    Numbers<N> n;
    while (n.count < N) {
        at_.skip_blanks();
        if (at_.at_statement_end()) break;
        n.fault = at_.number(n.value[n.count]);
        if (n.fault != NumberFault::none) break;
        ++n.count;
    }
    return n;
}

void ObjReader::number_fault(std::string_view what, NumberFault fault, int wanted) {
    ++out_.skipped;
    if (fault == NumberFault::none)
        warn(what, at_.line, "a {} needs {} numbers", what, wanted);
    else
        warn(what, at_.line, "'{}' is {}; this {} is not used", word_here(),
             fault == NumberFault::too_large ? "too large a number" : "not a finite number", what);
}

std::string ObjReader::word_here() const {
    return shown(Cursor(at_).word(), 40);
}

void ObjReader::position() {
    const std::size_t line = at_.line; // a statement may go on in the next one
    const Numbers<7> n = numbers<7>();
    auto& positions = out_.polygons.positions;
    note_line(out_.position_lines, line);
    constexpr std::size_t kMaxVertices = std::size_t{1} << 29; // as many as a frame can index
    if (positions.size() >= kMaxVertices) return stop("has more than 536870912 vertices");
    if (n.count < 3) {
        number_fault("vertex", n.fault, 3);
        ++bad_positions_;
        positions.push_back(DVec3(std::numeric_limits<double>::quiet_NaN()));
    } else {
        positions.push_back(DVec3(n.value[0], n.value[1], n.value[2]));
    }
    if (n.count > 3 || n.fault != NumberFault::none || !out_.polygons.colours.empty()) colour(n);
}

// v x y z [w] or v x y z r g b. The weight w matters to free-form curves only.
void ObjReader::colour(const Numbers<7>& n) {
    auto& colours = out_.polygons.colours;
    const std::size_t vertices = out_.polygons.positions.size();
    Vec3 display(1);
    if (n.count >= 6) {
        display = Vec3(clamped_colour(n.value[3]), clamped_colour(n.value[4]),
                       clamped_colour(n.value[5]));
        colours.resize(vertices - 1, Vec3(1));
    } else if (n.count >= 3 && n.fault != NumberFault::none) {
        warn("vertex colour", at_.line, "'{}' is not a finite number; this vertex stays white",
             word_here());
    }
    if (n.count >= 6 || !colours.empty()) colours.push_back(display);
}

void ObjReader::texture_coordinate() {
    const Numbers<2> n = numbers<2>();
    const bool good = n.count == 2 || (n.count == 1 && n.fault == NumberFault::none);
    if (!good) number_fault("texture coordinate", n.fault, 2);
    if (out_.polygons.uvs.size() >= std::numeric_limits<std::int32_t>::max())
        return stop("has more than 2147483647 texture coordinates");
    out_.polygons.uvs.push_back(good ? DVec2(n.value[0], n.count == 2 ? n.value[1] : 0.0)
                                     : DVec2(0));
}

void ObjReader::normal() {
    const Numbers<3> n = numbers<3>();
    DVec3 normal(0); // zero: missing
    if (n.count == 3) {
        normal = DVec3(n.value[0], n.value[1], n.value[2]);
        // Only the direction counts: brought into float's range where its length is out of it.
        const double length =
            std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
        if (length > 1e15 || (length > 0 && length < 1e-15)) normal = normal / length;
    } else {
        number_fault("normal", n.fault, 3);
    }
    if (out_.polygons.normals.size() >= std::numeric_limits<std::int32_t>::max())
        return stop("has more than 2147483647 normals");
    out_.polygons.normals.push_back(Vec3(normal));
}

void ObjReader::comment() {
    constexpr std::string_view kPolypaint = "#MRGB ";
    const std::string_view rest(at_.at, static_cast<std::size_t>(at_.end - at_.at));
    if (!rest.starts_with(kPolypaint)) return;
    at_.at += kPolypaint.size();
    polypaint();
}

// ZBrush writes vertex colours into comments: eight hexadecimal digits a vertex, mask, red, green,
// blue, as display (sRGB) codes, in the order of the vertices.
void ObjReader::polypaint() {
    for (;;) {
        int byte[4];
        for (int i = 0; i < 4; ++i) {
            if (at_.end - at_.at < 2) return;
            const int high = hex_digit(at_.at[0]), low = hex_digit(at_.at[1]);
            if (high < 0 || low < 0) return;
            byte[i] = high * 16 + low;
            at_.at += 2;
        }
        const auto linear = [&](int i) { return srgb_decode(static_cast<std::uint8_t>(byte[i])); };
        polypaint_.push_back(Vec3(linear(1), linear(2), linear(3)));
    }
}

void ObjReader::smoothing() {
    at_.skip_blanks();
    std::int64_t group = 0;
    const char* begin = at_.at;
    if (!read_integer(at_.at, at_.end, group)) {
        const std::string_view word = at_.word();
        if (word != "off" && word != "on" && !word.empty())
            warn("smoothing group", at_.line, "'{}' is no smoothing group", shown(word));
        group = word == "on" ? 1 : 0;
    } else if (group < 0 || group >= geom::kSmoothingUnset) {
        warn("smoothing group", at_.line, "'{}' is no smoothing group",
             shown({begin, static_cast<std::size_t>(at_.at - begin)}));
        group = 0;
    }
    smoothing_ = static_cast<std::uint32_t>(group);
    if (part_ && !part_->before_smoothing) part_->before_smoothing = out_.polygons.faces();
    out_.polygons.face_smoothing.resize(out_.polygons.faces(), geom::kSmoothingUnset);
}

void ObjReader::use_material() {
    const std::size_t line = at_.line;
    std::string name = at_.rest();
    if (part_) note_material_in_part();
    if (name.empty()) {
        material_ = -1;
        return;
    }
    const auto next = static_cast<std::int32_t>(out_.materials.size());
    const auto [entry, is_new] = material_ids_.try_emplace(std::move(name), next);
    if (is_new) out_.materials.push_back({entry->first, line});
    material_ = entry->second;
}

void ObjReader::checkpoint() {
    if (at_.at < next_checkpoint_ || stop_ || part_) return;
    if (progress_ &&
        !progress_(static_cast<double>(at_.at - file_.data()) / static_cast<double>(file_.size())))
        return stop("loading was cancelled");
    reserve_ahead();
    last_checkpoint_ = at_.at;
    const std::ptrdiff_t interval =
        std::min<std::ptrdiff_t>(kInterval, 2 * (at_.at - file_.data()));
    next_checkpoint_ = at_.end - at_.at > interval ? at_.at + interval : at_.end;
}

void ObjReader::reserve_ahead() {
    geom::PolygonMesh& m = out_.polygons;
    const double left = static_cast<double>(at_.end - at_.at) /
                        std::max(1.0, static_cast<double>(at_.at - last_checkpoint_));
    reserve_at_rate(m.positions, sizes_before_[0], left);
    reserve_at_rate(m.colours, sizes_before_[1], left);
    reserve_at_rate(m.uvs, sizes_before_[2], left);
    reserve_at_rate(m.normals, sizes_before_[3], left);
    reserve_at_rate(m.corners, sizes_before_[4], left);
    std::size_t faces_before = sizes_before_[5];
    reserve_at_rate(m.face_begin, faces_before, left);
    faces_before = sizes_before_[5];
    reserve_at_rate(m.face_material, faces_before, left);
    if (!m.face_smoothing.empty()) reserve_at_rate(m.face_smoothing, sizes_before_[5], left);
    sizes_before_[5] = m.faces();
}

void ObjReader::stop(std::string reason) {
    stop_ = Error{fmt::format("{}: {}", path_, reason), Exit::unreadable};
}

Result<> ObjReader::finish() {
    check_doubtful();
    geom::PolygonMesh& m = out_.polygons;
    if (free_form_line_ != 0)
        warn("free-form", free_form_line_,
             "free-form curves and surfaces ({}) are not supported and left out",
             fmt::join(free_form_keywords_, ", "));
    if (at_.nul_line != 0) warn("NUL bytes", at_.nul_line, "NUL bytes are read as blanks");
    tell_faults();
    if (m.positions.empty())
        return fail(Exit::unreadable, "{}: holds no vertices; is it an OBJ model?", path_);
    if (bad_positions_ == m.positions.size())
        return fail(Exit::unreadable, "{}: none of its {} vertices has three finite numbers", path_,
                    bad_positions_);
    if (!m.colours.empty()) decode_vertex_colours(m.colours, path_, warnings_);
    if (!polypaint_.empty() && m.colours.empty()) {
        polypaint_.resize(m.positions.size(), Vec3(1));
        m.colours = std::move(polypaint_);
    }
    if (show_lone_vertices(m))
        warnings_.add("points",
                      fmt::format("{}: has no face, line or point that can be drawn; its vertices "
                                  "({}) are shown as points",
                                  path_, m.point_vertices.size()));
    return {};
}

void ObjReader::tell_faults() {
    std::stable_sort(faults_.begin(), faults_.end(),
                     [](const Fault& a, const Fault& b) { return a.line < b.line; });
    for (const Fault& fault : faults_) {
        warnings_.add(fault.kind, fmt::format("{}:{}: {}", path_, fault.line, fault.text));
        warnings_.add_more(fault.kind, fault.count - 1);
    }
}

} // namespace scanout::io
