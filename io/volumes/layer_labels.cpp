// SPDX-License-Identifier: MIT
#include "io/volumes/layer_labels.h"

#include <cmath>
#include <utility>

#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

/// More different values are a picture.
constexpr std::size_t most_labels = 65535;

}  // namespace

LayerLabels::LayerLabels(const Volume& volume) : volume_(volume), by_value_(volume.layers) {
  for (const VolumeLabel& told : volume.labels) {
    if (told.layer >= volume.layers) continue;
    const double value = volume.level ? 1 : told.value;
    if (by_value_[told.layer].contains(value)) continue;  // the first one counts
    by_value_[told.layer].emplace(value, add(told.label, true));
  }
}

/// Two of one name would be one structure: the second takes its id, too.
std::uint32_t LayerLabels::add(StackLabel label, bool is_told) {
  if (label.name.empty()) label.name = label.id;
  const std::string name = label.name;
  if (names_.contains(label.name)) label.name += " (" + label.id + ')';
  for (int copy = 2; !names_.insert(label.name).second; ++copy)
    label.name = name + " (" + std::to_string(copy) + ')';
  labels_.push_back({std::move(label), false, is_told});
  return static_cast<std::uint32_t>(labels_.size());
}

void LayerLabels::begin(std::uint32_t slice, std::uint32_t layer) {
  slice_ = slice;
  layer_ = layer;
  last_value_ = std::nan("");
}

std::uint32_t LayerLabels::meet(std::uint32_t label) {
  labels_[label - 1].is_met = true;
  return label;
}

std::uint32_t LayerLabels::find(double value) {
  std::map<double, std::uint32_t>& known = by_value_[layer_];
  if (volume_.level) {
    if (!(value >= *volume_.level)) return 0;
    if (known.empty()) {
      const std::string id = std::to_string(layer_ + 1);
      known.emplace(1, add({"layer " + id, {}, id}, false));
    }
    return meet(known.begin()->second);
  }
  if (value == 0 || std::isnan(value)) return 0;
  if (const auto found = known.find(value); found != known.end()) return meet(found->second);
  constexpr double largest = 4294967295.0;
  if (!(value > 0 && value <= largest) || value != std::floor(value) || known.size() >= most_labels)
    refuse(value);
  return meet(
      known.emplace(value, add(named(static_cast<std::uint32_t>(value)), false)).first->second);
}

StackLabel LayerLabels::named(std::uint32_t value) const {
  if (volume_.label_of) return volume_.label_of(value);
  const std::string id = std::to_string(value);
  return {id, {}, id};
}

void LayerLabels::refuse(double value) const {
  throw InputError(volume_.name + ": slice " + std::to_string(slice_) + " has a pixel of value " +
                   exact(value) +
                   (by_value_[layer_].size() >= most_labels
                        ? ", one of more than " + std::to_string(most_labels) + " different ones"
                        : ", which is no label: those are whole numbers from 0 on") +
                   "; for an image of grey say with --level what is inside");
}

void LayerLabels::tell(Stack& stack) const {
  std::string absent;
  std::size_t count = 0;
  constexpr std::size_t enough = 10;
  for (const Met& met : labels_) {
    if (met.is_met) {
      stack.labels.push_back(met.label);
    } else if (++count <= enough) {
      absent += (absent.empty() ? "" : ", ") + met.label.name;
    }
  }
  if (count > enough) absent += " and " + std::to_string(count - enough) + " more";
  if (count > 0)
    stack.notes.push_back(volume_.name + ": labels without a pixel, left out: " + absent);
}

}  // namespace loft::io
