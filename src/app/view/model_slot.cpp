#include "app/view/model_slot.h"

#include <utility>

namespace scanout::app {

void ModelSlot::put(LoadedModel model, const frame::FrameOptions& options) {
    ++generation_;
    model_ = std::move(model);
    plans_ = frame::PlanCache(frame::facts(model_->scene, options.shadow_plane));
    error_.clear();
    has_held_model_ = true;
}

void ModelSlot::put_section(const std::optional<scene::SectionSpec>& section,
                            const frame::FrameOptions& options, Jobs& jobs) {
    if (!model_) return;
    model_->section = section;
    scene::put_section(jobs, section, model_->scene, model_->whole);
    plans_ = frame::PlanCache(frame::facts(model_->scene, options.shadow_plane));
}

void ModelSlot::put_error(std::string error) {
    ++generation_;
    model_.reset();
    error_ = std::move(error);
}

} // namespace scanout::app
