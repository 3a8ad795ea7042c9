#include "scene/material.h"

#include <utility>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

// Files have 100 000 materials, whose maps are few.
TEST(MaterialMap, TakesNoMemoryUntilItIsGiven) {
    EXPECT_EQ(sizeof(MaterialMap), sizeof(void*));
    EXPECT_LE(sizeof(Material), 320U);
    const Material plain;
    EXPECT_FALSE(plain.map_diffuse.given());
    EXPECT_EQ(plain.map_diffuse.texture(), -1);
    EXPECT_EQ(&*plain.map_diffuse, &*plain.map_bump) << "one for all that have none";
}

TEST(MaterialMap, ReadsAsAMapWithoutOptionsWhereThereIsNone) {
    const Material plain;
    const TextureMap none;
    const TextureMap& read = plain.map_normal;
    EXPECT_EQ(read.texture, none.texture);
    EXPECT_EQ(read.scale, none.scale);
    EXPECT_EQ(plain.map_normal->bump_multiplier, none.bump_multiplier);
}

TEST(MaterialMap, IsReadWithoutMakingOne) {
    Material not_const;
    const TextureMap* const read = not_const.map_normal.operator->();
    EXPECT_EQ(read, &*Material().map_diffuse);
    not_const.map_normal.edit().wrap_u = Wrap::clamp;
    EXPECT_EQ(not_const.map_normal->wrap_u, Wrap::clamp);
    EXPECT_EQ(read->wrap_u, Wrap::repeat);
}

TEST(MaterialMap, ACopyIsAMapOfItsOwn) {
    Material first;
    first.map_diffuse.edit().path = "a.png";
    first.map_diffuse.edit().texture = 3;
    Material second = first;
    second.map_diffuse.edit().texture = 4;
    EXPECT_EQ(first.map_diffuse.texture(), 3);
    EXPECT_EQ(second.map_diffuse->path, "a.png");
    const Material third = std::move(second);
    EXPECT_EQ(third.map_diffuse.texture(), 4);
    first = Material();
    EXPECT_FALSE(first.map_diffuse.given());
    std::swap(first.map_bump, first.map_diffuse);
    EXPECT_FALSE(first.map_bump.given());
}

} // namespace
} // namespace scanout::scene
