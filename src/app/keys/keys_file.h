// The user's keys: lines of TOML, an action's name and its key or keys.
//
//   # keys.toml
//   rotate_left = "A"
//   screenshot = ["F12", "Ctrl+P"]
//   quit = []                       no key
#pragma once

#include "app/keys/key_map.h"
#include "app/options/settings.h"
#include "base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

// Takes the lines of the text into the map. Returns a line about each that is wrong: what they
// would have changed stays as it was. `name` is the file's.
std::vector<std::string> take_keys(std::string_view text, const std::string& name, KeyMap& map);

struct UserKeys {
    KeyMap map;
    std::vector<std::string> faults;
};
// Of --nav, then of the user's keys.toml unless --no-config leaves it out, then of --keys. Fails
// (Exit::unreadable) where the file of --keys cannot be read.
Result<UserKeys> user_keys(const Settings& settings);

} // namespace scanout::app
