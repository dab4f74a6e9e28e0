// SPDX-License-Identifier: MIT
#include "io/session/stack_state.h"

#include <utility>

#include "reconstruct/nearest_height.h"

namespace loft::io {

std::optional<std::string> StackState::apply(const Edit& edit) {
  if (auto wrong = problem(edit)) return wrong;
  set(edit.slice.z, after(edit));
  return {};
}

std::optional<std::string> StackState::problem(const Edit& edit) const {
  if (edit.kind == Edit::Kind::insert || slices_.contains(edit.slice.z)) return {};
  return no_slice_at(edit.slice.z, slices_);
}

StackState::SharedSlice StackState::after(const Edit& edit) const {
  if (edit.kind == Edit::Kind::remove) return nullptr;
  const SharedSlice there = find(edit.slice.z);
  if (edit.kind == Edit::Kind::replace || there == nullptr)
    return std::make_shared<const Slice>(edit.slice);
  Slice both = *there;
  both.contours.insert(both.contours.end(), edit.slice.contours.begin(), edit.slice.contours.end());
  return std::make_shared<const Slice>(std::move(both));
}

void StackState::set(double z, SharedSlice slice) {
  if (slice == nullptr) {
    slices_.erase(z);
  } else {
    slices_[z] = std::move(slice);
  }
}

StackState::SharedSlice StackState::find(double z) const {
  const auto found = slices_.find(z);
  return found == slices_.end() ? nullptr : found->second;
}

std::vector<Slice> StackState::stack() const {
  std::vector<Slice> all;
  for (const auto& [z, slice] : slices_) all.push_back(*slice);
  return all;
}

}  // namespace loft::io
