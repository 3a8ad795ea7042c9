// Materials and textures of glTF files as the scene has them. Khronos 2021, 3.9.
#include "folder.h"
#include "gltf_file.h"
#include "io/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using image::Image;
using image::Rgba8;
using scene::Material;
using scene::Wrap;
using test::Folder;
using test::GltfBuilder;
using test::GltfRead;
using test::read_gltf_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string png_of(const Image& picture) {
    const auto png = image::encode_png(picture);
    return {reinterpret_cast<const char*>(png->data()), png->size()};
}
Image two_texels() { // opaque red, clear blue
    Image picture(2, 1, {255, 0, 0, 255});
    picture.at(1, 0) = {0, 0, 255, 64};
    return picture;
}

// A triangle with texture coordinates (0.25, 0.75), (1, 0), (0, 1) in two sets, the second shifted
// by 2.
GltfBuilder textured(const std::string& materials, const Image& picture = two_texels()) {
    GltfBuilder b;
    const int p = b.triangle(), uv = b.floats({0.25F, 0.75F, 1, 0, 0, 1}, "VEC2"),
              more = b.floats({2.25F, 2.75F, 3, 2, 2, 3}, "VEC2");
    b.primitive(fmt::format(
        R"("material":0,"attributes":{{"POSITION":{},"TEXCOORD_0":{},"TEXCOORD_1":{}}})", p, uv,
        more));
    const int image = b.view(png_of(picture));
    b.more = fmt::format(R"(,"images":[{{"bufferView":{},"mimeType":"image/png"}}],)"
                         R"("textures":[{{"source":0}},{{"source":0,"sampler":0}}],)"
                         R"("samplers":[{{"wrapS":33071,"wrapT":33648}}],"materials":[{}])",
                         image, materials);
    return b;
}

TEST(GltfMaterial, FactorsAreTheMaterialsNumbers) {
    const GltfRead r = read_gltf_file(
        textured(R"({"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.5],)"
                 R"("metallicFactor":0.25,"roughnessFactor":0.75},"emissiveFactor":[1,0,0.5],)"
                 R"("alphaMode":"BLEND","extensions":{"KHR_materials_emissive_strength":)"
                 R"({"emissiveStrength":4}}})")
            .glb());
    ASSERT_TRUE(r.result) << r.error();
    const Material& m = r.result->materials[0];
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.diffuse, Vec3(0.5, 0.25, 1));
    EXPECT_EQ(m.opacity, 0.5F);
    EXPECT_EQ(*m.metalness, 0.25F);
    EXPECT_EQ(*m.roughness, 0.75F);
    EXPECT_EQ(m.emission, Vec3(4, 0, 2));
    EXPECT_FALSE(m.alpha_cut || m.unlit);
}

TEST(GltfMaterial, WhatIsNotGivenIsARoughWhiteMetal) {
    const GltfRead r = read_gltf_file(textured("{}").glb());
    ASSERT_TRUE(r.result) << r.error();
    const Material& m = r.result->materials[0];
    EXPECT_EQ(m.diffuse, Vec3(1));
    EXPECT_EQ(*m.metalness, 1);
    EXPECT_EQ(*m.roughness, 1);
    EXPECT_EQ(r.mesh().face_material[0], 0);
    GltfBuilder none;
    none.primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", none.triangle()));
    EXPECT_EQ(read_gltf_file(none.glb()).mesh().face_material[0], -1);
}

TEST(GltfMaterial, AlphaCountsByItsMode) {
    const auto with = [](const std::string& mode) {
        return read_gltf_file(textured(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5],)"
                                       R"("baseColorTexture":{"index":0}})" +
                                       mode + "}")
                                  .glb());
    };
    const GltfRead opaque = with(""), mask = with(R"(,"alphaMode":"MASK","alphaCutoff":0.75)"),
                   blend = with(R"(,"alphaMode":"BLEND")");
    ASSERT_TRUE(opaque.result && mask.result && blend.result);
    EXPECT_EQ(opaque.result->materials[0].opacity, 1);
    const auto alpha = [](const GltfRead& r) {
        const auto texture = static_cast<std::size_t>(r.result->materials[0].map_diffuse.texture());
        return int{r.result->textures[texture].image.at(1, 0).a};
    };
    EXPECT_EQ(alpha(opaque), 255);
    EXPECT_EQ(alpha(mask), 64);
    EXPECT_EQ(*mask.result->materials[0].alpha_cut, 0.75F);
    EXPECT_EQ(mask.result->materials[0].opacity, 0.5F);
    EXPECT_EQ(alpha(blend), 64);
    EXPECT_FALSE(blend.result->materials[0].alpha_cut);
}

