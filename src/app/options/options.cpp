#include "app/options/options.h"

#include "app/options/readers.h"
#include "app/options/values.h"
#include "app/picture/nearest.h"
#include "image/colour_models.h"

#include <algorithm>
#include <array>

namespace scanout::app {
namespace {

constexpr unsigned kView = static_cast<unsigned>(Command::view);
constexpr unsigned kRender = static_cast<unsigned>(Command::render);
constexpr unsigned kCompare = static_cast<unsigned>(Command::compare);
constexpr unsigned kList = static_cast<unsigned>(Command::list);
constexpr unsigned kExplain = static_cast<unsigned>(Command::explain);
constexpr unsigned kFrontier = static_cast<unsigned>(Command::frontier);
constexpr unsigned kDoctor = static_cast<unsigned>(Command::doctor);
constexpr unsigned kGenerate = static_cast<unsigned>(Command::generate);
constexpr unsigned kInfo = static_cast<unsigned>(Command::info);
constexpr unsigned kRestore = static_cast<unsigned>(Command::restore);
constexpr unsigned kSpectrum = static_cast<unsigned>(Command::spectrum);
constexpr unsigned kColour = static_cast<unsigned>(Command::colour);
constexpr unsigned kSynthesise = static_cast<unsigned>(Command::synthesise);
constexpr unsigned kDraw = kView | kRender | kExplain | kFrontier;
constexpr unsigned kLoad = kDraw | kDoctor;                   // what takes a model and a view of it
constexpr unsigned kRead = kLoad | kInfo;                     // what takes a model
constexpr unsigned kMake = kSpectrum | kColour | kSynthesise; // a picture without a model
constexpr unsigned kAll = kRead | kCompare | kList | kGenerate | kRestore | kMake;

constexpr std::string_view kMetrics = "rmse rmse_codes psnr max flip ssim";

// Of each axis of src/techniques.h that has an option.
struct AxisOption {
    std::string_view axis;
    Slot slot;
    std::string_view choices, help;
};
constexpr std::string_view without_end(std::string_view words) {
    return words.substr(0, words.size() - 1);
}
#define SCANOUT_WORD(name) #name " "
#define SCANOUT_AXIS_asked(axis, LIST, help) {#axis, &frame::FrameOptions::axis, "", help},
#define SCANOUT_AXIS_listed(axis, LIST, help)                                                      \
    {#axis, Choice([](Settings& s, std::size_t i) {                                                \
         s.frame.axis = static_cast<decltype(s.frame.axis)>(i);                                    \
     }),                                                                                           \
     without_end(LIST(SCANOUT_WORD)), help},
#define SCANOUT_AXIS_planned(axis, LIST, help)
#define SCANOUT_AXIS(module, axis, LIST, Row, choice, help) SCANOUT_AXIS_##choice(axis, LIST, help)
constexpr AxisOption kAxes[] = {SCANOUT_AXES(SCANOUT_AXIS)};
#undef SCANOUT_WORD
#undef SCANOUT_AXIS
#undef SCANOUT_AXIS_asked
#undef SCANOUT_AXIS_listed
#undef SCANOUT_AXIS_planned

constexpr bool is_option_of(std::string_view option, std::string_view axis) {
    return std::equal(option.begin(), option.end(), axis.begin(), axis.end(),
                      [](char a, char b) { return a == b || (a == '-' && b == '_'); });
}
// The option of an axis, which is named as it is, with - for _.
constexpr Option axis_option(std::string_view name, unsigned commands = kDraw) {
    const AxisOption& a =
        *std::find_if(std::begin(kAxes), std::end(kAxes),
                      [&](const AxisOption& axis) { return is_option_of(name, axis.axis); });
    const bool listed = !a.choices.empty();
    return {name,
            0,
            listed ? "" : "NAME",
            a.choices,
            listed ? a.choices.substr(0, a.choices.find(' ')) : "auto",
            0,
            0,
            Group::picture,
            commands,
            a.slot,
            a.help};
}

