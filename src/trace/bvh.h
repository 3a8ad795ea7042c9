// Which triangle a ray meets first, and whether anything stands in its way. Embree's hierarchy
// finds the candidates in single precision: bounds are widened by more than its rounding, so that
// none is missed, and triangle.h decides in double. So nothing depends on the instruction set for
// which Embree was compiled, nor on the order in which it visits.
#pragma once

#include "base/result.h"
#include "trace/triangle.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace scanout::trace {

class Bvh {
public:
    // Fails (Exit::unreadable) where memory does not suffice, and (Exit::usage) soon after
    // `cancelled`, which another thread sets. embree: its configuration, as "isa=sse2".
    static Result<Bvh> create(std::vector<Corners> triangles, const char* embree = nullptr,
                              const std::atomic<bool>* cancelled = nullptr);
    ~Bvh();
    Bvh(Bvh&&) noexcept;
    Bvh& operator=(Bvh&&) noexcept;
    // That a hierarchy over so many triangles takes, about.
    static std::uint64_t bytes(std::size_t triangles);

    // Of the hits that come after this one, the first. Made with t alone, it is where to begin.
    Hit next(const Ray& ray, const Hit& after) const;
    // Whether some triangle lies between two parameters of the ray, other than `except` and those
    // that do not count: counts has an entry a triangle, or none, where all do.
    bool blocked(const Ray& ray, double least, double most, std::uint32_t except,
                 const std::vector<std::uint8_t>& counts) const;

    const Corners& corners(std::uint32_t triangle) const;
    double radius() const; // of a sphere about all of them; at least a tiny one

    struct State; // bvh.cpp's
private:
    explicit Bvh(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace scanout::trace
