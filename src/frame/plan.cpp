#include "frame/plan.h"

#include "raster/sample_pattern.h"

#include <fmt/format.h>

namespace scanout::frame {
namespace {

std::string names_of(std::string_view axis) {
    std::string names;
    for (const shade::Stage* stage : shade::catalogue())
        if (stage->card.axis == axis) names += fmt::format(" {}", stage->card.name);
    return names;
}

// The technique that the user names, or the automatic choice.
Result<const shade::Stage*> choose(std::string_view axis, const std::string& asked,
                                   std::string_view automatic) {
    const shade::Stage* stage =
        shade::find(axis, asked == "auto" ? automatic : std::string_view(asked));
    if (stage == nullptr)
        return fail(Exit::usage, "--{} {}: there is no such technique; choose auto{}", axis, asked,
                    names_of(axis));
    return stage;
}

Result<void> check_size(const FrameOptions& o) {
    if (o.width < 1 || o.height < 1 || o.width > kMaxSide || o.height > kMaxSide)
        return fail(Exit::usage,
                    "a picture of {}x{} pixels is not possible: each side must be 1 to {}", o.width,
                    o.height, kMaxSide);
    if (raster::sample_pattern(o.samples).empty())
        return fail(Exit::usage, "--samples {}: choose 1, 2, 4, 8 or 16", o.samples);
    return {};
}

} // namespace

SceneFacts facts(const scene::Scene& scene) {
    SceneFacts facts;
    const geom::Mesh& mesh = scene.mesh;
    facts.triangles = mesh.triangles();
    facts.lines = mesh.lines();
    facts.points = mesh.points();
    facts.vertex_colours = !mesh.colour.empty();
    std::vector<std::size_t> uses(scene.materials.size(), 0);
    for (const std::int32_t material : mesh.material)
        if (material >= 0) ++uses[static_cast<std::size_t>(material)];
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const scene::Material& material = scene.materials[i];
        if (material.map_diffuse.texture >= 0 && !mesh.uv.empty())
            facts.textured_triangles += uses[i];
        if (has_highlight(material)) facts.specular_triangles += uses[i];
    }
    return facts;
}

Result<FramePlan> plan(const FrameOptions& options, const SceneFacts& facts) {
    TRY_VOID(check_size(options));
    FramePlan plan;
    plan.options = options;
    const auto use = [&](const shade::Stage* stage) {
        plan.stages.push_back(stage);
        plan.attributes = plan.attributes | stage->card.needs;
    };
    TRY(const shade::Stage* interpolate, choose("interpolate", "auto", "perspective"));
    use(interpolate);
    TRY(const shade::Stage* texture, choose("texture", options.texture, "bilinear"));
    if (facts.textured_triangles > 0) {
        use(texture);
        plan.reasons.push_back(fmt::format("texture {}: {} of {} triangles have a readable map_Kd",
                                           texture->card.name, facts.textured_triangles,
                                           facts.triangles));
    } else {
        plan.reasons.push_back(
            "texture off: no triangle has a readable map_Kd and texture coordinates");
    }
    TRY(const shade::Stage* reflection,
        choose("reflection", options.reflection,
               facts.specular_triangles > 0 ? "blinn_phong" : "lambert"));
    use(reflection);
    plan.reasons.push_back(
        fmt::format("reflection {}: {} of {} triangles have a highlight (Ks not black, Ns above 0)",
                    reflection->card.name, facts.specular_triangles, facts.triangles));
    plan.attributes.colour = facts.vertex_colours;
    plan.reasons.push_back(facts.vertex_colours ? "vertex colours on: the file gives them"
                                                : "vertex colours off: the file gives none");
    if (facts.triangles == 0)
        plan.attributes.normal = plan.attributes.uv = false; // lines and points are unlit
    return plan;
}

} // namespace scanout::frame
