// What a diagnosis finds: of each hazard how many there are, where the worst one is, and which
// faces are concerned.
#pragma once

#include "geom/diagnose/hazard.h"
#include "math/vec.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

namespace scanout::geom {

// Hazards as bits.
using HazardMask = std::uint32_t;
inline constexpr HazardMask mask_of(Hazard hazard) {
    return HazardMask{1} << static_cast<unsigned>(hazard);
}

// Numbers of the file, from 0; faces and positions that the reader left out are not counted.
struct HazardPlace {
    std::optional<std::uint32_t> face, other_face, position;
    std::optional<DVec3> at; // file units
};

// Counts what is found of one hazard and keeps the worst: the largest badness, of equal ones the
// lowest face and position, so that no order of the search changes it.
class Tally {
public:
    void add(double badness, const HazardPlace& place) {
        ++count_;
        keep(badness, place);
    }
    void add(const Tally& other) {
        count_ += other.count_;
        if (other.count_ > 0) keep(other.badness_, other.place_);
    }
    std::size_t count() const { return count_; }
    double badness() const { return badness_; }
    const HazardPlace& place() const { return place_; }

private:
    void keep(double badness, const HazardPlace& place) {
        const bool first = !place_.face && !place_.position && !place_.at;
        if (!first && (badness < badness_ || (badness == badness_ && !before(place, place_))))
            return;
        badness_ = badness;
        place_ = place;
    }
    static bool before(const HazardPlace& a, const HazardPlace& b) {
        if (a.face != b.face) return a.face < b.face;
        if (a.other_face != b.other_face) return a.other_face < b.other_face;
        if (a.position != b.position) return a.position < b.position;
        if (!a.at || !b.at) return false;
        return std::tie(a.at->x, a.at->y, a.at->z) < std::tie(b.at->x, b.at->y, b.at->z);
    }
    std::size_t count_ = 0;
    double badness_ = 0;
    HazardPlace place_;
};

struct Finding {
    Hazard hazard{};
    std::size_t count = 0;
    double measure = 0; // of the worst one; what it is, its card says
    HazardPlace worst;
    double searched = 1; // part of the surface that was searched: below 1 where time ran out
};

struct Diagnosis {
    std::vector<Finding> findings; // in the order of Hazard; none of count 0 but those cut short
    std::vector<HazardMask> marks; // one a face
    std::size_t faces = 0, triangles = 0;
    bool stopped = false; // by progress: what would have been found is not known
    const Finding* find(Hazard hazard) const {
        for (const Finding& finding : findings)
            if (finding.hazard == hazard) return &finding;
        return nullptr;
    }
    std::size_t count(Hazard hazard) const {
        const Finding* finding = find(hazard);
        return finding != nullptr ? finding->count : 0;
    }
};

} // namespace scanout::geom
