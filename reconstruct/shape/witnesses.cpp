// SPDX-License-Identifier: MIT
#include "reconstruct/shape/witnesses.h"

#include <algorithm>

namespace loft {

namespace {

void make_unique(std::vector<std::uint32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

bool contains(std::span<const std::uint32_t> numbers, std::uint32_t number) {
  return std::ranges::find(numbers, number) != numbers.end();
}

}  // namespace

Witnesses::Witnesses(std::vector<Corners> faces, double distance)
    : first_(std::move(faces)),
      current_(first_),
      witnesses_(first_.size()),
      nearness_(distance),
      gone_(first_.size(), 0) {
  for (std::uint32_t face = 0; face < first_.size(); ++face) witnesses_[face] = {face};
  witnessed_ = witnesses_;
}

bool Witnesses::keeps_near(std::span<const std::uint32_t> gone, std::span<const Made> made,
                           std::span<const std::uint32_t> beside) {
  ++change_;
  for (const std::uint32_t face : gone) gone_[face] = change_;
  find_affected(gone);
  found_.clear();
  return std::ranges::all_of(
             affected_, [&](std::uint32_t face) { return finds_witnesses(face, made, beside); }) &&
         made_is_near(made, beside);
}

void Witnesses::replace(std::span<const std::uint32_t> gone, std::span<const Made> made) {
  for (const std::uint32_t face : gone) witnessed_[face].clear();
  for (const Made& each : made) current_[each.face] = each.corners;
  for (const auto& [first_face, witness] : found_)
    if (is_gone(witness) || !contains(witnesses_[first_face], witness))
      witnessed_[witness].push_back(first_face);
  for (const std::uint32_t face : affected_) witnesses_[face].clear();
  for (const auto& [first_face, witness] : found_) witnesses_[first_face].push_back(witness);
}

void Witnesses::find_affected(std::span<const std::uint32_t> gone) {
  affected_.clear();
  for (const std::uint32_t face : gone)
    for (const std::uint32_t first_face : witnessed_[face])
      if (contains(witnesses_[first_face], face)) affected_.push_back(first_face);
  make_unique(affected_);
}

bool Witnesses::finds_witnesses(std::uint32_t first_face, std::span<const Made> made,
                                std::span<const std::uint32_t> beside) {
  choice_.clear();
  choice_corners_.clear();
  for (const Made& each : made) {
    choice_.push_back(each.face);
    choice_corners_.push_back(each.corners);
  }
  const auto offer = [this](std::uint32_t face) {
    if (is_gone(face) || contains(choice_, face)) return;
    choice_.push_back(face);
    choice_corners_.push_back(current_[face]);
  };
  for (const std::uint32_t face : witnesses_[first_face]) offer(face);
  for (const std::uint32_t face : beside) offer(face);
  if (!nearness_.all_near(first_[first_face], choice_corners_)) return false;
  for (const std::uint32_t i : nearness_.used()) found_.emplace_back(first_face, choice_[i]);
  return true;
}

bool Witnesses::made_is_near(std::span<const Made> made, std::span<const std::uint32_t> beside) {
  choice_ = affected_;
  for (const std::uint32_t face : beside)
    choice_.insert(choice_.end(), witnessed_[face].begin(), witnessed_[face].end());
  make_unique(choice_);
  choice_corners_.clear();
  for (const std::uint32_t face : choice_) choice_corners_.push_back(first_[face]);
  return std::ranges::all_of(
      made, [this](const Made& each) { return nearness_.all_near(each.corners, choice_corners_); });
}

}  // namespace loft
