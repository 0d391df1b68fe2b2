// Each rule says what assimp's ColladaParser and ColladaLoader (5.2.5) take for granted.
#include "mesh/check_collada.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "xml/source_file.h"

namespace roboss {
namespace {

using Node = pugi::xml_node;
using Numbers = unsigned long long;

constexpr Numbers kNodesMax = 1'000'000;  // of a scene with its instances
constexpr std::size_t kDeepest = 1'000;

std::string id_behind(const char* reference) {
    return *reference == '#' ? reference + 1 : reference;
}

bool is(Node node, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, std::string_view(node.name())) != names.end();
}

Numbers number_of(Node node, const char* attribute, Numbers otherwise) {
    return node.attribute(attribute).as_ullong(otherwise);
}

/// All elements of this name below it: assimp does not ask how deep they are.
std::vector<Node> all_below(Node node, std::string_view name) {
    std::vector<Node> found;
    for (const Node child : node.children()) {
        if (is(child, {name})) found.push_back(child);
        const std::vector<Node> deeper = all_below(child, name);
        found.insert(found.end(), deeper.begin(), deeper.end());
    }
    return found;
}

/// Comments may stand between parts of a list.
template <class Take>
void each_word(Node list, const Take& take) {
    for (const Node part : list.children())
        if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata)
            for (const std::string_view word : xml::words_of(part.value())) take(word);
}

bool is_index(std::string_view word) {
    return std::ranges::all_of(word,
                               [](unsigned char c) { return std::isdigit(c) != 0 || c == '-' || c == '+'; });
}

std::string remedy_at(int line, const std::string& path) {
    return "Correct line " + std::to_string(line) + " of " + path + ", or export the mesh anew.";
}

class ColladaCheck {
  public:
    explicit ColladaCheck(const xml::SourceFile& file) : file_(file) {}

