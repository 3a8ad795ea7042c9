// Everything that the command line can say, as values. The table of options is the only writer.
#pragma once

#include "frame/options.h"
#include "image/pixel_format.h"
#include "io/formats.h"
#include "measure/known_frontier.h"
#include "scene/motion/motion.h"
#include "scene/section.h"
#include "scene/view.h"
#include "signal/band.h"
#include "signal/synthesis.h"
#include "textbook/methods.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scanout::app {

enum class Command : unsigned {
    view = 1,
    render = 2,
    compare = 4,
    list = 8,
    explain = 16,
    frontier = 32,
    doctor = 64,
    info = 128,
    generate = 256,
    restore = 512,
    spectrum = 1024,
    colour = 2048,
    synthesise = 4096
};

// In the order in which they are listed.
struct NamedCommand {
    std::string_view name;
    Command command;
};
inline constexpr std::array kCommands = {
    NamedCommand{"view", Command::view},        NamedCommand{"render", Command::render},
    NamedCommand{"explain", Command::explain},  NamedCommand{"frontier", Command::frontier},
    NamedCommand{"doctor", Command::doctor},    NamedCommand{"info", Command::info},
    NamedCommand{"compare", Command::compare},  NamedCommand{"spectrum", Command::spectrum},
    NamedCommand{"colour", Command::colour},    NamedCommand{"synthesise", Command::synthesise},
    NamedCommand{"list", Command::list},        NamedCommand{"restore", Command::restore},
    NamedCommand{"generate", Command::generate}};

// How a picture is written.
enum class PictureFormat : std::uint8_t { by_name, png, ppm, pam, raw, apng, y4m };
// What compare measures: a figure of image/metrics.h, image/compare.h or image/flip.h.
enum class Metric : std::uint8_t { none, rmse, rmse_codes, psnr, max, flip, ssim };
// Whether the viewer's picture converges to the reference when all is still; automatic: unless the
// user named a rung, which is then what stays on show.
enum class Converge : std::uint8_t { automatic, on, off };
// Whose keys and mouse the viewer has.
enum class Nav : std::uint8_t { scanout, blender, f3d };
enum class Backend : std::uint8_t { automatic, drm, fbdev, headless, terminal };
// How a terminal is drawn on.
enum class TerminalGraphics : std::uint8_t { automatic, kitty, sixel, blocks };

// An option as it stood on the command line.
struct GivenOption {
    std::string name, text; // without dashes; text: "" for a switch
};

// The cells of a contact sheet.
struct SheetGrid {
    int columns = 1, rows = 1;
};

// What of a model's transform has been given: scale, rotation and translation in this order are the
// transform's own; what comes in another order, more often or about a point is a step of its own.
struct ModelOrder {
    int given = 0; // 1: scale, 2: rotation, 3: translation, 4: steps
    std::optional<DVec3> about;
};

// One part of a run: of all pictures, numbered from 0, those whose number is index modulo count.
struct Shard {
    int index = 0, count = 1;
};

// Frames of a motion, both included: frame N is at N / fps seconds.
struct FrameRange {
    int first = 0, last = 0;
};

// What is drawn where nobody asks for anything.
inline frame::FrameOptions looks() {
    frame::FrameOptions options;
    options.samples = 4;
    options.samples_asked = false;
    options.lights = scene::default_lights();
    return options;
}

inline scene::CameraOptions stands() {
    scene::CameraOptions camera;
    camera.azimuth_degrees = 30;
    camera.elevation_degrees = 20;
    return camera;
}

struct Settings {
    Command command = Command::view;
    std::vector<GivenOption> given;     // in the order of the table of options
    std::vector<std::string> arguments; // models, pictures, or what to list
    std::vector<std::string> notes;     // on the options, to be said before the command runs
    bool no_config = false;             // the user's options for every run were left out

