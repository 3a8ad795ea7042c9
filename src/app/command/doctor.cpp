// scanout doctor: what in a model's file makes a picture other than the surface that was meant.
#include "app/command/commands.h"
#include "app/files.h"
#include "app/message.h"
#include "app/model_file.h"
#include "app/progress_bar.h"
#include "app/report/doctor_report.h"
#include "app/report/report.h"
#include "base/check.h"
#include "base/write_file.h"
#include "geom/build.h"
#include "geom/diagnose/diagnose.h"
#include "geom/mend_seams.h"
#include "io/obj/write_obj.h"
#include "simd/targets.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

namespace scanout::app {
namespace {

Result<void> check_doctor(const Settings& s) {
    if (s.arguments.size() != 1)
        return s.arguments.empty()
                   ? fail(Exit::usage, "name a model to examine, as in `scanout doctor "
                                       "models/spot/spot.obj`")
                   : fail(Exit::usage, "doctor takes one model, not {}; run it once for each",
                          fmt::join(s.arguments, " and "));
    if (!s.fix.empty() && !s.fix.ends_with(".obj"))
        return fail(Exit::usage, "--fix {}: writes OBJ; name a file that ends in .obj", s.fix);
    const std::vector<std::string> outputs = {s.json.value_or(""), s.sarif, s.fix};
    TRY_VOID(check_standard_output(outputs));
    return check_outputs(s.arguments, outputs);
}

// The scene of a mesh whose materials show nothing but where it is.
scene::Scene plain_scene(geom::Mesh mesh, std::size_t materials) {
    scene::Scene scene;
    scene.mesh = std::move(mesh);
    scene.materials.resize(materials);
    return scene;
}

class Doctor {
public:
    Doctor(const Settings& settings, LoadedModel model, io::ModelSource source, Jobs& jobs)
        : settings_(settings), model_(std::move(model)), source_(std::move(source)), jobs_(jobs) {}

    Result<Exit> run() {
        report_.path = model_.scene.path;
        report_.format = model_.format;
        report_.quick = settings_.quick;
        report_.width = settings_.frame.width;
        report_.height = settings_.frame.height;
        report_.radii_per_unit = scene::radii_per_unit(model_.scene.mesh);
        report_.warnings = model_.warnings;
        report_.face_lines = source_.face_lines;
        report_.position_lines = source_.position_lines;
        TRY_VOID(examine());
        const Result<void> fixed = settings_.fix.empty() ? Result<void>() : fix();
        TRY_VOID(tell()); // what was found, also where it cannot be mended
        TRY_VOID(fixed);
        return settings_.strict && has_warning(report_) ? Exit::hazards : Exit::ok;
    }

private:
    Result<void> examine() {
        const scene::CameraOptions camera = fitted_camera_of(settings_, model_);
        TRY(const scene::View view, scene::make_view(model_.scene.mesh, settings_.model, {}, camera,
                                                     {}, report_.width, report_.height));
        constexpr double kMostGap = 0.01;  // of coarse depth formats: surfaces, not planes
        constexpr double kDiagnosis = 0.6; // share of the time
        ProgressBar bar("examining " + report_.path, settings_.quiet);
        geom::DiagnoseOptions how;
        how.gap = std::min(measure::depth_step(view, settings_.frame), kMostGap);
        how.textured = textured(model_.scene.materials);
        how.search = !settings_.quick;
        if (settings_.seconds > 0) how.seconds = settings_.seconds;
        how.progress = [&](double share) {
            bar.show(share * kDiagnosis);
            return true;
        };
        report_.diagnosis = geom::diagnose(jobs_, source_.polygons, how);
        const std::optional<scene::Scene> split = without_t_vertices(how.tolerance);
        measure::HazardPixelsOptions pixels;
        pixels.frame = settings_.frame;
        pixels.model = settings_.model;
        pixels.camera = camera;
        pixels.progress = [&](double share) { bar.show(kDiagnosis + share * (1 - kDiagnosis)); };
        const scene::Scene plain =
            plain_scene(std::move(model_.scene.mesh), model_.scene.materials.size());
        TRY(report_.pixels, measure::hazard_pixels(plain, split ? &*split : nullptr,
                                                   report_.diagnosis.marks, pixels, jobs_));
        return {};
    }