TEST(GltfMaterial, EveryMapHasItsRoleAndChannel) {
    const GltfRead r = read_gltf_file(
        textured(
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},)"
            R"("metallicRoughnessTexture":{"index":0}},"normalTexture":{"index":0,"scale":0.5},)"
            R"("emissiveTexture":{"index":0},"emissiveFactor":[1,1,1]})")
            .glb());
    ASSERT_TRUE(r.result) << r.error();
    const Material& m = r.result->materials[0];
    EXPECT_EQ(m.map_roughness->channel, 'g');
    EXPECT_EQ(m.map_metalness->channel, 'b');
    EXPECT_GE(m.map_emission.texture(), 0);
    EXPECT_EQ(m.map_emission.texture(), m.map_roughness.texture()); // decoded once
    EXPECT_EQ(m.map_normal.texture(), m.map_roughness.texture());   // whatever its scale
    EXPECT_EQ(m.map_normal->normal_scale, 0.5F);
    EXPECT_EQ(m.map_diffuse->path, "images[0]");
}

// Each role's copy of a picture is charged, and made once.
TEST(GltfMaterial, CopiesOfAPictureAreChargedToTheTextures) {
    const auto with_maps = [](std::uint64_t texture_bytes) {
        Image picture(8, 8, {255, 0, 0, 255});
        picture.at(0, 0).a = 0;
        GltfBuilder b = textured(
            R"({"emissiveTexture":{"index":0},"emissiveFactor":[1,1,1]},)"
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)"
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)"
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"alphaMode":"MASK"})",
            picture);
        for (int i = 1; i < 4; ++i)
            b.primitive(
                fmt::format(R"("material":{},"attributes":{{"POSITION":0,"TEXCOORD_0":1}})", i));
        Reading how;
        how.texture_bytes = texture_bytes;
        return read_gltf_file(b.glb(), "a.glb", how);
    };
    const GltfRead all = with_maps(3 * 256);
    ASSERT_TRUE(all.result) << all.error();
    EXPECT_EQ(all.warnings, "");
    EXPECT_EQ(all.result->textures.size(), 3u);
    EXPECT_EQ(all.result->bytes, 3 * 256u);
    const GltfRead two = with_maps(3 * 256 - 1);
    ASSERT_TRUE(two.result) << two.error();
    EXPECT_EQ(two.warnings, "a.glb: images[0] takes more memory than textures may; drawn plain");
    EXPECT_EQ(two.result->textures.size(), 2u);
    EXPECT_TRUE(two.result->materials[3].map_diffuse->missing);
}

TEST(GltfMaterial, SamplersSayWhatLiesBeyondTheEdges) {
    const GltfRead r =
        read_gltf_file(textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}},)"
                                R"("emissiveTexture":{"index":0},"emissiveFactor":[1,1,1]})")
                           .glb());
    ASSERT_TRUE(r.result) << r.error();
    const Material& m = r.result->materials[0];
    EXPECT_EQ(m.map_diffuse->wrap_u, Wrap::clamp);
    EXPECT_EQ(m.map_diffuse->wrap_v, Wrap::mirror);
    EXPECT_EQ(m.map_emission->wrap_u, Wrap::repeat);
}

TEST(GltfMaterial, TextureCoordinatesRunUpFromTheSetThatTheFirstMapNames) {
    const GltfRead first = read_gltf_file(
        textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})").glb());
    EXPECT_EQ(first.mesh().uvs[0], DVec2(0.25, 0.25));
    const GltfRead second = read_gltf_file(
        textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})")
            .glb());
    EXPECT_EQ(second.mesh().uvs[0], DVec2(2.25, -1.75));
}

