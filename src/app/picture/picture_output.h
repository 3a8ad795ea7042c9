// Where the pictures of a run go: a file each, one stream, an animation, or a sheet of them all.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"
#include "image/image.h"

#include <cstddef>
#include <memory>
#include <string>

namespace scanout::app {

class PictureOutput {
public:
    // What was done with a picture; no path: it is written at the end, with others.
    struct Written {
        std::string path;
        std::size_t bytes = 0;
        double encode_ms = 0;
    };

    PictureOutput() = default;
    PictureOutput(const PictureOutput&) = delete;
    PictureOutput& operator=(const PictureOutput&) = delete;
    virtual ~PictureOutput() = default;

    // Pictures come in the order in which they are drawn, all of one size. index: of the model's
    // pictures. caption: on sheets.
    virtual Result<Written> add(const image::Image& picture, int index,
                                const std::string& caption) = 0;
    // Writes what is left.
    virtual Result<void> finish() { return {}; }
};

// settings.output is a file's name where {name} is filled in; it outlives the output.
std::unique_ptr<PictureOutput> make_output(const Settings& settings, PictureFormat format);

// Exit::usage where the file would be larger than memory, or a side of the sheet longer than a
// picture's may be. `pictures`: of the run.
Result<void> check_output_size(const Settings& settings, PictureFormat format, int pictures);

} // namespace scanout::app
