// See roles.h.
#include "gateway/roles.h"

#include <algorithm>
#include <array>

namespace roboss {
namespace {

constexpr std::array kNames{"watch", "steer", "administer"};

struct Needed {
    PageRole operator()(const GetStatus&) const { return PageRole::kWatch; }
    PageRole operator()(const GetGroups&) const { return PageRole::kWatch; }
    PageRole operator()(const GetBounds&) const { return PageRole::kWatch; }
    PageRole operator()(const GetProfile&) const { return PageRole::kWatch; }
    PageRole operator()(const GetTimeline&) const { return PageRole::kWatch; }
    PageRole operator()(const PreviewRun&) const { return PageRole::kWatch; }
    PageRole operator()(const SetWindow&) const { return PageRole::kAdminister; }
    PageRole operator()(const AddSimulator&) const { return PageRole::kAdminister; }
    PageRole operator()(const RemoveSimulator&) const { return PageRole::kAdminister; }
    PageRole operator()(const KillSimulator&) const { return PageRole::kAdminister; }
    PageRole operator()(const SaveRun&) const { return PageRole::kAdminister; }
    PageRole operator()(const QuitRun&) const { return PageRole::kAdminister; }
    PageRole operator()(const ChangeAccuracy&) const { return PageRole::kAdminister; }
    PageRole operator()(const PauseRun&) const { return PageRole::kSteer; }
    PageRole operator()(const ResumeRun&) const { return PageRole::kSteer; }
    PageRole operator()(const StepRun&) const { return PageRole::kSteer; }
    PageRole operator()(const SetSpeed&) const { return PageRole::kSteer; }
    PageRole operator()(const RewindRun&) const { return PageRole::kSteer; }
    PageRole operator()(const AddBookmark&) const { return PageRole::kSteer; }
    PageRole operator()(const RemoveBookmark&) const { return PageRole::kSteer; }
    PageRole operator()(const AddModels&) const { return PageRole::kSteer; }
    PageRole operator()(const RemoveRobots&) const { return PageRole::kSteer; }
    PageRole operator()(const CopyRobots&) const { return PageRole::kSteer; }
    PageRole operator()(const RestoreRobots&) const { return PageRole::kSteer; }
    PageRole operator()(const ResetRun&) const { return PageRole::kSteer; }
};

Error not_permitted(PageRole role, PageRole needed) {
    return {std::string("this page may only ") + name_of(role) + "; this needs the role " + name_of(needed),
            "open the address for that role, which the program printed at its start, or see --view-role",
            "not-permitted"};
}

Error not_asking(std::uint64_t page) {
    return {"page " + std::to_string(page) + " does not ask for control", "it may have left", "not-asking"};
}

}  // namespace

const char* name_of(PageRole role) {
    return kNames[static_cast<std::size_t>(role)];
}

std::string name_of(const OpenPage& page) {
    return page.user.empty() ? page.address : page.user + " at " + page.address;
}

std::optional<PageRole> parse_page_role(std::string_view name) {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (name == kNames[i]) return static_cast<PageRole>(i);
    return std::nullopt;
}

PageRole role_needed(const ControlAction& action) {
    return std::visit(Needed{}, action);
}

void ControlDesk::enter(OpenPage page) {
    const std::uint64_t number = page.number;
    pages_[number] = std::move(page);
    changed_ = true;
}

void ControlDesk::leave(std::uint64_t page) {
    pages_.erase(page);
    std::erase_if(asks_, [page](const Ask& a) { return a.page == page; });
    if (holder_ == page) give_to_next();
    changed_ = true;
}

Result<> ControlDesk::act(std::uint64_t page, PageRole needed) {
    const OpenPage* self = find(page);
    if (needed == PageRole::kWatch) return Ok{};
    if (self == nullptr || self->role < needed)
        return not_permitted(self == nullptr ? PageRole::kWatch : self->role, needed);
    if (!holder_) give_to(page);
    if (holder_ == page) return Ok{};
    return Error{"page " + std::to_string(*holder_) + " of " + name_of(*holder()) + " has control",
                 "ask for control", "no-control"};
}

Result<> ControlDesk::ask(std::uint64_t page, std::int64_t id, std::int64_t now_ms) {
    now_ms_ = now_ms;
    const OpenPage* self = find(page);
    if (self == nullptr || self->role == PageRole::kWatch)
        return not_permitted(PageRole::kWatch, PageRole::kSteer);
    std::erase_if(asks_, [&](const Ask& a) {  // the later one counts
        if (a.page == page) decisions_.push_back({page, a.id, false, "asked again"});
        return a.page == page;
    });
    asks_.push_back({page, id, now_ms});
    if (!holder_ || holder_ == page || holder()->role < self->role) give_to(page);
    changed_ = true;
    return Ok{};
}

Result<> ControlDesk::yield(std::uint64_t page, std::optional<std::uint64_t> to) {
    if (holder_ != page) return Error{"this page has no control", "ask for control", "no-control"};
    if (!to) return give_to_next(), Ok{};
    if (find_ask(*to) == asks_.end()) return not_asking(*to);
    give_to(*to);
    return Ok{};
}

Result<> ControlDesk::keep(std::uint64_t page, std::uint64_t from) {
    if (holder_ != page) return Error{"this page has no control", "ask for control", "no-control"};
    const auto found = find_ask(from);
    if (found == asks_.end()) return not_asking(from);
    decisions_.push_back({from, found->id, false, "page " + std::to_string(page) + " keeps control"});
    asks_.erase(found);
    changed_ = true;
    return Ok{};
}

void ControlDesk::advance(std::int64_t now_ms) {
    now_ms_ = now_ms;
    if (!asks_.empty() && now_ms - asks_.front().since_ms >= kReplyWithin_ms) give_to(asks_.front().page);
}

const OpenPage* ControlDesk::holder() const {
    return holder_ ? find(*holder_) : nullptr;
}

std::vector<OpenPage> ControlDesk::asking() const {
    std::vector<OpenPage> pages;
    for (const Ask& ask : asks_) pages.push_back(*find(ask.page));
    return pages;
}

const OpenPage* ControlDesk::find(std::uint64_t page) const {
    const auto found = pages_.find(page);
    return found == pages_.end() ? nullptr : &found->second;
}

/// Others that ask ask the new holder, from now on.
void ControlDesk::give_to(std::uint64_t page) {
    holder_ = page;
    changed_ = true;
    const auto found = find_ask(page);
    if (found == asks_.end()) return;
    decisions_.push_back({page, found->id, true, "this page has control"});
    asks_.erase(found);
    for (Ask& ask : asks_) ask.since_ms = now_ms_;
}

void ControlDesk::give_to_next() {
    holder_.reset();
    changed_ = true;
    if (!asks_.empty()) give_to(asks_.front().page);
}

std::deque<ControlDesk::Ask>::iterator ControlDesk::find_ask(std::uint64_t page) {
    return std::ranges::find(asks_, page, &Ask::page);
}

}  // namespace roboss
