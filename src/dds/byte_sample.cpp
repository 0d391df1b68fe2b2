// CDR, little-endian: an encapsulation header, a count, the bytes.
#include "dds/byte_sample.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include "dds/fragments.h"

namespace roboss {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::SerializedPayload_t;

ByteSampleType::ByteSampleType() {
    setName("roboss::ByteSample");
    m_typeSize = static_cast<std::uint32_t>(kPieceBytesMax + 64);
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
}

bool ByteSampleType::serialize(void* data, SerializedPayload_t* payload) {
    FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
    payload->encapsulation = CDR_LE;
    try {
        cdr.serialize_encapsulation();
        cdr << static_cast<ByteSample*>(data)->bytes;
    } catch (const eprosima::fastcdr::exception::Exception&) {
        return false;
    }
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
}

bool ByteSampleType::deserialize(SerializedPayload_t* payload, void* data) {
    // The count is checked before anything is allocated by it.
    std::uint32_t count = 0;
    if (payload->length < 8) return false;
    FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
    try {
        cdr.read_encapsulation();
        cdr >> count;
        if (count > payload->length - 8) return false;
        auto& bytes = static_cast<ByteSample*>(data)->bytes;
        bytes.resize(count);
        cdr.deserializeArray(bytes.data(), count);
    } catch (const eprosima::fastcdr::exception::Exception&) {
        return false;
    }
    return true;
}

std::function<std::uint32_t()> ByteSampleType::getSerializedSizeProvider(void* data) {
    return [data] { return static_cast<std::uint32_t>(static_cast<ByteSample*>(data)->bytes.size() + 8); };
}

}  // namespace roboss
