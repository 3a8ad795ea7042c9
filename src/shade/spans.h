// The pixels of a tile that one primitive fills alone, gathered by primitive: each is set up once a
// tile, and its pixels fill registers of lanes whatever rows they lie in.
#pragma once

#include "geom/mesh.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace scanout::shade {

// How a primitive is drawn.
struct Look {
    std::int32_t material; // index, -1: the default material
    bool lit;              // lines and points are not
    friend bool operator==(const Look&, const Look&) = default;
};
// How a mesh's primitives are drawn.
struct Looks {
    const geom::Mesh* mesh = nullptr;
    // Of all primitives, which are triangles then: asking the mesh misses the cache each time.
    std::optional<std::int32_t> only_material;
    Look of(std::uint32_t id) const {
        return only_material ? Look{*only_material, true} : of_mesh(id);
    }

private:
    Look of_mesh(std::uint32_t id) const;
};

class Spans {
public:
    // Pixels of one primitive. It may have several groups, where many share the table below.
    struct Group {
        std::uint32_t id;
        Look look;
        std::uint16_t last;  // span
        std::uint16_t count; // pixels
    };

    Spans();
    void clear();
    // Pixels of a row side by side; `pixel` is the first, by its number in the tile. Each pixel of
    // the tile once at most.
    void add(const Looks& looks, std::uint32_t id, int pixel, int count) {
        const Slot slot = slot_[id % kSlots];
        if (slot.id != id) return add_group(looks.of(id), id, pixel, count);
        Group& group = groups_[slot.group];
        group.last = add_span(pixel, count, group.last);
        group.count = static_cast<std::uint16_t>(group.count + count);
    }
    // Groups that look alike stand together. add() may not follow.
    void arrange();
    std::span<const Group> groups() const { return groups_; }
    // The numbers of a group's pixels; writes up to kBeyond more.
    static constexpr int kBeyond = 3;
    void put_pixels(const Group& group, std::int32_t* to) const {
        for_fours(group,
                  [=](int at, const Four& pixel) { std::memcpy(to + at, &pixel, sizeof pixel); });
    }
    // And as often the group's number.
    void put_pixels(const Group& group, std::int32_t* to, std::int32_t* number_to,
                    std::int32_t number) const {
        const Four numbers = Four{} + number;
        for_fours(group, [=](int at, const Four& pixel) {
            std::memcpy(to + at, &pixel, sizeof pixel);
            std::memcpy(number_to + at, &numbers, sizeof numbers);
        });
    }

private:
    static constexpr std::size_t kSlots = 1024;
    static constexpr std::uint16_t kNone = 0xffff;
    // Compilers put the four together one by one if they stand in a loop over int.
    using Four __attribute__((vector_size(16))) = std::int32_t;
    struct Span {
        std::uint16_t pixel, before; // of the same group, or kNone
        std::uint16_t count;
        std::uint16_t unused; // 8 bytes are found by fewer steps than 6
    };
    std::uint16_t add_span(int pixel, int count, std::uint16_t before) {
        span_[spans_] = {static_cast<std::uint16_t>(pixel), before,
                         static_cast<std::uint16_t>(count), 0};
        return static_cast<std::uint16_t>(spans_++);
    }
    // put(place of a pixel in the group, that one and the three behind it).
    template <class Put>
    void for_fours(const Group& group, const Put& put) const {
        const Span* const spans = span_.data();
        int at = 0;
        for (std::uint16_t i = group.last; i != kNone;) {
            const Span span = spans[i];
            Four pixel = Four{0, 1, 2, 3} + span.pixel;
            for (int k = 0; k < span.count; k += 4, pixel += 4) // most are no longer
                put(at + k, pixel);
            at += span.count;
            i = span.before;
        }
    }
    void add_group(const Look& look, std::uint32_t id, int pixel, int count);

    std::vector<Span> span_;
    std::size_t spans_ = 0;
    std::vector<Group> groups_;
    struct Slot {
        std::uint32_t id, group;
    };
    std::array<Slot, kSlots> slot_{}; // by id modulo kSlots: the last group there
    bool one_look_ = true;
};

} // namespace scanout::shade
