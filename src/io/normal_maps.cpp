#include "io/normal_maps.h"

#include <algorithm>
#include <cmath>

namespace scanout::io {
namespace {

class NormalCount {
public:
    void add(const image::Rgba8& p) {
        const int x = 2 * p.r - 255, y = 2 * p.g - 255, z = 2 * p.b - 255;
        const int square = x * x + y * y + z * z;
        units_ += z > 0 && square > 255 * 255 * 4 / 5 && square < 255 * 255 * 6 / 5 ? 1 : 0;
        bluer_ += p.b - p.r;
        ++texels_;
    }
    bool are_normals() const {
        return texels_ > 0 && units_ >= texels_ - texels_ / 50 && bluer_ > 32 * texels_;
    }

private:
    std::int64_t texels_ = 0, units_ = 0, bluer_ = 0;
};

// A part of a face's outline, fan by fan; in texels of the image, v up.
struct Triangle {
    DVec2 at, ab, ac;
    double area() const { return std::abs(ab.x * ac.y - ab.y * ac.x) / 2; }
};

class FacesOnImage {
public:
    FacesOnImage(const image::Image& image, const scene::TextureMap& map,
                 const geom::PolygonMesh& mesh, std::span<const std::uint32_t> faces)
        : image_(image), map_(map), mesh_(mesh), faces_(faces) {}

    bool show_normals() const {
        double all = 0;
        for_triangles([&](const Triangle& t) { all += t.area(); });
        if (!(all > 0) || !std::isfinite(all)) return false;
        // Linear in the file, however many materials share a picture.
        const double samples =
            std::min(double{1 << 15}, 256.0 * static_cast<double>(faces_.size()));
        NormalCount count;
        for_triangles([&](const Triangle& t) {
            const auto points = static_cast<int>(samples * (t.area() / all)) + 1;
            for (int i = 0; i < points; ++i)
                add(t, i, count);
        });
        return count.are_normals();
    }

private:
    template <class Visit>
    void for_triangles(const Visit& visit) const {
        for (const std::uint32_t face : faces_) {
            const std::size_t begin = mesh_.face_begin[face], end = mesh_.face_end(face);
            for (std::size_t c = begin + 2; c < end; ++c) {
                if (!has_uv(begin) || !has_uv(c - 1) || !has_uv(c)) continue;
                const DVec2 a = texel(begin), b = texel(c - 1), d = texel(c);
                visit(Triangle{a, b - a, d - a});
            }
        }
    }
    bool has_uv(std::size_t corner) const { return mesh_.corners[corner].uv >= 0; }
    DVec2 texel(std::size_t corner) const {
        const DVec2& uv = mesh_.uvs[static_cast<std::size_t>(mesh_.corners[corner].uv)];
        return {(uv.x * double{map_.scale.x} + double{map_.offset.x}) * image_.width(),
                (uv.y * double{map_.scale.y} + double{map_.offset.y}) * image_.height()};
    }
    // Points that fill a triangle evenly however many they are: the R2 sequence (Roberts 2018).
    void add(const Triangle& t, int i, NormalCount& count) const {
        const auto share = [&](double step) {
            const double x = 0.5 + i * step;
            return x - std::floor(x);
        };
        double b = share(0.7548776662466927), c = share(0.5698402909980532);
        if (b + c > 1) b = 1 - b, c = 1 - c;
        const DVec2 p = t.at + t.ab * b + t.ac * c;
        const int x = place(p.x, image_.width(), map_.wrap_u),
                  y = place(p.y, image_.height(), map_.wrap_v);
        count.add(image_.at(x, image_.height() - 1 - y));
    }
    static int place(double t, int size, scene::Wrap wrap) {
        const double whole = wrap == scene::Wrap::clamp ? std::clamp(t, 0.0, double(size - 1))
                                                        : t - std::floor(t / size) * size;
        return std::isfinite(whole) ? std::clamp(static_cast<int>(whole), 0, size - 1) : 0;
    }

    const image::Image& image_;
    const scene::TextureMap& map_;
    const geom::PolygonMesh& mesh_;
    std::span<const std::uint32_t> faces_;
};

} // namespace

bool holds_normals(const image::Image& image) {
    NormalCount count;
    for (const image::Rgba8& p : image.pixels())
        count.add(p);
    return count.are_normals();
}

bool shows_normals(const image::Image& image, const scene::TextureMap& map,
                   const geom::PolygonMesh& mesh, std::span<const std::uint32_t> faces) {
    return FacesOnImage(image, map, mesh, faces).show_normals();
}

} // namespace scanout::io
