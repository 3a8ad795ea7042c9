#include "app/keys/key_map.h"

#include "app/keys/keys_file.h"
#include "app/options/readers.h"
#include "base/check.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

struct NamedKey {
    std::string_view name;
    std::uint32_t keysym;
};
constexpr std::array kNamedKeys = {
    NamedKey{"Left", XKB_KEY_Left},
    NamedKey{"Right", XKB_KEY_Right},
    NamedKey{"Up", XKB_KEY_Up},
    NamedKey{"Down", XKB_KEY_Down},
    NamedKey{"PageUp", XKB_KEY_Page_Up},
    NamedKey{"PageDown", XKB_KEY_Page_Down},
    NamedKey{"Home", XKB_KEY_Home},
    NamedKey{"End", XKB_KEY_End},
    NamedKey{"Insert", XKB_KEY_Insert},
    NamedKey{"Delete", XKB_KEY_Delete},
    NamedKey{"Backspace", XKB_KEY_BackSpace},
    NamedKey{"Escape", XKB_KEY_Escape},
    NamedKey{"Space", XKB_KEY_space},
    NamedKey{"Tab", XKB_KEY_Tab},
    NamedKey{"Enter", XKB_KEY_Return},
    NamedKey{"F1", XKB_KEY_F1},
    NamedKey{"F2", XKB_KEY_F2},
    NamedKey{"F3", XKB_KEY_F3},
    NamedKey{"F4", XKB_KEY_F4},
    NamedKey{"F5", XKB_KEY_F5},
    NamedKey{"F6", XKB_KEY_F6},
    NamedKey{"F7", XKB_KEY_F7},
    NamedKey{"F8", XKB_KEY_F8},
    NamedKey{"F9", XKB_KEY_F9},
    NamedKey{"F10", XKB_KEY_F10},
    NamedKey{"F11", XKB_KEY_F11},
    NamedKey{"F12", XKB_KEY_F12},
    NamedKey{"KP+", XKB_KEY_KP_Add},
    NamedKey{"KP-", XKB_KEY_KP_Subtract},
    NamedKey{"KP1", XKB_KEY_KP_1},
    NamedKey{"KP2", XKB_KEY_KP_2},
    NamedKey{"KP3", XKB_KEY_KP_3},
    NamedKey{"KP4", XKB_KEY_KP_4},
    NamedKey{"KP5", XKB_KEY_KP_5},
    NamedKey{"KP6", XKB_KEY_KP_6},
    NamedKey{"KP7", XKB_KEY_KP_7},
    NamedKey{"KP8", XKB_KEY_KP_8},
    NamedKey{"KP9", XKB_KEY_KP_9},
};

// Without NumLock, the keypad's digits are arrows and the like: the binding names the key by its
// place.
std::uint32_t without_num_lock(std::uint32_t keysym) {
    constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 9> kPlaces = {
        {{XKB_KEY_KP_End, XKB_KEY_KP_1},
         {XKB_KEY_KP_Down, XKB_KEY_KP_2},
         {XKB_KEY_KP_Page_Down, XKB_KEY_KP_3},
         {XKB_KEY_KP_Left, XKB_KEY_KP_4},
         {XKB_KEY_KP_Begin, XKB_KEY_KP_5},
         {XKB_KEY_KP_Right, XKB_KEY_KP_6},
         {XKB_KEY_KP_Home, XKB_KEY_KP_7},
         {XKB_KEY_KP_Up, XKB_KEY_KP_8},
         {XKB_KEY_KP_Page_Up, XKB_KEY_KP_9}}};
    for (const auto& [without, with] : kPlaces)
        if (keysym == without) return with;
    return keysym == XKB_KEY_ISO_Left_Tab ? XKB_KEY_Tab : keysym; // Shift+Tab
}

