// Key codes -> keysyms by the user's keyboard layout (xkbcommon).
#pragma once

#include "base/result.h"
#include "port/input.h"

#include <cstdint>
#include <memory>
#include <string>

struct xkb_context;
struct xkb_keymap;
struct xkb_state;

namespace scanout::console {

class Keyboard {
public:
    // The layout of XKB_DEFAULT_RULES, _MODEL, _LAYOUT, _VARIANT and _OPTIONS; one that cannot be
    // compiled is replaced by "us" (see layout()). Exit::no_display when even that fails.
    static Result<Keyboard> create();

    // One key edge by its evdev code -> the event for it, with the modifiers held until then.
    port::Event key(std::uint32_t evdev_code, bool pressed);

    // No key is held any more.
    Result<void> reset();

    const std::string& layout() const {
        return layout_;
    } // "de", "us (XKB_DEFAULT_LAYOUT=qq failed)"

private:
    struct Free {
        void operator()(xkb_context* context) const;
        void operator()(xkb_keymap* keymap) const;
        void operator()(xkb_state* state) const;
    };
    Keyboard() = default;
    bool held(const char* modifier) const;

    std::unique_ptr<xkb_context, Free> context_;
    std::unique_ptr<xkb_keymap, Free> keymap_;
    std::unique_ptr<xkb_state, Free> state_;
    std::string layout_;
};

} // namespace scanout::console
