// What pages may do, and which of them has control: one page at a time acts, the others watch it and may ask.
// Pure: time is passed in, so that it can be tested without a network.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "wire/control.h"

namespace roboss {

/// What a page may do; each role includes those before it.
enum class PageRole : std::uint8_t {
    kWatch,      ///< sees everything
    kSteer,      ///< orders robots; pauses, steps, rewinds; adds and removes robots
    kAdminister  ///< writes files, ends the run, starts and ends Simulators, changes accuracy and window
};

/// "watch", "steer", "administer".
const char* name_of(PageRole role);
std::optional<PageRole> parse_page_role(std::string_view name);
/// The least role that may request this.
PageRole role_needed(const ControlAction& action);

/// Somebody who may open the page, known by a token.
struct PageUser {
    std::string name;  // empty: any holder of the token
    PageRole role = PageRole::kWatch;
    std::string digest;  // of the token (gateway/access.h)
    friend bool operator==(const PageUser&, const PageUser&) = default;
};

/// A page that is open.
struct OpenPage {
    std::uint64_t number = 0;
    std::string address;  // of its computer
    PageRole role = PageRole::kWatch;
    std::string user{};  // empty: it has none
};
/// "ann at 192.0.2.7", or only the address.
std::string name_of(const OpenPage& page);

/// Which page has control. A page that acts takes it if no page has it. A page that asks gets it when the
/// page that has it yields, leaves, or does not reply in time; at once from a page of a lower role.
class ControlDesk {
  public:
    /// A question that has been decided.
    struct Decision {
        std::uint64_t page = 0;
        std::int64_t id = 0;  // of its message
        bool granted = false;
        std::string text;
    };
    static constexpr std::int64_t kReplyWithin_ms = 10'000;

    void enter(OpenPage page);
    void leave(std::uint64_t page);
    /// The page is about to do what needs this role. An Error: not-permitted, no-control.
    Result<> act(std::uint64_t page, PageRole needed);
    /// Asks for control; the answer is a Decision. An Error if its role only watches.
    Result<> ask(std::uint64_t page, std::int64_t id, std::int64_t now_ms);
    /// Hands control to a page that asks for it, or, without `to`, gives it up. An Error: no-control,
    /// not-asking.
    Result<> yield(std::uint64_t page, std::optional<std::uint64_t> to);
    /// Keeps control from a page that asks for it. An Error: no-control, not-asking.
    Result<> keep(std::uint64_t page, std::uint64_t from);
    /// Lets time pass.
    void advance(std::int64_t now_ms);

    const OpenPage* holder() const;
    /// Pages that ask, in the order in which they did.
    std::vector<OpenPage> asking() const;
    const OpenPage* find(std::uint64_t page) const;
    /// Whether anything of this has changed since the last call.
    bool take_changed() { return std::exchange(changed_, false); }
    std::vector<Decision> take_decisions() { return std::exchange(decisions_, {}); }

  private:
    struct Ask {
        std::uint64_t page = 0;
        std::int64_t id = 0, since_ms = 0;
    };
    void give_to(std::uint64_t page);
    void give_to_next();
    std::deque<Ask>::iterator find_ask(std::uint64_t page);

    std::map<std::uint64_t, OpenPage> pages_;
    std::optional<std::uint64_t> holder_;
    std::deque<Ask> asks_;
    std::vector<Decision> decisions_;
    bool changed_ = false;
    std::int64_t now_ms_ = 0;
};

}  // namespace roboss
