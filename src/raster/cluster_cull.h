// Which clusters of triangles no pixel can show: beside the picture, or turned away as a whole.
// Never one that the triangles' own tests would keep: triangles snap to the grid, and one that is
// thin there may turn over.
#pragma once

#include "geom/clusters.h"
#include "image/image.h"
#include "raster/cull.h"
#include "raster/screen.h"

#include <cstdint>
#include <optional>
#include <span>

namespace scanout::raster {

// What a cluster can show in.
struct ClusterBounds {
    image::Rect pixels; // of the picture
    float nearest;      // no depth of it is nearer
};

class ClusterCull {
public:
    ClusterCull(const ScreenTransform& transform, Facing keep);
    // hidden[i]: 1 where the cluster is, else 0.
    void find_hidden(std::span<const geom::Cluster> clusters, std::uint8_t* hidden) const;
    // None where some vertex may lie off the screen.
    std::optional<ClusterBounds> bounds(const geom::Cluster& cluster) const;

    static constexpr double kSlack = 1 + 1e-9; // what is known of a cluster is rounded
    static constexpr double kBesidePixels = 2; // however far samples lie from pixels' centres

    // What is asked of clusters, side by side.
    struct Plane { // at a place p of the mesh: normal . p + offset
        DVec3 normal;
        double offset, length; // of the normal
    };
    struct Terms {
        double turn; // 1: what faces away from the eye is not kept; -1: what faces it; 0: all is
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
