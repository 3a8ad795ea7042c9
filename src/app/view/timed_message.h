// A line of text that is on the picture for some steps of the virtual clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace scanout::app {

class TimedMessage {
public:
    const std::string& text() const { return text_; } // empty: none is shown

    void show(std::string text, std::int64_t hide_step) {
        text_ = std::move(text);
        hide_step_ = hide_step;
    }
    void hide() { text_.clear(); }
    void advance_to(std::int64_t step) {
        if (step >= hide_step_) hide();
    }
    // The step that hides it.
    std::optional<std::int64_t> next_step() const {
        return text_.empty() ? std::nullopt : std::optional(hide_step_);
    }

private:
    std::string text_;
    std::int64_t hide_step_ = 0;
};

} // namespace scanout::app
