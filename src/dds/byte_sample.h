// ByteSample: the one data type on the wire, in IDL: struct ByteSample { sequence<octet> bytes; }.
// wire/codec.h defines the bytes; so no code generator is needed, and any DDS tool can still record it.
#pragma once

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <vector>

namespace roboss {

struct ByteSample {
    std::vector<std::uint8_t> bytes;
};

class ByteSampleType : public eprosima::fastdds::dds::TopicDataType {
  public:
    ByteSampleType();
    bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
    bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
    void* createData() override { return new ByteSample; }
    void deleteData(void* data) override { delete static_cast<ByteSample*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace roboss
