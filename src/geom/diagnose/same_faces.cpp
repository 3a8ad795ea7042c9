#include "geom/diagnose/same_faces.h"

#include "geom/diagnose/families.h"
#include "geom/diagnose/surface.h"
#include "geom/join_table.h"

#include <algorithm>

namespace scanout::geom {
namespace {

struct FaceKey {
    std::uint64_t hash; // of the corners' places, in any order
    std::uint32_t face;
};

FaceKey key_of(const Surface& surface, std::uint32_t face) {
    const PolygonMesh& m = surface.mesh();
    std::uint64_t sum = 0;
    for (std::size_t c = m.face_begin[face]; c < m.face_end(face); ++c)
        sum += mix_bits(surface.corner_place(c) + 1);
    return {sum, face};
}

// The same ring of places, from some corner on, read in one direction or the other.
bool same_ring(const Surface& surface, std::uint32_t a, std::uint32_t b, bool turned) {
    const PolygonMesh& m = surface.mesh();
    const std::size_t begin_a = m.face_begin[a], begin_b = m.face_begin[b];
    const std::size_t n = m.face_end(a) - begin_a;
    if (m.face_end(b) - begin_b != n) return false;
    for (std::size_t shift = 0; shift < n; ++shift) {
        std::size_t i = 0;
        while (i < n &&
               surface.corner_place(begin_a + i) ==
                   surface.corner_place(begin_b + (turned ? shift + n - i : shift + i) % n))
            ++i;
        if (i == n) return true;
    }
    return false;
}

} // namespace

std::vector<SameFace> find_same_faces(const Surface& surface) {
    std::vector<FaceKey> keys;
    keys.reserve(surface.usable().all.faces);
    for (std::uint32_t f = 0; f < surface.mesh().faces(); ++f)
        if (surface.has_area(f)) keys.push_back(key_of(surface, f));
    std::sort(keys.begin(), keys.end(), [](const FaceKey& a, const FaceKey& b) {
        return a.hash != b.hash ? a.hash < b.hash : a.face < b.face;
    });
    std::vector<SameFace> same;
    std::vector<std::uint32_t> different; // of one hash: rings that were not met before
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        while (end < keys.size() && keys[end].hash == keys[begin].hash)
            ++end;
        if (end - begin == 1) continue;
        different.clear();
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t face = keys[i].face;
            const auto met = [&](bool turned) {
                return std::find_if(different.begin(), different.end(), [&](std::uint32_t other) {
                    return same_ring(surface, face, other, turned);
                });
            };
            const auto repeated = met(false);
            const auto turned = repeated == different.end() ? met(true) : different.end();
            if (repeated != different.end())
                same.push_back({face, *repeated, false});
            else if (turned != different.end())
                same.push_back({face, *turned, true});
            if (repeated == different.end()) different.push_back(face);
        }
    }
    std::sort(same.begin(), same.end(),
              [](const SameFace& a, const SameFace& b) { return a.face < b.face; });
    return same;
}

void examine_duplicates(const Surface& surface, Findings& findings) {
    Tally repeated, turned;
    for (const SameFace& same : surface.same_faces()) {
        HazardPlace place = at_face(surface, same.face);
        place.other_face = same.first;
        (same.turned ? turned : repeated).add(0, place);
        const Hazard hazard = same.turned ? Hazard::back_to_back : Hazard::duplicate_faces;
        findings.mark(same.face, hazard);
        findings.mark(same.first, hazard);
    }
    findings.add(Hazard::duplicate_faces, repeated);
    findings.add(Hazard::back_to_back, turned);
}

} // namespace scanout::geom
