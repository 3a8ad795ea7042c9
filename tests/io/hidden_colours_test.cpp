#include "folder.h"
#include "io/hidden_colours.h"
#include "io/materials.h"
#include "io/obj/obj.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using image::Image;
using image::Rgba8;

const Rgba8 kLeaf{40, 160, 40, 255}, kHidden{255, 255, 255, 0};

TEST(HiddenColours, TakeThoseThatAreSeenHoweverFar) {
    for (const auto& [width, height] :
         std::vector<std::pair<int, int>>{{64, 64}, {61, 37}, {1, 9}, {300, 2}}) {
        Image picture(width, height, kHidden);
        picture.at(width / 3, height / 2) = kLeaf;
        picture.at(0, 0) = {40, 160, 40, 3};
        EXPECT_TRUE(fill_hidden_colours(picture));
        int seen = 0;
        for (const Rgba8& p : picture.pixels()) {
            EXPECT_EQ(Rgba8({p.r, p.g, p.b, 255}), kLeaf);
            seen += p.a > 0 ? 1 : 0;
        }
        EXPECT_EQ(seen, 2) << "alpha stays";
    }
}

// The next texel is what a bilinear filter mixes in, over the edge of a repeat, too.
TEST(HiddenColours, TakeTheNearestOnes) {
    Image picture(32, 32, kHidden);
    const Rgba8 red{200, 0, 0, 255}, blue{0, 0, 200, 255};
    for (int y = 0; y < 32; ++y) {
        picture.at(7, y) = red;
        picture.at(31, y) = blue;
    }
    fill_hidden_colours(picture);
    for (int y = 0; y < 32; ++y) {
        for (const int x : {5, 6, 8, 9})
            EXPECT_EQ(picture.at(x, y), (Rgba8{200, 0, 0, 0}));
        for (const int x : {29, 30, 0, 1})
            EXPECT_EQ(picture.at(x, y), (Rgba8{0, 0, 200, 0}));
    }
}

TEST(HiddenColours, CountByAlpha) {
    Image picture(3, 1, kHidden);
    picture.at(0, 0) = {100, 0, 0, 200};
    picture.at(2, 0) = {200, 0, 0, 50};
    fill_hidden_colours(picture);
    EXPECT_EQ(picture.at(1, 0), (Rgba8{120, 0, 0, 0}));
}

TEST(HiddenColours, AreNotLookedForWhereNothingHides) {
    Image picture(4, 4, {1, 2, 3, 1});
    EXPECT_FALSE(fill_hidden_colours(picture));
}

// A map whose alpha says nothing of what is seen keeps all its colours.
TEST(HiddenColours, AreFilledWhereAlphaHidesThemAlone) {
    const test::Folder folder;
    Image picture(4, 4, kHidden);
    picture.at(1, 1) = kLeaf;
    folder.write_picture("leaf.png", picture);
    folder.write_picture("grey.png", 2, 2, {90, 90, 90, 255});
    folder.write("m.mtl", "newmtl seen\nmap_Kd leaf.png\n"
                          "newmtl again\nmap_Kd leaf.png\n"
                          "newmtl by_map_d\nmap_Kd leaf.png\nmap_d grey.png\n"
                          "newmtl gloss\nKs 1 1 1\nNs 9\nmap_Ks leaf.png\n");
    Warnings warnings;
    const auto obj = read_obj("v 0 0 0\nmtllib m.mtl\nusemtl seen\nusemtl again\nusemtl by_map_d\n"
                              "usemtl gloss\n",
                              folder.path("m.obj"), warnings);
    const Materials loaded = load_materials(*obj, folder.path("m.obj"), warnings);
    ASSERT_EQ(loaded.materials.size(), 4U);
    const auto at_corner = [&](const scene::TextureMap& map) {
        return loaded.textures[static_cast<std::size_t>(map.texture)].image.at(3, 3);
    };
    EXPECT_EQ(at_corner(loaded.materials[0].map_diffuse), (Rgba8{40, 160, 40, 0}));
    EXPECT_EQ(loaded.materials[1].map_diffuse->texture, loaded.materials[0].map_diffuse->texture);
    EXPECT_EQ(at_corner(loaded.materials[2].map_diffuse), (Rgba8{255, 255, 255, 255}));
    EXPECT_EQ(at_corner(loaded.materials[3].map_specular), kHidden);
}

} // namespace
} // namespace scanout::io
