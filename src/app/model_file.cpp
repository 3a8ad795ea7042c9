#include "app/model_file.h"

#include "app/files.h"
#include "app/message.h"
#include "app/moving/moment.h"
#include "app/picture/texture_file.h"
#include "app/progress_bar.h"
#include "base/stopwatch.h"
#include "io/load.h"
#include "scene/fit.h"
#include "scene/section.h"

#include <algorithm>
#include <utility>

namespace scanout::app {

// --colour and --opacity: of all materials, in place of what the file says.
static void override_materials(const Settings& settings, scene::Scene& scene) {
    const auto change = [&](scene::Material& material) {
        if (settings.colour) {
            material.diffuse = *settings.colour;
            material.map_diffuse = {};
        }
        if (settings.opacity) {
            material.opacity = static_cast<float>(*settings.opacity);
            material.map_opacity = {};
            material.alpha_cut.reset();
        }
    };
    change(scene.unnamed);
    std::for_each(scene.materials.begin(), scene.materials.end(), change);
    if (settings.colour) scene.mesh.colour.clear();
}

Result<LoadedModel> load_model(const std::string& path, const Settings& settings, Jobs& jobs,
                               const std::function<bool(double)>& progress, io::ModelSource* source,
                               const std::optional<io::Reach>& reach) {
    if (path != "-") TRY_VOID(check_readable(path));
    const Stopwatch watch;
    Warnings warnings;
    io::LoadOptions options;
    options.progress = progress;
    options.jobs = &jobs;
    options.format = settings.model_format;
    options.memory_bytes =
        std::uint64_t{1'000'000} * static_cast<std::uint64_t>(settings.max_memory_mb);
    options.allow_outside = settings.allow_outside;
    options.split_t_vertices = settings.split_t_vertices && source == nullptr; // as the file has it
    options.unnamed_colour = settings.unnamed_colour;
    options.clamps = settings.frame.wrap == "clamp";
    if (!settings.animation.empty())
        options.animation = {settings.animation, seconds_of(settings, 0), reach};
    io::LoadTimes times;
    options.times = &times;
    io::ModelFormat format{};
    options.format_read = &format;
    options.source = source;
    std::vector<std::string> libraries;
    options.libraries = &libraries;
    TRY(scene::Scene scene, io::load(path, options, warnings));
    // CAD programs and slicers have z up.
    const auto up = format == io::ModelFormat::stl ? scene::UpAxis::plus_z : scene::UpAxis::plus_y;
    LoadedModel model;
    model.scene = std::move(scene);
    model.load_times = times;
    model.up = up;
    model.format = format;
    model.libraries = std::move(libraries);
    model.warnings = warnings.lines();
    override_materials(settings, model.scene);
    if (!settings.texture_file.empty())
        TRY_VOID(put_texture(settings.texture_file, model.scene, model.warnings));
    if (settings.section) {
        const Stopwatch cutting;
        model.section = settings.section;
        scene::put_section(jobs, settings.section, model.scene, model.whole);
        if (settings.verbose)
            say(fmt::format("section {}: {:.2f} ms", model.scene.section->plane,
                            cutting.milliseconds()));
        if (const std::string line = scene::remark(*model.scene.section); !line.empty())
            model.warnings.push_back(fmt::format("{}: {}", path, line));
    }
    model.load_ms = watch.milliseconds();
    return model;
}

scene::CameraOptions camera_of(const Settings& settings, const LoadedModel& model) {
    scene::CameraOptions camera = settings.camera;
    if (!settings.up_given) camera.up = model.up;
    return camera;
}

// The corners of a mesh's box, framed as the mesh is.
static geom::Mesh box_of(const geom::Mesh& mesh) {
    geom::Mesh box;
    box.centre = mesh.centre;
    box.exponent = mesh.exponent;
    box.radius = mesh.radius;
    for (unsigned i = 0; i < 8; ++i) {
        const DVec3 corner((i & 1U) != 0 ? mesh.box_max.x : mesh.box_min.x,
                           (i & 2U) != 0 ? mesh.box_max.y : mesh.box_min.y,
                           (i & 4U) != 0 ? mesh.box_max.z : mesh.box_min.z);
        box.position.emplace_back(scene::radii_from_centre(mesh, corner) * double{mesh.radius});
    }
    return box;
}

scene::CameraOptions fitted_camera_of(const Settings& settings, const LoadedModel& model) {
    const double aspect = static_cast<double>(settings.frame.width) / settings.frame.height;
    const scene::CameraOptions camera = camera_of(settings, model);
    // Of an animation all moments: the box that holds them.
    const geom::Mesh box = model.scene.animated ? box_of(model.whole_mesh()) : geom::Mesh();
    const geom::Mesh& mesh = model.scene.animated ? box : model.whole_mesh();
    if (settings.motion)
        return scene::fitted(mesh, settings.model, camera, aspect, *settings.motion);
    return scene::fitted(mesh, settings.model, camera, aspect, settings.turntable);
}

Result<LoadedModel> load_model_with_messages(const std::string& path, const Settings& settings,
                                             Jobs& jobs, io::ModelSource* source) {
    Result<LoadedModel> model = [&] {
        ProgressBar bar("reading " + path, settings.quiet);
        return load_model(
            path, settings, jobs,
            [&](double fraction) {
                bar.show(fraction);
                return true;
            },
            source);
    }();
    if (model) print_warnings(model->warnings, settings);
    return model;
}

void print_warnings(const std::vector<std::string>& warnings, const Settings& settings) {
    if (settings.quiet) return;
    for (const std::string& line : warnings)
        say("scanout: warning: " + line);
}

void warn(const std::vector<std::string>& warnings, const Settings& settings,
          std::vector<std::string>& report) {
    print_warnings(warnings, settings);
    report.insert(report.end(), warnings.begin(), warnings.end());
}

} // namespace scanout::app
