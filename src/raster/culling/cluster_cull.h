// Cluster culling against the frustum and by facing: which clusters are outside the picture or
// back-facing as a whole. Never one that triangle culling would keep: triangles snap to the grid,
// and a thin one may turn over there.
#pragma once

#include "geom/clusters.h"
#include "image/image.h"
#include "raster/culling/cull.h"
#include "raster/screen/screen.h"

#include <cstdint>
#include <optional>
#include <span>

namespace scanout::raster {

// The screen bounds of a cluster.
struct ClusterBounds {
    image::Rect pixels; // of the picture
    float nearest;      // no depth of it is nearer
};

class ClusterCull {
public:
    ClusterCull(const ScreenTransform& transform, Facing keep);
    // culled[i]: 1 where the cluster is culled, else 0.
    void find_culled(std::span<const geom::Cluster> clusters, std::uint8_t* culled) const;
    // None where some vertex may lie off the screen.
    std::optional<ClusterBounds> bounds(const geom::Cluster& cluster) const;

    static constexpr double kSlack = 1 + 1e-9; // rounding of the clusters' bounds
    static constexpr double kBesidePixels = 2; // however far samples lie from pixels' centres

    // The view's side of the tests, the same for all clusters.
    struct Plane { // at a position p of the mesh: normal . p + offset
        DVec3 normal;
        double offset, length; // of the normal
    };
    struct Terms {
        double winding; // 1: culls back faces; -1: culls front faces; 0: neither
        bool perspective;
        double near_w;
        Plane w, x, y, z;  // view space: the distance along the view axis; to the right, up, back
        Plane edge[4];     // of the picture, positive inside, in pixels times w
        DVec3 eye;         // in the mesh; or, where the view is parallel, the way from it
        double eye_length; // of that
        // Twice a triangle's area in pixels is this by that in the mesh, the sine of its angle to
        // the view ray and its distance, over the cube of w.
        double area;
        // Of a length of the mesh in pixels, at distance 1 on the view axis: at most.
        double scale, stretch;
        double most_aside; // pixels from the view axis within which nothing is cut
    };

private:
    ScreenTransform transform_;
    Terms terms_;
};

} // namespace scanout::raster
