// Kruskal's algorithm over the joints, most needed first.
#include "model/joint_graph.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string_view>
#include <unordered_map>

#include "world/joint_type.h"

namespace roboss {
namespace {

/// Joints whose coordinates others need: mimic leaders and followers, gearboxes' hinges, odometers.
std::set<std::string> joints_in_use(const ModelSpec& spec) {
    std::set<std::string> used;
    for (const JointSpec& joint : spec.joints) {
        for (const AxisSpec& axis : joint.axes)
            if (axis.mimic) used.insert({joint.name, axis.mimic->joint});
        if (!joint_type(joint.kind).couples) continue;
        for (const JointSpec& hinge : spec.joints)
            for (const std::string& end : {joint.parent, joint.child})
                if ((hinge.parent == joint.gearbox_reference && hinge.child == end) ||
                    (hinge.child == joint.gearbox_reference && hinge.parent == end))
                    used.insert(hinge.name);
    }
    for (const LinkSpec& link : spec.links)
        for (const SensorSpec& sensor : link.sensors) {
            const std::vector<std::string> read = joints_read(sensor);
            used.insert(read.begin(), read.end());
        }
    for (const OnboardSpec& onboard : spec.onboard) {
        const std::vector<std::string> named = joints_named(onboard.parameters);
        used.insert(named.begin(), named.end());
    }
    return used;
}

/// How much a joint should be in the tree.
int worth(const JointSpec& joint, bool in_use) {
    const JointType& type = joint_type(joint.kind);
    if (joint.closes_loop) return -1;
    if (type.welds()) return 100;
    int sum = in_use ? 50 : 0;
    for (const AxisSpec& axis : joint.axes) {
        const bool limited = !type.endless && axis.has_limits();
        if (axis.position_gain > 0 || axis.velocity_gain > 0 || axis.armature > 0) sum += 8;
        if (limited || axis.friction > 0 || axis.initial_position != 0) sum += 4;
        if (axis.damping > 0 || axis.spring_stiffness > 0) sum += 2;
        if (axis.max_effort >= 0 && axis.max_effort < kUnlimited) sum += 1;
    }
    return sum;
}

std::size_t root_of(std::vector<std::size_t>& group, std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
}

/// Finds the ends of all joints. validate() reports joints that name no such link.
std::vector<std::optional<JointEnds>> find_ends(const ModelSpec& spec) {
    std::unordered_map<std::string_view, std::size_t> links;
    for (std::size_t i = 0; i < spec.links.size(); ++i) links.emplace(spec.links[i].name, i);
    std::vector<std::optional<JointEnds>> ends(spec.joints.size());
    for (std::size_t j = 0; j < spec.joints.size(); ++j) {
        const auto parent = links.find(spec.joints[j].parent), child = links.find(spec.joints[j].child);
        const bool on_world = spec.joints[j].parent == "world";
        if (child == links.end() || (!on_world && parent == links.end())) continue;
        ends[j] = {on_world ? spec.links.size() : parent->second, child->second};
    }
    return ends;
}

/// Marks the joints of the spanning forest.
std::vector<char> span_joints(const ModelSpec& spec, const std::vector<std::optional<JointEnds>>& ends) {
    std::vector<std::size_t> order(spec.joints.size()), group(spec.links.size() + 1);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::iota(group.begin(), group.end(), std::size_t{0});
    const std::set<std::string> used = joints_in_use(spec);
    std::vector<int> worths;
    for (const JointSpec& joint : spec.joints) worths.push_back(worth(joint, used.count(joint.name) > 0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return worths[a] > worths[b]; });
    std::vector<char> in_tree(spec.joints.size(), 0);
    for (std::size_t j : order) {
        const JointSpec& joint = spec.joints[j];
        if (joint_type(joint.kind).couples || !ends[j]) continue;
        const std::size_t a = root_of(group, ends[j]->parent), b = root_of(group, ends[j]->child);
        if (a == b) continue;
        group[std::max(a, b)] = std::min(a, b);
        in_tree[j] = 1;
    }
    return in_tree;
}

constexpr std::size_t kNoPart = static_cast<std::size_t>(-1);

/// The links that joints connect with `start`, not walking through the world.
LinkedPart connected_part(const JointGraph& graph, std::size_t start, std::size_t part,
                          std::vector<std::size_t>& part_of) {
    LinkedPart found{{start}, false};
    part_of[start] = part;
    for (std::size_t i = 0; i < found.links.size(); ++i) {
        for (const std::size_t to : graph.neighbours[found.links[i]]) {
            if (to == graph.world) {
                found.fixed_base = true;
            } else if (part_of[to] == kNoPart) {
                part_of[to] = part;
                found.links.push_back(to);
            }
        }
    }
    return found;
}

}  // namespace

JointGraph build_joint_graph(const ModelSpec& spec) {
    JointGraph graph;
    graph.world = spec.links.size();
    graph.edges.resize(spec.links.size() + 1);
    graph.neighbours.resize(spec.links.size() + 1);
    graph.is_child.assign(spec.links.size() + 1, 0);
    graph.ends = find_ends(spec);
    const std::vector<char> in_tree = span_joints(spec, graph.ends);
    for (std::size_t j = 0; j < spec.joints.size(); ++j) {
        if (joint_type(spec.joints[j].kind).couples || !graph.ends[j]) continue;
        const auto [parent, child] = *graph.ends[j];
        graph.is_child[child] = 1;
        graph.neighbours[parent].push_back(child);
        graph.neighbours[child].push_back(parent);
        if (!in_tree[j]) {
            graph.cut.push_back(j);
            continue;
        }
        graph.edges[parent].push_back({j, child, false});
        graph.edges[child].push_back({j, parent, true});
    }
    return graph;
}

std::vector<LinkedPart> connected_parts(const JointGraph& graph,
                                        const std::vector<std::pair<std::size_t, std::size_t>>& tied) {
    std::vector<LinkedPart> parts;
    std::vector<std::size_t> part_of(graph.world, kNoPart);
    for (std::size_t link = 0; link < graph.world; ++link)
        if (part_of[link] == kNoPart) parts.push_back(connected_part(graph, link, parts.size(), part_of));
    for (const auto& [a, b] : tied) {
        const std::size_t into = std::min(part_of[a], part_of[b]), from = std::max(part_of[a], part_of[b]);
        if (into == from || !parts[into].fixed_base || !parts[from].fixed_base) continue;
        for (const std::size_t link : parts[from].links)
            part_of[link] = into, parts[into].links.push_back(link);
        parts[from].links.clear();
    }
    std::erase_if(parts, [](const LinkedPart& part) { return part.links.empty(); });
    for (LinkedPart& part : parts) std::ranges::sort(part.links);
    return parts;
}

}  // namespace roboss