// A part of the textbook renderers (src/textbook/methods.h); set(settings, index of the method).
struct PartOption {
    std::string_view part, choices, help;
};
#define SCANOUT_METHOD(name, blurb) #name " "
#define SCANOUT_PART(part, Type, METHODS, help)                                                    \
    {#part, without_end(METHODS(SCANOUT_METHOD)), "of --renderer: " help},
constexpr PartOption kParts[] = {TEXTBOOK_PARTS(SCANOUT_PART)};
constexpr std::string_view kRenderers = without_end("scanout " TEXTBOOK_RENDERER(SCANOUT_METHOD));
#undef SCANOUT_METHOD
#undef SCANOUT_PART
constexpr Option part_option(std::string_view name, Choice set) {
    const PartOption& p = *std::find_if(std::begin(kParts), std::end(kParts),
                                        [&](const PartOption& part) { return part.part == name; });
    return {name, 0,      "",    p.choices,     "", 0, 0, Group::picture, kRender,
            set,  p.help, false, name == "clip"};
}

// Rows: name, letter, value, choices, default, min, max, group, commands, slot, help.
constexpr std::array kOptions = std::to_array<Option>({
    {"output", 'o', "FILE", "", "", 0, 0, Group::output, kRender,
     Text([](Settings& s) -> std::string& { return s.output; }),
     "where the picture goes; - is standard output; {n} in the name is its number, {frame} that of "
     "its frame, {name} the model's name: of several models each gets a file"},
    {"output", 'o', "FILE", "", "", 0, 0, Group::output, kMake | kGenerate,
     Text([](Settings& s) -> std::string& { return s.output; }),
     "where it goes; - is standard output; generate writes a model where the name ends in .obj"},
    {"format", 0, "", "png ppm pam raw apng y4m", "", 0, 0, Group::output,
     kRender | kMake | kGenerate, Choice([](Settings& s, std::size_t i) {
         constexpr std::array kFormats = {PictureFormat::png,  PictureFormat::ppm,
                                          PictureFormat::pam,  PictureFormat::raw,
                                          PictureFormat::apng, PictureFormat::y4m};
         s.picture_format = kFormats[i];
     }),
     "the file's format, where its extension does not say it; apng (an animated PNG) and y4m "
     "(video, "
     "uncompressed) hold all pictures of a turntable or a motion"},
    {"fps", 0, "N", "", "30", 1, 1000, Group::output, kRender,
     Integer([](Settings& s) -> int& { return s.fps; }),
     "pictures a second of apng and y4m, and frames a second of --motion"},
    {"sheet", 0, "CxR", "", "", 0, 0, Group::output, kRender, Parsed(read_sheet),
     "draw all pictures of the run into one, C columns and R rows of --size with their names"},
    {"pair", 0, "", "", "", 0, 0, Group::output, kRender,
     Switch([](Settings& s) -> bool& { return s.pair; }),
     "draw two models by one camera, each where it lies in its file: side by side, or to a file "
     "each "
     "where -o has {name}"},
    {"shard", 0, "I/N", "", "", 0, 0, Group::output, kRender, Parsed(read_shard),
     "draw each Nth picture of the run alone, from the Ith on: N runs with I from 1 to N share the "
     "work and draw the same bits as one"},
    {"pixel-format", 0, "NAME", "", "", 0, 0, Group::output, kView | kRender | kExplain,
     Parsed(read_pixel_format),
     "the pixels of a display (`list formats`): raw files hold its bytes; other pictures, hashes "
     "and comparisons of explain are as that display would show them"},
    {"hash", 0, "", "", "", 0, 0, Group::output, kRender,
     Switch([](Settings& s) -> bool& { return s.hash; }),
     "print each picture's hash on standard output"},
    {"fail-if-empty", 0, "", "", "", 0, 0, Group::output, kRender,
     Switch([](Settings& s) -> bool& { return s.fail_if_empty; }),
     "exit code 4 where a picture shows nothing of its model"},
    {"json", 0, "FILE", "", "", 0, 0, Group::output, kRead | kCompare | kList, Parsed(read_json),
     "report as JSON, on standard output or to --json=FILE", true},
    {"csv", 0, "FILE", "", "", 0, 0, Group::output, kFrontier,
     Text([](Settings& s) -> std::string& { return s.csv; }),
     "write every point that was measured, a line each"},
    {"svg", 0, "FILE", "", "", 0, 0, Group::output, kFrontier,
     Text([](Settings& s) -> std::string& { return s.chart_svg; }),
     "draw error against time: all points, the frontier, the reference's own noise"},
    {"png", 0, "FILE", "", "", 0, 0, Group::output, kFrontier,
     Text([](Settings& s) -> std::string& { return s.chart_png; }), "draw the same as a picture"},
    {"sheet", 0, "FILE", "", "", 0, 0, Group::output, kFrontier,
     Text([](Settings& s) -> std::string& { return s.sheet_png; }),
     "draw a contact sheet: pictures with their errors and worst parts, enlarged"},
    {"html", 0, "FILE", "", "", 0, 0, Group::output, kFrontier,
     Text([](Settings& s) -> std::string& { return s.report_html; }),
     "write a report in one file: sentences, chart, tables, pictures with their errors"},

    {"size", 's', "WxH", "", "1280x720", 0, 0, Group::picture, kLoad, Parsed(read_size),
     "pixels of the picture; the viewer uses it only without a display"},
    {"samples", 0, "", "1 2 4 8 16", "4", 0, 0, Group::picture, kDraw,
     Choice([](Settings& s, std::size_t i) {
         s.frame.samples = 1 << i;
         s.frame.samples_asked = true;
     }),
     "coverage samples a pixel: more make smoother edges; --aa samples_N says the same"},
    axis_option("aa"),
    axis_option("render-scale"),
    {"background", 0, "COLOUR", "", "#303338", 0, 0, Group::picture, kDraw, Parsed(read_background),
     "#rrggbb or a name (black white grey slate red green blue sky transparent)"},
    axis_option("cull", kLoad),
    axis_option("interpolate"),
    axis_option("texture"),
    axis_option("wrap"),
    axis_option("source"),
    axis_option("mapping"),
    axis_option("reflection"),
    axis_option("ambient-occlusion"),
    axis_option("transparency"),
    axis_option("blend"),
    axis_option("depth", kLoad),
    axis_option("depth-test", kLoad),
    axis_option("stencil"),
    axis_option("colour-by"),
    axis_option("edges"),
    {"edge-angle", 0, "DEGREES", "", "30", 0, 180, Group::picture, kDraw,
     Real([](Settings& s) -> double& { return s.frame.edge_angle; }),
     "--edges feature draws the edges at which the surface bends by more than this"},
    {"annotate", 0, "LIST", "", "none", 0, 0, Group::picture, kDraw, Parsed(read_annotate),
     "draw over the shading, with commas between: points (vertices of faces), normals, box, grid "
     "(on the ground), axes (x red, y green, z blue)"},
    {"measure", 0, "POINTS", "", "none", 0, 0, Group::picture, kView | kRender,
     Parsed(read_measure),
     "X,Y,Z:X,Y,Z in the file's coordinates: say the distance, and draw its line over the picture; "
     "with :X,Y,Z again, both distances and the angle at the second point"},
    {"line-width", 0, "N", "", "1", 1, frame::kMaxLineWidth, Group::picture, kDraw,
     Integer([](Settings& s) -> int& { return s.frame.line_width; }),
     "pixels that a line is wide, of the file, of --edges and of --annotate"},
    {"point-size", 0, "N", "", "1", 1, frame::kMaxLineWidth, Group::picture, kDraw,
     Integer([](Settings& s) -> int& { return s.frame.point_size; }),
     "pixels a side of the square that a point is; of --annotate points 3 at least"},
    {"alpha-cut", 0, "ALPHA", "", "0.5", 0, 1, Group::picture, kDraw,
     Real([](Settings& s) -> double& { return s.frame.alpha_cut; }),
     "cut-out surfaces show where their alpha is at least this"},
    {"exposure", 0, "STOPS", "", "0", -frame::kMaxStops, frame::kMaxStops, Group::picture, kDraw,
     Real([](Settings& s) -> double& { return s.frame.exposure; }),
     "brighten or darken all light: times 2 for every stop"},
    axis_option("tone"),
    axis_option("blend-space"),
    axis_option("encode"),
    axis_option("dither"),

    axis_option("shading"),
    axis_option("shadow"),
    {"shadow-size", 0, "N", "", "1024", frame::kMinShadowSize, frame::kMaxShadowSize,
     Group::picture, kDraw, Integer([](Settings& s) -> int& { return s.frame.shadow_size; }),
     "texels a side of a shadow map; a point light inside the model has six of half that"},
    {"shadow-filter", 0, "N", "", "3", 1, frame::kMaxShadowFilter, Group::picture, kDraw,
     Integer([](Settings& s) -> int& { return s.frame.shadow_filter; }),
     "texels a side that map_pcf reads, and map_soft where its penumbra is narrower"},
    {"shadow-plane", 0, "NX,NY,NZ,D", "", "ground", 0, 0, Group::picture, kDraw,
     Parsed(read_shadow_plane),
     "the plane NX x + NY y + NZ z = D, in the file's coordinates, on whose triangles --shadow "
     "projected falls; ground: the largest flat side of the model's box"},
    {"light", 0, "SPEC", "", "", 0, 0, Group::picture, kDraw, Parsed(read_light),
     "instead of key and fill (hemisphere stays until it or ambient is named); may be given again: "
     "none, key, fill, hemisphere, "
     "ambient:POWER, hemisphere:X,Y,Z (where its sky is; goes on with :ground=#rrggbb), "
     "directional:X,Y,Z (where it comes from), point:X,Y,Z, spot:X,Y,Z:to=X,Y,Z:cone=INNER,OUTER "
     "in the file's coordinates, camera:X,Y,Z (fixed to the camera); each may go on with "
     ":colour= :power= :size= (radius in the file's unit; of a directional light in degrees, up to "
     "80) "
     ":shape=sphere|square :shadow=on|off :frame=world|camera :name=",
     false, true},
    axis_option("convolution"),

    {"effect", 0, "NAME=on|off|auto", "", "", 0, 0, Group::picture, kDraw, Parsed(read_effect),
     "force an effect on or off (`scanout explain` names them, with the reason for each); may be "
     "given "
     "again",
     false, true},

    {"view", 0, "", kViews, "", 0, 0, Group::camera, kLoad, Choice(choose_view),
     "look from a named side"},
    {"camera", 0, "AZ,EL[,DISTANCE]", "", "30,20", 0, 0, Group::camera, kLoad, Parsed(read_camera),
     "look from AZ degrees around (counter-clockwise seen from above, 0 is the front) and EL "
     "degrees "
     "up (-90 to 90), from DISTANCE bounding radii (default: the model just fits)"},
    {"shift", 0, "X,Y", "", "0,0", 0, 0, Group::camera, kLoad, Parsed(read_shift),
     "move the camera to the right and up, in bounding radii; with --camera's DISTANCE: a model "
     "that is made to fit is centred"},
    {"eye", 0, "X,Y,Z", "", "", 0, 0, Group::camera, kLoad, Parsed(read_eye),
     "put the eye there, in the model file's coordinates; wants --look-at"},
    {"look-at", 0, "X,Y,Z", "", "", 0, 0, Group::camera, kLoad, Parsed(read_look_at),
     "look at this point; --target X,Y,Z says the same"},
    {"like", 0, "FILE", "", "", 0, 0, Group::camera, kDraw,
     Text([](Settings& s) -> std::string& { return s.like; }),
     "draw as a screenshot of the viewer shows it (a PNG that holds its command line), or a file "
     "of "
     "--state; what the command line says counts before it"},
    {"fov", 0, "DEGREES", "", "45", 0.1, 175, Group::camera, kLoad,
     Real([](Settings& s) -> double& { return s.camera.fov_degrees; }), "vertical field of view"},
    {"screen-fit", 0, "", "height width stretch", "height", 0, 0, Group::camera, kLoad,
     Choice([](Settings& s, std::size_t i) {
         s.camera.screen_fit = static_cast<scene::ScreenFit>(i);
     }),
     "of the picture's sides, the one that --fov is of; stretch: both, as if the picture were "
     "square"},
    {"near", 0, "DISTANCE", "", "", 0, 0, Group::camera, kLoad, Parsed(read_near),
     "cut away what is nearer to the eye's plane, in bounding radii; default: nothing that shows"},
    {"far", 0, "DISTANCE", "", "", 0, 0, Group::camera, kLoad, Parsed(read_far),
     "cut away what is farther from the eye's plane, in bounding radii; default: nothing"},
    {"frustum", 0, "L,R,B,T,N,F", "", "", 0, 0, Group::camera, kLoad, Parsed(read_frustum),
     "see from the eye through a window from L to R and from B to T on the near plane, at N, as "
     "far "
     "as F, in bounding radii; in place of --fov, --near and --far"},
    {"ortho", 0, "L,R,B,T,N,F", "", "", 0, 0, Group::camera, kLoad, Parsed(read_ortho),
     "the same without foreshortening"},
    {"projection", 0, "", "perspective orthographic", "perspective", 0, 0, Group::camera, kLoad,
     Choice([](Settings& s, std::size_t i) {
         s.camera.projection = static_cast<scene::Projection>(i);
     }),
     "with or without foreshortening"},
    {"up", 0, "", "y -y z -z x -x", "", 0, 0, Group::camera, kLoad,
     Choice([](Settings& s, std::size_t i) {
         s.camera.up = static_cast<scene::UpAxis>(i);
         s.up_given = true;
     }),
     "the model's axis that points up; default: z in STL, else y"},
    {"model-format", 0, "NAME", "", "", 0, 0, Group::model, kRead, Parsed(read_model_format),
     "the model's format (obj stl ply off gltf), instead of the one that its content tells; a "
     "model named - is read from standard input"},

    {"max-memory", 0, "MB", "", "", 1, 100'000'000, Group::model, kRead,
     Integer([](Settings& s) -> int& { return s.max_memory_mb; }),
     "refuse a model that takes more to load, or whose reference does; default: what is available"},
    {"allow-outside", 0, "", "", "", 0, 0, Group::model, kRead,
     Switch([](Settings& s) -> bool& { return s.allow_outside; }),
     "read libraries and textures outside of the model's folder, too"},
    {"t-vertices", 0, "", "split keep", "", 0, 0, Group::model, kLoad,
     Choice([](Settings& s, std::size_t i) { s.split_t_vertices = i == 0; }),
     "vertices that lie within other faces' edges: split makes them corners of those faces, keep "
     "leaves the gaps (default split)"},
    {"base-colour", 0, "COLOUR", "", "0.6", 0, 0, Group::model, kDraw, Parsed(read_base_colour),
     "colour of what the file gives no material: #rrggbb, a name, or a linear grey from 0 to 1"},
    {"colour", 0, "R,G,B|#rrggbb|auto", "", "auto", 0, 0, Group::model, kDraw, Parsed(read_colour),
     "colour of all materials, in place of theirs, of map_Kd with its alpha, and of the vertices' "
     "(codes from 0 to 255)"},
    {"opacity", 0, "X|auto", "", "auto", 0, 0, Group::model, kDraw, Parsed(read_opacity),
     "opacity of all materials, from 0 to 1, in place of d, Tr and map_d; the alpha of map_Kd "
     "stays"},
    {"texture-file", 0, "FILE", "", "", 0, 0, Group::model, kDraw,
     Text([](Settings& s) -> std::string& { return s.texture_file; }),
     "lay this picture on what the file gives no texture: it multiplies a material's colour, and "
     "is "
     "the colour of what has no material"},
    {"scale", 0, "S or X,Y,Z", "", "1", 0, 0, Group::model, kRead, Parsed(read_scale),
     "scale the model about its centre; transforms are done in the order in which they are given, "
     "each as often as it is given",
     false, true, true},
    {"rotate", 0, "X,Y,Z", "", "0,0,0", 0, 0, Group::model, kRead, Parsed(read_rotate),
     "turn it, in degrees about x, y and z, in this order", false, true, true},
    {"rotate-axis", 0, "X,Y,Z:DEGREES", "", "", 0, 0, Group::model, kRead, Parsed(read_rotate_axis),
     "turn it about this axis", false, true, true},
    {"translate", 0, "X,Y,Z", "", "0,0,0", 0, 0, Group::model, kRead, Parsed(read_translate),
     "move it, in bounding radii", false, true, true},
    {"shear", 0, "AXIS:A,B", "", "", 0, 0, Group::model, kRead, Parsed(read_shear),
     "shear it: x:A,B moves x by A y + B z, y:A,B moves y by A x + B z, z:A,B moves z by A x + B y",
     false, true, true},
    {"matrix", 0, "16 NUMBERS", "", "", 0, 0, Group::model, kRead, Parsed(read_matrix),
     "transform it by a matrix, four rows of four numbers with commas between, for columns x, y, "
     "z, "
     "1: the last row is 0,0,0,1, the last column moves, in bounding radii",
     false, true, true},
    {"about", 0, "X,Y,Z|centre", "", "centre", 0, 0, Group::model, kRead, Parsed(read_about),
     "do the transforms that follow about this point, in the file's coordinates", false, true,
     true},
    {"section", 0, "PLANE", "", "none", 0, 0, Group::model, kDraw, Parsed(read_section),
     "cut away what lies in front of a plane, and cap the cut where the surface is closed: x:0.5 "
     "cuts "
     "away where x is above half of the model's box, -x:0.5 where it is below (also y, z); or "
     "NX,NY,NZ,D, where NX x + NY y + NZ z is above D in the file's coordinates"},
    {"renderer", 0, "", kRenderers, "scanout", 0, 0, Group::picture, kRender,
     Choice([](Settings& s, std::size_t i) {
         s.renderer.reset();
         if (i > 0) s.renderer = static_cast<textbook::Renderer>(i - 1);
     }),
     "who draws: scanout, or plain code by the methods of textbooks (`list renderers`)"},
    part_option("line",
                [](Settings& s, std::size_t i) { s.parts.line = static_cast<textbook::Line>(i); }),
    part_option("fill",
                [](Settings& s, std::size_t i) { s.parts.fill = static_cast<textbook::Fill>(i); }),
    part_option("interpolation",
                [](Settings& s, std::size_t i) {
                    s.parts.interpolation = static_cast<textbook::Interpolation>(i);
                }),
    part_option("hidden", [](Settings& s,
                             std::size_t i) { s.parts.hidden = static_cast<textbook::Hidden>(i); }),
    part_option("clip",
                [](Settings& s, std::size_t i) {
                    const auto clip = static_cast<textbook::Clip>(i);
                    (textbook::cuts_lines(clip) ? s.parts.line_clip : s.parts.clip) = clip;
                }),
    {"reference", 0, "", "", "", 0, 0, Group::picture, kRender,
     Switch([](Settings& s) -> bool& { return s.reference; }),
     "draw by rays in double precision, 16 to 4096 samples a pixel: slow, the picture that "
     "techniques are measured against; models and filters as asked, rungs ignored"},
    {"reference-samples", 0, "", "16 32 64 128 256 512 1024 2048 4096", "", 0, 0, Group::picture,
     kRender | kFrontier, Choice([](Settings& s, std::size_t i) { s.reference_samples = 16 << i; }),
     "most samples that a pixel of the reference gets; default: 4096; frontier takes 1024, a quick "
     "one 128"},
    {"turntable", 0, "N", "", "", 1, 100000, Group::model, kRender,
     Integer([](Settings& s) -> int& { return s.turntable; }),
     "draw N pictures of one full turn; -o wants {n} in the name"},
    {"motion", 0, "FILE", "", "", 0, 0, Group::model, kDraw,
     Text([](Settings& s) -> std::string& { return s.motion_file; }),
     "move model, camera and lights by the keys of a TOML file (docs/MOTION.md); view plays it, "
     "Space pauses"},
    {"animation", 0, "NAME|N", "", "", 0, 0, Group::model, kDraw,
     Text([](Settings& s) -> std::string& { return s.animation; }),
     "pose a glTF model by its animation of this name or number, at --time; render draws it frame "
     "by frame, view shows that moment"},
    {"time", 0, "SECONDS", "", "0", 0, 1e9, Group::model, kDraw, Parsed(read_time),
     "of --motion or --animation: this moment; view begins with it, and waits for Space"},

    {"backend", 0, "", "auto drm fbdev headless terminal", "auto", 0, 0, Group::display, kView,
     Choice([](Settings& s, std::size_t i) { s.backend = static_cast<Backend>(i); }),
     "where to show: auto tries DRM, then the framebuffer; terminal: in the terminal that scanout "
     "runs in, also by ssh; headless: nowhere, for replays"},
    {"terminal", 0, "", "auto kitty sixel blocks", "auto", 0, 0, Group::display, kView,
     Choice([](Settings& s, std::size_t i) { s.terminal = static_cast<TerminalGraphics>(i); }),
     "with --backend terminal: kitty's graphics, sixels, or half blocks of text; auto asks the "
     "terminal"},
    {"device", 0, "FILE", "", "", 0, 0, Group::display, kView | kList,
     Text([](Settings& s) -> std::string& { return s.device; }),
     "the display's device, such as /dev/dri/card1 or /dev/fb0"},
    {"connector", 0, "NAME|help", "", "", 0, 0, Group::display, kView,
     Text([](Settings& s) -> std::string& { return s.connector; }),
     "the DRM connector; help: lists them"},
    {"mode", 0, "WxH[@HZ]|preferred|highest|help", "", "", 0, 0, Group::display, kView,
     Text([](Settings& s) -> std::string& { return s.mode; }),
     "the DRM mode; help: lists them; default: the one that the monitor prefers"},
    {"watch", 0, "", "", "", 0, 0, Group::display, kView,
     Switch([](Settings& s) -> bool& { return s.watch; }),
     "read the shown file again when it, its materials or its textures are written anew; it need "
     "not "
     "be there yet"},
    {"state", 0, "FILE", "", "", 0, 0, Group::display, kView,
     Text([](Settings& s) -> std::string& { return s.state; }),
     "begin with the view that the file holds, if it is there, and write the last view into it"},
    {"no-pointer", 0, "", "", "", 0, 0, Group::display, kView,
     Switch([](Settings& s) -> bool& { return s.no_pointer; }), "draw no mouse pointer"},
    {"keys", 0, "FILE", "", "", 0, 0, Group::display, kView,
     Text([](Settings& s) -> std::string& { return s.keys; }),
     "take keys from a TOML file, lines such as rotate_left = [\"Left\", \"A\"] (`list keys` names "
     "the actions); before it ~/.config/scanout/keys.toml counts"},
    {"nav", 0, "", "scanout blender f3d", "scanout", 0, 0, Group::display, kView,
     Choice([](Settings& s, std::size_t i) { s.nav = static_cast<Nav>(i); }),
     "keys and mouse as in another viewer"},
    {"inertia", 0, "", "", "", 0, 0, Group::display, kView,
     Switch([](Settings& s) -> bool& { return s.inertia; }),
     "what a drag has turned goes on turning for a moment when the button goes up"},
    {"converge", 0, "", "auto on off", "auto", 0, 0, Group::display, kView,
     Choice([](Settings& s, std::size_t i) { s.converge = static_cast<Converge>(i); }),
     "when all is still, let the picture converge to what `render --reference` draws; auto: unless "
     "you name a rung of an axis, which then stays; not with --no-times, --record and --replay"},
    {"no-times", 0, "", "", "", 0, 0, Group::times, kView | kExplain | kFrontier,
     Switch([](Settings& s) -> bool& { return s.no_times; }),
     "show nothing that depends on the clock, so that equal states are equal pictures and equal "
     "tables; recording and replaying imply it"},
    {"record", 0, "FILE", "", "", 0, 0, Group::display, kView,
     Text([](Settings& s) -> std::string& { return s.record; }),
     "write every action with the step of its time, for --replay"},
    {"replay", 0, "FILE", "", "", 0, 0, Group::display, kView,
     Text([](Settings& s) -> std::string& { return s.replay; }),
     "play the actions of a file; its `frame NAME.png` lines write pictures"},

    {"axis", 0, "NAME", "", "", 0, 0, Group::times, kFrontier, Parsed(read_axis),
     "measure this axis of rungs alone (`list techniques`); may be given again", false, true},
    {"seconds", 0, "S", "", "40", 1, 100000, Group::times, kFrontier,
     Real([](Settings& s) -> double& { return s.seconds; }),
     "time of measuring, after the reference: what is not measured by then is left out"},
    {"quick", 0, "", "", "", 0, 0, Group::times, kFrontier,
     Switch([](Settings& s) -> bool& { return s.quick; }),
     "10 seconds, a noisier reference, FLIP of the frontier alone"},
    {"budget", 0, "TIME", "", "", 0, 0, Group::times, kView | kRender, Parsed(read_budget),
     "draw with the most accurate rungs whose frames take no longer on this machine (16ms, 0.5s; a "
     "number is milliseconds); axes that the command line names stay as named; measured once, then "
     "remembered. While something moves, view keeps to it by drawing fewer pixels; default: the "
     "display's refresh interval; none: it does not"},
    {"max-error", 0, "CODES", "", "", 0, 0, Group::times, kView | kRender, Parsed(read_max_error),
     "draw with the quickest rungs that err no more against the reference: root mean square of "
     "sRGB codes, 0 to 255; with --budget: within that time"},
    {"frames", 0, "A..B|N", "", "1", 0, 0, Group::times, kRender, Parsed(read_frames),
     "A..B: draw frames A to B of --motion or --animation, --fps a second; -o wants {frame} in the "
     "name. N: draw "
     "each picture N times, for times in --json"},
    {"threads", 't', "N", "", "0", 0, 256, Group::times, kRead | kMake | kGenerate,
     Integer([](Settings& s) -> int& { return s.threads; }),
     "threads that draw; 0 is one for each core; the picture is the same"},
    {"target", 0, "NAME", "", "auto", 0, 0, Group::times, kLoad, Parsed(read_target),
     "instruction set that draws (`list targets`); the picture is the same"},

    {"max-diff", 0, "N", "", "0", 0, 255, Group::comparison, kCompare,
     Integer([](Settings& s) -> int& { return s.max_difference; }),
     "a pixel counts when a channel differs by more than N of 255"},
    {"max-pixels", 0, "N", "", "0", 0, 1e12, Group::comparison, kCompare,
     BigInteger([](Settings& s) -> std::int64_t& { return s.max_pixels; }),
     "the pictures are equal when at most N pixels count"},
    {"out", 0, "PREFIX", "", "", 0, 0, Group::comparison, kCompare,
     Text([](Settings& s) -> std::string& { return s.difference_prefix; }),
     "where got.png, expected.png and difference.png go when the pictures differ: a folder, or the "
     "beginning of the names; default: beside A"},
    {"metric", 0, "", kMetrics, "", 0, 0, Group::comparison, kCompare,
     Choice([](Settings& s, std::size_t i) { s.metric = static_cast<Metric>(i + 1); }),
     "print this figure alone: rmse (of linear light, 0 to 1), rmse_codes (of sRGB codes, 0 to "
     "255), psnr (of linear light, dB), max (largest difference, codes), flip (mean FLIP), ssim"},
    {"limit", 0, "X", "", "", 0, 0, Group::comparison, kCompare, Parsed(read_limit),
     "with --metric: the pictures are the same when the figure is at most X; of psnr and ssim, at "
     "least X; default: whatever it is"},
    {"heatmap", 0, "FILE", "", "", 0, 0, Group::comparison, kCompare,
     Text([](Settings& s) -> std::string& { return s.heat_map; }),
     "write the error of each pixel as a picture: black is none, pale yellow 255 codes, each "
     "doubling of the error a step lighter; with --metric flip, FLIP from 0 to 1; with --metric "
     "ssim, 1 - SSIM from 0 to 1"},

    {"keep", 0, "LOW..HIGH", "", "", 0, 0, Group::picture, kSpectrum, Parsed(read_keep),
     "write the picture of these frequencies alone, as fractions of Nyquist's (half a wave a "
     "pixel; "
     "slanting waves have up to 1.42): ..0.25 blurs, 0.25.. leaves edges, around half the light of "
     "white; default: draw the spectrum"},
    {"channels", 0, "", image::kColourModelNames, "", 0, 0, Group::picture, kColour,
     Choice([](Settings& s, std::size_t i) { s.channels = image::colour_models()[i].name; }),
     "draw the channels that a picture has in this model, black to white: beside each other, or to "
     "a file each where -o has {n}"},
    {"by", 0, "", "patch pixel", "patch", 0, 0, Group::picture, kSynthesise,
     Choice([](Settings& s, std::size_t i) {
         constexpr std::array kWays = {signal::SynthesisBy::patch, signal::SynthesisBy::pixel};
         s.synthesis.by = kWays[i];
     }),
     "patch: squares of the sample, cut where they differ least; pixel: one pixel at a time, far "
     "slower"},
    {"window", 0, "N", "", "", signal::kLeastWindow, frame::kMaxSide, Group::picture, kSynthesise,
     Integer([](Settings& s) -> int& { return s.synthesis.window; }),
     "pixels a side of what has to fit: a patch (default: a quarter of the sample), or what is "
     "around a pixel (odd; default 11); as large as the largest part that repeats"},
    {"size", 's', "WxH", "", "", 0, 0, Group::picture, kSynthesise | kGenerate,
     Parsed(read_made_size),
     "pixels of the picture; of a model of terrain or mandelbrot, vertices along x and z; default: "
     "twice the sample's, 512x512, 257x257"},
    {"detail", 0, "N", "", "", 0, 100000, Group::picture, kGenerate,
     Parsed([](Settings& s, std::string_view text) -> Result<void> {
         TRY(const std::int64_t detail, parse_integer(text));
         if (detail < 0 || detail > 100000)
             return fail(Exit::usage, "must be 0 to 100000, not {}", detail);
         s.detail = static_cast<int>(detail);
         return {};
     }),
     "how fine: rings of zone_plate, squares a side of checker, octaves of terrain, iterations of "
     "mandelbrot, recursions of koch, thousand points of fern, sierpinski and dragon"},
    {"seed", 0, "N", "", "1", 0, 1e15, Group::picture, kSynthesise | kGenerate,
     BigInteger([](Settings& s) -> std::int64_t& { return s.seed; }),
     "another number, another picture; the same number, the same bits"},

    {"quick", 0, "", "", "", 0, 0, Group::examination, kDoctor,
     Switch([](Settings& s) -> bool& { return s.quick; }),
     "leave out the search for T-vertices, cracks, overlaps and intersections"},
    {"seconds", 0, "N", "", "60", 1, 100000, Group::examination, kDoctor,
     Real([](Settings& s) -> double& { return s.seconds; }),
     "search for overlaps and intersections no longer; what is left is said"},
    {"strict", 0, "", "", "", 0, 0, Group::examination, kDoctor,
     Switch([](Settings& s) -> bool& { return s.strict; }), "exit code 4 where there is a warning"},
    {"fix", 0, "OUT.obj", "", "", 0, 0, Group::output, kDoctor,
     Text([](Settings& s) -> std::string& { return s.fix; }),
     "write the model with all mended that needs no guess; no vertex moves"},
    {"sarif", 0, "FILE", "", "", 0, 0, Group::output, kDoctor,
     Text([](Settings& s) -> std::string& { return s.sarif; }),
     "report to a file that CI systems read (SARIF 2.1.0)"},

    {"no-config", 0, "", "", "", 0, 0, Group::general, kAll,
     Switch([](Settings& s) -> bool& { return s.no_config; }),
     "leave out the options of ~/.config/scanout/options and of SCANOUT_OPTIONS, and the keys of "
     "~/.config/scanout/keys.toml"},
    {"verbose", 'v', "", "", "", 0, 0, Group::general, kAll,
     Switch([](Settings& s) -> bool& { return s.verbose; }), "say more on standard error"},
    {"quiet", 'q', "", "", "", 0, 0, Group::general, kAll,
     Switch([](Settings& s) -> bool& { return s.quiet; }), "no warnings, no progress"},
});
static_assert(std::all_of(std::begin(kAxes), std::end(kAxes), [](const AxisOption& a) {
    return std::any_of(kOptions.begin(), kOptions.end(),
                       [&](const Option& option) { return is_option_of(option.name, a.axis); });
}));

Result<void> outside(const Option& option, std::string_view text) {
    return fail(Exit::usage, "must be {} to {}, not {}", option.min, option.max, text);
}

struct Applier {
    const Option& option;
    std::string_view text;
    Settings& settings;

    Result<void> operator()(Switch slot) const {
        slot(settings) = true;
        return {};
    }
    template <class Number>
    Result<void> whole(Number& place) const {
        TRY(const std::int64_t value, parse_integer(text));
        const double wide = static_cast<double>(value);
        if (wide < option.min || wide > option.max) return outside(option, text);
        place = static_cast<Number>(value);
        return {};
    }
    Result<void> operator()(Integer slot) const { return whole(slot(settings)); }
    Result<void> operator()(BigInteger slot) const { return whole(slot(settings)); }
    Result<void> operator()(Real slot) const {
        TRY(const double value, parse_real(text));
        if (value < option.min || value > option.max) return outside(option, text);
        slot(settings) = value;
        return {};
    }
    Result<void> words_for(std::string& place) const {
        if (text.empty())
            return fail(Exit::usage, "wants {}, not nothing; is a variable empty?", option.value);
        place = text;
        return {};
    }
    Result<void> operator()(Text slot) const { return words_for(slot(settings)); }
    Result<void> operator()(Asked slot) const { return words_for(settings.frame.*slot); }
    Result<void> operator()(Choice slot) const {
        const std::vector<std::string_view> allowed = words_in(option.choices);
        const auto found = std::find(allowed.begin(), allowed.end(), text);
        if (found == allowed.end())
            return fail(Exit::usage, "wants one of {}; not '{}'{}", option.choices, text,
                        did_you_mean(text, allowed));
        slot(settings, static_cast<std::size_t>(found - allowed.begin()));
        return {};
    }
    Result<void> operator()(Parsed slot) const { return slot(settings, text); }
};

// The axis whose technique the option names; "": none.
std::string_view axis_of(const Option& option) {
    if (option.name == "samples") return "aa";
    const auto* const found =
        std::find_if(std::begin(kAxes), std::end(kAxes),
                     [&](const AxisOption& axis) { return is_option_of(option.name, axis.axis); });
    return found != std::end(kAxes) ? found->axis : "";
}

} // namespace

std::span<const Option> options() {
    return kOptions;
}

Result<void> apply(const Option& option, std::string_view text, Settings& settings) {
    const Result<void> applied = std::visit(Applier{option, text, settings}, option.slot);
    if (!applied) return fail(applied.error().exit, "--{} {}", option.name, applied.error().what);
    if (const std::string_view axis = axis_of(option); !axis.empty())
        settings.named_axes.emplace(axis);
    // A number of samples that nobody asks for goes with another way to smooth edges.
    const auto asks_samples = [](const GivenOption& given) { return given.name == "samples"; };
    if (option.name == "aa" && !frame::is_auto(text) &&
        std::none_of(settings.given.begin(), settings.given.end(), asks_samples))
        settings.frame.samples = 1;
    settings.given.push_back({std::string(option.name), std::string(text)});
    return {};
}

} // namespace scanout::app
