// Builds a ModelTree: collects the parts, names them, then follows `relative_to` and `attached_to` depth
// first, with a mark on those on the way, so that a circle is found.
#include <algorithm>
#include <cstring>
#include <set>

#include "sdf/ignored_elements.h"
#include "sdf/known_elements.h"
#include "sdf/model_tree.h"

namespace roboss::sdf_import {
namespace {

using Kind = TreePart::Kind;

enum class State { kOpen, kBusy, kDone };

/// A part as written.
struct Draft {
    TreePart part;
    Pose X_RP;
    std::string relative_to;  // the frame R
    std::string attached_to;  // what it moves with; of a joint the child
    State pose = State::kOpen, body = State::kOpen;
};

const char* tag_of(Kind kind) {
    constexpr const char* kTags[] = {"nested model", "link", "joint", "frame"};
    return kTags[static_cast<int>(kind)];
}

bool is_reserved(const std::string& name) {
    return name == "world" || (name.size() >= 4 && name.starts_with("__") && name.ends_with("__"));
}

std::string or_else(std::string text, const std::string& otherwise) {
    return text.empty() ? otherwise : text;
}

/// Elements of a file that have no effect.
void report_elements(const Element& model, Diagnostics& diagnostics) {
    report_unknown_elements(model, diagnostics);
    report_ignored_elements(model, diagnostics);
}

class TreeReader {
  public:
    /// `open`: the files that are being read, each including the next.
    TreeReader(IncludeStore& includes, const ElementReader& reader, std::set<std::string>& open)
        : includes_(includes), reader_(reader), open_(open) {}

    std::unique_ptr<ModelTree> read(const Element& model) {
        tree_->source = model;
        tree_->is_static = reader_.boolean(model, "static", false);
        collect(model);
        std::ranges::stable_sort(drafts_, {}, [](const Draft& draft) { return draft.part.kind; });
        name_parts();
        resolve();
        return std::move(tree_);
    }

  private:
    Diagnostics& diagnostics() const { return reader_.diagnostics(); }

    void collect(const Element& model) {
        for (const auto node : model.node.children()) {
            const Element element{model.source, node};
            const char* tag = node.name();
            if (std::strcmp(tag, "model") == 0)
                add_model(element, TreeReader(includes_, reader_, open_).read(element));
            if (std::strcmp(tag, "include") == 0) add_include(element);
            if (std::strcmp(tag, "link") == 0) add_link(element);
            if (std::strcmp(tag, "joint") == 0) add_joint(element);
            if (std::strcmp(tag, "frame") == 0) add_frame(element);
        }
    }

    Draft& add(Kind kind, const Element& source) {
        const Element pose = source.child("pose");
        Draft& draft = drafts_.emplace_back();
        draft.part.kind = kind;
        draft.part.source = source;
        draft.part.name = source.name();
        draft.X_RP = reader_.pose(pose);
        draft.relative_to = relative_to(pose);
        return draft;
    }

    void add_link(const Element& link) {
        Draft& draft = add(Kind::kLink, link);
        draft.relative_to = or_else(draft.relative_to, kModelFrame);
        draft.part.body = link.name();
        draft.body = State::kDone;
    }

    void add_joint(const Element& joint) {
        Draft& draft = add(Kind::kJoint, joint);
        draft.attached_to = trimmed(joint.text("child"));
        draft.part.parent = trimmed(joint.text("parent"));
        for (const char* end : {"parent", "child"})
            if (trimmed(joint.text(end)).empty())
                diagnostics().error(joint.where(), "missing-element",
                                    "joint '" + joint.name() + "' has no <" + end + ">",
                                    "Name the link there.");
    }

    void add_frame(const Element& frame) {
        Draft& draft = add(Kind::kFrame, frame);
        draft.attached_to = or_else(frame.node.attribute("attached_to").value(), kModelFrame);
        draft.relative_to = or_else(draft.relative_to, draft.attached_to);
    }

