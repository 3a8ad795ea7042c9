// The table of contents of the textbook renderers: the methods of the documents by the part that
// they play, as a person would find them in a book. One name = one file here = one word of the
// command line: help, lists, completions and errors come from these rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

// X(name, what it is)
// clang-format off
#define TEXTBOOK_LINE(X)                                                                           \
    X(kx_b, "y = k x + b at every column, rounded")                                                \
    X(dda_one_axis, "y grows by k a column: gaps where abs(k) > 1")                                \
    X(dda, "the longer axis grows by one, the other by the slope")                                 \
    X(midpoint, "the sign of F at the midpoint chooses the next pixel")                            \
    X(bresenham, "an integer error term")                                                          \
    X(wu, "two pixels a column, weighted by distance (Wu 1991)")
#define TEXTBOOK_FILL(X)                                                                           \
    X(flat_halves, "cut at the middle vertex, both sides stepped from line to line")               \
    X(x_scanline, "crossings with all edges, sorted and paired")                                   \
    X(active_edges, "crossings of the edges that a line meets, stepped by 1/k")                    \
    X(box_all_edges, "every pixel of the box counts the edges to its left")                        \
    X(box_edge_functions, "every pixel of the box asks three cross products")
#define TEXTBOOK_INTERPOLATION(X)                                                                  \
    X(nearest_vertex, "the value of the nearest vertex")                                           \
    X(inverse_distance, "weights 1/distance: naive")                                               \
    X(affine, "barycentric on the screen")                                                         \
    X(perspective, "barycentric, divided by w")                                                    \
    X(spans_affine, "stepped down the edges, then along the line")                                 \
    X(spans_perspective, "the same of value/w and 1/w")                                            \
    X(spans_from_vertex, "the same begun at the vertex: spikes where t passes 1")
#define TEXTBOOK_HIDDEN(X)                                                                         \
    X(none, "nothing hides anything: the edges of all faces")                                      \
    X(drawing_order, "later faces of the file over earlier ones")                                  \
    X(painters, "far to near, by the distance of the middle")                                      \
    X(painters_ordered, "far to near, by comparing faces where they overlap (Newell et al. 1972)") \
    X(warnock, "windows cut in four until one face decides")                                       \
    X(z_linear, "z-buffer of (2z - (f + n))/(f - n)")                                              \
    X(z_squared, "z-buffer of z z / z")                                                            \
    X(z_pseudo, "z-buffer of C + D/z")
// The first three cut faces, the others lines.
#define TEXTBOOK_CLIP(X)                                                                           \
    X(six_planes, "faces: six planes before the division, 3 to 9 corners, a fan")                  \
    X(four_cases, "faces: 0, 1, 2 or 3 corners inside, in camera space")                           \
    X(sutherland_hodgman, "faces: on the screen, against each side of a window")                   \
    X(cohen_sutherland, "lines: outcodes of four bits")                                            \
    X(midpoint_subdivision, "lines: halved until each end is found")                               \
    X(liang_barsky, "lines: the largest entering and the least leaving t")
#define TEXTBOOK_RENDERER(X)                                                                       \
    X(textbook, "the best method of each part")                                                    \
    X(compendium, "depth -1 to 1, equal depths pass, flat halves in spans")                        \
    X(course, "depth 0 to 1/f, painter's algorithm, four-case clip")                               \
    X(software_graphics, "depth 0 to 1 and not compared")

// P(part, type, methods, help of --part)
#define TEXTBOOK_PARTS(P)                                                                          \
    P(line, Line, TEXTBOOK_LINE, "how --hidden none draws edges")                                  \
    P(fill, Fill, TEXTBOOK_FILL, "how triangles become pixels")                                    \
    P(interpolation, Interpolation, TEXTBOOK_INTERPOLATION, "how values of vertices spread over pixels") \
    P(hidden, Hidden, TEXTBOOK_HIDDEN, "which of several faces is seen")                           \
    P(clip, Clip, TEXTBOOK_CLIP,                                                                   \
      "what cuts off what leaves the view; once for faces, once for lines")
// clang-format on

namespace scanout::textbook {

#define TEXTBOOK_ENUMERATOR(name, blurb) name,
#define TEXTBOOK_ENUM(part, Type, METHODS, help)                                                   \
    enum class Type : std::uint8_t { METHODS(TEXTBOOK_ENUMERATOR) };
TEXTBOOK_PARTS(TEXTBOOK_ENUM)
enum class Renderer : std::uint8_t { TEXTBOOK_RENDERER(TEXTBOOK_ENUMERATOR) };
#undef TEXTBOOK_ENUM
#undef TEXTBOOK_ENUMERATOR

struct Method {
    std::string_view name, blurb;
};
struct Part {
    std::string_view name, help;
    std::span<const Method> methods;
};
std::span<const Part> parts(); // line, fill, interpolation, hidden, clip
std::span<const Method> renderers();

constexpr bool cuts_lines(Clip clip) {
    return clip >= Clip::cohen_sutherland;
}

// Depth, as a document has it. Their left-handed axes and clockwise fronts are not rebuilt: z turns
// round, the order of the corners with it, and no pixel changes (trap 12).
struct Conventions {
    double depth_at_near = 0;    // z/w there
    bool depth_ends_at_1 = true; // z/w at the far plane; the course's ends at 1/f
    bool equal_passes = false;   // a depth that is equal to the one that is there
};

// A renderer: one method a part.
struct Parts {
    Line line = Line::bresenham;
    Fill fill = Fill::box_edge_functions;
    Interpolation interpolation = Interpolation::perspective;
    Hidden hidden = Hidden::z_pseudo;
    Clip clip = Clip::six_planes;        // of faces
    Clip line_clip = Clip::liang_barsky; // of lines
    Conventions conventions;
};

// The parts that a user names; the others are the renderer's own.
struct AskedParts {
    std::optional<Line> line;
    std::optional<Fill> fill;
    std::optional<Interpolation> interpolation;
    std::optional<Hidden> hidden;
    std::optional<Clip> clip, line_clip;
    bool any() const { return line || fill || interpolation || hidden || clip || line_clip; }
};
Parts parts_of(Renderer renderer, const AskedParts& asked = {});

} // namespace scanout::textbook
