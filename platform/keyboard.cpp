#include "platform/keyboard.h"

#include <cstdlib>

#include <xkbcommon/xkbcommon.h>

namespace scanout::console {
namespace {

constexpr std::uint32_t kEvdevOffset = 8; // xkb key codes are evdev codes plus 8

} // namespace

void Keyboard::Free::operator()(xkb_context* context) const {
    xkb_context_unref(context);
}
void Keyboard::Free::operator()(xkb_keymap* keymap) const {
    xkb_keymap_unref(keymap);
}
void Keyboard::Free::operator()(xkb_state* state) const {
    xkb_state_unref(state);
}

Result<Keyboard> Keyboard::create() {
    Keyboard keyboard;
    keyboard.context_.reset(xkb_context_new(XKB_CONTEXT_NO_FLAGS));
    if (!keyboard.context_) return fail(Exit::no_display, "xkbcommon cannot start");
    // The layout is reported by us, in one line.
    xkb_context_set_log_level(keyboard.context_.get(), XKB_LOG_LEVEL_CRITICAL);
    const char* asked = std::getenv("XKB_DEFAULT_LAYOUT");
    const xkb_rule_names from_environment{};
    keyboard.keymap_.reset(xkb_keymap_new_from_names(keyboard.context_.get(), &from_environment,
                                                     XKB_KEYMAP_COMPILE_NO_FLAGS));
    keyboard.layout_ = asked != nullptr && *asked != 0 ? asked : "us";
    if (!keyboard.keymap_) {
        xkb_rule_names us{};
        us.rules = "evdev";
        us.model = "pc105";
        us.layout = "us";
        us.variant = "";
        us.options = "";
        keyboard.keymap_.reset(
            xkb_keymap_new_from_names(keyboard.context_.get(), &us, XKB_KEYMAP_COMPILE_NO_FLAGS));
        keyboard.layout_ =
            fmt::format("us (XKB_DEFAULT_LAYOUT={} cannot be used)", keyboard.layout_);
    }
    if (!keyboard.keymap_)
        return fail(Exit::no_display,
                    "no keyboard layout can be read: install the package xkb-data");
    TRY_VOID(keyboard.reset());
    return keyboard;
}

Result<void> Keyboard::reset() {
    state_.reset(xkb_state_new(keymap_.get()));
    if (!state_) return fail(Exit::internal, "xkbcommon: no memory for the keyboard's state");
    return {};
}

bool Keyboard::held(const char* modifier) const {
    return xkb_state_mod_name_is_active(state_.get(), modifier, XKB_STATE_MODS_EFFECTIVE) > 0;
}

port::Event Keyboard::key(std::uint32_t evdev_code, bool pressed) {
    const xkb_keycode_t code = evdev_code + kEvdevOffset;
    port::Event event;
    event.kind = port::EventKind::key;
    event.keycode = evdev_code;
    event.pressed = pressed;
    event.keysym = xkb_state_key_get_one_sym(state_.get(), code);
    const xkb_layout_index_t layout = xkb_state_key_get_layout(state_.get(), code);
    const xkb_keysym_t* base = nullptr;
    if (layout != XKB_LAYOUT_INVALID &&
        xkb_keymap_key_get_syms_by_level(keymap_.get(), code, layout, 0, &base) == 1)
        event.base_keysym = *base;
    event.shift = held(XKB_MOD_NAME_SHIFT);
    event.control = held(XKB_MOD_NAME_CTRL);
    event.alt = held(XKB_MOD_NAME_ALT);
    event.repeats = xkb_keymap_key_repeats(keymap_.get(), code) != 0;
    xkb_state_update_key(state_.get(), code, pressed ? XKB_KEY_DOWN : XKB_KEY_UP);
    return event;
}

} // namespace scanout::console
