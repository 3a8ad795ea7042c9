// Annotations: what is drawn over the shading to show how a model is built, and
// how large it is. They are kinds of lines and points that the user asks for by
// name, any of them at once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace scanout::frame {

enum class Annotation : std::uint8_t {
    points,  // the vertices of faces
    normals, // a short line from each vertex along its normal
    box,     // the edges of the bounding box, along the file's axes
    grid,    // squares on the ground, the lowest plane of the box
    axes     // the file's axes x, y, z in red, green and blue, from the lowest corner
             // of the box
};
inline constexpr std::array<std::string_view, 5> kAnnotationNames = {"points", "normals", "box",
                                                                     "grid", "axes"};

// A set of them.
class Annotations {
public:
    bool has(Annotation a) const { return (bits_ & bit(a)) != 0; }
    void toggle(Annotation a) { bits_ = static_cast<std::uint8_t>(bits_ ^ bit(a)); }
    bool empty() const { return bits_ == 0; }
    friend bool operator==(const Annotations&, const Annotations&) = default;

private:
    static std::uint8_t bit(Annotation a) {
        return static_cast<std::uint8_t>(1U << static_cast<unsigned>(a));
    }
    std::uint8_t bits_ = 0;
};

std::string to_string(Annotations annotations); // "box,grid"; "none" where there is none
std::optional<Annotation> annotation_named(std::string_view name);

} // namespace scanout::frame
