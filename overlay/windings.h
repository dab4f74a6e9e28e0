// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/flat_map.h"
#include "overlay/interned.h"
#include "overlay/layer.h"

namespace loft::overlay {

struct WindingTag {
  static constexpr char prefix = 'w';
};
/// How often the rings of every layer wind around a place.
using WindingId = cdt::Id<WindingTag>;

[[nodiscard]] constexpr std::uint64_t hash_of(LayerId layer) { return layer.index(); }

/// The windings and the covers that were met, each once: small numbers for what would be long
/// lists beside each triangle. The first of both stands for outside of everything.
class Windings {
 public:
  Windings() { forget(); }

  void add_layer(FillRule rule) {
    rules_.push_back(rule);
    by_layer_.emplace_back();
  }
  /// All that was met; the layers stay.
  void forget();

  /// What is met beyond a ring of a layer. `step` is +1 where that enters its left side, else -1.
  /// Cost: constant expected, where it was asked before.
  [[nodiscard]] WindingId crossed(WindingId here, LayerId layer, int step);
  [[nodiscard]] CoverId cover(WindingId windings) const { return covers_of_[windings.index()]; }
  /// The layers of a cover, sorted.
  [[nodiscard]] std::span<const LayerId> layers(CoverId cover) const {
    return covers_[cover.index()];
  }

  /// The covers that have any of some layers, those that have several as often.
  [[nodiscard]] std::vector<CoverId> covers_with(std::span<const LayerId> layers) const;
  [[nodiscard]] std::vector<CoverId> all_covers() const;

  [[nodiscard]] std::uint32_t size() const { return lists_.size(); }
  [[nodiscard]] std::uint32_t cover_count() const { return covers_.size(); }

 private:
  /// A layer whose rings wind around, and how often: of even_odd, 1. None does so 0 times.
  struct Turns {
    LayerId layer;
    int times;

    friend bool operator==(const Turns&, const Turns&) = default;
    friend std::uint64_t hash_of(const Turns& turns) {
      return std::uint64_t{turns.layer.index()} << 32 | static_cast<std::uint32_t>(turns.times);
    }
  };

  [[nodiscard]] WindingId with(WindingId here, LayerId layer, int step);
  [[nodiscard]] int turned(LayerId layer, int times, int step) const;
  [[nodiscard]] WindingId number_of_changed();

  std::vector<FillRule> rules_;  // by layer
  Interned<Turns> lists_;
  std::vector<CoverId> covers_of_;  // by windings
  Interned<LayerId> covers_;
  std::vector<std::vector<CoverId>> by_layer_;  // the covers with it
  FlatMap crossings_;                           // what crossed() answered

  // Scratch memory, kept to spare allocations.
  std::vector<Turns> changed_;
  std::vector<LayerId> inside_;
};

}  // namespace loft::overlay
