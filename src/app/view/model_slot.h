// The slot of the shown model: a model and its plans, or the reason why there is none.
#pragma once

#include "app/model_file.h"
#include "frame/plan/plan_cache.h"

#include <optional>
#include <string>

namespace scanout::app {

class ModelSlot {
public:
    // A loaded model, or an error of its file, replaces the slot's contents.
    void put(LoadedModel model, const frame::FrameOptions& options);
    void put_error(std::string error);
    // Cuts the model by another plane, or by none; its facts are found anew.
    void put_section(const std::optional<scene::SectionSpec>& section,
                     const frame::FrameOptions& options, Jobs& jobs);

    const LoadedModel* model() const { return model_ ? &*model_ : nullptr; }
    // Whole: a section moves neither the camera nor the lights.
    const geom::Mesh* mesh() const { return model_ ? &model_->whole_mesh() : nullptr; }
    const frame::SceneFacts& facts() const { return plans_.facts(); } // of the model
    // A plan for the model; valid until the next call.
    Result<const frame::FramePlan*> plan(const frame::FrameOptions& options,
                                         const scene::View& view) {
        return plans_.plan(options, view);
    }

    const std::string& error() const { return error_; } // empty: none
    int generation() const { return generation_; }      // grows with each put()
    bool has_held_model() const { return has_held_model_; }

private:
    std::optional<LoadedModel> model_;
    frame::PlanCache plans_;
    std::string error_;
    int generation_ = 0;
    bool has_held_model_ = false;
};

} // namespace scanout::app
