// A file read in parts on several threads against the same file read from beginning to end.
#pragma once

#include "folder.h"
#include "io/obj/obj.h"
#include "io/stl/stl.h"

#include <bit>
#include <cstring>
#include <string>
#include <tuple>
#include <vector>

namespace scanout::io::test {

inline Jobs& three_threads() {
    static Jobs jobs(3);
    return jobs;
}

// Bit by bit: what could not be read is NaN.
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// What differs; empty when nothing does.
inline std::string difference(const geom::PolygonMesh& a, const geom::PolygonMesh& b) {
    std::string names;
    const auto note = [&](bool same, const char* name) { names += same ? "" : name; };
    note(same_bits(a.positions, b.positions), " positions");
    note(same_bits(a.colours, b.colours), " colours");
    note(same_bits(a.uvs, b.uvs), " uvs");
    note(same_bits(a.normals, b.normals), " normals");
    note(same_bits(a.corners, b.corners), " corners");
    note(same_bits(a.face_begin, b.face_begin), " face_begin");
    note(same_bits(a.face_material, b.face_material), " face_material");
    note(same_bits(a.face_smoothing, b.face_smoothing), " face_smoothing");
    note(same_bits(a.line_vertices, b.line_vertices), " line_vertices");
    note(same_bits(a.line_begin, b.line_begin), " line_begin");
    note(same_bits(a.line_material, b.line_material), " line_material");
    note(same_bits(a.point_vertices, b.point_vertices), " point_vertices");
    note(same_bits(a.point_material, b.point_material), " point_material");
    return names;
}

inline std::string difference(const std::vector<NameAtLine>& a, const std::vector<NameAtLine>& b,
                              const char* what) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i)
        same = a[i].name == b[i].name && a[i].line == b[i].line;
    return same ? "" : what;
}

inline std::string difference(const ObjFile& a, const ObjFile& b) {
    return difference(a.polygons, b.polygons) + difference(a.materials, b.materials, " materials") +
           difference(a.libraries, b.libraries, " libraries") +
           (a.skipped == b.skipped ? "" : " skipped");
}

inline std::string difference(const StlResult& a, const StlResult& b) {
    return difference(a.polygons, b.polygons) +
           (a.facets == b.facets && a.skipped == b.skipped ? "" : " counts");
}

// `read(text, warnings, how)` in parts of some sizes against `whole`, with what it warned of.
template <class File, class Read>
std::string difference_in_parts(const Result<File>& whole, const Warnings& warnings,
                                std::string_view text, std::vector<std::size_t> part_bytes,
                                Read&& read) {
    std::string found;
    for (const std::size_t bytes : part_bytes) {
        Warnings told;
        const Result<File> parts = read(text, told, Reading{&three_threads(), bytes, nullptr});
        std::string here;
        if (whole.has_value() != parts.has_value())
            here = " one is an error";
        else if (whole)
            here = difference(*whole, *parts);
        else if (whole.error().what != parts.error().what)
            here = " error: " + parts.error().what + " and not " + whole.error().what;
        if (told.lines() != warnings.lines())
            here += " warnings:\n" + all_lines(told) + "\nand not:\n" + all_lines(warnings);
        if (!here.empty()) found += fmt::format("\nparts of {} bytes:{}", bytes, here);
    }
    return found;
}

} // namespace scanout::io::test
