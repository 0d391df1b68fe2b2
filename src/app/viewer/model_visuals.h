// ModelVisuals: the visuals of the Models of a run. The World of the world file has those of the first Model;
// each addition brings its own World. The visuals of each Model are kept, so a rewind to before an addition
// shows the world of that time; of many Models only the youngest are known.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/copy_place.h"
#include "model/model.h"
#include "wire/control.h"
#include "world/world.h"

namespace roboss {

class ModelVisuals {
  public:
    void begin(const Model& model, World world);
    bool begun() const { return !first_.empty(); }
    /// `to` was made of `from` and looks like it, unless it is known already.
    void change(const Model& from, const Model& to);
    struct Addition {
        const Model &from, &to, &added;  // `to` is `from` with copies of `added`
    };
    /// `world`: that `added` was compiled from, once for each place.
    void add(const Addition& addition, World world, std::span<const CopyPlace> places);
    /// `to` is `from` with copies of robots, which look as their originals.
    void copy(const Model& from, const Model& to, std::span<const CopyRobots::Copy> copies);
    using Worlds = std::vector<std::shared_ptr<const World>>;
    /// `to` is `from` with robots of these Worlds. It may be called for one robot after the other.
    void bring_back(const Model& from, const Model& to, const Worlds& worlds);
    Worlds worlds_of(const Model& model) const;
    /// Forgets all Models but the first one and this one: the run does not return to the others.
    void keep_only(const Model& model);
    /// A later World hides an earlier one's names.
    std::vector<const World*> of(const Model& model) const;
    /// How many Models are known, for tests.
    std::size_t models() const { return by_model_.size(); }

  private:
    void learn(const Model& model, Worlds worlds);

    static constexpr std::size_t kModelsMost = 100;
    Worlds first_;                              // of the world file's Model
    std::uint64_t first_hash_ = 0;              // of that Model
    std::map<std::uint64_t, Worlds> by_model_;  // by hash; without the first
    std::deque<std::uint64_t> order_;           // their hashes, the oldest first
};

}  // namespace roboss
