#include "geom/build.h"

#include "base/chunks.h"
#include "base/memory.h"
#include "geom/framing.h"
#include "geom/line_faces.h"
#include "geom/normals.h"
#include "geom/spatial_order.h"
#include "geom/triangulate.h"
#include "geom/usable.h"
#include "geom/vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace scanout::geom {
namespace {

class Builder {
public:
    Builder(Jobs& jobs, PolygonMesh& polygons, BuildResult& result, const Usable& usable,
            std::span<const DVec2> uv_step)
        : jobs_(jobs), m_(polygons), result_(result), mesh_(result.mesh), usable_(usable),
          uv_step_(uv_step),
          vertices_(jobs, polygons,
                    std::min(m_.positions.size(), m_.corners.size() + m_.line_vertices.size() +
                                                      m_.point_vertices.size())),
          scratch_(static_cast<std::size_t>(jobs.threads())) {}

    // False: stopped by go_on.
    bool add_faces(const std::function<bool(double)>& go_on) {
        mesh_.index.reserve(usable_.all.triangles * 3);
        mesh_.material.reserve(usable_.all.triangles);
        mesh_.face.reserve(usable_.all.triangles);
        const std::size_t chunks = usable_.chunks.size();
        for (std::size_t chunk = 0; chunk < chunks;) {
            if (!go_on(static_cast<double>(chunk) / static_cast<double>(chunks))) return false;
            const std::size_t begin = chunk;
            std::size_t corners = 0;
            while (chunk < chunks && corners < kBatch)
                corners += usable_.chunks[chunk++].corners;
            add_batch(begin, chunk);
        }
        return true;
    }

    // A polyline is drawn whole or not at all, as a face is.
    void add_lines() {
        for (std::size_t line = 0; line < m_.line_begin.size(); ++line) {
            const std::size_t begin = m_.line_begin[line];
            const std::size_t end =
                line + 1 < m_.line_begin.size() ? m_.line_begin[line + 1] : m_.line_vertices.size();
            const std::span part = std::span(m_.line_vertices).subspan(begin, end - begin);
            if (!std::all_of(part.begin(), part.end(),
                             [&](auto p) { return usable_.position[p] != 0; })) {
                ++result_.skipped_lines;
                continue;
            }
            for (std::size_t i = 1; i < part.size(); ++i) {
                add_bare_vertex(part[i - 1], mesh_.line_index);
                add_bare_vertex(part[i], mesh_.line_index);
                mesh_.line_material.push_back(m_.line_material[line]);
            }
        }
        number_bare_vertices(mesh_.line_index);
    }

    void add_points() {
        for (std::size_t i = 0; i < m_.point_vertices.size(); ++i) {
            if (usable_.position[m_.point_vertices[i]] == 0) {
                ++result_.skipped_points;
                continue;
            }
            add_bare_vertex(m_.point_vertices[i], mesh_.point_index);
            mesh_.point_material.push_back(m_.point_material[i]);
        }
        number_bare_vertices(mesh_.point_index);
    }

    // Last: frees what the others need.
    void make_vertices() {
        release(m_.face_begin);
        release(m_.face_material);
        release(corners_);
        vertices_.write(mesh_, usable_.all.uv, !m_.colours.empty());
    }

private:
    static constexpr std::size_t kBatch = 1 << 16; // corners whose vertices are found at once
    // A texture that is repeated very often has uvs whose floats keep too few digits of the place
    // within one repeat: such a face is moved by whole repeats towards 0 (HARD-CASES 36), where
    // that shows the same (BuildOptions::uv_step).

    // Where a block's corners and triangles begin: the former in corners_, the latter in the mesh.
    struct Place {
        std::size_t corner, triangle;
    };
    struct ShiftedCorner {
        std::size_t corner; // in corners_
        DVec2 uv;
    };

    // The faces of some chunks.
    void add_batch(std::size_t begin, std::size_t end) {
        places_.assign(1, {0, mesh_.material.size()});
        for (std::size_t b = begin; b < end; ++b)
            places_.push_back({places_.back().corner + usable_.chunks[b].corners,
                               places_.back().triangle + usable_.chunks[b].triangles});
        corners_.resize(places_.back().corner);
        shifted_.resize(std::max(shifted_.size(), end - begin));
        for_chunks(jobs_, end - begin, 1, [&](std::size_t i, std::size_t, int) {
            copy_corners(begin + i, places_[i].corner, shifted_[i]);
        });
        for (std::size_t i = 0; i < end - begin; ++i)
            shift_uvs(shifted_[i]);
        const std::span<const std::uint32_t> numbers = vertices_.numbers_of(corners_);
        mesh_.index.resize(places_.back().triangle * 3);
        mesh_.material.resize(places_.back().triangle);
        mesh_.face.resize(places_.back().triangle);
        for_chunks(jobs_, end - begin, 1, [&](std::size_t i, std::size_t, int worker) {
            cut_faces(begin + i, places_[i], numbers, scratch_[static_cast<std::size_t>(worker)]);
        });
    }