    Result<> run() {
        collect(file_.root());
        visit(file_.root());
        for (const auto& [id, node] : by_id_) (void)nodes_under(node);
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

    void collect(Node node) {
        for (const Node child : node.children()) {
            if (is(child, {"node", "visual_scene"})) {
                by_id_.emplace(child.attribute("id").value(), child);
                by_name_.emplace(child.attribute("name").value(), child);
            }
            collect(child);
        }
    }

    void visit(Node node) {
        for (const Node child : node.children()) {
            if (is(child, {"p", "h", "v", "vcount"})) check_indices(child);
            if (is(child, {"triangles", "polylist", "polygons", "tristrips"})) check_faces(child);
            if (is(child, {"effect"})) check_parameters(child);
            if (is(child, {"float_array"}))
                arrays_[child.attribute("id").value()] = number_of(child, "count", 0);
            if (is(child, {"Name_array", "IDREF_array"})) arrays_[child.attribute("id").value()] = 0;
            if (wrong_) return;
            visit(child);
            if (is(child, {"mesh"})) check_accessors(child);
        }
    }

    /// It does not go on behind a word that is no integer, and takes all memory.
    void check_indices(Node list) {
        each_word(list, [&](std::string_view word) {
            if (!is_index(word))
                refuse(list,
                       "'" + std::string(word.substr(0, 40)) + "' stands among the indices of its faces");
        });
    }

    /// It compares an index with the accessor's count, and not with how many numbers there are.
    void check_accessors(Node mesh) {
        for (const Node accessor : all_below(mesh, "accessor")) check_accessor(accessor);
    }

    void check_accessor(Node accessor) {
        const Numbers count = number_of(accessor, "count", 0);
        const std::string name = accessor.attribute("source").value();
        const auto array = arrays_.find(id_behind(name.c_str()));
        if (count == 0 || array == arrays_.end()) return;  // the latter it notices
        const Numbers stride = number_of(accessor, "stride", 1), offset = number_of(accessor, "offset", 0);
        const Numbers each = std::max<Numbers>(all_below(accessor, "param").size(), 1), there = array->second;
        // Without overflow: there >= offset + (count - 1) * stride + each.
        const bool fits = offset <= there && each <= there - offset &&
                          (count == 1 || stride <= (there - offset - each) / (count - 1));
        if (!fits)
            refuse(accessor, "its <accessor> reads " + std::to_string(count) + " times " +
                                 std::to_string(stride) + " numbers of '" + name + "', which has " +
                                 std::to_string(there));
    }

    void check_faces(Node faces) {
        const Numbers count = number_of(faces, "count", 0);
        const std::size_t lists = all_below(faces, "p").size();
        // It asserts that the lists hold as many primitives as are announced; without a count it reads 0.
        const Numbers primitives = is(faces, {"polygons"}) ? lists : count * lists;
        if (!is(faces, {"tristrips"}) && primitives != count)
            refuse(faces, "<" + std::string(faces.name()) + "> announces " + std::to_string(count) +
                              " faces and has " + std::to_string(lists) + " <p>");
        if (is(faces, {"polylist"}) && count > 0 && !is_counted(faces))
            refuse(faces, "<polylist> has no <vcount> before its <p>");
        // It subtracts 2 from the corners of a strip.
        if (is(faces, {"tristrips"}))
            for (const Node strip : all_below(faces, "p")) check_strip(faces, strip);
    }

    static bool is_counted(Node polylist) {
        for (const Node child : polylist.children()) {
            if (is(child, {"vcount"})) return true;
            if (is(child, {"p"})) return false;
        }
        return false;
    }

    void check_strip(Node faces, Node strip) {
        Numbers indices = 0, each = 1;
        each_word(strip, [&](std::string_view) { ++indices; });
        for (const Node input : all_below(faces, "input"))
            each = std::max(each, std::min<Numbers>(number_of(input, "offset", 0), indices) + 1);
        if (indices / each < 3) refuse(strip, "a strip of <tristrips> has fewer than three corners");
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

    static void collect_parameters(Node node, std::map<std::string, std::string>& next) {
        for (const Node child : node.children()) {
            if (is(child, {"newparam"})) {
                const Node value = child.first_element_by_path("surface/init_from");
                const Node sampler = child.first_element_by_path("sampler2D/source");
                next[child.attribute("sid").value()] = (value ? value : sampler).text().get();
            }
            collect_parameters(child, next);
        }
    }

    /// It copies the nodes behind <instance_node>, without end if they form a ring. How many nodes that
    /// gives.
    Numbers nodes_under(Node node) {
        if (wrong_) return 0;
        const auto known = under_.find(node.offset_debug());
        if (known != under_.end()) return known->second;
        if (!in_progress_.insert(node.offset_debug()).second)
            return refuse(node, "<instance_node> puts the node '" +
                                    std::string(node.attribute("id").value()) + "' into itself"),
                   0;
        if (in_progress_.size() > kDeepest) refuse(node, "its instances are nested too deep");
        Numbers all = 1;
        for (const Node child : node.children()) {
            if (is(child, {"node"})) all += nodes_under(child);
            if (!is(child, {"instance_node"})) continue;
            const std::string url = id_behind(child.attribute("url").value());
            const auto [first, last] = (by_id_.contains(url) ? by_id_ : by_name_).equal_range(url);
            for (auto other = first; other != last; ++other) all += nodes_under(other->second);
        }
        in_progress_.erase(node.offset_debug());
        if (all > kNodesMax) refuse(node, "its instances are more than a million nodes");
        return under_[node.offset_debug()] = all;
    }

    const xml::SourceFile& file_;
    std::optional<Error> wrong_;             // the first
    std::map<std::string, Numbers> arrays_;  // by id: the numbers in the last one so far, which it takes
    std::multimap<std::string, Node> by_id_, by_name_;
    std::map<std::ptrdiff_t, Numbers> under_;
    std::set<std::ptrdiff_t> in_progress_;
};

}  // namespace

Result<> check_collada(const std::string& path, const std::string& text) {
    Diagnostics diagnostics;
    const auto file = xml::SourceFile::from_text(path, text, {}, diagnostics);
    if (!file) {
        const Diagnostic& first = diagnostics.items().front();
        return Error{"is no mesh that can be read: " + first.message, remedy_at(first.where.line, path)};
    }
    return ColladaCheck(*file).run();
}

}  // namespace roboss
