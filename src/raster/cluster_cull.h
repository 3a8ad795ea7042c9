// Which clusters of triangles no pixel can show: beside the picture, or turned away as a whole.
// Never one that the triangles' own tests would keep: triangles snap to the grid, and one that is
// thin there may turn over.
#pragma once

#include "geom/clusters.h"
#include "image/image.h"
#include "raster/cull.h"
#include "raster/screen.h"

#include <optional>

namespace scanout::raster {

// What a cluster can show in.
struct ClusterBounds {
    image::Rect pixels; // of the picture
    float nearest;      // no depth of it is nearer
};

class ClusterCull {
public:
    ClusterCull(const ScreenTransform& transform, Facing keep);
    bool hides(const geom::Cluster& cluster) const;
    // None where some vertex may lie off the screen.
    std::optional<ClusterBounds> bounds(const geom::Cluster& cluster) const;

private:
    struct Plane { // at a place p of the mesh: normal . p + offset
        DVec3 normal;
        double offset, length; // of the normal
    };
    Plane plane(const DVec3& weights) const;
    bool beside(const geom::Cluster& cluster, double most_w) const;
    bool turned_away(const geom::Cluster& cluster, double least_w, double most_w) const;

    ScreenTransform transform_;
    double turn_; // 1: what faces away from the eye is not kept; -1: what faces it; 0: all is
    DVec3 row_[3];
    Plane w_, x_, y_, z_; // view space: the distance along the view axis; to the right, up, back
    Plane edge_[4];       // of the picture, positive inside, in pixels times w
    double determinant_;  // of the mesh's space in the view's
    DVec3 eye_;           // in the mesh; or, where the view is parallel, the way to it
    double eye_length_;   // of that
    double stretch_;      // at most, of a length of the mesh in pixels at distance 1
};

} // namespace scanout::raster
