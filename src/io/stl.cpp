#include "io/stl.h"

#include "geom/framing.h"
#include "geom/join_table.h"
#include "io/cursor.h"
#include "io/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace {

using Triangle = std::array<DVec3, 3>;

// A binary file: 80 bytes of anything, the number of facets, then for each facet its normal, its
// three vertices (12 floats, little endian) and two bytes that some programs use for a colour.
constexpr std::size_t kHeader = 84, kFacet = 50;
constexpr std::size_t kMostFacets = (std::size_t{1} << 29) / 3; // a frame indexes 2^29 vertices

std::uint32_t little_endian(const char* bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

Triangle binary_facet(std::string_view file, std::size_t facet) {
    const char* at = file.data() + kHeader + facet * kFacet + 12; // the normal is not used
    Triangle triangle;
    for (DVec3& vertex : triangle)
        for (int axis = 0; axis < 3; ++axis, at += 4)
            vertex[axis] = std::bit_cast<float>(little_endian(at));
    return triangle;
}

bool is_finite(const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [](const DVec3& v) { return geom::is_finite(v); });
}

// Gathers facets. Vertices on the same place become one, so that normals can be shared.
class Collector {
public:
    Collector(const std::string& path, Warnings& warnings, std::size_t expected)
        : path_(path), warnings_(warnings), positions_(expected / 2) {
        result_.polygons.positions.reserve(expected / 2);
        result_.polygons.corners.reserve(expected * 3);
        result_.polygons.face_begin.reserve(expected);
    }

    void add(const Triangle& triangle) {
        geom::PolygonMesh& m = result_.polygons;
        m.face_begin.push_back(static_cast<std::uint32_t>(m.corners.size()));
        for (const DVec3& vertex : triangle) {
            const DVec3 v = vertex + 0.0; // -0 becomes 0
            geom::Corner corner;
            corner.position = static_cast<std::int32_t>(positions_.find_or_add(
                hash(v), [&](std::uint32_t i) { return m.positions[i] == v; },
                [&] { m.positions.push_back(v); },
                [&](std::uint32_t i) { return hash(m.positions[i]); }));
            m.corners.push_back(corner);
        }
    }

    // `line`: the finished message, with its place.
    void skip(std::string line) {
        if (result_.skipped++ == 0) first_fault_ = line;
        warnings_.add("stl facet", std::move(line));
    }

    Result<StlResult> finish() {
        result_.facets = result_.polygons.faces();
        if (result_.skipped > 0 && result_.facets == 0)
            return fail(Exit::unreadable, "{}; {} has no facet that can be drawn", first_fault_,
                        path_);
        if (result_.facets == 0)
            return fail(Exit::unreadable, "{}: an STL file without facets: nothing to draw", path_);
        result_.polygons.face_material.assign(result_.facets, -1);
        return std::move(result_);
    }

private:
    static std::uint64_t hash(const DVec3& v) {
        std::uint64_t h = geom::mix_bits(std::bit_cast<std::uint64_t>(v.x));
        h = geom::mix_bits(h + std::bit_cast<std::uint64_t>(v.y));
        return geom::mix_bits(h + std::bit_cast<std::uint64_t>(v.z));
    }

    const std::string& path_;
    Warnings& warnings_;
    geom::JoinTable positions_;
    StlResult result_;
    std::string first_fault_;
};

Result<> report(const std::function<bool(double)>& progress, std::size_t done, std::size_t size,
                const std::string& path) {
    if (progress && !progress(static_cast<double>(done) / static_cast<double>(size)))
        return fail(Exit::unreadable, "{}: loading was cancelled", path);
    return {};
}

// --- Which of the two

bool is_word(std::string_view word, std::string_view lower) {
    return word.size() == lower.size() &&
           std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
               return a == b || (a >= 'A' && a <= 'Z' && a + 32 == b);
           });
}

// The size agrees with the count that the header tells. The first kHeader bytes are enough.
bool is_exactly_binary(std::string_view head, std::uint64_t size) {
    return head.size() >= kHeader &&
           size - kHeader == std::uint64_t{kFacet} * little_endian(head.data() + 80);
}