    /// `placement`: the frame of the model that stands at the pose; empty: the model's own.
    void place_model(Draft& draft, const ModelTree& model, const std::string& placement) {
        draft.relative_to = or_else(draft.relative_to, kModelFrame);
        if (placement.empty()) return;
        if (const auto X_NP = model.pose_of(placement))
            draft.X_RP = draft.X_RP * inverse(*X_NP);
        else
            diagnostics().error(
                draft.part.source.where(), "unknown-frame",
                "the placement frame '" + placement + "' is not in model '" + draft.part.name + "'",
                "Name one of its links, joints or frames.");
    }

    void add_model(const Element& model, std::shared_ptr<const ModelTree> tree) {
        Draft& draft = add(Kind::kModel, model);
        draft.part.model = std::move(tree);
        place_model(draft, *draft.part.model, model.node.attribute("placement_frame").value());
    }

    void add_include(const Element& include) {
        const Element model = includes_.model_of(include);
        if (!model) return;
        if (!open_.insert(model.source->path()).second) {
            diagnostics().error(include.where(), "include-cycle",
                                "'" + model.source->path() + "' includes itself",
                                "Remove one of the <include>s in the circle.");
            return;
        }
        report_elements(model, diagnostics());
        std::unique_ptr<ModelTree> tree = TreeReader(includes_, reader_, open_).read(model);
        open_.erase(model.source->path());
        tree->is_static = reader_.boolean(include, "static", tree->is_static);
        Draft& draft = add(Kind::kModel, include.child("pose") ? include : model);
        if (!include.child("pose")) draft.relative_to.clear();  // that of a file by itself
        draft.part.source = model;
        draft.part.name = include.child("name") ? include.text("name") : model.name();
        place_model(draft, *tree,
                    include.child("placement_frame") ? include.text("placement_frame")
                                                     : model.node.attribute("placement_frame").value());
        if (include.node.attribute("merge").as_bool())
            merge(include, *tree);
        else
            draft.part.model = std::move(tree);
    }

    /// The parts of the model become parts of this one, relative to a frame that stands for the merged
    /// model's.
    void merge(const Element& include, const ModelTree& tree) {
        const std::string frame = "_merged__" + drafts_.back().part.name + "__model__";
        Draft& proxy = drafts_.back();
        proxy.part.kind = Kind::kFrame;
        proxy.part.source = include;
        proxy.part.name = frame;
        proxy.attached_to = or_else(tree.canonical_link, kModelFrame);
        merged_.push_back({tree.source, frame, {}});
        for (const auto& [model, X_TN] : tree.merged) merged_.push_back({model, frame, X_TN});
        for (const TreePart& part : tree.parts) {
            Draft& draft = drafts_.emplace_back();
            draft.part = part;
            draft.X_RP = part.X_MP;
            draft.relative_to = frame;
            draft.body = State::kDone;
            draft.attached_to = part.body;
            if (part.model_frame == kModelFrame) draft.part.model_frame = frame;
        }
    }

    void name_parts() {
        std::vector<Draft> named;
        for (Draft& draft : drafts_) {
            TreePart& part = draft.part;
            check_name(part);
            if (rename_in_old_file(part, named) || tree_->by_name.emplace(part.name, named.size()).second) {
                named.push_back(std::move(draft));
            } else if (!part.name.empty()) {
                diagnostics().error(
                    part.source.where(), "duplicate-name",
                    std::string(tag_of(part.kind)) + " '" + part.name +
                        "' has the name of another link, joint, frame or nested model of model '" +
                        tree_->source.name() + "'",
                    "Give it a name of its own.");
            }
        }
        drafts_ = std::move(named);
        for (Draft& draft : drafts_) tree_->parts.push_back(std::move(draft.part));
    }

