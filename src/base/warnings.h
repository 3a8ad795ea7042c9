// Warnings: troubles that did not stop us. Each kind is one line, however often it occurs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scanout {

class Warnings {
public:
    // The first place of a kind is kept, later ones are counted: add("bad face", "cube.obj:12: face
    // wants vertex 9, the file has 8") twice reads "cube.obj:12: ... (and 1 more like it)".
    void add(std::string_view kind, std::string line);
    // `count` more occurrences of a kind at once.
    void add_more(std::string_view kind, std::size_t count);

    bool empty() const { return kinds_.empty(); }
    std::size_t count(std::string_view kind) const;
    // One finished line a kind, in the order of first occurrence.
    std::vector<std::string> lines() const;

private:
    struct Kind {
        std::string name;
        std::string first_line;
        std::size_t count = 0;
    };
    std::vector<Kind> kinds_;
};

} // namespace scanout
