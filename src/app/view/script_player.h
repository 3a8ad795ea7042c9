// Plays a recording and keeps the place in it.
#pragma once

#include "app/view/recording.h"

#include <optional>
#include <utility>

namespace scanout::app {

class ScriptPlayer {
public:
    explicit ScriptPlayer(std::optional<Script> script) : script_(std::move(script)) {}

    bool has_script() const { return script_.has_value(); }
    // The step of the next action; nothing when all are taken.
    std::optional<std::int64_t> next_step() const {
        return script_ && next_ < script_->size() ? std::optional((*script_)[next_].step)
                                                  : std::nullopt;
    }
    // The next action, once its step has come. Null: none is due.
    const Action* take_due(std::int64_t step) {
        const std::optional<std::int64_t> next = next_step();
        return next && *next <= step ? &(*script_)[next_++].action : nullptr;
    }

private:
    std::optional<Script> script_;
    std::size_t next_ = 0;
};

} // namespace scanout::app
