// Frontiers that were measured, in files: a budget is met without measuring again. A file holds its
// key, its points, and a hash of both: what is damaged, or of another form, counts as missing.
#pragma once

#include "base/result.h"
#include "measure/known_frontier.h"

#include <optional>
#include <string>
#include <string_view>

namespace scanout::app {

class FrontierCache {
public:
    static constexpr std::size_t kMostFiles = 64;

    explicit FrontierCache(std::string folder) : folder_(std::move(folder)) {}
    // $XDG_CACHE_HOME/scanout, else $HOME/.cache/scanout (XDG Base Directory Specification: a
    // relative path counts as none). Exit::unreadable where there is neither.
    static Result<FrontierCache> of_user();

    std::optional<measure::KnownFrontier> find(const std::string& key) const;
    // Makes the folder where it is missing, and removes all but the newest kMostFiles files of it.
    // Exit::unreadable where the file cannot be written, and where anything but a regular file
    // stands in its place.
    Result<void> keep(const std::string& key, const measure::KnownFrontier& known) const;
    std::string file_of(const std::string& key) const;

private:
    void remove_old_files() const;

    std::string folder_;
};

// The file's text, and back; nothing for what is not the text of this key.
std::string to_text(const std::string& key, const measure::KnownFrontier& known);
std::optional<measure::KnownFrontier> parse_frontier(std::string_view text, const std::string& key);

} // namespace scanout::app