// KHR_texture_transform's own picture: an offset, then a turn counter-clockwise of the coordinates,
// then a scale.
TEST(GltfMaterial, ATextureTransformMovesTheCoordinates) {
    const GltfRead r = read_gltf_file(
        textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
                 R"({"KHR_texture_transform":{"offset":[0.5,0],"rotation":1.5707963267948966,)"
                 R"("scale":[2,4]}}}}})")
            .glb());
    ASSERT_TRUE(r.result) << r.error();
    // (0.25, 0.75) -> scaled (0.5, 3) -> turned (3, -0.5) -> moved (3.5, -0.5); v up: 1.5.
    EXPECT_NEAR(r.mesh().uvs[0].x, 3.5, 1e-12);
    EXPECT_NEAR(r.mesh().uvs[0].y, 1.5, 1e-12);
}

TEST(GltfMaterial, ASideIsLeftOutUnlessTheFileSaysBoth) {
    for (const bool both : {false, true})
        EXPECT_EQ(read_gltf_file(textured(both ? R"({"doubleSided":true})" : "{}").glb())
                      .result->materials[0]
                      .one_sided,
                  !both);
}

TEST(GltfMaterial, ATextureTransformOfScaleZeroShowsOneTexel) {
    const GltfRead r = read_gltf_file(
        textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
                 R"({"KHR_texture_transform":{"scale":[0,0],"offset":[0.25,0.5]}}}}})")
            .glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.warnings, "");
    EXPECT_GE(r.result->materials[0].map_diffuse.texture(), 0);
    EXPECT_EQ(r.mesh().uvs, std::vector<DVec2>(3, DVec2(0.25, 0.5)));
}

TEST(GltfMaterial, AnotherMapsTransformIsTakenRelativeToTheFirst) {
    const GltfRead r = read_gltf_file(
        textured(
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
            R"({"KHR_texture_transform":{"offset":[1,2],"scale":[2,2]}}}},"emissiveFactor":[1,1,1],)"
            R"("emissiveTexture":{"index":0}})")
            .glb());
    ASSERT_TRUE(r.result) << r.error();
    const scene::TextureMap& map = r.result->materials[0].map_emission;
    const DVec2 uv = r.mesh().uvs[0];
    EXPECT_NEAR(uv.x * map.scale.x + map.offset.x, 0.25, 1e-6);
    EXPECT_NEAR(uv.y * map.scale.y + map.offset.y, 0.25, 1e-6); // 1 - 0.75
}

TEST(GltfMaterial, AMapWithCoordinatesOfItsOwnIsLeftOutAndSaid) {
    for (const char* other :
         {R"("texCoord":1)", R"("extensions":{"KHR_texture_transform":{"rotation":1}})",
          R"("texCoord":2)"}) {
        const GltfRead r =
            read_gltf_file(textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},)"
                                    R"("emissiveFactor":[1,1,1],"emissiveTexture":{"index":0,)" +
                                    std::string(other) + "}}")
                               .glb());
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_LT(r.result->materials[0].map_emission.texture(), 0);
        EXPECT_EQ(r.warnings,
                  "a.glb: materials[0].emissiveTexture has other texture coordinates than "
                  "its first map; drawn without");
    }
}

TEST(GltfMaterial, AnUnlitMaterialShowsItsColourAlone) {
    const GltfRead r = read_gltf_file(
        textured(R"({"extensions":{"KHR_materials_unlit":{}},"emissiveFactor":[1,1,1]})").glb());
    ASSERT_TRUE(r.result) << r.error();
    const Material& m = r.result->materials[0];
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.emission, Vec3(0));
    EXPECT_FALSE(m.roughness || m.metalness);
}

TEST(GltfMaterial, SpecularGlossinessGivesItsDiffusePart) {
    const GltfRead r =
        read_gltf_file(textured(R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":)"
                                R"({"diffuseFactor":[0.5,0.5,0,1],"glossinessFactor":0.25}}})")
                           .glb());
    ASSERT_TRUE(r.result) << r.error();
    const Material& m = r.result->materials[0];
    EXPECT_EQ(m.diffuse, Vec3(0.5, 0.5, 0));
    EXPECT_EQ(*m.metalness, 0);
    EXPECT_EQ(*m.roughness, 0.75F);
}

