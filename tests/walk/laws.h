// What must hold of every frame that a command line asks for.
#pragma once

#include "frame/facts/facts.h"
#include "scene/scene.h"
#include "support/random.h"

#include <string>
#include <vector>

namespace scanout::test {

enum class Outcome { drawn, refused, broken };

struct Verdict {
    Outcome outcome = Outcome::drawn;
    std::vector<std::string> faults;
};

struct WalkModel {
    scene::Scene scene;
    std::string path;
};

// Light is finite; another number of threads, size of tiles and SIMD target gives the same bits; an
// effect that the plan has off changes none when it is forced off or on, nor one that it has on
// when it is forced on, alone or all together (HARD-CASES P8, Z7). A command line that is refused
// says why on one line. random: chooses which effects, targets and threads.
Verdict judge(const std::vector<std::string>& arguments, const WalkModel& model, Random& random);

} // namespace scanout::test
