// Comparing bytes.
#include "gateway/view_state_cache.h"

#include <algorithm>
#include <cstring>

#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

namespace protocol = viewer_protocol;

constexpr std::int64_t kStale_ms = 1'500;  // a Controller that was started afresh counts from the beginning

/// Ascending with the Controllers of a run and their views; never 0.
std::uint64_t stamp_of(const ViewStates& views) {
    return (static_cast<std::uint64_t>(views.epoch) << 40) + (views.serial & 0xFF'FFFF'FFFFull) + 1;
}

template <class T>
void put(std::vector<std::uint8_t>& bytes, std::size_t at, const T& value) {
    std::memcpy(bytes.data() + at, &value, sizeof(value));
}

}  // namespace

void ViewStateCache::begin(std::shared_ptr<const ShownScene> scene) {
    *this = ViewStateCache();
    scene_ = std::move(scene);
    std::size_t offset = 0;
    for (std::size_t r = 0; r < scene_->layout.robots(); ++r) {
        offsets_.push_back(offset);
        offset += scene_->layout.bytes_of(RobotId(r));
    }
    entries_.resize(offset);
    stamps_.assign(offsets_.size(), 0);
}

bool ViewStateCache::take(const ViewStates& views, std::int64_t now_ms) {
    if (!scene_ || views.model_hash != scene_->model->hash) return false;
    const std::uint64_t stamp = stamp_of(views);
    if (stamp < newest_ && now_ms - taken_ms_ > kStale_ms) {
        std::fill(stamps_.begin(), stamps_.end(), std::uint64_t{1});
        newest_ = 0;
    }
    if (stamp > newest_) {
        rests_ = newest_ != 0 && views.tick == tick_;
        newest_ = stamp;
        at_newest_ = 0;
        tick_ = views.tick;
    }
    taken_ms_ = now_ms;
    renewed_.assign(stamps_.size(), 0);
    std::size_t offset = 0;
    while (const std::optional<RobotId> robot = scene_->layout.entry_at(views.entries, offset)) {
        const std::size_t r = robot->index(), size = scene_->layout.bytes_of(*robot);
        if (stamp >= stamps_[r]) {
            heard_ += stamps_[r] == 0 ? 1 : 0;
            at_newest_ += stamp == newest_ && stamps_[r] != stamp ? 1 : 0;
            stamps_[r] = stamp;
            renewed_[r] = 1;
            std::memcpy(entries_.data() + offsets_[r], views.entries.data() + offset, size);
        }
        offset += size;
    }
    take_extras(views.extras);
    return true;
}

/// Of the robots renewed what `extras` says, of the others what was known.
void ViewStateCache::take_extras(const ViewExtras& extras) {
    if (extras_ == extras) return;
    const auto renewed = [&](RobotId robot) {
        return robot.index() < renewed_.size() && renewed_[robot.index()] != 0;
    };
    const auto merged = [&](auto known, const auto& now, auto member) {
        std::erase_if(known, [&](const auto& item) { return renewed(item.*member); });
        for (const auto& item : now)
            if (renewed(item.*member)) known.push_back(item);
        std::stable_sort(known.begin(), known.end(),
                         [&](const auto& a, const auto& b) { return a.*member < b.*member; });
        return known;
    };
    ViewExtras next{merged(extras_.surfaces, extras.surfaces, &ViewSurface::robot),
                    merged(extras_.bonds, extras.bonds, &ViewBond::holder)};
    if (next == extras_) return;
    extras_ = std::move(next);
    ++extras_serial_;
}

std::vector<std::uint8_t> ViewStateCache::message(Shelf& shelf) const {
    if (shelf.entries.size() != entries_.size() || shelf.sent.size() != stamps_.size()) {
        shelf.entries.assign(entries_.size(), 0);
        shelf.sent.assign(stamps_.size(), 0);
        shelf.whole = true;
    }
    std::vector<std::uint8_t> bytes(protocol::kStateBytes);
    bytes.reserve(protocol::kStateBytes + entries_.size());
    std::uint32_t robots = 0;
    for (std::size_t r = 0; r < stamps_.size(); ++r) {
        const std::size_t size = scene_->layout.bytes_of(RobotId(r));
        const std::uint8_t* entry = entries_.data() + offsets_[r];
        std::uint8_t* had = shelf.entries.data() + offsets_[r];
        if (stamps_[r] == 0) continue;
        if (!shelf.whole && shelf.sent[r] != 0 && std::memcmp(entry, had, size) == 0) continue;
        std::memcpy(had, entry, size);
        shelf.sent[r] = 1;
        bytes.insert(bytes.end(), entry, entry + size);
        ++robots;
    }
    const bool whole = robots == stamps_.size();
    const auto flags =
        static_cast<std::uint8_t>((whole ? protocol::kFlagWhole : 0) | (rests_ ? protocol::kFlagRest : 0));
    put(bytes, protocol::kStateKindAt, protocol::kStateKind);
    put(bytes, protocol::kStateFlagsAt, flags);
    put(bytes, protocol::kStateSceneAt, scene_->number);
    put(bytes, protocol::kStateTickAt, static_cast<double>(tick_));
    put(bytes, protocol::kStateTimeAt, static_cast<double>(tick_) * scene_->model->dt_s);
    put(bytes, protocol::kStateRobotsAt, robots);
    if (whole) shelf.whole = false;
    return bytes;
}

}  // namespace roboss
