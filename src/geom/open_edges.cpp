#include "geom/open_edges.h"

#include "base/chunks.h"
#include "geom/place.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

namespace scanout::geom {
namespace {

constexpr int kBucketBits = 8;
constexpr std::size_t kBuckets = std::size_t{1} << kBucketBits;
constexpr std::uint32_t kNoFace = 0xffffffff;

struct Use {
    std::uint64_t key; // of the edge
    OpenEdge edge;
};

class OpenEdgeFinder {
public:
    OpenEdgeFinder(Jobs& jobs, const PolygonMesh& mesh, const Usable& usable,
                   const Framing& framing)
        : jobs_(jobs), mesh_(mesh), usable_(usable), place_(mesh.positions.size()) {
        for_chunks(jobs, place_.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i)
                if (usable.position[i] != 0)
                    place_[i] = hash_of_place(place_as_drawn(framing.normalise(mesh.positions[i])));
        });
    }

    std::vector<OpenEdge> find() const {
        std::vector<std::size_t> begin;
        const std::vector<std::uint32_t> faces = faces_by_bucket(begin);
        std::vector<std::vector<OpenEdge>> found(kBuckets);
        jobs_.for_each(static_cast<int>(kBuckets), [&](int index, int) {
            const auto b = static_cast<std::size_t>(index);
            std::vector<Use> uses;
            for (std::size_t i = begin[b]; i < begin[b + 1]; ++i)
                for_edges(faces[i], [&](std::uint64_t key, OpenEdge edge) {
                    if (bucket_of(key) == b) uses.push_back({key, edge});
                });
            find_open(uses, found[b]);
        });
        std::vector<OpenEdge> open;
        for (const std::vector<OpenEdge>& part : found)
            open.insert(open.end(), part.begin(), part.end());
        sort_by_corner(open);
        return open;
    }

    // Edges that are used an odd number of times leave a bit of a table set, others none, but where
    // two of the first share it: then the parity of all keys tells that some are missing.
    std::optional<std::vector<OpenEdge>> find_odd() const {
        const std::uint64_t all = parity_of_keys();
        if (all == 0) return std::vector<OpenEdge>();
        const std::size_t bits = std::bit_ceil(8 * std::max<std::size_t>(mesh_.corners.size(), 64));
        std::vector<std::uint64_t> odd(bits / 64);
        const auto slot = [&](std::uint64_t key) { return key & (bits - 1); };
        for (std::size_t f = 0; f < mesh_.faces(); ++f)
            for_edges(f, [&](std::uint64_t key, OpenEdge) {
                odd[slot(key) / 64] ^= std::uint64_t{1} << slot(key) % 64;
            });
        std::vector<Use> uses;
        std::uint64_t found = 0;
        for (std::size_t f = 0; f < mesh_.faces(); ++f)
            for_edges(f, [&](std::uint64_t key, OpenEdge edge) {
                if ((odd[slot(key) / 64] >> slot(key) % 64 & 1) == 0) return;
                uses.push_back({key, edge});
                found ^= key;
            });
        if (found != all) return std::nullopt;
        std::vector<OpenEdge> open;
        find_open(uses, open);
        sort_by_corner(open);
        return open;
    }

private:
    std::uint64_t place(std::size_t corner) const {
        return place_[static_cast<std::size_t>(mesh_.corners[corner].position)];
    }

