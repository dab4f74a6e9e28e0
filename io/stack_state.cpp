// SPDX-License-Identifier: MIT
#include "io/stack_state.h"

namespace loft::io {

std::optional<std::string> StackState::apply(const Edit& edit) {
  const double z = edit.slice.z;
  const auto there = slices_.find(z);
  if (edit.kind == Edit::Kind::insert) {
    Slice& slice = slices_.try_emplace(z, Slice{z, {}}).first->second;
    slice.contours.insert(slice.contours.end(), edit.slice.contours.begin(),
                          edit.slice.contours.end());
    return {};
  }
  if (there == slices_.end()) return "there is no slice at that height";
  if (edit.kind == Edit::Kind::remove) {
    slices_.erase(there);
  } else {
    there->second = edit.slice;
  }
  return {};
}

std::vector<Slice> StackState::stack() const {
  std::vector<Slice> all;
  for (const auto& [z, slice] : slices_) all.push_back(slice);
  return all;
}

}  // namespace loft::io
