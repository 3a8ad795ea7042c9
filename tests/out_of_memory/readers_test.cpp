// Memory that runs out at any point while a model is loaded: one line, exit code 70, nothing
// leaked. Every allocation of every reader fails in turn, once; this program's operator new does
// that. What C libraries allocate for pictures does not go through it: they refuse the picture
// themselves.
#include "base/warnings.h"
#include "io/load.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

namespace {

thread_local long allocations_left = -1; // until one fails; below 0: none does
thread_local bool has_failed = false;
std::atomic<long> live{0};

void* allocated(std::size_t bytes, std::size_t alignment) {
    if (allocations_left == 0) {
        allocations_left = -1;
        has_failed = true;
        throw std::bad_alloc();
    }
    if (allocations_left > 0) --allocations_left;
    void* memory = nullptr;
    if (::posix_memalign(&memory, std::max(alignment, sizeof(void*)), bytes) != 0)
        throw std::bad_alloc();
    ++live;
    return memory;
}

void freed(void* memory) {
    if (memory == nullptr) return;
    --live;
    std::free(memory);
}

} // namespace

void* operator new(std::size_t bytes) {
    return allocated(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return allocated(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    freed(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    freed(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    freed(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    freed(memory);
}

namespace scanout::io {
namespace {

class Files {
public:
    Files() {
        std::string name =
            (std::filesystem::temp_directory_path() / "scanout-memory-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;
    ~Files() { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return (folder_ / name).string();
    }
    std::string write_packed(const std::string& name, const std::string& content) const {
        const std::string path = (folder_ / name).string();
        const gzFile file = ::gzopen(path.c_str(), "wb");
        ::gzwrite(file, content.data(), static_cast<unsigned>(content.size()));
        ::gzclose(file);
        return path;
    }

private:
    std::filesystem::path folder_;
};

const std::string kObj =
    "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n"
    "v 2 2 nan\nvt 0 0\nvt 99 0\nvt 99 99\nvn 0 0 1\nusemtl a\ns 1\n"
    "f 1/1/1 2/2/1 3/3/1 4/1/1\nusemtl gone\nf -1 -2 -3\nf 5 1 2\nl 1 2 3\np 1\n"
    "f 1 2 3 4 3 9\nhello\n";
const std::string kMtl = "newmtl a\nKd 0 0 0\nmap_Kd t.ppm\nmap_bump t.ppm\nmap_d gone.png\n";
const std::string kPicture = "P6\n2 2\n255\n############";

std::string binary_stl() {
    std::string file(80, ' ');
    const auto add = [&](auto value) {
        file.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    add(std::uint32_t{2});
    for (int facet = 0; facet < 2; ++facet) {
        for (const float x : {0, 0, 1, 0, 0, facet, 1, 0, 0, 0, 1, 0})
            add(static_cast<float>(x));
        add(std::uint16_t{0x801f});
    }
    return file;
}

std::string binary_ply(bool big_endian) {
    std::string file = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                       "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                       "property double z\nproperty uchar red\nproperty uchar green\n"
                       "property uchar blue\nelement face 2\n"
                       "property list uchar int vertex_indices\nend_header\n";
    const auto add = [&](auto value) {
        std::string bytes(reinterpret_cast<const char*>(&value), sizeof value); // little-endian
        if (big_endian) std::reverse(bytes.begin(), bytes.end());
        file += bytes;
    };
    for (int vertex = 0; vertex < 3; ++vertex) {
        add(vertex == 1 ? 1.0F : 0.0F);
        add(vertex == 2 ? 1.0F : 0.0F);
        add(0.0);
        for (int channel = 0; channel < 3; ++channel)
            add(static_cast<std::uint8_t>(channel == vertex ? 255 : 0));
    }
    for (int face = 0; face < 2; ++face) {
        add(std::uint8_t{3});
        for (const std::int32_t index : {0, 1 + face, 2 - face})
            add(index);
    }
    return file;
}

struct Loaded {
    Result<scene::Scene> scene;
    std::vector<std::string> warnings;
};

Loaded load_with(long allocations, const std::string& path) {
    Warnings warnings;
    has_failed = false;
    allocations_left = allocations;
    auto scene = load(path, {}, warnings);
    allocations_left = -1;
    return {std::move(scene), warnings.lines()};
}

// What is wrong with a load in which an allocation has failed; empty: nothing. What is only looked
// up, such as the memory that is free, may do without.
std::string fault(const Loaded& loaded, const Loaded& whole, const std::string& path) {
    if (loaded.scene)
        return loaded.scene->mesh.position == whole.scene->mesh.position &&
                       loaded.scene->textures.size() == whole.scene->textures.size() &&
                       loaded.warnings == whole.warnings
                   ? ""
                   : "it is loaded in part";
    const Error& error = loaded.scene.error();
    return error.exit == Exit::internal && error.what.find(path) != std::string::npos &&
                   error.what.find('\n') == std::string::npos
               ? ""
               : "it ends with '" + error.what + "'";
}

// Loads the model, and lets each allocation fail that this needs.
void expect_one_line_wherever_memory_ends(const std::string& path) {
    ASSERT_TRUE(load_with(-1, path).scene) << path; // makes tables that are made once
    const Loaded whole = load_with(-1, path);
    long points = 0, ended = 0;
    for (;; ++points) {
        const long before = live;
        std::string what;
        {
            const Loaded loaded = load_with(points, path);
            if (!has_failed) break;
            what = fault(loaded, whole, path);
            ended += loaded.scene ? 0 : 1;
        }
        if (what.empty() && live != before) what = "memory leaks";
        ASSERT_EQ(what, "") << path << ": when allocation " << points << " fails";
    }
    EXPECT_GT(ended, 20) << path;
}

TEST(OutOfMemory, EndsEveryReaderWithOneLine) {
    const Files files;
    files.write("m.mtl", kMtl);
    files.write("t.ppm", kPicture);
    const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n";
    const std::string ply = "ply\nformat ascii 1.0\ncomment TextureFile t.ppm\nelement vertex 3\n"
                            "property float x\nproperty float y\nproperty float z\n"
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                            triangle + "3 0 1 2\n";
    for (const std::string& path :
         {files.write("m.obj", kObj), files.write_packed("m.obj.gz", kObj),
          files.write("binary.stl", binary_stl()),
          files.write("ascii.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                   "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"),
          files.write("m.ply", ply), files.write("little.ply", binary_ply(false)),
          files.write("big.ply", binary_ply(true)),
          files.write("m.off", "OFF\n3 1 0\n" + triangle + "3 0 1 2 255 0 0\n")})
        expect_one_line_wherever_memory_ends(path);
}

} // namespace
} // namespace scanout::io
