// A record is an operation code (a byte), the number of bytes that follow (8) and these bytes. Chunks hold
// packed records. Names and topics come before the messages that refer to them.
#include "bags/mcap_reader.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <unordered_map>

#include "bags/crc32.h"
#include "bags/decompress.h"
#include "core/archive.h"

namespace roboss::bags {

namespace {

constexpr std::size_t kHeadBytes = 9;                               // of a record
constexpr std::uint64_t kMostRecordBytes = std::uint64_t{1} << 30;  // of a record or an unpacked chunk

enum class Op : std::uint8_t {
    kNone = 0,  // never written
    kFooter = 2,
    kSchema = 3,
    kChannel = 4,
    kMessage = 5,
    kChunk = 6,
    kDataEnd = 15  // behind it comes an index
};

struct Head {
    Op op = Op::kNone;
    std::uint64_t size = 0;  // bytes behind the head
};

/// `bytes`: at least kHeadBytes.
Head head_of(Bytes bytes) {
    Head head;
    wire::Reader in(bytes);
    in.scalar(head.op);
    in.scalar(head.size);
    return head;
}

bool is_read(Op op) {
    return op == Op::kSchema || op == Op::kChannel || op == Op::kMessage || op == Op::kChunk;
}

Error bad_record(const std::string& what) {
    return {what, "record it again, or repair it (`mcap recover`)", "bad-record"};
}

Error at_byte(const std::string& what, std::uint64_t byte, const Error& why) {
    return {what + " at byte " + std::to_string(byte) + ": " + why.message, why.remedy, why.code};
}

/// The records of a file.
class Records {
  public:
    explicit Records(Intake& intake) : intake_(intake) {}

    /// One of those that is_read() names.
    Result<> take(Op op, Bytes content) {
        switch (op) {
            case Op::kSchema:
                return schema(content);
            case Op::kChannel:
                return channel(content);
            case Op::kMessage:
                return message(content);
            default:
                return chunk(content);
        }
    }

  private:
    Result<> schema(Bytes content) {
        wire::Reader in(content);
        std::uint16_t id = 0;
        std::string name;
        in.scalar(id);
        field(in, name);
        if (in.failed()) return bad_record("a schema: " + in.failure());
        types_.try_emplace(id, std::move(name));
        return Ok{};
    }

    Result<> channel(Bytes content) {
        wire::Reader in(content);
        std::uint16_t id = 0, schema = 0;
        std::string topic, encoding;
        in.scalar(id);
        in.scalar(schema);
        field(in, topic);
        field(in, encoding);
        if (in.failed()) return bad_record("a channel: " + in.failure());
        if (channels_.contains(id)) return Ok{};  // repeated in each chunk
        const auto type = types_.find(schema);
        channels_[id] = intake_.add_topic(std::move(topic), type == types_.end() ? "" : type->second,
                                          std::move(encoding));
        return Ok{};
    }

    Result<> message(Bytes content) {
        wire::Reader in(content);
        std::uint16_t id = 0;
        std::uint32_t sequence = 0;
        std::uint64_t log_ns = 0, published_ns = 0;
        in.scalar(id);
        in.scalar(sequence);
        in.scalar(log_ns);
        in.scalar(published_ns);
        if (in.failed()) return bad_record("a message: " + in.failure());
        const auto channel = channels_.find(id);
        if (channel == channels_.end())
            return bad_record("a message of channel " + std::to_string(id) +
                              ", which is not described before");
        return intake_.add(channel->second, log_ns, content.last(in.left()));
    }

    Result<> chunk(Bytes content) {
        wire::Reader in(content);
        std::uint64_t first_ns = 0, last_ns = 0, size = 0, stored = 0;
        std::uint32_t checksum = 0;
        std::string compression;
        in.scalar(first_ns);
        in.scalar(last_ns);
        in.scalar(size);
        in.scalar(checksum);
        field(in, compression);
        in.scalar(stored);
        if (in.failed()) return bad_record(in.failure());
        if (stored > in.left())
            return bad_record("it announces " + std::to_string(stored) + " bytes and has " +
                              std::to_string(in.left()));
        if (size > kMostRecordBytes)
            return Error{"it announces " + std::to_string(size) + " unpacked bytes",
                         "write chunks of at most 1 GiB", "too-large"};
        const Bytes packed = content.subspan(content.size() - in.left(), static_cast<std::size_t>(stored));
        if (compression.empty()) return records(packed, size, checksum);
        const auto unpacked = decompressed(compression, packed, static_cast<std::size_t>(size));
        if (!unpacked) return unpacked.error();
        return records(unpacked.value(), size, checksum);
    }

