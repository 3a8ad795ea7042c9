// The viewer's state, as plain values: only actions and steps of the virtual clock change it.
#pragma once

#include "app/switches/live_switches.h"
#include "frame/options.h"
#include "scene/light.h"
#include "scene/pose.h"
#include "scene/section.h"
#include "scene/view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace scanout::app {

// The view of the model, everything in it that keys and mouse change: undo and reset restore it.
struct Look {
    scene::Pose pose;
    scene::Orbit orbit;
    int view = -1; // index into kViews; -1: the command line's camera
    scene::Projection projection = scene::Projection::perspective;
    scene::UpAxis up = scene::UpAxis::plus_y;
    frame::Cull cull = frame::FrameOptions().cull;
    std::string edges = "none";                // over the shading: a technique of that axis
    std::string colour_by = "light";           // likewise
    frame::Annotations annotations;            // likewise
    std::optional<scene::SectionSpec> section; // that the model is cut by
    bool turntable = false;
    bool plays = false;            // a motion
    std::int64_t motion_steps = 0; // of the virtual clock that it has played, since --time
    Rendering rendering;
    std::array<int, 3> stretch{}; // zoom levels along the model's x, y and z
    scene::Flight flight;
    bool flies = false;                                       // keys and mouse fly the camera
    std::array<scene::LightMove, scene::kMaxLights> lights{}; // of the frame's lights
    friend bool operator==(const Look&, const Look&) = default;
};

struct PointerState {
    int x = 0, y = 0; // pixels
    bool visible = false;
    std::int64_t hide_step = 0;
    friend bool operator==(const PointerState&, const PointerState&) = default;
};

struct ViewerState {
    Look look;
    bool camera_mode = false; // keys and mouse drive the camera instead of the model
    bool info = false;
    int help = 0;                    // the page of the help sheet that is open, from 1; 0: none
    int warnings = 0;                // likewise of the file's warnings
    int explain = 0;                 // the page of the plan that is open, from 1; 0: none
    int doctor = 0;                  // the hazard that is selected, from 1; 0: the panel is closed
    bool measuring = false;          // clicks choose points, or the command line did
    std::array<DVec3, 3> measured{}; // file coordinates
    int measured_count = 0;
    bool error_map = false; // in place of the picture, what it errs
    bool split = false;     // the reference to the right of a line
    bool frontier = false;  // its panel
    int split_x = 0;        // of the line, pixels from the left
    int file = 0;
    int scale_axis = -1; // along which + and - scale; -1: all
    int fly_speed = 0;   // doublings
    int light = -1;      // the one that keys and mouse move; -1: none, they move model or camera
    PointerState pointer;
    friend bool operator==(const ViewerState&, const ViewerState&) = default;
};

} // namespace scanout::app
