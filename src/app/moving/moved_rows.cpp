#include "app/moving/moved_rows.h"

#include <array>

namespace scanout::app {
namespace {

using scene::LightKind;
using scene::Moved;

constexpr double kAnyNumber = 1e15;
constexpr unsigned bit_of(LightKind kind) {
    return 1U << static_cast<unsigned>(kind);
}
constexpr unsigned kDirectionals = bit_of(LightKind::directional), kSpots = bit_of(LightKind::spot),
                   kHemispheres = bit_of(LightKind::hemisphere), kPoints = bit_of(LightKind::point),
                   kEveryLight =
                       kDirectionals | kSpots | kHemispheres | kPoints | bit_of(LightKind::ambient);

constexpr std::array kMovedRows = std::to_array<MovedRow>({
    {"model", "translate", Moved::translate, 3, -kAnyNumber, kAnyNumber, "[0, 1, 0]"},
    {"model", "rotate", Moved::rotate, 3, -kAnyNumber, kAnyNumber, "[0, 90, 0]"},
    {"model", "turn", Moved::turn, 4, -kAnyNumber, kAnyNumber, "[0, 0.7071, 0, 0.7071]"},
    {"model", "scale", Moved::scale, 3, -kAnyNumber, kAnyNumber, "[1, 2, 1]"},
    {"camera", "azimuth", Moved::azimuth, 1, -kAnyNumber, kAnyNumber, "90"},
    {"camera", "elevation", Moved::elevation, 1, -90, 90, "20"},
    {"camera", "distance", Moved::distance, 1, 1e-6, kAnyNumber, "3"},
    {"camera", "shift", Moved::shift, 2, -kAnyNumber, kAnyNumber, "[0, 0.5]"},
    {"camera", "fov", Moved::fov, 1, 0.1, 175, "45"},
    {"camera", "eye", Moved::eye, 3, -kAnyNumber, kAnyNumber, "[0, 1, 5]"},
    {"camera", "look-at", Moved::look_at, 3, -kAnyNumber, kAnyNumber, "[0, 1, 0]"},
    {"light", "at", Moved::at, 3, -kAnyNumber, kAnyNumber, "[0, 2, 1]",
     kEveryLight & ~bit_of(LightKind::ambient)},
    {"light", "to", Moved::to, 3, -kAnyNumber, kAnyNumber, "[0, 1, 0]", kSpots},
    {"light", "cone", Moved::cone, 2, 0, 180, "[20, 30]", kSpots},
    {"light", "colour", Moved::colour, 3, 0, 1, "[1, 0.5, 0.2] or \"#ffcc88\"", kEveryLight},
    {"light", "ground", Moved::ground, 3, 0, 1, "[0.2, 0.2, 0.2] or \"#808080\"", kHemispheres},
    {"light", "power", Moved::power, 1, 0, scene::kMaxPower, "0.8", kEveryLight},
    {"light", "size", Moved::size, 1, 0, kAnyNumber, "0.2", kDirectionals | kPoints | kSpots},
});

} // namespace

std::span<const MovedRow> moved_rows() {
    return kMovedRows;
}

} // namespace scanout::app
