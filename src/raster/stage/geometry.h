// The geometry stage of a frame: transforms every vertex once, snaps, culls against the frustum and
// by facing, clips, sets triangles up in canonical order, and bins each primitive to the tiles that
// it may touch. On all cores; what a tile holds does not depend on which worker did what, only its
// order does, and visibility is commutative.
#pragma once

#include "base/jobs.h"
#include "base/large_array.h"
#include "geom/mesh.h"
#include "raster/clipped/clipped_setup.h"
#include "raster/clipped/clipped_triangle.h"
#include "raster/culling/cluster_cull.h"
#include "raster/culling/cull.h"
#include "raster/culling/depth_sort.h"
#include "raster/culling/occlusion.h"
#include "raster/screen/alpha_mode.h"
#include "raster/screen/primitive.h"
#include "raster/screen/screen.h"
#include "raster/tile/area.h"
#include "raster/tile/tile.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
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
    bool triangles_only = false; // no lines, no points
    // The occlusion history of the view. If given, clusters that were occluded are deferred, and
    // tiles are drawn by draw() or draw_triangles() into a VisibilityTile, by the default depth
    // rule. Not with alpha modes.
    OcclusionHistory* occlusion = nullptr;
};

class Geometry {
public:
    // The mesh must outlive the draws that follow.
    void run(Jobs& jobs, const geom::Mesh& mesh, const ScreenTransform& transform,
             const GeometryOptions& options);

