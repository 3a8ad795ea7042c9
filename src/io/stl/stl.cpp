#include "io/stl/stl.h"

#include "base/chunks.h"
#include "geom/framing.h"
#include "io/little_endian.h"
#include "io/stl/colours.h"
#include "io/stl/reader.h"
#include "io/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace scanout::io {
namespace {

// A binary file: 80 bytes of anything, the number of facets, then for each facet its normal, its
// three vertices (12 floats, little endian) and two bytes that some programs use for a colour.
constexpr std::size_t kHeader = 84, kFacet = 50;
constexpr std::size_t kMaxFacets = (std::size_t{1} << 29) / 3; // a frame indexes 2^29 vertices

StlTriangle binary_facet(std::string_view file, std::size_t facet) {
    const char* at = file.data() + kHeader + facet * kFacet + 12; // the normal is not used
    StlTriangle triangle;
    for (DVec3& vertex : triangle)
        for (int axis = 0; axis < 3; ++axis, at += 4)
            vertex[axis] = std::bit_cast<float>(little_endian(at));
    return triangle;
}

std::uint16_t attribute(std::string_view file, std::size_t facet) {
    const char* at = file.data() + kHeader + facet * kFacet + kFacet - 2;
    return static_cast<std::uint16_t>(static_cast<unsigned char>(at[0]) |
                                      static_cast<unsigned char>(at[1]) << 8);
}

bool is_finite(const StlTriangle& t) {
    return std::all_of(t.begin(), t.end(), [](const DVec3& v) { return geom::is_finite(v); });
}

// --- Which of the two

// Does the size agree with the facet count in the header? The first kHeader bytes are enough.
bool is_exactly_binary(std::string_view head, std::uint64_t size) {
    return head.size() >= kHeader &&
           size - kHeader == std::uint64_t{kFacet} * little_endian(head.data() + 80);
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
        const StlTriangle t = binary_facet(file, i);
        good += std::all_of(t.begin(), t.end(), [&](const DVec3& v) {
            return moderate(v.x) && moderate(v.y) && moderate(v.z);
        });
    }
    return good * 2 >= looked_at && file.substr(0, 1024).find('\0') != std::string_view::npos;
}

// --- Binary

// The number of facets to read: the header's count, at most those in the file; all, where it is 0.
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
                              const std::function<bool(double)>& progress, Jobs& jobs) {
    constexpr std::size_t kBatch = 32768, kBlock = 2048;
    const std::size_t facets = facets_to_read(file, path, warnings);
    StlCollector collector(jobs, path, warnings, facets);
    std::vector<StlTriangle> batch;
    std::vector<std::uint8_t> bad;
    std::vector<std::int32_t> materials;
    StlColours colours(file.substr(0, 80));
    for (std::size_t first = 0; first < facets; first += kBatch) {
        TRY_VOID(
            report(progress, first * kFacet, file.size(), path)); // a facet behind: none is reread
        batch.resize(std::min(kBatch, facets - first));
        bad.assign(batch.size(), 0);
        for_chunks(jobs, batch.size(), kBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                batch[i] = binary_facet(file, first + i);
                bad[i] = is_finite(batch[i]) ? 0 : 1;
            }
        });
        std::size_t kept = 0;
        materials.resize(batch.size());
        for (std::size_t i = 0; i < batch.size(); ++i) {
            if (bad[i] == 0) {
                materials[kept] = colours.number(attribute(file, first + i));
                batch[kept++] = batch[i];
            } else {
                collector.skip(fmt::format("{}: facet {} has a coordinate that is not a finite "
                                           "number: skipped",
                                           path, first + i + 1));
            }
        }
        collector.add(std::span(batch).first(kept), std::span(materials).first(kept));
    }
    TRY(StlResult result, collector.finish());
    result.colours = colours.materials();
    return result;
}

} // namespace

std::size_t stl_facets_told(std::string_view head, std::uint64_t size) {
    return is_exactly_binary(head, size) ? little_endian(head.data() + 80) : 0;
}

bool is_stl(std::string_view head, std::uint64_t size) {
    return (is_exactly_binary(head, size) && size > kHeader) || begins_like_ascii_stl(head);
}

Result<StlResult> read_stl(std::string_view file, const std::string& path, Warnings& warnings,
                           const std::function<bool(double)>& progress, const Reading& how) {
    std::optional<Jobs> alone;
    Jobs& jobs = how.jobs != nullptr ? *how.jobs : alone.emplace(1);
    if (file.empty()) return fail(Exit::unreadable, "{}: the file is empty", path);
    if (file.substr(0, 4096).find_first_not_of('\0') == std::string_view::npos)
        return fail(Exit::unreadable,
                    "{}: holds zero bytes: the download or copy was cut short, fetch it again",
                    path);
    if (file.size() / kFacet > kMaxFacets) // an ASCII facet is longer than a binary one
        return fail(Exit::unreadable,
                    "{}: has more than {} facets, which is too many: cut the model "
                    "into parts",
                    path, kMaxFacets);
    if (is_exactly_binary(file, file.size()))
        return read_binary(file, path, warnings, progress, jobs);
    if (begins_like_ascii_stl(file))
        return read_ascii_stl(file, path, warnings, progress,
                              {&jobs, how.part_bytes, how.read_again});
    if (is_plausibly_binary(file)) return read_binary(file, path, warnings, progress, jobs);
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
