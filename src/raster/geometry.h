// The geometry stage of a frame: transform every vertex once, snap, cull, clip, put into canonical
// order, and hand each primitive to the tiles that it may touch. On all cores; what a tile holds
// does not depend on which worker did what, only its order does, and visibility is commutative.
#pragma once

#include "base/jobs.h"
#include "base/large_array.h"
#include "geom/mesh.h"
#include "raster/area.h"
#include "raster/cluster_cull.h"
#include "raster/cull.h"
#include "raster/hidden_clusters.h"
#include "raster/layer.h"
#include "raster/nearest_first.h"
#include "raster/piece.h"
#include "raster/piece_set_up.h"
#include "raster/primitive.h"
#include "raster/screen.h"
#include "raster/tile.h"

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
    bool areas = false;        // or whole boxes count, not samples
    int tile_size = kTileSize; // 8, 16, 32 or 64 pixels a side; pictures do not depend on it
    // Of the default material, then of each material of the scene. Empty: all are opaque.
    std::span<const Layer> layers = {};
    bool triangles_only = false; // no lines, no points
    // Of the frame before. Given, clusters that were hidden then wait, and tiles are drawn by
    // draw() or draw_triangles() into a VisibilityTile, by the usual rule. Not with layers.
    HiddenClusters* hidden = nullptr;
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
    // The same in two parts: triangles, then lines and points on the ground that is shown.
    void draw_triangles(int tile, VisibilityTile& out);
    void draw_on_ground(int tile, const VisibilityTile& shown, VisibilityTile& out) const;
    // Those of this layer that may touch the tile, by id.
    void layered(int tile, Layer layer, std::vector<std::uint32_t>& out) const;
    // Draws one triangle; returns the pixels that it may have changed, none if it does not show.
    image::Rect draw_one(std::uint32_t triangle, VisibilityTile& out) const;
    // The triangles among that.
    void draw(int tile, AreaTile& out) const;
    // Draws what is opaque, one primitive after the other, lines and points without a ground; calls
    // drawn(id, pixels that it may have changed) after each that shows. `order` is room for what
    // the tile holds.
    struct ById {
        std::vector<std::uint32_t> triangles;
        std::vector<Segment> segments;
        std::vector<Point> points;
    };
    using Drawn = std::function<void(std::uint32_t, const image::Rect&)>;
    void draw_each(int tile, VisibilityTile& out, ById& order, const Drawn& drawn) const;

    // Of what may be seen, and of all lines and points.
    std::span<const ScreenVertex> vertices() const { return vertices_; }
    // What is drawn of a triangle that has a vertex off the screen.
    Pieces pieces(std::uint32_t triangle) const;
    std::uint64_t triangles_drawn() const; // when the tiles are: of clusters that waited, too
    // No triangle that may be seen has a vertex off the screen.
    bool all_whole() const;

private:
    // What one worker found, with one list a tile. Whole triangles are named by their id, parts of
    // small ones by its place (geom/clusters.h), and set up again by the tile that draws them: four
    // bytes each instead of sixty.
    struct Batch {
        std::vector<PieceSetUp> pieces;
        std::vector<Segment> segments;
        std::vector<Point> points;
        struct Bin {
            std::vector<std::uint32_t> triangles, pieces, segments, points;
            // Clusters by number in the batch: what waits, and what is drawn and asked about.
            std::vector<std::uint32_t> waiting, asked;
            PartsByKind parts; // of small triangles
            const std::vector<TilePart>& parts_of(PartKind kind) const {
                return parts[static_cast<std::size_t>(kind)];
            }
            // Triangles that may cover whole blocks, by depth and id, until they are put before the
            // others, the nearest first: they hide what comes after them.
            std::vector<DepthAndId> large;
            void put_large_first();
            // f(place) for the triangles that have parts here.
            template <class F>
            void for_small(F&& f) const;
        };
        struct Asked {
            std::uint32_t cluster;
            ClusterBounds bounds;
        };
        std::vector<Asked> asked;
        std::vector<Bin> bins;
        std::vector<Bin> layered; // what is not opaque: none where everything is
        CullResult found;         // of one chunk
        PlacedParts placed;       // of what is kept of it
        std::uint64_t triangles_drawn = 0;
        bool cut = false; // some triangle was
        void clear(int tiles, bool layers);
    };
    void find_needed(Jobs& jobs, bool all_vertices);
    // Does a cluster wait? What does or is asked about the batch has.
    bool waits(Batch& batch, std::size_t cluster) const;
    void transform_needed(Jobs& jobs);
    void transform_blocks(std::size_t begin, std::size_t end);
    // In a tile whose others are drawn: which it does not hide; and those of them that waited. Of
    // one: what no tile has transformed before, and what it has in the tile.
    void draw_waiting(int tile, VisibilityTile& out);
    void transform_late(std::size_t cluster);
    void find_late(std::size_t cluster, const image::Rect& area, LateParts& out);
    // Of a chunk, by place, without those of clusters that are not seen.
    void add_seen(Batch& batch, std::size_t begin, std::size_t end) const;
    void add_triangles(Batch& batch, std::size_t begin, std::size_t end) const;
    void add_large(Batch& batch, const KeptTriangle& kept, std::uint32_t triangle) const;
    void add_small(Batch& batch, const KeptTriangle& kept) const;
    // What the tile whose corner is this pixel has of a small triangle.
    void add_part(const KeptTriangle& kept, int left, int top, PartsByKind& parts) const;
    TilePartList list_of(std::span<const TilePart> parts, PartKind kind) const {
        return {vertices_, mesh_->index_by_place(), parts, kind, mesh_->clusters.triangle};
    }
    void draw_backs(int tile, VisibilityTile& out) const;
    void add_clipped(Batch& batch, std::uint32_t triangle) const;
    std::array<ScreenVertex, 3> corners(std::uint32_t triangle) const;
    Layer layer_of(std::uint32_t triangle) const {
        return layers_[static_cast<std::size_t>(mesh_->material[triangle] + 1)];
    }
    std::uint32_t flags(std::uint32_t vertex) const;
    void add_segment(Batch& batch, std::uint32_t segment) const;
    void add_point(Batch& batch, std::uint32_t point) const;
    // f(tile) of each that has some of these pixels.
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
    std::vector<Layer> layers_;
    // Of clusters of triangles that may be seen: is it one? Empty: all may.
    std::vector<std::uint8_t> seen_;
    std::optional<ClusterCull> cluster_cull_;
    HiddenClusters* hidden_ = nullptr;
    // Of blocks of vertices: does one have it? What no triangle needs keeps old places. Those of
    // clusters that waited are found when a tile first needs them, under one of the locks.
    std::vector<std::uint8_t> needed_;
    std::array<std::mutex, 64> late_;
    std::atomic<std::uint64_t> late_drawn_ = 0; // triangles
    LargeArray<ScreenVertex> vertices_;
    std::vector<Batch> batches_;
};

} // namespace scanout::raster
