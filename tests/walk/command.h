// Random command lines of `scanout render`: any technique of any axis, any effect forced, cameras
// from inside to far away, lights anywhere. What there is comes from the program's own tables, so
// that new techniques and effects join by themselves.
#pragma once

#include "support/random.h"

#include <string>
#include <vector>

namespace scanout::test {

// Where a model stands in its file's coordinates.
struct ModelPlace {
    std::string path;
    DVec3 centre{0};
    double radius = 1;
};

class CommandMaker {
public:
    CommandMaker();
    // Without the program's name, from `render` on.
    std::vector<std::string> make(const ModelPlace& model, Random& random) const;

private:
    struct Axis {
        std::string option; // "--blend-space"
        std::vector<std::string> names;
    };
    std::vector<Axis> axes_;
    std::vector<std::string> effects_, light_kinds_;
};

// As one types it.
std::string shell_line(const std::vector<std::string>& arguments);

} // namespace scanout::test
