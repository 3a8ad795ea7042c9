#include "frame/catalogue.h"
#include "support/axes.h"

#include <set>

#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

TEST(Techniques, HaveEveryNameOfTheTableOnceWithAWholeCard) {
    std::set<std::pair<std::string_view, std::string_view>> table;
    for (const auto& [axis, names] : test::axes())
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
