#include "scene/content.h"

#include <functional>
#include <set>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

Scene scene() {
    Scene s;
    s.mesh.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    s.mesh.normal = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    s.mesh.uv = {{0, 0}, {1, 0}, {0, 1}};
    s.mesh.index = {0, 1, 2};
    s.mesh.material = {0};
    s.mesh.face = {0};
    s.materials.resize(2);
    s.textures.push_back({"a.png", image::Image(2, 3)});
    return s;
}

// Each of these changes a picture, or may.
TEST(Content, WhateverAPictureDependsOnChangesTheHash) {
    const std::vector<std::function<void(Scene&)>> changes = {
        [](Scene&) {},
        [](Scene& s) { s.mesh.position[1].x = 2; },
        [](Scene& s) { s.mesh.normal[2].y = 1; },
        [](Scene& s) { s.mesh.uv[2].y = 0.5F; },
        [](Scene& s) { s.mesh.uv.clear(); },
        [](Scene& s) { s.mesh.colour.resize(3); },
        [](Scene& s) { std::swap(s.mesh.index[0], s.mesh.index[1]); },
        [](Scene& s) { s.mesh.material[0] = 1; },
        [](Scene& s) { s.mesh.face[0] = 1; },
        [](Scene& s) {
            s.mesh.line_index = {0, 1};
        },
        [](Scene& s) { s.mesh.point_index = {0}; },
        [](Scene& s) { s.mesh.exponent = 3; },
        [](Scene& s) { s.mesh.centre.x = 1; },
        [](Scene& s) { s.materials[1].diffuse.x = 0.1F; },
        [](Scene& s) { s.materials[1].shininess = 10; },
        [](Scene& s) { s.materials[1].opacity = 0.5F; },
        [](Scene& s) { s.materials[1].roughness = 0; },
        [](Scene& s) { s.materials[1].metalness = 0; },
        [](Scene& s) { s.materials[1].map_diffuse.edit().texture = 0; },
        [](Scene& s) { s.materials[1].map_bump.edit().texture = 0; },
        [](Scene& s) { s.materials[1].map_normal.edit().texture = 0; },
        [](Scene& s) { s.materials[1].map_diffuse.edit().scale.y = 2; },
        [](Scene& s) { s.materials[1].map_diffuse.edit().wrap_u = Wrap::clamp; },
        [](Scene& s) { s.materials[1].map_diffuse.edit().wrap_v = Wrap::mirror; },
        [](Scene& s) { s.materials[1].unlit = true; },
        [](Scene& s) { s.materials[1].one_sided = true; },
        [](Scene& s) { s.materials[1].alpha_cut = 0.5F; },
        [](Scene& s) { s.materials.pop_back(); },
        [](Scene& s) { s.textures[0].image.at(1, 2).g = 7; },
        [](Scene& s) { s.textures[0].image = image::Image(3, 2); },
    };
    std::set<std::uint64_t> hashes;
    for (const auto& change : changes) {
        Scene changed = scene();
        change(changed);
        EXPECT_TRUE(hashes.insert(content_hash(changed)).second) << "change " << hashes.size();
    }
    EXPECT_EQ(hashes.count(content_hash(scene())), 1U);
}

TEST(Content, EachMapOfAMaterialChangesTheHash) {
    std::set<std::uint64_t> hashes;
    for (const NamedMap& row : kTextureMaps) {
        Scene changed = scene();
        (changed.materials[1].*row.map).edit().texture = 0;
        EXPECT_TRUE(hashes.insert(content_hash(changed)).second) << row.name;
    }
    EXPECT_EQ(hashes.count(content_hash(scene())), 0U);
}

// Names of files and materials, and what is counted, change no picture.
TEST(Content, NamesDoNotCount) {
    Scene named = scene();
    named.path = "other.obj";
    named.materials[0].name = "steel";
    named.textures[0].path = "b.png";
    named.counts.bytes = 12;
    named.revision = 5;
    EXPECT_EQ(content_hash(named), content_hash(scene()));
}

} // namespace
} // namespace scanout::scene
