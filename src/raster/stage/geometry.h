// The geometry stage of a frame: transforms every vertex once, snaps, culls against the frustum and
// by facing, clips, sets triangles up in canonical order, and bins each primitive to the tiles that
// it may touch. On all cores; what a tile holds does not depend on which worker did what, only its
// order does, and visibility is commutative.
#pragma once

#include "base/jobs.h"
#include "geom/mesh.h"
#include "raster/clipped/clipped_triangle.h"
#include "raster/culling/cull.h"
#include "raster/micro/deferred_triangles.h"
#include "raster/screen/alpha_mode.h"
#include "raster/screen/primitive.h"
#include "raster/screen/screen.h"
#include "raster/screen/tile_grid.h"
#include "raster/stage/bins.h"
#include "raster/stage/occlusion_pass.h"
#include "raster/stage/vertex_stage.h"
#include "raster/tile/area.h"
#include "raster/tile/tile.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace scanout::raster {

struct GeometryOptions {
    int width = 0, height = 0;
    Facing keep = Facing::any;
    bool mirrored = false;     // front faces wind clockwise in view space
    int samples = 1;           // of the tiles that will be drawn
    bool areas = false;        // or exact areas, not samples
    int tile_size = kTileSize; // 8, 16, 32 or 64 pixels a side; pictures do not depend on it
    // Of the default material, then of each material of the scene. Empty: all are opaque.
    std::span<const AlphaMode> alpha_modes = {};
    // Likewise: 1 where back faces are left out of what `keep`, then any, keeps. Empty: nowhere.
    std::span<const std::uint8_t> one_sided = {};
    bool triangles_only = false; // no lines, no points
    bool all_vertices = false;   // are transformed, for lines that another mesh has
    // The id of the mesh's first line; 0: the triangles' ids come before it.
    std::uint32_t first_line = 0;
    int line_width = 1, point_size = 1; // pixels
    // The occlusion history of the view. If given, clusters that were occluded are deferred, and
    // tiles are drawn by draw() or draw_triangles() into a VisibilityTile, by the default depth
    // rule. Not with alpha modes, nor with one-sided materials.
    OcclusionHistory* occlusion = nullptr;
    bool centres = false; // tiles of one sample will be drawn as well
};

class Geometry {
public:
    // The mesh must outlive the draws that follow.
    void run(Jobs& jobs, const geom::Mesh& mesh, const ScreenTransform& transform,
             const GeometryOptions& options);

    int tiles_across() const { return grid_.across; }
    int tiles() const { return grid_.across * down_; }
    image::Rect tile_area(int tile) const;
    bool is_empty(int tile) const; // no primitive may touch it
    // Draws everything opaque that may touch the tile. scratch: needed with an occlusion history.
    void draw(int tile, VisibilityTile& out, DeferredTriangles* scratch = nullptr);
    // The same in two steps: triangles, then lines and points on the triangles that are visible.
    void draw_triangles(int tile, VisibilityTile& out, DeferredTriangles* scratch = nullptr);
    bool has_lines(int tile) const; // lines or points may touch it
    // The tile must hold the triangles as its support.
    void draw_lines(int tile, const LineSupport& support, VisibilityTile& out) const;
    LineSupport line_support() const { return {*mesh_, vertices(), *transform_}; }
    std::uint32_t first_line() const { return first_line_; }
    // Triangles with this alpha mode that may touch the tile, by id.
    void of_mode(int tile, AlphaMode mode, std::vector<std::uint32_t>& out) const;
    // Draws one triangle; returns the pixels that it may have changed, none if it is not visible.
    image::Rect draw_one(std::uint32_t triangle, VisibilityTile& out) const;
    // The pixels of an area of the picture that may hold a sample of the triangle.
    image::Rect pixels_of(std::uint32_t triangle, const image::Rect& area) const;
    // Adds the opaque triangles.
    void draw(int tile, AreaTile& out) const;
    // Draws what is opaque, one primitive after the other, lines and points without support; calls
    // drawn(id, pixels that it may have changed) after each that is visible. `order` is scratch
    // memory for the primitives of the tile.
    struct ById {
        std::vector<std::uint32_t> triangles;
        std::vector<Segment> segments;
        std::vector<Point> points;
    };
    using Drawn = std::function<void(std::uint32_t, const image::Rect&)>;
    void draw_each(int tile, VisibilityTile& out, ById& order, const Drawn& drawn) const;

