// A text file in parts that several threads read at once. A part is read as if nothing stood before
// it; only what comes out plain, with no fault and nothing that hangs on what came before, is taken
// as it is. The rest is read again by the one reader that knows what stands before, so the result
// and every message are those of reading from beginning to end.
#pragma once

#include "base/jobs.h"
#include "io/animation_moment.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace scanout::io {

// All textures of a model together may take this much memory, decoded.
inline constexpr std::uint64_t kTextureBytes = std::uint64_t{1} << 30;

// How a file is read. But for the limits of textures the result does not depend on it.
struct Reading {
    Jobs* jobs = nullptr; // null, or of one thread: from beginning to end
    std::size_t part_bytes = std::size_t{512} * 1024;
    std::size_t* read_again = nullptr; // counts the parts that had to be, where given
    std::uint64_t texture_bytes = kTextureBytes;
    std::uint64_t memory_bytes = ~std::uint64_t{0}; // that the model may take
    bool allow_outside = false;                 // files outside of the model's folder may be read
    bool lines = false;                         // note where elements stand, in formats of lines
    std::optional<AnimationMoment> animation{}; // of a file that has some; none: at rest
};

class TextParts {
public:
    explicit TextParts(const Reading& how) : how_(how) {}

    // True of the start of a line where the format lets a part begin.
    using MayBegin = bool (*)(std::string_view from_line);

    // The parts to read next, from `text`'s begin on: some for each thread, each but for the file's
    // last ends behind a line end that no backslash continues. None where that is not worth it, or
    // cannot be: then read on by yourself, about part_bytes, and ask again.
    std::vector<std::string_view> next(std::string_view text, MayBegin may_begin);

    // How many of these had to be read again. Where most are, fewer are tried.
    void read_again(std::size_t parts, std::size_t of);

    Jobs& jobs() const { return *how_.jobs; }
    std::size_t part_bytes() const { return how_.part_bytes; }

private:
    std::size_t cut(std::string_view text, std::size_t from, MayBegin may_begin) const;

    Reading how_;
    std::size_t pause_ = 0, pauses_left_ = 0; // calls of next() that give none
};

} // namespace scanout::io