    /// The records of a chunk.
    Result<> records(Bytes bytes, std::uint64_t size, std::uint32_t checksum) {
        if (bytes.size() != size)
            return bad_record("it announces " + std::to_string(size) + " bytes and has " +
                              std::to_string(bytes.size()));
        if (checksum != 0 && crc32(bytes) != checksum)
            return Error{"its CRC is wrong: the file is damaged",
                         "copy it again, or repair it (`mcap recover`)", "bad-crc"};
        for (std::size_t at = 0; at < bytes.size();) {
            if (bytes.size() - at < kHeadBytes) return bad_record("its last record is cut");
            const Head head = head_of(bytes.subspan(at));
            if (head.size > bytes.size() - at - kHeadBytes)
                return at_byte("its record", at, bad_record("it reaches beyond the chunk"));
            if (head.op == Op::kChunk) return at_byte("its record", at, bad_record("a chunk in a chunk"));
            const auto length = static_cast<std::size_t>(head.size);
            if (is_read(head.op))
                if (Result<> taken = take(head.op, bytes.subspan(at + kHeadBytes, length)); !taken)
                    return at_byte("its record", at, taken.error());
            at += kHeadBytes + length;
        }
        return Ok{};
    }

    Intake& intake_;
    std::unordered_map<std::uint16_t, std::string> types_;     // names of schemas
    std::unordered_map<std::uint16_t, std::size_t> channels_;  // their topics in the intake
};

/// A file whose size is known.
class McapFile {
  public:
    explicit McapFile(const std::string& path) : in_(path, std::ios::binary) {
        std::error_code ignored;
        size_ = std::filesystem::file_size(path, ignored);
        if (ignored) in_.setstate(std::ios::failbit);
    }
    std::uint64_t size() const { return size_; }
    /// Bytes from a place on. An Error if they are not there.
    Result<> read(std::uint64_t at, std::size_t count, std::vector<std::uint8_t>& bytes) {
        bytes.resize(count);
        if (at != next_) in_.seekg(static_cast<std::streamoff>(at));  // it drops what is read ahead
        next_ = at + count;
        if (!in_ || !in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count)))
            return Error{"cannot read the bytes from " + std::to_string(at) + " on",
                         "check the permissions and the disk", "no-file"};
        return Ok{};
    }
    Result<bool> has_magic(std::uint64_t at) {
        std::vector<std::uint8_t> bytes;
        if (size_ < kMcapMagic.size()) return false;
        if (Result<> done = read(at, kMcapMagic.size(), bytes); !done) return done.error();
        return std::equal(bytes.begin(), bytes.end(), kMcapMagic.begin(),
                          [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); });
    }

  private:
    std::ifstream in_;
    std::uint64_t size_ = 0;
    std::uint64_t next_ = 0;  // where the stream stands
};

/// All records up to the end of the messages. Returns the byte at which the file is cut, or its size.
Result<std::uint64_t> read_records(McapFile& file, bool finished, Records& records) {
    std::vector<std::uint8_t> bytes;
    for (std::uint64_t at = kMcapMagic.size();;) {
        const std::uint64_t left = file.size() - at;
        Head head;
        if (left >= kHeadBytes) {
            if (Result<> done = file.read(at, kHeadBytes, bytes); !done) return done.error();
            head = head_of(bytes);
        }
        if (left < kHeadBytes || head.op == Op::kNone || head.size > left - kHeadBytes) {
            if (!finished) return at;  // a writer that was interrupted may also leave zeros
            return at_byte(
                "the record", at,
                bad_record(head.op == Op::kNone ? "it has no type" : "it reaches beyond the file"));
        }
        if (head.op == Op::kDataEnd || head.op == Op::kFooter) return file.size();
        if (is_read(head.op)) {
            const std::string name = head.op == Op::kChunk ? "the chunk" : "the record";
            if (head.size > kMostRecordBytes)
                return at_byte(name, at,
                               {"it has " + std::to_string(head.size) + " bytes",
                                "write records of at most 1 GiB", "too-large"});
            if (Result<> done = file.read(at + kHeadBytes, static_cast<std::size_t>(head.size), bytes); !done)
                return done.error();
            if (Result<> taken = records.take(head.op, bytes); !taken)
                return at_byte(name, at, taken.error());
        }
        at += kHeadBytes + head.size;
    }
}

}  // namespace

Result<> read_mcap(Intake& intake, Diagnostics& diagnostics) {
    McapFile file(intake.file());
    const Result<bool> begins = file.has_magic(0);
    if (!begins) return begins.error();
    if (!begins.value())
        return Error{"it does not begin as an MCAP file", "give a bag of ROS 2", "not-a-bag"};
    const Result<bool> ends = file.has_magic(file.size() - kMcapMagic.size());
    if (!ends) return ends.error();
    const bool finished = ends.value() && file.size() >= 2 * kMcapMagic.size();
    Records records(intake);
    const Result<std::uint64_t> end = read_records(file, finished, records);
    if (!end) return end.error();
    if (!finished)
        diagnostics.warning({intake.file(), 0}, "truncated",
                            "the file is not finished: it is read up to byte " + std::to_string(end.value()) +
                                " of " + std::to_string(file.size()),
                            "its recorder was interrupted, or the copy is incomplete");
    return Ok{};
}

}  // namespace roboss::bags