    static void sort_by_corner(std::vector<OpenEdge>& edges) {
        std::sort(edges.begin(), edges.end(),
                  [](const OpenEdge& a, const OpenEdge& b) { return a.corner < b.corner; });
    }
    // Exclusive or of all uses' keys: 0 where all edges are used an even number of times.
    std::uint64_t parity_of_keys() const {
        std::vector<std::uint64_t> parities((mesh_.faces() + kFaceChunk - 1) / kFaceChunk);
        for_chunks(jobs_, mesh_.faces(), kFaceChunk, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t f = begin; f < end; ++f)
                for_edges(
                    f, [&](std::uint64_t key, OpenEdge) { parities[begin / kFaceChunk] ^= key; });
        });
        std::uint64_t all = 0;
        for (const std::uint64_t parity : parities)
            all ^= parity;
        return all;
    }
    static std::size_t bucket_of(std::uint64_t key) {
        return static_cast<std::size_t>(key >> (64 - kBucketBits));
    }

    // Calls visit(key, edge) for the edges of a face that can be drawn, on three places or more.
    template <class Visit>
    void for_edges(std::size_t face, Visit&& visit) const {
        if (!usable_.face[face]) return;
        if (stands_on_two_places(mesh_, face, [this](std::size_t c) { return place(c); })) return;
        const std::size_t end = mesh_.face_end(face);
        std::size_t before = end - 1;
        for (std::size_t c = mesh_.face_begin[face]; c < end; before = c++)
            if (place(before) != place(c))
                visit(
                    mix_bits(place(before) + place(c)),
                    OpenEdge{static_cast<std::uint32_t>(face), static_cast<std::uint32_t>(before)});
    }

    // The faces of the edges whose keys are in a bucket. Faces, not
    // edges: a quarter of the memory. begin: of each bucket, and the end.
    std::vector<std::uint32_t> faces_by_bucket(std::vector<std::size_t>& begin) const {
        begin.assign(kBuckets + 1, 0);
        std::vector<std::uint32_t> last(kBuckets, kNoFace);
        const auto count = [&](std::uint64_t key, OpenEdge edge) {
            const std::size_t b = bucket_of(key);
            if (std::exchange(last[b], edge.face) != edge.face) ++begin[b + 1];
        };
        for (std::size_t f = 0; f < mesh_.faces(); ++f)
            for_edges(f, count);
        for (std::size_t b = 0; b < kBuckets; ++b)
            begin[b + 1] += begin[b];
        std::vector<std::uint32_t> faces(begin[kBuckets]);
        std::vector<std::size_t> next(begin);
        last.assign(kBuckets, kNoFace);
        const auto place = [&](std::uint64_t key, OpenEdge edge) {
            const std::size_t b = bucket_of(key);
            if (std::exchange(last[b], edge.face) != edge.face) faces[next[b]++] = edge.face;
        };
        for (std::size_t f = 0; f < mesh_.faces(); ++f)
            for_edges(f, place);
        return faces;
    }

    void find_open(std::vector<Use>& uses, std::vector<OpenEdge>& out) const {
        std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
            return a.key != b.key ? a.key < b.key : a.edge.corner < b.edge.corner;
        });
        for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
            bool open = true;
            while (++end < uses.size() && uses[end].key == uses[begin].key) {
                const std::uint32_t face = uses[end].edge.face;
                open = open && face != uses[end - 1].edge.face && // not a cut to a hole
                       face_hash(face) == face_hash(uses[begin].edge.face);
            }
            for (std::size_t i = begin; open && i < end; ++i)
                out.push_back(uses[i].edge);
        }
    }

    // Of the face's places, in any order.
    std::uint64_t face_hash(std::uint32_t face) const {
        std::uint64_t sum = 0;
        for (std::size_t c = mesh_.face_begin[face]; c < mesh_.face_end(face); ++c)
            sum += place(c);
        return sum;
    }

    Jobs& jobs_;
    const PolygonMesh& mesh_;
    const Usable& usable_;
    std::vector<std::uint64_t> place_; // hashes of the positions' places
};

} // namespace

std::vector<OpenEdge> open_edges(Jobs& jobs, const PolygonMesh& mesh, const Usable& usable,
                                 const Framing& framing, OpenEdgeSearch search) {
    const OpenEdgeFinder finder(jobs, mesh, usable, framing);
    if (search == OpenEdgeSearch::odd)
        if (std::optional<std::vector<OpenEdge>> odd = finder.find_odd()) return *std::move(odd);
    return finder.find();
}

} // namespace scanout::geom