    void check_name(const TreePart& part) {
        const auto report = [&](const char* code, const std::string& what, const std::string& remedy) {
            diagnostics().error(part.source.where(), code, std::string(tag_of(part.kind)) + what, remedy);
        };
        const std::string named = " '" + part.name + "'";
        if (part.name.empty())
            report("no-name", " of model '" + tree_->source.name() + "' has no name", "Give it one.");
        if (is_reserved(part.name))
            report("reserved-name", named + ": SDFormat keeps this name for itself", "Choose another name.");
        if (part.name.find("::") != part.name.npos && version_of(*part.source.source) >= 108)
            report("reserved-name",
                   named + " has '::' in its name, which stands for nested models since SDFormat 1.8",
                   "Write a nested <model>, or another name.");
    }

    /// Before SDFormat 1.7 a link, a joint and a frame could share a name: as in Gazebo, the later kind gets
    /// an ending.
    bool rename_in_old_file(TreePart& part, const std::vector<Draft>& named) {
        if (version_of(*part.source.source) >= 107 || part.kind == Kind::kModel) return false;
        const auto taken = tree_->by_name.find(part.name);
        if (taken == tree_->by_name.end() || named[taken->second].part.kind == part.kind) return false;
        const std::string base = part.name + "_" + tag_of(part.kind);
        std::string name = base;
        for (int i = 0; tree_->by_name.count(name) > 0; ++i) name = base + std::to_string(i);
        diagnostics().warning(part.source.where(), "renamed",
                              std::string(tag_of(part.kind)) + " '" + part.name +
                                  "' has the name of another part of its model; it becomes '" + name + "'",
                              "Give it a name of its own.");
        if (part.kind == Kind::kLink) part.body = name;
        part.name = name;
        return tree_->by_name.emplace(name, named.size()).second;
    }

    void resolve() {
        find_canonical_link();
        for (std::size_t i = 0; i < drafts_.size(); ++i) {
            solve_pose(i);
            solve_body(i);
        }
        for (TreePart& part : tree_->parts)
            if (part.kind == Kind::kJoint && part.parent != "world")
                part.parent = tree_->body_of(part.parent).value_or(part.parent);
        for (const Merged& merged : merged_)
            if (const auto X_MF = tree_->pose_of(merged.frame))
                tree_->merged.emplace_back(merged.model, *X_MF * merged.X_FN);
    }

    /// The one that is named, else the first.
    void find_canonical_link() {
        const std::string named = tree_->source.node.attribute("canonical_link").value();
        if (named.empty()) tree_->canonical_link = first_link();
        if (!named.empty() && link_named(named)) tree_->canonical_link = named;
        const Element& model = tree_->source;
        const bool nests =
            std::ranges::any_of(tree_->parts, [](const TreePart& part) { return part.model != nullptr; });
        if (!tree_->canonical_link.empty() || (named.empty() && (tree_->is_static || nests))) return;
        if (named.empty())
            diagnostics().error(model.where(), "no-links", "model '" + model.name() + "' has no links",
                                "Give it a link, or remove it.");
        else
            diagnostics().error(model.where(), "unknown-frame",
                                "the canonical link '" + named + "' is not in model '" + model.name() + "'",
                                "Name one of its links; those of nested models are NESTED::LINK.");
    }

    std::string first_link() const {
        const auto link = std::ranges::find(tree_->parts, Kind::kLink, &TreePart::kind);
        if (link != tree_->parts.end()) return link->name;
        for (const TreePart& part : tree_->parts)
            if (part.model && !part.model->canonical_link.empty())
                return part.name + "::" + part.model->canonical_link;
        return {};
    }

    bool link_named(const std::string& name) const {
        const ModelTree* tree = tree_.get();
        std::string rest = name;
        while (true) {
            const auto named = tree->locate(rest);
            if (!named) return false;
            if (named->rest.empty()) return tree->parts[named->part].kind == Kind::kLink;
            tree = tree->parts[named->part].model.get();
            rest = named->rest;
        }
    }

    /// False, and an error, if the part depends on itself.
    bool enter(State& state, const TreePart& part) {
        if (state == State::kBusy)
            diagnostics().error(
                part.source.where(), "frame-cycle",
                "the frame of " + std::string(tag_of(part.kind)) + " '" + part.name + "' depends on itself",
                "Break the circle of relative_to, attached_to and joints.");
        if (state != State::kOpen) return false;
        state = State::kBusy;
        return true;
    }