std::string_view without_mark(std::string_view file) {
    if (file.starts_with("\xef\xbb\xbf")) file.remove_prefix(3);
    return file;
}

// A binary file has a zero byte near its start: in its count, its coordinates or its attributes.
bool is_ascii(std::string_view file) {
    Cursor cursor(without_mark(file).substr(0, 1024));
    while (cursor.at_line_end() && !cursor.done())
        cursor.next_line();
    cursor.skip_blanks();
    const std::string_view word = cursor.word();
    return (is_word(word, "solid") || is_word(word, "facet")) &&
           file.substr(0, 1024).find('\0') == std::string_view::npos;
}

// Where the size disagrees, the facets must look like geometry: of random bytes, one facet in 300
// would have nine coordinates of moderate size.
bool is_plausibly_binary(std::string_view file) {
    if (file.size() < kHeader + kFacet) return false;
    const std::size_t looked_at = std::min<std::size_t>((file.size() - kHeader) / kFacet, 100);
    const auto moderate = [](double x) {
        return x == 0 || (std::abs(x) > 1e-20 && std::abs(x) < 1e20);
    };
    std::size_t good = 0;
    for (std::size_t i = 0; i < looked_at; ++i) {
        const Triangle t = binary_facet(file, i);
        good += std::all_of(t.begin(), t.end(), [&](const DVec3& v) {
            return moderate(v.x) && moderate(v.y) && moderate(v.z);
        });
    }
    return good * 2 >= looked_at && file.substr(0, 1024).find('\0') != std::string_view::npos;
}

// --- Binary

// How many facets to read: as many as are told, if they are there.
std::size_t facets_to_read(std::string_view file, const std::string& path, Warnings& warnings) {
    const std::size_t told = little_endian(file.data() + 80);
    const std::size_t there = (file.size() - kHeader) / kFacet;
    const std::size_t behind = file.size() - kHeader - std::min(told, there) * kFacet;
    if (told > there)
        warnings.add("stl count",
                     fmt::format("{}: the header tells of {} facets, but the file ends "
                                 "after {}: those are drawn",
                                 path, told, there));
    else if (told == 0 && there > 0)
        warnings.add("stl count",
                     fmt::format("{}: the header tells of no facets, but there are {}: "
                                 "those are drawn",
                                 path, there));
    else if (behind > 0)
        warnings.add("stl count",
                     fmt::format("{}: {} bytes behind the last facet are not read", path, behind));
    return told == 0 ? there : std::min(told, there);
}

Result<StlResult> read_binary(std::string_view file, const std::string& path, Warnings& warnings,
                              const std::function<bool(double)>& progress) {
    const std::size_t facets = facets_to_read(file, path, warnings);
    Collector collector(path, warnings, facets);
    for (std::size_t i = 0; i < facets; ++i) {
        if (i % 16384 == 0)
            TRY_VOID(
                report(progress, i * kFacet, file.size(), path)); // a facet behind: none is reread
        const Triangle triangle = binary_facet(file, i);
        if (is_finite(triangle))
            collector.add(triangle);
        else
            collector.skip(fmt::format("{}: facet {} has a coordinate that is not a finite number: "
                                       "skipped",
                                       path, i + 1));
    }
    return collector.finish();
}

// --- ASCII

// Word by word: a facet is three times "vertex X Y Z" between "facet" and "endfacet", in any case
// and layout; everything else (normals, loops, colours) is passed over. A name stands behind solid
// and endsolid, up to the line's end.
class AsciiReader {
public:
    AsciiReader(std::string_view file, const std::string& path, Collector& collector)
        : cursor_(without_mark(file)), path_(path), collector_(collector) {}

    std::size_t left() const { return static_cast<std::size_t>(cursor_.end - cursor_.at); }

