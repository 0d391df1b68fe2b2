// LocalView: shows a LocalRun in browsers. A Gateway speaks to a run over a Bus, as to a Controller
// (docs/cluster.md); a LocalRun has neither. This stands in for that Controller, on a Bus in the process: it
// hands out Model and scene, sends views and exact states, passes the orders of pages on to the LocalRun, and
// says why it refuses the rest (docs/decisions/0030-views-of-local-runs.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gateway/roles.h"
#include "local/local_run.h"
#include "world/world.h"

namespace roboss {

/// Where a LocalView listens, and what its pages may do.
struct LocalViewOptions {
    std::string listen = "8090";       ///< [ADDRESS:]PORT; if the port is taken, one of those behind it
    std::string page_folder;           ///< with the page's files
    PageRole role = PageRole::kSteer;  ///< the greatest that a page gets
    std::string program = "roboss";    ///< what pages show as the program
    bool insecure = false;  ///< beyond loopback, too, without TLS; else with a certificate of its own
};

/// The Worlds that a Model was made of: the first one, and those of what was added (scene/placed_copies.h).
using Looks = std::vector<std::shared_ptr<const World>>;

/// See the top of the file. Not for use by several threads at once; the server has its own thread.
class LocalView {
  public:
    /// Listens at once; an Error says why it cannot.
    static Result<std::unique_ptr<LocalView>> open(const LocalViewOptions& options);
    ~LocalView();

    /// Where browsers find it, with the token if one is needed.
    const std::string& url() const;
    /// SHA-256 of its certificate, as browsers show it; empty: it is not served over TLS.
    const std::string& fingerprint() const;
    /// To be called often: after each part of a step, and some thirty times a second while nothing is
    /// stepped. Shows the run as it is now, and gives it the orders of pages. It is cheap between two views,
    /// and while nobody watches. The run may be another one each time, also of another Model.
    void turn(LocalRun& run, const Looks& looks);
    /// How many pages are open.
    std::size_t pages() const;
    /// Refusals and such, one line each, since the last call.
    std::vector<std::string> take_notices();
    /// Tells all pages why it ends, and closes them. To be called once, before the end.
    void say_farewell(const std::string& reason);

  private:
    struct Parts;
    explicit LocalView(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace roboss
