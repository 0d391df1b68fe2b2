// JSON texts of what a run replies, for the command line and web pages. Fields: docs/cluster.md.
#pragma once

#include <optional>
#include <string>

#include "wire/control.h"
#include "wire/message.h"
#include "wire/view_extras.h"

namespace roboss {

/// The fields of `roboss control status`; `robots` only if they were requested.
std::string status_json(const RunStatus& status);
/// The line that pages get twice a second (docs/viewer-protocol.md). real_time_factor: simulated seconds per
/// real second lately.
std::string status_line(const RunStatus& status, double real_time_factor);
/// The run has ended, or failed.
std::string over_line(const RunOver& over);
/// The line with surfaces in motion and bonds (docs/viewer-protocol.md).
std::string extras_line(const ViewExtras& extras, Tick tick, std::uint32_t scene);
/// By robot: its Simulator and its island.
std::string groups_json(const RobotGroups& groups);
/// The boxes that robots swept, m.
std::string bounds_json(const RobotBounds& bounds);
/// Where the time of the steps goes.
std::string profile_json(const RunProfile& profile);
/// Its line for pages that watch it; a refusal says why there is none.
std::string profile_line(const RunProfile& profile);
std::string profile_line(const Error& refusal);
/// Branches and bookmarks of the journal.
std::string timeline_json(const RunTimeline& timeline);
/// What is shown and what is not; the robots only as a number.
std::string preview_json(const RunPreview& preview);
/// The lines of both for pages (docs/viewer-protocol.md).
std::string timeline_line(const RunTimeline& timeline);
std::string preview_line(const RunPreview& preview, std::int64_t id);

}  // namespace roboss