    int tiles_across() const { return across_; }
    int tiles() const { return across_ * down_; }
    image::Rect tile_area(int tile) const;
    bool is_empty(int tile) const; // no primitive may touch it
    // Draws everything opaque that may touch the tile.
    void draw(int tile, VisibilityTile& out);
    // The same in two steps: triangles, then lines and points on the triangles that are visible.
    void draw_triangles(int tile, VisibilityTile& out);
    void draw_lines(int tile, const VisibilityTile& shown, VisibilityTile& out) const;
    // Triangles with this alpha mode that may touch the tile, by id.
    void of_mode(int tile, AlphaMode mode, std::vector<std::uint32_t>& out) const;
    // Draws one triangle; returns the pixels that it may have changed, none if it is not visible.
    image::Rect draw_one(std::uint32_t triangle, VisibilityTile& out) const;
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
    std::span<const ScreenVertex> vertices() const { return vertices_; }
    // The clipped triangles of a triangle that has a vertex off the screen.
    ClippedTriangles clipped_of(std::uint32_t triangle) const;
    std::uint64_t triangles_drawn() const; // after the tiles are drawn: deferred ones count
    // No triangle that may be visible has a vertex off the screen.
    bool all_unclipped() const;

private:
    // What one worker found, with a bin a tile. Unclipped triangles are stored as ids, small ones
    // as BinnedTriangle with their spatial index (geom/clusters.h), and set up again by the tile
    // that draws them: four or eight bytes each instead of sixty.
    struct Batch {
        std::vector<ClippedSetup> clipped;
        std::vector<Segment> segments;
        std::vector<Point> points;
        struct Bin {
            std::vector<std::uint32_t> triangles, clipped, segments, points;
            // Indices into `queries`: deferred clusters, and queried ones that are drawn at once.
            std::vector<std::uint32_t> deferred, queries;
            BinnedByKind small; // of small triangles
            const std::vector<BinnedTriangle>& small_of(SmallKind kind) const {
                return small[static_cast<std::size_t>(kind)];
            }
            // Triangles that may cover whole blocks, by depth and id; prepend_large() puts them
            // before the others, front to back, so that they occlude what is drawn after them.
            std::vector<DepthAndId> large;
            void prepend_large();
            // f(spatial index) for the small triangles.
            template <class F>
            void for_small(F&& f) const;
        };
        struct OcclusionQuery {
            std::uint32_t cluster;
            ClusterBounds bounds;
        };
        std::vector<OcclusionQuery> queries;
        std::vector<Bin> bins;
        std::vector<Bin> not_opaque; // cut-outs and blended ones: no bins where all are opaque
        CullResult found;            // of one chunk
        BinningResult binning;       // of its visible triangles
        std::uint64_t triangles_drawn = 0;
        bool has_clipped = false; // some triangle was
        void clear(int tiles, bool alpha_modes);
    };
    void find_needed(Jobs& jobs, bool all_vertices);
    // Is a cluster deferred? Adds deferred and queried ones to the batch.
    bool defers(Batch& batch, std::size_t cluster) const;
    void transform_needed(Jobs& jobs);
    void transform_groups(std::size_t begin, std::size_t end);
    // Draws deferred clusters that the tile does not occlude, when all others are drawn. For one
    // cluster: transforms vertices that no tile has transformed before; culls its triangles and
    // bins them for the tile.
    void draw_deferred(int tile, VisibilityTile& out);
    void transform_deferred(std::size_t cluster);
    void cull_deferred(std::size_t cluster, const image::Rect& area, DeferredTriangles& out);
    // Bins a range of the spatial order, without clusters that are culled or deferred.
    void bin_visible(Batch& batch, std::size_t begin, std::size_t end) const;
    void bin_triangles(Batch& batch, std::size_t begin, std::size_t end) const;
    void bin_large(Batch& batch, const VisibleTriangle& visible, std::uint32_t triangle) const;
    void bin_small(Batch& batch, const VisibleTriangle& visible) const;
    // Bins a small triangle in the tile whose first pixel this is.
    void bin_small_part(const VisibleTriangle& visible, int left, int top,
                        BinnedByKind& small) const;
    BinnedList list_of(std::span<const BinnedTriangle> small, SmallKind kind) const {
        return {vertices_, mesh_->index_in_spatial_order(), small, kind, mesh_->clusters.triangle};
    }
    void draw_back_facing(int tile, VisibilityTile& out) const;
    void bin_clipped(Batch& batch, std::uint32_t triangle) const;
    std::array<ScreenVertex, 3> vertices_of(std::uint32_t triangle) const;
    AlphaMode alpha_mode_of(std::uint32_t triangle) const {
        return alpha_modes_[static_cast<std::size_t>(mesh_->material[triangle] + 1)];
    }
    std::uint32_t flags(std::uint32_t vertex) const;
    void bin_segment(Batch& batch, std::uint32_t segment) const;
    void bin_point(Batch& batch, std::uint32_t point) const;
    // f(tile) of each tile that has some of these pixels.
    template <class F>
    void for_tiles(int x0, int y0, int x1, int y1, F&& f) const {
        const int first = x0 >> tile_bits_, end = ((x1 - 1) >> tile_bits_) + 1;
        for (int y = y0 >> tile_bits_; y <= (y1 - 1) >> tile_bits_; ++y)
            for (int x = first; x < end; ++x)
                f(static_cast<std::size_t>(y * across_ + x));
    }
    template <class F>
    void for_tiles(const image::Rect& bounds, F&& f) const {
        if (!bounds.empty()) for_tiles(bounds.x0, bounds.y0, bounds.x1, bounds.y1, f);
    }

    int width_ = 0, height_ = 0, across_ = 0, down_ = 0;
    int tile_size_ = kTileSize, tile_bits_ = 0; // 1 << tile_bits_ is tile_size_
    CullOptions cull_;
    const geom::Mesh* mesh_ = nullptr;         // of the last run
    std::optional<ScreenTransform> transform_; // likewise
    std::vector<AlphaMode> alpha_modes_;
    // 1 for each cluster that may be visible and is not deferred. Empty: all triangles may be.
    std::vector<std::uint8_t> visible_clusters_;
    std::optional<ClusterCull> cluster_cull_;
    OcclusionHistory* occlusion_ = nullptr;
    // 1 for each vertex group that a cluster needs. Vertices of other groups keep old positions.
    // Groups of deferred clusters are transformed when a tile first needs them, under one of the
    // locks.
    std::vector<std::uint8_t> needed_groups_;
    std::array<std::mutex, 64> deferred_locks_;
    std::atomic<std::uint64_t> deferred_drawn_ = 0; // triangles
    LargeArray<ScreenVertex> vertices_;
    std::vector<Batch> batches_;
};

} // namespace scanout::raster