TEST(GltfMaterial, PicturesComeFromFilesAndDataUris) {
    const Folder folder;
    folder.write("a b.png", png_of(two_texels()));
    const auto with = [&](const std::string& image) {
        GltfBuilder b = textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
        const std::size_t begin = b.more.find("{\"bufferView\""), end = b.more.find('}', begin);
        b.more.replace(begin, end - begin + 1, image);
        return read_gltf_file(b.glb(), folder.path("a.glb"));
    };
    const GltfRead file = with(R"({"uri":"a%20b.png"})");
    ASSERT_EQ(file.result->textures.size(), 2u) << file.warnings;
    EXPECT_EQ(file.warnings, "");
    EXPECT_EQ(
        with(
            R"({"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQ)"
            R"(VR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="})")
            .warnings,
        "");
    EXPECT_THAT(with(R"({"uri":"no.png"})").warnings,
                HasSubstr("a.glb: images[0]: 'no.png' is not there; drawn plain"));
    EXPECT_THAT(
        with(R"({"uri":"../../no.png"})").warnings,
        HasSubstr("'../../no.png' lies outside of the model's folder (--allow-outside reads it); "
                  "drawn plain"));
    EXPECT_THAT(with(R"({"uri":"data:image/png;base64,*"})").warnings,
                HasSubstr("a.glb: images[0]: its data URI cannot be read; drawn plain"));
    EXPECT_THAT(with("{}").warnings,
                HasSubstr("a.glb: images[0] names neither a file nor a buffer view; drawn plain"));
    folder.write("text.png", "text");
    EXPECT_THAT(with(R"({"uri":"text.png"})").warnings, HasSubstr("a.glb: images[0]: "));
}

TEST(GltfMaterial, WhatShouldShineInPartsDoesNotShineWholeWithoutItsMap) {
    GltfBuilder b = textured(R"({"emissiveTexture":{"index":0},"emissiveFactor":[1,1,1]})");
    b.more.replace(b.more.find("image/png"), 9, "image/xyz"); // what the bytes are counts
    EXPECT_EQ(read_gltf_file(b.glb()).result->materials[0].emission, Vec3(1));
    b.more.replace(b.more.find("\"source\":0"), 10, "\"source\":9");
    EXPECT_EQ(read_gltf_file(b.glb()).result->materials[0].emission, Vec3(0));
}

TEST(GltfMaterial, ReferencesThatLeadNowhereAreDrawnWithout) {
    GltfBuilder b = textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":7}}})");
    const GltfRead texture = read_gltf_file(b.glb());
    ASSERT_TRUE(texture.result) << texture.error();
    EXPECT_EQ(
        texture.warnings,
        "a.glb: materials[0].baseColorTexture.index is 7, and there are 2 textures; drawn without");
    GltfBuilder m;
    m.primitive(fmt::format(R"("material":3,"attributes":{{"POSITION":{}}})", m.triangle()));
    EXPECT_EQ(
        read_gltf_file(m.glb()).warnings,
        "a.glb: meshes[0].primitives[0].material is 3, and there are 0 materials; drawn without");
    GltfBuilder i;
    i.primitive(fmt::format(R"("material":0,"attributes":{{"POSITION":{}}})", i.triangle()));
    i.more = R"(,"textures":[{"source":2}],"materials":[{"normalTexture":{"index":0}}])";
    EXPECT_THAT(read_gltf_file(i.glb()).warnings,
                HasSubstr("a.glb: textures[0] names no image that is read; drawn plain"));
}

TEST(GltfMaterial, ColoursOfVerticesAreLinearAndWhiteElsewhere) {
    GltfBuilder b;
    const int p = b.triangle();
    const int c =
        b.accessor(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 255, 0, 255, 0, 0, 0, 128}, 5121,
                   "VEC4", 3, R"(,"normalized":true)");
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", p));
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{},"COLOR_0":{}}})", p, c));
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", p));
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    const auto& colours = r.mesh().colours;
    ASSERT_EQ(colours.size(), 9u);
    EXPECT_EQ(colours[0], Vec3(1));
    EXPECT_EQ(colours[3], Vec3(1, 0, static_cast<float>(51 / 255.0)));
    EXPECT_EQ(colours[8], Vec3(1));
    EXPECT_EQ(r.warnings, "a.glb: COLOR_0 has alphas below 1, which are not drawn");
}

TEST(GltfMaterial, LessThanNoColourAndMoreThanWhiteAreCut) {
    GltfBuilder b;
    const int p = b.triangle(), c = b.floats({-1, 2, 1e-30F, 0, 0, 0, 1, 1, 1}, "VEC3");
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{},"COLOR_0":{}}})", p, c));
    EXPECT_EQ(read_gltf_file(b.glb()).mesh().colours[0], Vec3(0, 1, 0));
}

} // namespace
} // namespace scanout::io
