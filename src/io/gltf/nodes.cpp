#include "io/gltf/nodes.h"

#include "io/gltf/json.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

// The parent of each node, -1 of roots. With one parent each, what does not lead to a root is a
// cycle.
Result<std::vector<Index>> parents_of(const Document& d, const std::string& path) {
    std::vector<Index> parents(d.nodes.size(), -1);
    for (std::size_t i = 0; i < d.nodes.size(); ++i)
        for (const Index child : d.nodes[i].children) {
            Index& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0 && parent != static_cast<Index>(i))
                return fail(Exit::unreadable,
                            "{}: nodes[{}] is a child of nodes[{}] and of nodes[{}]", path, child,
                            parent, i);
            parent = static_cast<Index>(i);
        }
    enum : char { unknown, on_way, rooted };
    std::vector<char> known(d.nodes.size(), unknown);
    for (std::size_t i = 0; i < d.nodes.size(); ++i) {
        std::vector<Index> way;
        Index at = static_cast<Index>(i);
        for (; at >= 0 && known[static_cast<std::size_t>(at)] == unknown;
             at = parents[static_cast<std::size_t>(at)]) {
            known[static_cast<std::size_t>(at)] = on_way;
            way.push_back(at);
        }
        if (at >= 0 && known[static_cast<std::size_t>(at)] == on_way)
            return fail(Exit::unreadable, "{}: nodes[{}] is its own descendant, by nodes[{}]", path,
                        at, way.back());
        for (const Index node : way)
            known[static_cast<std::size_t>(node)] = rooted;
    }
    return parents;
}

class Walk {
public:
    Walk(const Document& document, Accessors& accessors, Budget& budget, const std::string& path,
         Warnings& warnings)
        : d_(document), accessors_(accessors), budget_(budget), path_(path), warnings_(warnings) {}

    Result<SceneNodes> from(const std::vector<Index>& scene, const std::vector<Index>& roots) {
        out_.world.assign(d_.nodes.size(), DMat4(1));
        TRY_VOID(each_node(roots, [&](Index index, const DMat4& parent) -> Result<> {
            const auto number = static_cast<std::size_t>(index);
            out_.world[number] = parent * d_.nodes[number].matrix;
            return {};
        }));
        TRY_VOID(each_node(scene, [&](Index index, const DMat4&) {
            return d_.nodes[static_cast<std::size_t>(index)].mesh < 0 ? Result<>() : add(index);
        }));
        return std::move(out_);
    }

private:
    // Calls visit(node, its parent's place) for the roots and what hangs on them, each node once: a
    // scene may name one twice.
    template <class Visit>
    Result<> each_node(const std::vector<Index>& roots, Visit&& visit) {
        struct Waiting {
            Index node, parent;
        };
        std::vector<Waiting> waiting;
        std::vector<bool> seen(d_.nodes.size(), false);
        for (auto root = roots.rbegin(); root != roots.rend(); ++root)
            waiting.push_back({*root, -1});
        while (!waiting.empty()) {
            const Waiting now = waiting.back();
            waiting.pop_back();
            const auto number = static_cast<std::size_t>(now.node);
            if (seen[number]) continue;
            seen[number] = true;
            TRY_VOID(visit(now.node, now.parent < 0
                                         ? DMat4(1)
                                         : out_.world[static_cast<std::size_t>(now.parent)]));
            const Node& node = d_.nodes[number];
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                waiting.push_back({*child, now.node});
        }
        return {};
    }

    Result<> add(Index index) {
        const Node& node = d_.nodes[static_cast<std::size_t>(index)];
        const DMat4& matrix = out_.world[static_cast<std::size_t>(index)];
        if (node.instances.empty() && node.fault.empty()) {
            out_.draws.push_back({index, node.mesh, matrix});
            return {};
        }
        auto places = instances(index);
        if (!places) {
            warnings_.add("glTF instances", fmt::format("{}; drawn once", places.error().what));
            out_.draws.push_back({index, node.mesh, matrix});
            return {};
        }
        for (const DMat4& one : *places)
            out_.draws.push_back({index, node.mesh, matrix * one});
        return {};
    }

    // EXT_mesh_gpu_instancing: each instance's place within the node.
    Result<std::vector<DMat4>> instances(Index index) {
        const Node& node = d_.nodes[static_cast<std::size_t>(index)];
        if (!node.fault.empty())
            return fail(Exit::unreadable, "{}: nodes[{}].{}", path_, index, node.fault);
        struct Part {
            std::string_view name;
            int rows;
            std::optional<View> view;
        };
        std::array<Part, 3> parts = {Part{"TRANSLATION", 3, {}}, Part{"ROTATION", 4, {}},
                                     Part{"SCALE", 3, {}}};
        std::uint64_t all = ~std::uint64_t{0}; // attributes of another name count, too
        for (const auto& [name, accessor] : node.instances)
            all = std::min(all, d_.accessors[static_cast<std::size_t>(accessor)].count);
        for (Part& part : parts) {
            const Index accessor = find(node.instances, part.name);
            if (accessor < 0) continue;
            TRY(part.view, accessors_.view(accessor));
            if (part.view->rows != part.rows)
                return fail(Exit::unreadable,
                            "{}: nodes[{}]: accessors[{}] has {} numbers an instance, {} has {}",
                            path_, index, accessor, part.view->rows, part.name, part.rows);
        }
        if (all > kMostInstances)
            return fail(Exit::unreadable, "{}: nodes[{}] has {} instances, {} at most are drawn",
                        path_, index, all, kMostInstances);
        TRY_VOID(budget_.take(all * 3 * sizeof(Draw), fmt::format("nodes[{}]", index)));
        struct Place {
            DVec3 translation{0}, scale{1};
            std::array<double, 4> rotation{0, 0, 0, 1};
        };
        std::vector<Place> places(all);
        const auto read = [&]<int kRows>(Part& part, auto&& to) {
            if (!part.view) return;
            part.view->count = all;
            for_elements<kRows>(*part.view, [&](std::uint64_t i, const auto* element) {
                std::copy_n(element, kRows, to(places[i]));
            });
        };
        read.operator()<3>(parts[0], [](Place& p) { return &p.translation.x; });
        read.operator()<4>(parts[1], [](Place& p) { return p.rotation.data(); });
        read.operator()<3>(parts[2], [](Place& p) { return &p.scale.x; });
        std::vector<DMat4> out;
        out.reserve(all);
        for (const Place& p : places)
            out.push_back(trs_matrix(p.translation, p.rotation.data(), p.scale));
        return out;
    }

    static constexpr std::uint64_t kMostInstances = 1 << 24;

    const Document& d_;
    Accessors& accessors_;
    Budget& budget_;
    const std::string& path_;
    Warnings& warnings_;
    SceneNodes out_;
};

} // namespace

Result<SceneNodes> walk_nodes(const Document& d, Accessors& accessors, Budget& budget,
                              const std::string& path, Warnings& warnings) {
    TRY(const std::vector<Index> parents, parents_of(d, path));
    std::vector<Index> roots;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (parents[i] < 0) roots.push_back(static_cast<Index>(i));
    Walk walk(d, accessors, budget, path, warnings);
    return walk.from(d.scene.value_or(roots), roots);
}

} // namespace scanout::io::gltf
