#include "geom/mend_winding.h"

#include "geom/diagnose/shells.h"
#include "geom/diagnose/surface.h"

#include <algorithm>

namespace scanout::geom {
namespace {

// Faces that meet at an edge which no third one uses; `against`: they use it in one direction.
struct Neighbour {
    std::uint32_t face;
    bool against;
};

class Neighbours {
public:
    explicit Neighbours(const Surface& surface) : begin_(surface.mesh().faces() + 1, 0) {
        const auto for_pairs = [&](auto&& visit) {
            surface.for_each_edge([&](std::span<const Surface::EdgeUse> uses) {
                if (uses.size() == 2 && uses[0].face != uses[1].face)
                    visit(uses[0].face, uses[1].face, uses[0].forward == uses[1].forward);
            });
        };
        for_pairs([&](std::uint32_t a, std::uint32_t b, bool) {
            ++begin_[a + 1];
            ++begin_[b + 1];
        });
        for (std::size_t i = 1; i < begin_.size(); ++i)
            begin_[i] += begin_[i - 1];
        list_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for_pairs([&](std::uint32_t a, std::uint32_t b, bool against) {
            list_[next[a]++] = {b, against};
            list_[next[b]++] = {a, against};
        });
    }
    std::span<const Neighbour> of(std::uint32_t face) const {
        return std::span(list_).subspan(begin_[face], begin_[face + 1] - begin_[face]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<Neighbour> list_;
};

void turn(PolygonMesh& m, std::size_t face) {
    const auto begin = m.corners.begin() + m.face_begin[face];
    std::reverse(begin, m.corners.begin() + static_cast<std::ptrdiff_t>(m.face_end(face)));
}

constexpr std::uint8_t kUnseen = 2;

// The faces connected with `first`; `turned` becomes 0 or 1 for each. False: no choice makes them
// wound alike.
bool spread(const Neighbours& neighbours, std::uint32_t first, std::vector<std::uint8_t>& turned,
            std::vector<std::uint32_t>& faces) {
    bool possible = true;
    faces.assign(1, first);
    turned[first] = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::uint32_t face = faces[i];
        for (const Neighbour& n : neighbours.of(face)) {
            const auto wanted = static_cast<std::uint8_t>(turned[face] ^ (n.against ? 1 : 0));
            if (turned[n.face] == kUnseen) {
                turned[n.face] = wanted;
                faces.push_back(n.face);
            } else if (turned[n.face] != wanted) {
                possible = false;
            }
        }
    }
    return possible;
}

void turn_shells_outwards(Jobs& jobs, PolygonMesh& m, Mended& report) {
    const Surface surface(jobs, m);
    const Shells shells = find_shells(surface);
    for (std::size_t f = 0; f < m.faces(); ++f) {
        if (shells.of_face[f] == kNoPlace || !shells.shells[shells.of_face[f]].flipped) continue;
        turn(m, f);
        ++report.turned;
    }
}

} // namespace

void make_winding_alike(Jobs& jobs, PolygonMesh& m, Mended& report) {
    {
        const Surface surface(jobs, m);
        const Neighbours neighbours(surface);
        std::vector<std::uint8_t> turned(m.faces(), kUnseen);
        std::vector<std::uint32_t> faces;
        for (std::uint32_t f = 0; f < m.faces(); ++f) {
            if (turned[f] != kUnseen) continue;
            if (!spread(neighbours, f, turned, faces)) {
                ++report.one_sided;
                continue;
            }
            const auto many = static_cast<std::size_t>(std::count_if(
                faces.begin(), faces.end(), [&](std::uint32_t face) { return turned[face] == 1; }));
            const std::uint8_t which = many * 2 > faces.size() ? 0 : 1; // the fewer ones
            for (const std::uint32_t face : faces) {
                if (turned[face] != which) continue;
                turn(m, face);
                ++report.turned;
            }
        }
    }
    turn_shells_outwards(jobs, m, report);
}

} // namespace scanout::geom
