// The frame state, and all else that shading reads of a frame's plan, view, lights and shadows:
// what stages, the gatherer and the transparency pass are given is made here, and only here.
#pragma once

#include "frame/pass/lights.h"
#include "frame/plan/plan.h"
#include "raster/screen/screen.h"
#include "raster/stage/geometry.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/gather/gather_input.h"
#include "shade/mip/mip_chain.h"
#include "shade/setup/interpolation_step.h"
#include "shade/stage.h"

#include <optional>
#include <vector>

namespace scanout::frame {

// What it is made of, and refers to.
struct ShadingSource {
    const scene::Scene& scene;
    const scene::View& view;
    const FramePlan& plan;
    const FrameLights& lights;
    const raster::Geometry& geometry;
    const raster::ScreenTransform& transform;
    const shade::MipChains& mips;
    const shade::AddedLines* added = nullptr;         // null: none
    std::span<const Vec3> triangle_colours = {};      // of frames that colour by a fact
    const shade::LightShadow* shadows = nullptr;      // of each light; null: none casts
    const shade::OcclusionImage* occlusion = nullptr; // of frames that have it
    shade::LinearPicture* linear = nullptr;           // also filled, unless null
};

class ShadingInput {
public:
    explicit ShadingInput(const ShadingSource& from);
    ShadingInput(const ShadingInput&) = delete;
    ShadingInput& operator=(const ShadingInput&) = delete;
    const shade::GatherInput& gather() const { return gather_; }

private:
    void set_frame(const ShadingSource& from);
    void set_transparency(const FramePlan& plan);
    void set_gather(const ShadingSource& from);

    std::optional<shade::StepLimits> steps_;
    std::vector<DVec2> uv_steps_;
    std::vector<std::uint8_t> blends_;
    shade::FrameState frame_;
    shade::TransparencyInput transparency_;
    shade::GatherInput gather_;
};

} // namespace scanout::frame
