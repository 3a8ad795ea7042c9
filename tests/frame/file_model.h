// A model as the text of a file, to be changed in ways that must not change its picture: written as
// OBJ and MTL, loaded by io, seen by a camera in file coordinates, drawn by the renderer.
#pragma once

#include "io/load.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::test {

struct FileFace {
    std::array<int, 3> vertex, normal;
    int material = 0;
};

// Colour, depth and id of a frame; ids name places in the file, so the first two alone are compared
// where its order changes.
struct Shown {
    image::Image image;
    std::vector<float> depth;
    std::vector<std::uint32_t> id;
    bool same_but_for_ids(const Shown& other) const {
        return image == other.image && depth == other.depth;
    }
    bool operator==(const Shown& other) const { return same_but_for_ids(other) && id == other.id; }
};

struct FileModel {
    std::vector<DVec3> vertex; // file units
    std::vector<Vec3> normal;
    std::vector<FileFace> face;
    DVec3 eye{0}, target{0};
    double opacity = 1; // of the second material

    std::string text() const {
        std::string out = "mtllib model.mtl\n";
        for (const DVec3& v : vertex)
            out += fmt::format("v {:.17g} {:.17g} {:.17g}\n", v.x, v.y, v.z);
        for (const Vec3& n : normal)
            out += fmt::format("vn {:.9g} {:.9g} {:.9g}\n", n.x, n.y, n.z);
        for (const FileFace& f : face) {
            out += fmt::format("usemtl m{}\nf", f.material);
            for (std::size_t i = 0; i < 3; ++i)
                out += fmt::format(" {}//{}", f.vertex[i] + 1, f.normal[i] + 1);
            out += '\n';
        }
        return out;
    }
    scene::Scene load() const {
        const TemporaryFolder folder;
        std::string materials;
        for (int m = 0; m < kMaterials; ++m)
            materials += fmt::format("newmtl m{}\nKd {} {} 0.4\nKs 0.{} 0 0.2\nNs 20\nd {}\n", m,
                                     0.1 + 0.2 * m, 0.9 - 0.2 * m, m, m == 1 ? opacity : 1);
        folder.write("model.mtl", materials);
        Warnings warnings;
        auto scene = io::load(folder.write("model.obj", text()), {}, warnings);
        EXPECT_TRUE(scene) << scene.error().what;
        EXPECT_TRUE(warnings.lines().empty()) << warnings.lines().front();
        return scene ? std::move(*scene) : scene::Scene{};
    }
    scene::View view(const geom::Mesh& mesh, int width, int height) const {
        scene::CameraOptions camera;
        camera.eye = eye;
        camera.target = target;
        const auto v = scene::make_view(mesh, {}, {}, camera, {}, width, height);
        EXPECT_TRUE(v);
        return v ? *v : scene::View{};
    }
    Shown picture(const frame::FrameOptions& options, int threads = 1) const {
        const scene::Scene scene = load();
        const auto plan = frame::plan(options, frame::facts(scene));
        EXPECT_TRUE(plan);
        Jobs jobs(threads);
        frame::Renderer renderer(jobs);
        frame::Visibility seen;
        image::Image picture =
            renderer.render(scene, view(scene.mesh, options.width, options.height), *plan, &seen);
        return {std::move(picture), std::move(seen.depth), std::move(seen.id)};
    }
    static constexpr int kMaterials = 5;
};

inline frame::FrameOptions picture_options(int samples, frame::Cull cull = frame::Cull::none) {
    frame::FrameOptions options;
    options.width = 200;
    options.height = 140;
    options.samples = samples;
    options.cull = cull;
    return options;
}

template <class List>
void shuffle(List& list, Random& random) {
    for (std::size_t i = list.size() - 1; i > 0; --i)
        std::swap(list[i], list[static_cast<std::size_t>(random.whole(0, static_cast<int>(i)))]);
}

// Triangles of every size about the eye's path, coordinates in multiples of 2^-20; no two lie in
// one plane. `inside`: the eye stands among them, so that some cross the eye's plane.
inline FileModel file_soup(Random& random, int triangles, bool inside) {
    FileModel m;
    const auto tidy = [](const DVec3& v) {
        return DVec3(std::nearbyint(v.x * 0x1p20), std::nearbyint(v.y * 0x1p20),
                     std::nearbyint(v.z * 0x1p20)) *
               0x1p-20;
    };
    for (int i = 0; i < triangles; ++i) {
        FileFace f{};
        const DVec3 middle = random.in_cube(1);
        for (std::size_t k = 0; k < 3; ++k) {
            f.vertex[k] = f.normal[k] = static_cast<int>(m.vertex.size());
            m.vertex.push_back(tidy(middle + random.in_cube(i % 5 == 0 ? 1.5 : 0.3)));
            m.normal.push_back(Vec3(random.in_cube(1)));
        }
        // Some share an edge with the one before.
        if (i % 3 == 2) {
            f.vertex[0] = m.face.back().vertex[1];
            f.vertex[1] = m.face.back().vertex[2];
        }
        f.material = random.whole(0, FileModel::kMaterials - 1);
        m.face.push_back(f);
    }
    m.eye = inside ? tidy({0.2, 0.1, 0.3}) : tidy({1.5, 2.25, 3.5});
    m.target = tidy({-0.125, 0, 0.0625});
    return m;
}

inline std::int64_t samples_covered(const Shown& shown) {
    return std::count_if(shown.depth.begin(), shown.depth.end(), [](float d) { return d > 0; });
}

} // namespace scanout::test
