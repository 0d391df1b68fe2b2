#include "fastdds/service_end.h"

#include <chrono>
#include <utility>

namespace roboss::fastdds {
namespace {

constexpr std::size_t kMaxWaiting = 1000;   // replies
constexpr std::int64_t kPatienceMs = 5000;  // for a client's reader
const ros2::Qos kQos{true, false, 1000};

std::int64_t now_ms() {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Result<std::unique_ptr<ServiceEnd>> ServiceEnd::open(const Parts& parts, ros2::EntityId entity,
                                                     const std::string& name, const ros2::ServiceType& type) {
    std::unique_ptr<ServiceEnd> made(new ServiceEnd(parts, entity, name));
    auto replies = Writer::open(parts.participant, reply_topic(name, type.name), type.reply_hash, kQos,
                                [&inbox = parts.inbox] { inbox.wake(); });
    if (!replies) return replies.error();
    made->replies_ = std::move(replies).value();
    auto requests = Reader::open(parts.participant, request_topic(name, type.name), type.request_hash, kQos,
                                 [end = made.get()](Sample sample) { end->take_request(std::move(sample)); });
    if (!requests) return requests.error();
    made->requests_ = std::move(requests).value();
    return made;
}

void ServiceEnd::reply(const ros2::CallId& call, std::string_view cdr) {
    std::optional<Reply> reply = calls_.close(call, cdr);
    if (!reply || send(*reply)) return;
    if (waiting_.size() >= kMaxWaiting) waiting_.pop_front();
    waiting_.push_back({std::move(*reply), now_ms() + kPatienceMs});
}

void ServiceEnd::send_waiting() {
    if (waiting_.empty()) return;
    const std::int64_t now = now_ms();
    std::erase_if(waiting_,
                  [&](const Waiting& waiting) { return send(waiting.reply) || waiting.until_ms < now; });
}

void ServiceEnd::take_request(Sample sample) {
    const Peer client = parts_.peers.of(sample.writer);
    std::optional<ros2::Incoming> request = calls_.open(
        {sample.writer, sample.number, sample.related, std::move(sample.bytes), client.is_cyclone});
    if (!request) return parts_.notices.count_unreadable(name_, "a request is no CDR");
    request->entity = entity_;
    request->peer_type = client.hash;
    if (!parts_.inbox.put(std::move(*request), kQos.depth)) parts_.notices.count_dropped(name_);
}

bool ServiceEnd::send(const Reply& reply) {
    if (!has_reader(replies_->readers(), reply)) return false;
    rtps::WriteParams parameters;
    parameters.related_sample_identity().writer_guid() = to_fastdds(reply.related);
    const auto number = static_cast<std::uint64_t>(reply.number);
    parameters.related_sample_identity().sequence_number() = {static_cast<std::int32_t>(number >> 32),
                                                              static_cast<std::uint32_t>(number)};
    replies_->send(reply.bytes, parameters);
    return true;
}

}  // namespace roboss::fastdds