    // Reads some of the file; false at its end.
    bool step() {
        constexpr std::size_t kStep = 1 << 20;
        const std::size_t until = left() > kStep ? left() - kStep : 0;
        while (left() > until)
            word();
        if (left() > 0) return true;
        if (open_) skip(fault_.empty() ? "the file ends within a facet" : fault_);
        return false;
    }

private:
    void word() {
        cursor_.skip_blanks();
        if (cursor_.at_line_end()) {
            cursor_.next_line();
            return;
        }
        const std::string_view word = cursor_.word();
        if (is_word(word, "vertex"))
            vertex();
        else if (is_word(word, "facet"))
            begin_facet();
        else if (is_word(word, "endfacet"))
            end_facet();
        else if (is_word(word, "solid") || is_word(word, "endsolid"))
            cursor_.skip_to_line_end(left());
    }

    void begin_facet() {
        if (open_) skip(fault_.empty() ? "the facet has no 'endfacet'" : fault_);
        open_ = true;
        vertices_ = 0;
        fault_.clear();
        fault_line_ = cursor_.line;
    }

    void vertex() {
        if (!open_) {
            begin_facet();
            fault("a vertex outside of a facet");
        }
        DVec3 v(0);
        for (int axis = 0; axis < 3; ++axis) {
            cursor_.skip_blanks();
            const NumberFault f = cursor_.number(v[axis]);
            if (f == NumberFault::none) continue;
            fault(f == NumberFault::too_large ? "the number is too large"
                                              : "a vertex has three numbers");
            cursor_.skip_to_line_end(left());
            return;
        }
        if (vertices_ < 3) triangle_[vertices_] = v;
        ++vertices_;
    }

    void end_facet() {
        if (open_ && fault_.empty() && vertices_ == 3)
            collector_.add(triangle_);
        else if (open_ && fault_.empty())
            skip(fmt::format("a facet of {} vertices, not three", vertices_));
        else
            skip(open_ ? fault_ : "an 'endfacet' without 'facet'");
        open_ = false;
    }

    // The first fault of a facet is the one that is told, with its own line.
    void fault(const char* what) {
        if (!fault_.empty()) return;
        fault_ = what;
        fault_line_ = cursor_.line;
    }

    void skip(std::string_view what) {
        if (!open_) fault_line_ = cursor_.line;
        collector_.skip(fmt::format("{}:{}: {}: facet skipped", path_, fault_line_, what));
    }

    Cursor cursor_;
    const std::string& path_;
    Collector& collector_;
    bool open_ = false; // within a facet
    std::size_t vertices_ = 0;
    Triangle triangle_{};
    std::string fault_; // of this facet
    std::size_t fault_line_ = 0;
};

Result<StlResult> read_ascii(std::string_view file, const std::string& path, Warnings& warnings,
                             const std::function<bool(double)>& progress) {
    Collector collector(path, warnings, file.size() / 256); // a facet has 150 to 280 characters
    AsciiReader reader(file, path, collector);
    while (reader.step())
        TRY_VOID(report(progress, file.size() - reader.left(), file.size(), path));
    return collector.finish();
}

} // namespace

std::size_t stl_facets_told(std::string_view head, std::uint64_t size) {
    return is_exactly_binary(head, size) ? little_endian(head.data() + 80) : 0;
}

Result<StlResult> read_stl(std::string_view file, const std::string& path, Warnings& warnings,
                           const std::function<bool(double)>& progress) {
    if (file.empty()) return fail(Exit::unreadable, "{}: the file is empty", path);
    if (file.size() / kFacet > kMostFacets) // an ASCII facet is longer than a binary one
        return fail(Exit::unreadable,
                    "{}: has more than {} facets, which is too many: cut the model "
                    "into parts",
                    path, kMostFacets);
    if (is_exactly_binary(file, file.size())) return read_binary(file, path, warnings, progress);
    if (is_ascii(file)) return read_ascii(file, path, warnings, progress);
    if (is_plausibly_binary(file)) return read_binary(file, path, warnings, progress);
    if (const auto reason = not_a_text_model(file))
        return fail(Exit::unreadable, "{}: {}", path, *reason);
    if (file.size() < kHeader + kFacet)
        return fail(Exit::unreadable,
                    "{}: not an STL file: {} bytes are too few for a facet, and it does not begin "
                    "with 'solid'",
                    path, file.size());
    return fail(Exit::unreadable,
                "{}: not an STL file: it neither begins with 'solid' nor holds binary facets",
                path);
}

} // namespace scanout::io
