// The lines at which faces and positions of an OBJ file stand.
#include "io/obj/obj.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::io {
namespace {

RC_GTEST_PROP(ObjLines, AreThoseOfTheStatementsWhereverPartsBegin, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::vector<std::uint32_t> faces, positions = {1, 2, 3};
    std::uint32_t line = 4;
    const int statements = *rc::gen::inRange(0, 400);
    for (int i = 0; i < statements; ++i) {
        switch (random() % 8) {
        case 0:
            text += "# f 1 2 3\n";
            break;
        case 1:
            text += "v 1 2 3\n";
            positions.push_back(line);
            break;
        case 2:
            text += "f 1 2\n"; // too short
            break;
        case 3:
            text += "f 1 2 9999999\n"; // there is none: known at the end
            break;
        case 4: // over three lines
            text += "f 1 \\\n2 \\\n3\n";
            faces.push_back(line);
            line += 2;
            break;
        case 5:
            text += "\n";
            break;
        default:
            text += "f -1 -2 -3\n";
            faces.push_back(line);
        }
        ++line;
    }
    if (faces.empty()) {
        text += "f 1 2 3\n";
        faces.push_back(line);
    }
    Jobs jobs(2);
    for (const bool in_parts : {false, true}) {
        Reading how;
        if (in_parts) {
            how.jobs = &jobs;
            how.part_bytes = 100;
        }
        Warnings warnings;
        const auto plain = read_obj(text, "a.obj", warnings, nullptr, how);
        RC_ASSERT(plain && plain->face_lines.empty() && plain->position_lines.empty());
        how.lines = true;
        const auto read = read_obj(text, "a.obj", warnings, nullptr, how);
        RC_ASSERT(read.has_value());
        RC_ASSERT(read->face_lines == faces);
        RC_ASSERT(read->position_lines == positions);
        RC_ASSERT(read->polygons.faces() == faces.size());
    }
}

} // namespace
} // namespace scanout::io
