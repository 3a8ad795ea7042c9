#include "io/obj/write_obj.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace scanout::io {
namespace {

double display_of(float linear) { // IEC 1999
    const double x = std::max(double{linear}, 0.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

class ObjWriter {
public:
    ObjWriter(const geom::PolygonMesh& mesh, std::span<const std::string> materials)
        : m_(mesh), materials_(materials) {}

    std::string write(std::span<const std::string> libraries) {
        for (const std::string& library : libraries)
            line("mtllib {}\n", library);
        vertices();
        faces();
        lines();
        points();
        return {out_.data(), out_.size()};
    }

private:
    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    }

    void vertices() {
        for (std::size_t i = 0; i < m_.positions.size(); ++i) {
            const DVec3& p = m_.positions[i];
            line("v {} {} {}", p.x, p.y, p.z);
            if (!m_.colours.empty()) {
                const Vec3& c = m_.colours[i];
                line(" {:.6g} {:.6g} {:.6g}", display_of(c.x), display_of(c.y), display_of(c.z));
            }
            out_.push_back('\n');
        }
        for (const DVec2& uv : m_.uvs)
            line("vt {} {}\n", uv.x, uv.y);
        for (const Vec3& n : m_.normals)
            line("vn {} {} {}\n", n.x, n.y, n.z);
    }

    void use(std::int32_t material) {
        const bool named = material >= 0 && !materials_[static_cast<std::size_t>(material)].empty();
        if (!named) material = -1;
        if (material == material_) return;
        material_ = material;
        if (named)
            line("usemtl {}\n", materials_[static_cast<std::size_t>(material)]);
        else
            line("usemtl\n");
    }

    void smooth(std::uint32_t group) {
        if (group == smoothing_ || group == geom::kSmoothingUnset) return;
        smoothing_ = group;
        if (group == geom::kSmoothingOff)
            line("s off\n");
        else
            line("s {}\n", group);
    }

    void faces() {
        for (std::size_t f = 0; f < m_.faces(); ++f) {
            use(m_.face_material[f]);
            if (!m_.face_smoothing.empty()) smooth(m_.face_smoothing[f]);
            out_.push_back('f');
            for (std::size_t c = m_.face_begin[f]; c < m_.face_end(f); ++c)
                corner(m_.corners[c]);
            out_.push_back('\n');
        }
    }

    void corner(const geom::Corner& c) {
        if (c.uv >= 0 && c.normal >= 0)
            line(" {}/{}/{}", c.position + 1, c.uv + 1, c.normal + 1);
        else if (c.normal >= 0)
            line(" {}//{}", c.position + 1, c.normal + 1);
        else if (c.uv >= 0)
            line(" {}/{}", c.position + 1, c.uv + 1);
        else
            line(" {}", c.position + 1);
    }

    void lines() {
        for (std::size_t i = 0; i < m_.line_begin.size(); ++i) {
            use(m_.line_material[i]);
            const std::size_t end =
                i + 1 < m_.line_begin.size() ? m_.line_begin[i + 1] : m_.line_vertices.size();
            out_.push_back('l');
            for (std::size_t v = m_.line_begin[i]; v < end; ++v)
                line(" {}", m_.line_vertices[v] + 1);
            out_.push_back('\n');
        }
    }

    void points() {
        for (std::size_t i = 0; i < m_.point_vertices.size(); ++i) {
            use(m_.point_material[i]);
            line("p {}\n", m_.point_vertices[i] + 1);
        }
    }

    const geom::PolygonMesh& m_;
    std::span<const std::string> materials_;
    fmt::memory_buffer out_;
    std::int32_t material_ = -1;
    std::uint32_t smoothing_ = geom::kSmoothingUnset;
};

} // namespace

std::string obj_text(const geom::PolygonMesh& mesh, std::span<const std::string> materials,
                     std::span<const std::string> libraries) {
    return ObjWriter(mesh, materials).write(libraries);
}

} // namespace scanout::io
