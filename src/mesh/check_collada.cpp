// Each rule says what assimp's ColladaParser and ColladaLoader (5.2.5) take for granted.
#include "mesh/check_collada.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/diagnostics.h"
#include "mesh/collada_edit.h"
#include "mesh/collada_elements.h"
#include "mesh/collada_faces.h"

namespace roboss {
namespace {

using collada::each_below;
using collada::is;
using collada::Node;

constexpr std::uint64_t kNodesMax = 200'000;  // of a scene with its instances, 3 KB each in assimp
constexpr std::uint64_t kCornersMax = 30'000'000;
// assimp's recursion over nodes takes 1.2 KB of stack for each: measured, 600 KB here.
constexpr int kDeepest = 500;

std::string id_behind(const char* reference) {
    return *reference == '#' ? reference + 1 : reference;
}

std::string remedy_at(int line, const std::string& path) {
    return "Correct line " + std::to_string(line) + " of " + path + ", or export the mesh anew.";
}

class ColladaCheck {
  public:
    explicit ColladaCheck(const xml::SourceFile& file) : file_(file) {}

    Result<> run() {
        check_top();
        const Node top = file_.root();
        each_below(top, [&](Node node) {
            if (is(node, {"effect"})) check_parameters(node);
            if (!is(node, {"node", "visual_scene"})) return;
            by_id_.emplace(node.attribute("id").value(), node);
            by_name_.emplace(node.attribute("name").value(), node);
        });
        for (const Node geometries : top.children("library_geometries")) faces_.read_library(geometries);
        for (const auto& [id, node] : by_id_) (void)scene_under(node);
        if (wrong_) return *wrong_;
        return Ok{};
    }

  private:
    void refuse(Node node, const std::string& what) {
        if (wrong_) return;
        const int line = file_.line(node);
        wrong_ = Error{"is no mesh that can be read: line " + std::to_string(line) + ": " + what,
                       remedy_at(line, file_.path())};
    }

    /// assimp takes the first element of this name.
    void check_top() {
        for (const Node top : file_.root().parent().children()) {
            if (top.type() != pugi::node_element) continue;
            if (top != file_.root()) refuse(top, "a second element stands beside <COLLADA>");
            if (!is(top, {"COLLADA"}))
                refuse(top, "the file's element is <" + std::string(top.name()) + "> instead of <COLLADA>");
        }
    }

    /// It follows a sampler to its surface and from there to a picture, without end if they form a ring.
    void check_parameters(Node effect) {
        std::map<std::string, std::string> next;
        collect_parameters(effect, next);
        for (const auto& [name, source] : next) {
            std::string at = name;
            for (std::size_t step = 0; next.contains(at); ++step) {
                if (step > next.size())
                    return refuse(effect, "the parameter '" + name + "' of an effect refers to itself");
                at = next.at(at);
            }
        }
    }

    static void collect_parameters(Node effect, std::map<std::string, std::string>& next) {
        each_below(effect, [&](Node parameter) {
            if (!is(parameter, {"newparam"})) return;
            std::string& reference = next[parameter.attribute("sid").value()] = "";
            each_below(parameter, [&](Node node) {
                if (is(node, {"surface"}) && node.child("init_from"))
                    reference = node.child("init_from").text().get();
                if (is(node, {"sampler2D"})) reference = id_behind(node.attribute("url").value());
                if (is(node, {"source"})) reference = node.child_value();
            });
        });
    }

    struct Size {
        std::uint64_t nodes = 0, corners = 0;

        /// What is far too much may be less than it is: instances of instances pass all numbers.
        void operator+=(const Size& other) {
            nodes = std::min(nodes + other.nodes, 100 * kNodesMax);
            corners = std::min(corners + other.corners, 100 * kCornersMax);
        }
    };

    /// It copies the nodes behind <instance_node>, without end if they form a ring. What that gives.
    Size scene_under(Node node) {
        if (wrong_) return {};
        const auto known = under_.find(node.offset_debug());
        if (known != under_.end()) return known->second;
        if (!in_progress_.insert(node.offset_debug()).second) {
            refuse(node, "<instance_node> puts the node '" + std::string(node.attribute("id").value()) +
                             "' into itself");
            return {};
        }
        if (in_progress_.size() > kDeepest) refuse(node, "its instances are nested too deep");
        Size all{1, 0};
        for (const Node child : node.children()) {
            const std::string url = id_behind(child.attribute("url").value());
            if (is(child, {"node"})) all += scene_under(child);
            if (is(child, {"instance_geometry"})) all += {0, faces_.corners_of(url)};
            if (!is(child, {"instance_node"})) continue;
            const auto [first, last] = (by_id_.contains(url) ? by_id_ : by_name_).equal_range(url);
            for (auto other = first; other != last; ++other) all += scene_under(other->second);
        }
        in_progress_.erase(node.offset_debug());
        if (is(node, {"visual_scene"}) && (all.nodes > kNodesMax || all.corners > kCornersMax))
            refuse(node, "with all instances, the scene has too many nodes (" + std::to_string(all.nodes) +
                             ") or corners of faces (" + std::to_string(all.corners) + ")");
        return under_[node.offset_debug()] = all;
    }

    const xml::SourceFile& file_;
    std::optional<Error> wrong_;  // the first
    collada::Faces faces_{[this](Node node, const std::string& what) { refuse(node, what); }};
    std::multimap<std::string, Node> by_id_, by_name_;
    std::map<std::ptrdiff_t, Size> under_;
    std::set<std::ptrdiff_t> in_progress_;
};

}  // namespace

Result<std::unique_ptr<xml::SourceFile>> checked_collada(const std::string& path, const std::string& text) {
    Diagnostics diagnostics;
    auto file = xml::SourceFile::from_text(path, text, {}, diagnostics, kDeepest);
    if (!file) {
        const Diagnostic& first = diagnostics.items().front();
        return Error{"is no mesh that can be read: " + first.message, remedy_at(first.where.line, path)};
    }
    put_collada_at_rest(file->root());
    if (const Result<> good = ColladaCheck(*file).run(); !good) return good.error();
    return file;
}

std::string collada_text(const xml::SourceFile& file) {
    std::ostringstream text;
    file.root().print(text, "", pugi::format_raw);
    return std::move(text).str();
}

}  // namespace roboss
