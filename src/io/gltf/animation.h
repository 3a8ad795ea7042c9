// Animations: keys that move nodes and weigh morph targets, and a document as it is at a moment of
// one. Khronos 2021, 3.11 and appendix C.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "io/gltf/accessor.h"
#include "scene/motion/track.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanout::io::gltf {

// The animation of this name, or else of this number. Exit::usage where there is none: what there
// is.
Result<Index> find_animation(const Document& document, std::string_view name_or_number,
                             const std::string& path);

// The channels of an animation that can be used; the others are warnings.
class Clip {
public:
    static Result<Clip> read(const Document& document, Accessors& accessors, Index animation,
                             const std::string& path, Budget& budget, Warnings& warnings);

    double duration() const { return duration_; } // seconds: until its last key
    // Puts the document's nodes where they are at a time; after the duration it begins again.
    void pose(double seconds, Document& document) const;

private:
    struct Moving {
        Index node;
        AnimationPath path;
        scene::Track track;
    };
    std::vector<Moving> moving_;
    double duration_ = 0;
};

// Any weight but 0.
bool weighs_targets(const Document& document);
// What the mesh of a node weighs its morph targets by: the node's own weights, else the mesh's.
const std::vector<double>& weights_of(const Document& document, const Node& node);

} // namespace scanout::io::gltf