// The layout needed Shift to make this sign: the binding names the sign, not Shift.
bool is_shifted_sign(const port::Event& event) {
    const bool letter = (event.keysym >= XKB_KEY_a && event.keysym <= XKB_KEY_z) ||
                        (event.keysym >= XKB_KEY_A && event.keysym <= XKB_KEY_Z);
    return event.keysym != event.base_keysym && !letter;
}

// As other viewers have it, where that differs from the table of actions.
constexpr std::string_view kBlenderKeys = R"(
fit = "Home"
reset = ["R", "Backspace"]
rotate_left = ["Left", "KP4"]
rotate_right = ["Right", "KP6"]
rotate_up = ["Up", "KP8"]
rotate_down = ["Down", "KP2"]
toggle_fly = ["W", "Tab", "~"]
screenshot = ["S", "F12"]
)";
constexpr std::string_view kF3dKeys = R"(
previous_file = ["Left", "PageUp"]
next_file = ["Right", "PageDown"]
reload = ["Up", "F5"]
rotate_left = "4"
rotate_right = "6"
rotate_up = "8"
rotate_down = "2"
reset = ["Enter", "Home", "R"]
toggle_axes = "X"
aa_next = ["A", "F3"]
tone_next = ["T", "F8"]
colour_next = ["C", "M"]
cull_next = "Shift+C"
toggle_explain = "Shift+X"
)";

// Of each preset: what a drag does.
struct Drag {
    Nav nav;
    port::Button button;
    bool shift, control;
    ActionId action;
    std::string_view label;
};
using port::Button;
constexpr std::array kDrags = {
    Drag{Nav::scanout, Button::left, false, false, ActionId::drag_rotate, "Left drag"},
    Drag{Nav::scanout, Button::left, true, false, ActionId::drag_move, "Shift/mid drag"},
    Drag{Nav::scanout, Button::left, false, true, ActionId::drag_roll, "Ctrl+drag"},
    Drag{Nav::scanout, Button::middle, false, false, ActionId::drag_move, ""},
    Drag{Nav::scanout, Button::right, false, false, ActionId::drag_zoom, "Right drag"},
    Drag{Nav::blender, Button::middle, false, false, ActionId::drag_rotate, "Middle drag"},
    Drag{Nav::blender, Button::middle, true, false, ActionId::drag_move, "Shift+mid drag"},
    Drag{Nav::blender, Button::middle, false, true, ActionId::drag_zoom, "Ctrl+mid drag"},
    Drag{Nav::f3d, Button::left, false, false, ActionId::drag_rotate, "Left drag"},
    Drag{Nav::f3d, Button::left, false, true, ActionId::drag_roll, "Ctrl+left drag"},
    Drag{Nav::f3d, Button::middle, false, false, ActionId::drag_move, "Middle drag"},
    Drag{Nav::f3d, Button::right, false, false, ActionId::drag_zoom, "Right drag"},
};

bool is_drag(ActionId id) {
    return std::any_of(kDrags.begin(), kDrags.end(),
                       [&](const Drag& drag) { return drag.action == id; });
}

} // namespace

std::optional<Key> parse_key(std::string_view text) {
    Key key;
    if (text.starts_with("Ctrl+") && text.size() > 5) {
        key.control = true;
        text.remove_prefix(5);
    }
    if (text.starts_with("Shift+") && text.size() > 6) {
        key.shift = true;
        text.remove_prefix(6);
    }
    for (const NamedKey& named : kNamedKeys)
        if (named.name == text) {
            key.keysym = named.keysym;
            return key;
        }
    // Printable ASCII: the keysym is the character's code.
    if (text.size() != 1 || text[0] <= ' ' || text[0] > '~') return std::nullopt;
    const char c = text[0];
    key.keysym = static_cast<std::uint32_t>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return key;
}

KeyMap KeyMap::standard() {
    KeyMap map;
    for (const ActionRow& row : action_rows())
        for (const std::string_view text : words_in(row.keys)) {
            const std::optional<Key> key = parse_key(text);
            CHECK(key.has_value());
            map.bindings_.push_back({std::string(text), *key, row.id});
        }
    return map;
}

