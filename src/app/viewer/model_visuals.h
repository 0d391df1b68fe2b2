// ModelVisuals: the visuals of the Models of a run. The World of the world file has those of the first Model;
// each addition brings its own World. The visuals of each Model are kept, so a rewind to before an addition
// shows the world of that time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
#include "world/world.h"

namespace roboss {

class ModelVisuals {
  public:
    void begin(const Model& model, World world);
    /// `to` was made of `from` and looks like it, unless it is known already.
    void change(const Model& from, const Model& to);
    struct Addition {
        const Model &from, &to, &added;  // `to` is `from` with `added`
    };
    /// `world`: that `added` was compiled from; put at X_WA under `name`.
    void add(const Addition& addition, World world, const Pose& X_WA, const std::string& name);
    /// A later World hides an earlier one's names.
    std::vector<const World*> of(const Model& model) const;

  private:
    std::vector<std::size_t> indices_of(const Model& model) const;

    std::vector<std::shared_ptr<const World>> worlds_;
    std::map<std::uint64_t, std::vector<std::size_t>> by_model_;  // by hash: indices in worlds_
};

}  // namespace roboss
