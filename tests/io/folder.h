// A temporary folder with files in it, gone at the end of the test; and the warnings of a read, at
// hand.
#pragma once

#include "base/warnings.h"
#include "image/codec.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace scanout::io::test {

class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "scanout-io-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }

    std::string path(const std::string& name) const { return path_ + "/" + name; }

    std::string write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = path(name);
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << content;
        return file.string();
    }

    std::string write_picture(const std::string& name, int width, int height,
                              image::Rgba8 colour) const {
        return write_picture(name, image::Image(width, height, colour));
    }
    std::string write_picture(const std::string& name, const image::Image& picture) const {
        const auto png = image::encode_png(picture);
        return write(name, {reinterpret_cast<const char*>(png->data()), png->size()});
    }

private:
    std::string path_;
};

// Some warning holds all of `parts`.
inline bool warned(const Warnings& warnings, std::initializer_list<std::string_view> parts) {
    for (const std::string& line : warnings.lines()) {
        bool all = true;
        for (const std::string_view part : parts)
            all = all && line.find(part) != std::string::npos;
        if (all) return true;
    }
    return false;
}

inline std::string all_lines(const Warnings& warnings) {
    std::string text;
    for (const std::string& line : warnings.lines())
        text += line + "\n";
    return text;
}

} // namespace scanout::io::test
