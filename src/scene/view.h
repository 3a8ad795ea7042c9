// The matrices of one frame, from options and integer state: in double, computed once a frame.
// [Compendium 8, 10], [Course 2, 3], [Primer 3]. No float appears before a vertex is transformed.
#pragma once

#include "base/result.h"
#include "geom/mesh.h"
#include "math/vec.h"
#include "scene/pose.h"
#include "scene/transform.h"

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace scanout::scene {

enum class Projection : std::uint8_t { perspective, orthographic };
enum class UpAxis : std::uint8_t { plus_y, minus_y, plus_z, minus_z, plus_x, minus_x };
std::string_view name_of(UpAxis up); // "y", "-y" ...
DMat3 up_rotation(UpAxis up);        // the file's axes -> the world's axes, where y is up

// Scale, then rotation (about x, y, z in this order), then translation, about the model's centre;
// then the steps.
struct ModelTransform {
    DVec3 scale{1}; // one number on the command line, or three
    DVec3 rotate_degrees{0};
    DVec3 translate{0}; // bounding radii
    std::vector<TransformStep> steps;
    // By which a motion has turned it, after all of these, about its centre and the world's axes,
    // and moved it then, bounding radii.
    std::optional<DMat3> turn = std::nullopt;
    DVec3 moved{0};
};
// to_view * turn, to be followed by the rest: a model turned by hand is multiplied in this order.
DMat3 turned(const DMat3& to_view, const ModelTransform& model);

// Of the picture's sides, --fov's: its height, its width, or both, whatever the shape of pixels.
enum class ScreenFit : std::uint8_t { height, width, stretch };

// A picture's sides, as they are given: bounding radii on the near plane, or everywhere where the
// view is orthographic. Only for that projection.
struct Window {
    Projection projection = Projection::perspective;
    double left = -1, right = 1, bottom = -1, top = 1;
};

struct CameraOptions {
    double azimuth_degrees = 0, elevation_degrees = 0;
    double distance = 0; // bounding radii; 0: the sphere just fits the narrower side of the picture
    DVec2 shift{0};      // of the eye and what it looks at: to the right and up, bounding radii
    double fov_degrees = 45; // vertical, but for what `screen_fit` says
    ScreenFit screen_fit = ScreenFit::height;
    std::optional<Window> window; // in place of fov_degrees and screen_fit
    // Bounding radii from the eye: what is nearer or farther is not drawn. Of a perspective view
    // above 0; where it is not given, so near that nothing is missed. With a window they are its.
    std::optional<double> near, far;
    Projection projection = Projection::perspective;
    UpAxis up = UpAxis::plus_y;
    std::optional<DVec3>
        pivot; // what it looks at, in file coordinates; default: the model's centre
    // In file coordinates; both or neither. They replace azimuth, elevation, distance and pivot.
    std::optional<DVec3> eye, target;
};

// The same camera at these angles, where the model fits (scene/fit.h): in place of its eye and
// target.
CameraOptions fitted_from(double azimuth_degrees, double elevation_degrees, CameraOptions camera);

// The named views: azimuth and elevation in degrees. front back left right top bottom iso.
struct NamedView {
    std::string_view name;
    double azimuth_degrees, elevation_degrees;
};
std::optional<NamedView> named_view(std::string_view name);

// The view of a frame: all positions and projections that it needs. View space: eye at the origin,
// looks down -z, x right, y up, unit = bounding radius.
struct View {
    // view position = linear * mesh position + translation
    DMat3 linear{1};
    DVec3 translation{0};
    DMat3 normal{1};       // cofactor of linear, scaled to a largest entry near 1
    bool mirrored = false; // det(linear) < 0: front faces wind clockwise on the screen
    Projection projection = Projection::perspective;
    // Half the picture's extent at distance 1 (perspective) or everywhere (orthographic).
    double half_width = 1, half_height = 1;
    DVec2 middle{0};          // of the picture: its place to the right and up, likewise
    double near_distance = 0; // perspective: clips nearer points; depth = near / distance
    // What the caller cuts off, by the distance from the eye's plane: what is nearer, where the
    // view is orthographic; what is farther.
    double cut_near = -std::numeric_limits<double>::infinity(),
           cut_far = std::numeric_limits<double>::infinity();
    double target_distance = 0; // from the eye to what it looks at
    // Orthographic: depth = (z - depth_origin) * depth_scale, in (0, 1) for all of the model.
    double depth_origin = 0, depth_scale = 1;
    double centre_distance = 0; // from the eye's plane to the model's centre
    // The world, which does not move with the model: the file's axes in view space, and the
    // position of the model's centre before it is moved. Unit = bounding radius.
    DMat3 world_axes{1};
    DVec3 world_origin{0};
    UpAxis up = UpAxis::plus_y; // the file's axis that points up
};

// File coordinates -> bounding radii from the model's centre, along the file's axes.
DVec3 radii_from_centre(const geom::Mesh& mesh, const DVec3& file);
double radii_per_unit(const geom::Mesh& mesh); // of the file

// Fails (Exit::usage) for a singular camera: eye == target, numbers that are not finite.
Result<View> make_view(const geom::Mesh& mesh, const ModelTransform& model, const Pose& pose,
                       const CameraOptions& camera, const Orbit& orbit, int width, int height,
                       const Flight& flight = {});

// Half of the picture's width and height, of whose sides `fit` names one that is this long.
DVec2 half_extents(double half, ScreenFit fit, double aspect);

// How the flight turns what the camera on the orbit sees; `rotation` is that camera's, world ->
// view.
DMat3 turn_of(const Flight& flight, const DMat3& rotation);
// From the world's axes to view space.
inline DMat3 rotation_of(const View& view) {
    return view.world_axes * transpose(up_rotation(view.up));
}

// A power of two that scales the view's lengths so that their squares are floats; 1 but for scenes
// of 2^40 bounding radii and more.
double to_floats(const View& view);

// A place of the file in view space; and the point of a picture, in pixels from its upper left
// corner, at which a place in view space is seen. In perspective it must lie before the eye, z < 0.
DVec3 in_view(const DVec3& file_place, const View& view, const geom::Mesh& mesh);
DVec2 picture_point(const View& view, const DVec3& seen, int width, int height);

// The world units that one pixel spans on the plane through the model's centre: for dragging.
double world_units_per_pixel(const View& view, int height);

} // namespace scanout::scene