    template <class Visit>
    void for_usable_faces(std::size_t chunk, Visit&& visit) const {
        const std::size_t end = std::min((chunk + 1) * kFaceChunk, m_.faces());
        for (std::size_t f = chunk * kFaceChunk; f < end; ++f)
            if (usable_.face[f]) visit(f);
    }

    // Before the vertices are numbered, which overwrites corners.
    void copy_corners(std::size_t chunk, std::size_t to, std::vector<ShiftedCorner>& shifted) {
        shifted.clear();
        for_usable_faces(chunk, [&](std::size_t f) {
            const DVec2 shift = uv_shift(f);
            for (std::size_t c = m_.face_begin[f]; c < m_.face_end(f); ++c, ++to) {
                corners_[to] = m_.corners[c];
                if (shift == DVec2(0) || corners_[to].uv < 0) continue;
                const DVec2& uv = m_.uvs[static_cast<std::size_t>(corners_[to].uv)];
                shifted.push_back({to, uv - shift});
            }
        });
    }

    void shift_uvs(const std::vector<ShiftedCorner>& shifted) {
        constexpr std::size_t kMaxUvs = std::numeric_limits<std::int32_t>::max();
        for (const ShiftedCorner& s : shifted) {
            if (m_.uvs.size() >= kMaxUvs) return;
            corners_[s.corner].uv = static_cast<std::int32_t>(m_.uvs.size());
            m_.uvs.push_back(s.uv);
        }
    }

    // For one worker.
    struct Scratch {
        std::vector<std::uint32_t> cut; // triangles of a face's corners
        std::vector<DVec3> outline;
    };

    void cut_faces(std::size_t chunk, Place at, std::span<const std::uint32_t> numbers,
                   Scratch& scratch) {
        for_usable_faces(chunk, [&](std::size_t f) {
            const std::size_t n = m_.face_end(f) - m_.face_begin[f];
            const std::span corners = std::span(corners_).subspan(at.corner, n);
            scratch.cut.clear();
            if (n == 3) {
                scratch.cut.insert(scratch.cut.end(), {0, 1, 2});
            } else {
                scratch.outline.clear();
                for (const Corner& c : corners)
                    scratch.outline.push_back(m_.positions[static_cast<std::size_t>(c.position)]);
                triangulate(scratch.outline, scratch.cut);
            }
            for (std::size_t i = 0; i < scratch.cut.size(); ++i)
                mesh_.index[at.triangle * 3 + i] = numbers[at.corner + scratch.cut[i]];
            for (std::size_t i = 0; i < n - 2; ++i, ++at.triangle) {
                mesh_.material[at.triangle] = m_.face_material[f];
                mesh_.face[at.triangle] = static_cast<std::uint32_t>(f);
            }
            at.corner += n;
        });
    }

    // Of lines and points: their vertices' numbers come at the end of `out`.
    void add_bare_vertex(std::uint32_t position, std::vector<std::uint32_t>& out) {
        bare_.push_back({.position = static_cast<std::int32_t>(position)});
        if (bare_.size() >= kBatch) number_bare_vertices(out);
    }
    void number_bare_vertices(std::vector<std::uint32_t>& out) {
        const std::span<const std::uint32_t> numbers = vertices_.numbers_of(bare_);
        out.insert(out.end(), numbers.begin(), numbers.end());
        bare_.clear();
    }

    DVec2 uv_shift(std::size_t face) const {
        DVec2 lo(std::numeric_limits<double>::infinity()), largest(0);
        if (!usable_.all.uv) return largest;
        for (std::size_t c = m_.face_begin[face]; c < m_.face_end(face); ++c) {
            if (m_.corners[c].uv < 0) continue;
            const DVec2& uv = m_.uvs[static_cast<std::size_t>(m_.corners[c].uv)];
            lo = {std::min(lo.x, uv.x), std::min(lo.y, uv.y)};
            largest = {std::max(largest.x, std::abs(uv.x)), std::max(largest.y, std::abs(uv.y))};
        }
        const auto material = static_cast<std::size_t>(m_.face_material[face]); // -1: none
        const DVec2 step = material < uv_step_.size() ? uv_step_[material] : DVec2(2);
        const auto moved = [](double least, double most, double by) {
            return most > double{Mesh::kLargeUv} && by > 0 ? std::floor(least / by) * by : 0.0;
        };
        return {moved(lo.x, largest.x, step.x), moved(lo.y, largest.y, step.y)};
    }