KeyMap KeyMap::of(Nav nav) {
    KeyMap map = standard();
    map.nav_ = nav;
    const std::string_view keys = nav == Nav::blender ? kBlenderKeys
                                  : nav == Nav::f3d   ? kF3dKeys
                                                      : std::string_view();
    const std::vector<std::string> faults = take_keys(keys, "preset", map);
    CHECK(faults.empty());
    return map;
}

std::optional<ActionId> KeyMap::find(const port::Event& event, bool flying) const {
    if (event.alt) return std::nullopt;
    std::optional<ActionId> found;
    for (const Binding& binding : bindings_) {
        if (binding.key.control != event.control) continue;
        const bool of_flight = is_flying(binding.action);
        if (of_flight ? !flying : found.has_value()) continue;
        const bool sign = is_shifted_sign(event) && binding.key.keysym == event.keysym;
        const bool key = binding.key.keysym == without_num_lock(event.base_keysym) &&
                         binding.key.shift == event.shift;
        if (!sign && !key) continue;
        if (of_flight) return binding.action;
        found = binding.action;
    }
    return found;
}

std::optional<std::string> KeyMap::bind(ActionId action, std::span<const std::string> keys) {
    std::vector<Binding> own;
    for (const std::string& text : keys) {
        const std::optional<Key> key = parse_key(text);
        if (!key) return text;
        own.push_back({text, *key, action});
    }
    std::erase_if(bindings_, [&](const Binding& other) {
        if (other.action == action) return true;
        const bool taken = is_flying(other.action) == is_flying(action) &&
                           std::any_of(own.begin(), own.end(),
                                       [&](const Binding& b) { return b.key == other.key; });
        if (taken) changed_.push_back(other.action);
        return taken;
    });
    std::move(own.begin(), own.end(), std::back_inserter(bindings_));
    changed_.push_back(action);
    return std::nullopt;
}

bool KeyMap::is_changed(ActionId action) const {
    return std::find(changed_.begin(), changed_.end(), action) != changed_.end();
}

std::string KeyMap::keys_of(ActionId action, bool first_alone) const {
    std::string text;
    for (const Binding& binding : bindings_) {
        if (binding.action != action) continue;
        text += (text.empty() ? "" : " ") + binding.text;
        if (first_alone) break;
    }
    return text;
}

std::string KeyMap::label(const ActionRow& row) const {
    if (is_drag(row.id)) {
        const auto* const drag = std::find_if(kDrags.begin(), kDrags.end(), [&](const Drag& d) {
            return d.nav == nav_ && d.action == row.id && !d.label.empty();
        });
        return drag != kDrags.end() ? std::string(drag->label) : std::string();
    }
    // The actions of the rows after it, that have no name on the sheet, stand on its line.
    const std::span<const ActionRow> rows = action_rows();
    const auto first = static_cast<std::size_t>(row.id);
    std::size_t end = first + 1;
    while (end < rows.size() && rows[end].sheet.empty() && !rows[end].keys.empty())
        ++end;
    bool changed = false;
    for (std::size_t i = first; i < end; ++i)
        changed = changed || is_changed(rows[i].id);
    if (!changed) return std::string(row.sheet);
    std::string text;
    for (std::size_t i = first; i < end; ++i) {
        const std::string keys = keys_of(rows[i].id, end > first + 1);
        text += (text.empty() || keys.empty() ? "" : " ") + keys;
    }
    return text;
}

std::optional<ActionId> KeyMap::drag(port::Button button, bool shift, bool control) const {
    const Drag* without = nullptr; // where no row has the modifiers
    for (const Drag& drag : kDrags) {
        if (drag.nav != nav_ || drag.button != button) continue;
        if (drag.shift ? shift : drag.control ? control && !shift : !shift && !control)
            return drag.action;
        if (!drag.shift && !drag.control) without = &drag;
    }
    return without != nullptr ? std::optional(without->action) : std::nullopt;
}

} // namespace scanout::app