    // The model with T-vertices in the edges on which they lie; nothing where there are none.
    std::optional<scene::Scene> without_t_vertices(double tolerance) const {
        if (report_.diagnosis.count(geom::Hazard::t_vertices) == 0) return std::nullopt;
        geom::PolygonMesh polygons = source_.polygons;
        geom::split_t_vertices(jobs_, polygons, tolerance);
        geom::BuildOptions build;
        build.jobs = &jobs_;
        Warnings said_already;
        geom::BuildResult built =
            geom::build_mesh(std::move(polygons), build, report_.path, said_already);
        return plain_scene(std::move(built.mesh), model_.scene.materials.size());
    }

    Result<void> fix() {
        std::vector<std::string> materials;
        for (const scene::Material& material : model_.scene.materials)
            materials.push_back(material.name);
        if (std::any_of(materials.begin(), materials.end(),
                        [](const std::string& name) { return name.empty(); }))
            report_.not_kept.push_back(
                fmt::format("{}: textures and colours of faces are left out: OBJ keeps them in a "
                            "library, and {} has none",
                            settings_.fix, report_.path));
        const std::vector<std::string> libraries = libraries_beside(settings_.fix);
        constexpr double kMending = 0.8; // share of the time
        ProgressBar bar("mending " + report_.path, settings_.quiet);
        report_.mended = geom::mend(jobs_, source_.polygons, geom::DiagnoseOptions().tolerance,
                                    [&](double share) { bar.show(share * kMending); });
        if (source_.polygons.positions.empty())
            return fail(Exit::unreadable,
                        "{}: not written: no face of {} has an area, so nothing is left",
                        settings_.fix, report_.path);
        TRY_VOID(write_file(settings_.fix, io::obj_text(source_.polygons, materials, libraries)));
        report_.fixed_path = settings_.fix;
        return {};
    }

    // Names of the libraries as a file in the output's folder gives them.
    std::vector<std::string> libraries_beside(const std::string& output) {
        std::vector<std::string> names;
        const std::filesystem::path folder = std::filesystem::absolute(output).parent_path();
        for (const std::string& library : source_.libraries) {
            names.push_back(std::filesystem::absolute(library).lexically_relative(folder).string());
            if (names.back().starts_with(".."))
                report_.not_kept.push_back(
                    fmt::format("{}: its library {} lies outside of its folder: draw it with "
                                "--allow-outside, or copy library and textures",
                                output, names.back()));
        }
        return names;
    }

    Result<void> tell() const {
        print_warnings(report_.not_kept, settings_);
        if (settings_.json != "-" && settings_.sarif != "-") {
            for (const std::string& line : doctor_lines(report_))
                say(line, stdout);
            if (!report_.fixed_path.empty()) say(mended_line(report_), stdout);
        }
        if (!settings_.sarif.empty()) TRY_VOID(write_file(settings_.sarif, doctor_sarif(report_)));
        return write_report(settings_, doctor_json(report_));
    }

    const Settings& settings_;
    LoadedModel model_;
    io::ModelSource source_;
    Jobs& jobs_;
    DoctorReport report_;
};

} // namespace

Result<Exit> run_doctor(const Settings& settings) {
    TRY_VOID(check_doctor(settings));
    Jobs jobs(settings.threads);
    io::ModelSource source;
    TRY(LoadedModel model,
        load_model_with_messages(settings.arguments.front(), settings, jobs, &source));
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    return Doctor(settings, std::move(model), std::move(source), jobs).run();
}

} // namespace scanout::app
