// Which key does what: the keys of the table of actions, changed by a preset and by the user's
// file. The camera that flies has keys of its own, which come first while it does.
#pragma once

#include "app/options/settings.h"
#include "app/view/actions.h"
#include "port/input.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

// A key as the table spells it: "Shift+Left", "Ctrl+C", "KP+", "?".
struct Key {
    std::uint32_t keysym = 0; // of xkbcommon; letters in lower case
    bool shift = false, control = false;
    friend bool operator==(const Key&, const Key&) = default;
};
std::optional<Key> parse_key(std::string_view text); // empty: no such key

class KeyMap {
public:
    static KeyMap standard();
    // The keys and the mouse of a preset.
    static KeyMap of(Nav nav);

    // The action that a key press is bound to. Letters and named keys are looked up by the
    // unshifted key, so that Caps Lock does not matter; signs such as + and ? by the sign that the
    // layout gives.
    std::optional<ActionId> find(const port::Event& event, bool flying = false) const;

    // These keys, each spelt as parse_key() reads it, are the action's from now on, and no other
    // action's. Returns the first that is no key; then nothing changes.
    std::optional<std::string> bind(ActionId action, std::span<const std::string> keys);

    // How the help sheet names the keys, or the hand, of a row of actions; empty: there are none.
    std::string label(const ActionRow& row) const;

    // What a drag with this button does; nothing where it does nothing.
    std::optional<ActionId> drag(port::Button button, bool shift, bool control) const;

private:
    struct Binding {
        std::string text;
        Key key;
        ActionId action;
    };
    std::string keys_of(ActionId action, bool first_alone) const;
    bool is_changed(ActionId action) const;

    std::vector<Binding> bindings_;
    std::vector<ActionId> changed_;
    Nav nav_ = Nav::scanout;
};

} // namespace scanout::app