    frame::FrameOptions frame = looks();
    std::set<std::string, std::less<>> named_axes; // of techniques, that the command line names
    bool holds_budget = true; // while the viewer's picture moves; false: --budget none
    measure::Limits limits;   // --budget, --max-error: the other axes' rungs are chosen
    scene::ModelTransform model;
    ModelOrder order; // while the command line is read
    std::optional<scene::SectionSpec> section;
    std::optional<io::ModelFormat> model_format; // --model-format
    int max_memory_mb = 0; // that loading a model, or its reference, may take; 0: what is available
    bool allow_outside = false; // of the model's folder
    bool split_t_vertices = true;
    scene::CameraOptions camera = stands();
    Vec3 unnamed_colour{scene::kUnnamedGrey}; // --base-colour
    std::optional<Vec3> colour;               // --colour, linear; none: the file's
    std::optional<double> opacity;            // --opacity, likewise
    std::string texture_file;                 // --texture-file, on materials that name none
    std::vector<DVec3> measured;              // --measure: two points or three
    std::string named_view;                   // --view; already in `camera`
    bool camera_given = false, light_given = false, up_given = false;

    std::string target = "auto"; // SIMD target
    int threads = 0;             // 0: one a core
    bool verbose = false, quiet = false;
    std::optional<std::string> json; // the file; "-": standard output
    std::optional<image::PixelFormat> pixel_format;
    std::string pixel_format_name;

    std::string output;
    PictureFormat picture_format = PictureFormat::by_name;
    bool hash = false;
    bool fail_if_empty = false; // exit code 4 where a picture shows nothing of its model
    std::optional<textbook::Renderer> renderer; // none: the production renderer
    textbook::AskedParts parts;                 // of a textbook renderer
    bool reference = false;                     // drawn by rays, as what rungs are measured against
    int reference_samples = 0; // a pixel of the reference, at most; 0: what the command takes
    int turntable = 0;         // pictures in a full turn; 0: one picture
    int frames = 1;            // how often each picture is drawn, for times
    int fps = 30;              // pictures a second of an animation, frames a second of a motion
    std::string motion_file;
    std::string animation;               // of the model's file, by name or number
    std::optional<scene::Motion> motion; // of the file, once it is read
    std::optional<double> time;          // --time, seconds
    std::optional<FrameRange> range;     // --frames A..B
    std::optional<SheetGrid> sheet;
    std::optional<Shard> shard;
    bool pair = false; // two models by one camera

    Backend backend = Backend::automatic;
    TerminalGraphics terminal = TerminalGraphics::automatic;
    std::string device, connector, mode;
    std::string record, replay;
    std::string like, state; // files of views (view_file.h)
    bool watch = false;      // the shown file is read again when it changes
    bool no_pointer = false, no_times = false;
    std::string keys; // the file
    Nav nav = Nav::scanout;
    bool inertia = false; // what was turned by the mouse goes on for a while
    Converge converge = Converge::automatic;

    std::vector<std::string> axes; // of frontier; empty: all
    double seconds = 0;            // of measuring or searching; 0: what the command takes
    bool quick = false, strict = false;
    std::string csv, chart_svg, chart_png, sheet_png, report_html, fix, sarif; // files

    int max_difference = 0;
    std::int64_t max_pixels = 0;
    std::string difference_prefix;
    Metric metric = Metric::none;
    std::optional<double> limit; // of the metric
    std::string heat_map;        // the file

    std::optional<signal::Band> keep; // of spectrum; none: the spectrum itself is drawn
    std::string_view channels;        // of colour: a model's name; empty: a colour is asked for
    signal::Synthesis synthesis;      // but for its size and seed
    std::optional<std::pair<int, int>> made_size; // width and height of what is made
    std::int64_t seed = 1;
    std::optional<int> detail; // of generate; none: what the formula takes
};

inline bool is_given(const Settings& settings, std::string_view option) {
    return std::any_of(settings.given.begin(), settings.given.end(),
                       [&](const GivenOption& given) { return given.name == option; });
}

} // namespace scanout::app