    Jobs& jobs_;
    PolygonMesh& m_;
    BuildResult& result_;
    Mesh& mesh_;
    const Usable& usable_;
    std::span<const DVec2> uv_step_;
    Vertices vertices_;
    std::vector<Place> places_;                       // of a batch's chunks, and their end
    std::vector<Corner> corners_;                     // of a batch
    std::vector<std::vector<ShiftedCorner>> shifted_; // of each block
    std::vector<Corner> bare_;
    std::vector<Scratch> scratch_;
};

// Of the time that a mesh takes to build: where normals begin, faces, and what comes behind them.
constexpr double kToNormals = 0.1, kToFaces = 0.5, kToVertices = 0.7, kToOrder = 0.75,
                 kToClusters = 0.95;

// The part of all that goes from `begin` to `end`.
std::function<bool(double)> part_of(const std::function<bool(double)>& progress, double begin,
                                    double end) {
    return [&progress, begin, end](double share) {
        return !progress || progress(begin + share * (end - begin));
    };
}

Framing framing_of_box(Jobs& jobs, const std::pair<DVec3, DVec3>& box) {
    std::vector<DVec3> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners.emplace_back((i & 1U) != 0 ? box.second.x : box.first.x,
                             (i & 2U) != 0 ? box.second.y : box.first.y,
                             (i & 4U) != 0 ? box.second.z : box.first.z);
    return framing_of(jobs, corners, std::vector<std::uint8_t>(corners.size(), 1));
}

void normalise(Jobs& jobs, PolygonMesh& m, const Usable& usable, const BuildOptions& options,
               Mesh& mesh) {
    const Framing framing = options.reach ? framing_of_box(jobs, *options.reach)
                                          : framing_of(jobs, m.positions, usable.position);
    mesh.centre = framing.centre;
    mesh.exponent = framing.exponent;
    mesh.radius = framing.radius;
    mesh.box_min = framing.box_min;
    mesh.box_max = framing.box_max;
    for_chunks(jobs, m.positions.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            m.positions[i] = framing.normalise(m.positions[i]);
    });
}

void warn_of(std::size_t count, const char* what, const std::string& name, Warnings& warnings) {
    if (count > 0)
        warnings.add(what,
                     fmt::format("{}: {} {} not drawn: a coordinate is not a finite number, or "
                                 "there are too few corners",
                                 name, count, what));
}

} // namespace

BuildResult build_mesh(PolygonMesh&& polygons, const BuildOptions& options, const std::string& name,
                       Warnings& warnings) {
    PolygonMesh m = std::move(polygons);
    std::optional<Jobs> alone;
    Jobs& jobs = options.jobs != nullptr ? *options.jobs : alone.emplace(1);
    BuildResult result;
    const Usable usable(jobs, m);
    result.skipped_faces = m.faces() - usable.all.faces;
    normalise(jobs, m, usable, options, result.mesh); // from here on everything is of unit size
    result.stopped = !make_normals(jobs, m, usable.face, options.crease_degrees,
                                   part_of(options.progress, kToNormals, kToFaces));
    if (result.stopped) return result;
    release(m.face_smoothing);
    {
        Builder builder(jobs, m, result, usable, options.uv_step);
        result.stopped = !builder.add_faces(part_of(options.progress, kToFaces, kToVertices));
        if (result.stopped) return result;
        builder.add_lines();
        builder.add_points();
        builder.make_vertices();
    }
    m = PolygonMesh();
    std::vector<std::uint32_t> order;
    const auto to_clusters = part_of(options.progress, kToOrder, kToClusters);
    result.stopped =
        !to_clusters(0) || !spatial_order(jobs, result.mesh, order, to_clusters) || !to_clusters(1);
    if (result.stopped) return result;
    if (!order.empty()) order_vertices(jobs, result.mesh, order);
    find_line_faces(result.mesh);
    result.mesh.clusters = find_clusters(jobs, result.mesh, std::move(order));
    use_large_pages(result.mesh.clusters.index);
    use_large_pages(result.mesh.clusters.spatial_index);
    use_large_pages(result.mesh.index);
    use_large_pages(result.mesh.position);
    use_large_pages(result.mesh.normal);
    use_large_pages(result.mesh.uv);
    use_large_pages(result.mesh.exact_uv);
    use_large_pages(result.mesh.colour);
    warn_of(result.skipped_faces, "faces", name, warnings);
    warn_of(result.skipped_lines, "lines", name, warnings);
    warn_of(result.skipped_points, "points", name, warnings);
    return result;
}

} // namespace scanout::geom