    // Of triangles that may be visible, and of all lines and points.
    std::span<const ScreenVertex> vertices() const { return vertex_stage_.vertices(); }
    // The clipped triangles of a triangle that has a vertex off the screen.
    ClippedTriangles clipped_of(std::uint32_t triangle) const;
    std::uint64_t triangles_drawn() const; // after the tiles are drawn: deferred ones count
    // The tiles are drawn once more: what they count begins anew.
    void draw_again() { deferred_drawn_ = 0; }
    // No triangle that may be visible has a vertex off the screen.
    bool all_unclipped() const;

private:
    // Opaque triangles that may touch the tile, by id; and drawn so.
    void sort_triangles(int tile, std::vector<std::uint32_t>& out) const;
    void draw_in_order(int tile, VisibilityTile& out, std::vector<std::uint32_t>& order) const;
    void find_visible_clusters(Jobs& jobs);
    // The pixels of the area that may hold a sample of the triangle; of its parts that are visible,
    // where they are drawn to `out`.
    image::Rect box_of(std::uint32_t triangle, const image::Rect& area, VisibilityTile* out) const;
    // Draws deferred clusters that the tile does not occlude, when all others are drawn.
    void draw_deferred(int tile, VisibilityTile& out, DeferredTriangles& scratch);
    void cull_deferred(std::size_t cluster, const image::Rect& area, DeferredTriangles& out);
    // Bins a range of the spatial order, without clusters that are culled or deferred.
    void bin_visible(WorkerBins& worker, std::size_t begin, std::size_t end) const;
    void bin_triangles(WorkerBins& worker, std::size_t begin, std::size_t end) const;
    void bin_large(WorkerBins& worker, const VisibleTriangle& visible,
                   std::uint32_t triangle) const;
    void bin_small(WorkerBins& worker, const VisibleTriangle& visible) const;
    // Bins a small triangle in the tile whose first pixel this is.
    void bin_small_in_tile(const VisibleTriangle& visible, int left, int top,
                           BinnedByKind& small) const;
    BinnedList list_of(std::span<const BinnedTriangle> small, SmallKind kind) const {
        return {vertices(), mesh_->index_in_spatial_order(), small, kind, mesh_->clusters.triangle};
    }
    void draw_back_facing(int tile, VisibilityTile& out) const;
    void bin_clipped(WorkerBins& worker, std::uint32_t triangle) const;
    std::array<ScreenVertex, 3> vertices_of(std::uint32_t triangle) const;
    AlphaMode alpha_mode_of(std::uint32_t triangle) const {
        return alpha_modes_[static_cast<std::size_t>(mesh_->material[triangle] + 1)];
    }
    bool is_one_sided(std::uint32_t triangle) const {
        return !one_sided_.empty() &&
               one_sided_[static_cast<std::size_t>(mesh_->material[triangle] + 1)] != 0;
    }
    std::uint32_t flags(std::uint32_t vertex) const;
    void bin_segment(WorkerBins& worker, std::uint32_t segment) const;
    void bin_point(WorkerBins& worker, std::uint32_t point) const;

    int width_ = 0, height_ = 0, down_ = 0; // pixels; rows of tiles
    std::uint32_t first_line_ = 0;
    int line_width_ = 1, point_size_ = 1;
    TileGrid grid_{};
    CullOptions cull_;
    const geom::Mesh* mesh_ = nullptr;         // of the last run
    std::optional<ScreenTransform> transform_; // likewise
    std::vector<AlphaMode> alpha_modes_;
    std::vector<std::uint8_t> one_sided_;
    // 1 for each cluster that may be visible and is not deferred. Empty: all triangles may be.
    std::vector<std::uint8_t> visible_clusters_;
    OcclusionPass occlusion_;
    VertexStage vertex_stage_;
    std::atomic<std::uint64_t> deferred_drawn_ = 0; // triangles
    std::vector<WorkerBins> workers_;
};

} // namespace scanout::raster
