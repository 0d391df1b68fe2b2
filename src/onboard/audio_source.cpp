// See onboard_kinds/audio_source.h.
#include <cmath>

#include "onboard/controllers.h"

namespace roboss {
namespace {

/// Whether command number `k` came and was not obeyed yet.
bool hears(const OnboardContext& c, std::size_t k, double& heard) {
    const auto at = static_cast<double>(c.commanded_at(k));
    if (at <= heard) return false;
    heard = at;
    return true;
}

/// Ticks that the source may play.
double ticks_of(const AudioSource& source, const OnboardContext& c) {
    return std::floor(source.play_duration / c.dt() + 1e-6);
}

}  // namespace

void run(const AudioSourceSpec& spec, OnboardContext& c) {
    using Spec = AudioSourceSpec;
    for (std::size_t i = 0; i < spec.sources.size(); ++i) {
        const std::span<double> memory = c.memory().subspan(i * Spec::kSize, Spec::kSize);
        const auto now = static_cast<double>(c.tick());
        if (hears(c, 2 * i, memory[Spec::kPlayHeard])) {
            if (memory[Spec::kPlays] == 0) memory[Spec::kSince] = now;
            memory[Spec::kPlays] = 1;
        }
        if (hears(c, 2 * i + 1, memory[Spec::kStopHeard])) memory[Spec::kPlays] = 0;
        const AudioSource& source = spec.sources[i];
        if (source.play_duration > 0 && now - memory[Spec::kSince] > ticks_of(source, c))
            memory[Spec::kPlays] = 0;
    }
}

}  // namespace roboss
