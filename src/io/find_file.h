// Finds a file that a model names: models travel between systems, so names come with backslashes,
// in the wrong case, or with the folders of the machine that wrote them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace scanout::io {

std::string folder_of(const std::string& path); // "" for a bare file name

class FileFinder {
public:
    FileFinder() = default;
    // Finds nothing that a name leads to outside of this folder, by ".." or from the root; links in
    // the folder are its owner's word.
    explicit FileFinder(const std::string& root);

    // Does the name lead out of there?
    bool is_outside(const std::string& folder, std::string_view name) const;

    // The path of `name`, relative to `folder`: as it stands; with '\' as '/'; in any case,
    // composed or decomposed, and as Latin-1 (file_name.h). Only names that exist are returned,
    // whatever they are: Mapping refuses what is no regular file.
    std::optional<std::string> find(const std::string& folder, std::string_view name);

    // find() in `folder`, then in `other_folder`, then by the bare file name in both; likewise for
    // the name's other spellings.
    std::optional<std::string> find_anywhere(const std::string& folder,
                                             const std::string& other_folder,
                                             std::string_view name);

private:
    std::optional<std::string> entry_in_any_case(const std::string& folder, std::string_view name);

    std::string root_; // absolute, with a slash at its end; empty: anything may be read
    // Folders are read once: a model may name thousands of files that are not there.
    using Entries = std::unordered_map<std::string, std::string>; // folded -> as it stands
    std::unordered_map<std::string, Entries> folders_;
};

} // namespace scanout::io
