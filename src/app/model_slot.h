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

    const LoadedModel* model() const { return model_ ? &*model_ : nullptr; }
    const geom::Mesh* mesh() const { return model_ ? &model_->scene.mesh : nullptr; }
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