    /// A joint without relative_to stands in the frame of its child; validate() reports a child that is not
    /// there.
    static const std::string& frame_of(const Draft& draft) {
        return draft.relative_to.empty() ? draft.attached_to : draft.relative_to;
    }

    /// The part and those that it depends on, each before the one that needs it. Chains may be longer than a
    /// stack.
    std::vector<std::size_t> in_order_of_need(std::size_t part, State Draft::*state,
                                              const std::string& (*needs)(const Draft&)) {
        std::vector<std::size_t> way;
        std::optional<ModelTree::Named> next = ModelTree::Named{part, {}};
        while (next && enter(drafts_[next->part].*state, tree_->parts[next->part])) {
            way.push_back(next->part);
            next = tree_->locate(needs(drafts_[next->part]));
        }
        std::ranges::reverse(way);
        return way;
    }

    void solve_pose(std::size_t part) {
        for (const std::size_t i : in_order_of_need(part, &Draft::pose, frame_of)) place(i);
    }

    void place(std::size_t i) {
        Draft& draft = drafts_[i];
        TreePart& part = tree_->parts[i];
        const std::string& frame = frame_of(draft);
        const auto X_MR = tree_->pose_of(frame);
        part.X_MP = X_MR ? *X_MR * draft.X_RP : draft.X_RP;
        draft.pose = State::kDone;
        if (X_MR || draft.relative_to.empty()) return;
        diagnostics().error(part.source.where(), "unknown-frame",
                            std::string(tag_of(part.kind)) + " '" + part.name + "' is relative to '" + frame +
                                "', which model '" + tree_->source.name() + "' does not have",
                            "Name a link, joint, frame or nested model of the model, or NESTED::NAME.");
    }

    void solve_body(std::size_t part) {
        const auto needs = [](const Draft& draft) -> const std::string& { return draft.attached_to; };
        for (const std::size_t i : in_order_of_need(part, &Draft::body, needs)) attach(i);
    }

    void attach(std::size_t i) {
        Draft& draft = drafts_[i];
        TreePart& part = tree_->parts[i];
        if (part.kind != Kind::kModel)
            part.body = tree_->body_of(draft.attached_to)
                            .value_or(part.kind == Kind::kJoint ? draft.attached_to : "");
        else if (!part.model->canonical_link.empty())
            part.body = part.name + "::" + part.model->canonical_link;
        draft.body = State::kDone;
        const bool reported = draft.relative_to == draft.attached_to;  // with its pose
        if (part.kind != Kind::kFrame || reported || tree_->pose_of(draft.attached_to)) return;
        diagnostics().error(part.source.where(), "unknown-frame",
                            "frame '" + part.name + "' is attached to '" + draft.attached_to +
                                "', which model '" + tree_->source.name() + "' does not have",
                            "Name a link, joint, frame or nested model of the model, or NESTED::NAME.");
    }

    struct Merged {
        Element model;
        std::string frame;  // that stands for the frame of the model or of the one that merged it
        Pose X_FN;
    };

    IncludeStore& includes_;
    const ElementReader& reader_;
    std::set<std::string>& open_;
    std::unique_ptr<ModelTree> tree_ = std::make_unique<ModelTree>();
    std::vector<Draft> drafts_;  // from name_parts() on one for each of tree_->parts, which then has its part
    std::vector<Merged> merged_;
};

}  // namespace

std::unique_ptr<ModelTree> read_model_tree(const Element& model, IncludeStore& includes,
                                           const ElementReader& reader) {
    report_elements(model, reader.diagnostics());
    if (is_reserved(model.name()))
        reader.diagnostics().error(model.where(), "reserved-name",
                                   "model '" + model.name() + "': SDFormat keeps this name for itself",
                                   "Choose another name.");
    std::set<std::string> open{model.source->path()};
    return TreeReader(includes, reader, open).read(model);
}

}  // namespace roboss::sdf_import
