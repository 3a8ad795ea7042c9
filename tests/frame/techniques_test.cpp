#include "frame/techniques.h"
#include "techniques.h"

#include <set>

#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

TEST(Techniques, HaveEveryNameOfTheTableOnceWithAWholeCard) {
#define SCANOUT_NAME(name) #name,
    const std::pair<std::string_view, std::vector<std::string_view>> axes[] = {
        {"interpolate", {SCANOUT_INTERPOLATE(SCANOUT_NAME)}},
        {"texture", {SCANOUT_TEXTURE(SCANOUT_NAME)}},
        {"wrap", {SCANOUT_WRAP(SCANOUT_NAME)}},
        {"mapping", {SCANOUT_MAPPING(SCANOUT_NAME)}},
        {"source", {SCANOUT_SOURCE(SCANOUT_NAME)}},
        {"map", {SCANOUT_MAP(SCANOUT_NAME)}},
        {"light", {SCANOUT_LIGHT(SCANOUT_NAME)}},
        {"shadow", {SCANOUT_SHADOW(SCANOUT_NAME)}},
        {"reflection", {SCANOUT_REFLECTION(SCANOUT_NAME)}},
        {"sides", {SCANOUT_SIDES(SCANOUT_NAME)}},
        {"cull", {SCANOUT_CULL(SCANOUT_NAME)}},
        {"depth", {SCANOUT_DEPTH(SCANOUT_NAME)}},
        {"depth_test", {SCANOUT_DEPTH_TEST(SCANOUT_NAME)}},
        {"blend", {SCANOUT_BLEND(SCANOUT_NAME)}},
        {"stencil", {SCANOUT_STENCIL(SCANOUT_NAME)}},
        {"shading", {SCANOUT_SHADING(SCANOUT_NAME)}},
        {"transparency", {SCANOUT_TRANSPARENCY(SCANOUT_NAME)}},
        {"aa", {SCANOUT_AA(SCANOUT_NAME)}},
        {"convolution", {SCANOUT_CONVOLUTION(SCANOUT_NAME)}},
        {"exposure", {SCANOUT_EXPOSURE(SCANOUT_NAME)}},
        {"tone", {SCANOUT_TONE(SCANOUT_NAME)}},
        {"blend_space", {SCANOUT_BLEND_SPACE(SCANOUT_NAME)}},
        {"encode", {SCANOUT_ENCODE(SCANOUT_NAME)}},
        {"dither", {SCANOUT_DITHER(SCANOUT_NAME)}}};
#undef SCANOUT_NAME
    std::set<std::pair<std::string_view, std::string_view>> table;
    for (const auto& [axis, names] : axes)
        for (const std::string_view name : names)
            EXPECT_TRUE(table.emplace(axis, name).second) << axis << ' ' << name;
    for (const Technique* t : techniques()) {
        EXPECT_EQ(table.erase({t->axis, t->name}), 1U) << t->axis << ' ' << t->name;
        EXPECT_FALSE(t->blurb.empty()) << t->name;
        EXPECT_FALSE(t->source.empty()) << t->name;
    }
    for (const auto& [axis, name] : table)
        ADD_FAILURE() << axis << ' ' << name << " is not listed";
}

} // namespace
} // namespace scanout::frame
