// SPDX-License-Identifier: MIT
#include "reconstruct/shape/witnesses.h"

#include <algorithm>

namespace loft {

namespace {

/// More than rounding may make of how far a map moves a point, as a share of the distance.
constexpr double rounding = 0x1p-10;

void make_unique(std::vector<std::uint32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

bool contains(std::span<const std::uint32_t> numbers, std::uint32_t number) {
  return std::ranges::find(numbers, number) != numbers.end();
}

}  // namespace

Witnesses::Witnesses(std::vector<Corners> faces, std::vector<Cover::Neighbours> neighbours,
                     double distance)
    : first_(std::move(faces)),
      current_(first_),
      witnesses_(first_.size()),
      first_is_mapped_(first_.size(), true),
      is_mapped_(first_.size(), true),
      distance_(distance),
      cover_(first_, std::move(neighbours), distance),
      nearness_(distance),
      gone_(first_.size(), 0) {
  for (std::uint32_t face = 0; face < first_.size(); ++face) witnesses_[face] = {face};
  witnessed_ = witnesses_;
}

bool Witnesses::keeps_near(const Change& change) {
  ++change_;
  for (const std::uint32_t face : change.gone) gone_[face] = change_;
  find_affected(change.gone);
  found_.clear();
  around_made_.clear();
  is_by_map_ =
      change.moved <= distance_ &&
      std::ranges::all_of(change.gone, [this](std::uint32_t face) { return is_mapped_[face]; });
  if (is_by_map_)
    for (const Made& each : change.made)
      around_made_.emplace_back(each.corners, change.moved + rounding * distance_);
  const auto stays_near = [&](std::uint32_t first_face) {
    if (!is_by_map_ || !first_is_mapped_[first_face]) return finds_witnesses(first_face, change);
    follow_map(first_face, change);
    return true;
  };
  return std::ranges::all_of(affected_, stays_near) && (is_by_map_ || made_is_near(change));
}

void Witnesses::replace(const Change& change) {
  for (const std::uint32_t face : change.gone) witnessed_[face].clear();
  for (const Made& each : change.made) {
    current_[each.face] = each.corners;
    is_mapped_[each.face] = is_by_map_;
  }
  for (const auto& [first_face, witness] : found_)
    if (is_gone(witness) || !contains(witnesses_[first_face], witness))
      witnessed_[witness].push_back(first_face);
  for (const std::uint32_t face : affected_) {
    witnesses_[face].clear();
    if (!is_by_map_) first_is_mapped_[face] = false;
  }
  for (const auto& [first_face, witness] : found_) witnesses_[first_face].push_back(witness);
}

void Witnesses::find_affected(std::span<const std::uint32_t> gone) {
  affected_.clear();
  for (const std::uint32_t face : gone)
    for (const std::uint32_t first_face : witnessed_[face])
      if (contains(witnesses_[first_face], face)) affected_.push_back(first_face);
  make_unique(affected_);
}

void Witnesses::follow_map(std::uint32_t first_face, const Change& change) {
  for (const std::uint32_t face : witnesses_[first_face])
    if (!is_gone(face)) found_.emplace_back(first_face, face);
  for (std::size_t i = 0; i < change.made.size(); ++i)
    if (around_made_[i].may_meet(first_[first_face]))
      found_.emplace_back(first_face, change.made[i].face);
}

bool Witnesses::finds_witnesses(std::uint32_t first_face, const Change& change) {
  choice_.clear();
  choice_corners_.clear();
  for (const Made& each : change.made) {
    choice_.push_back(each.face);
    choice_corners_.push_back(each.corners);
  }
  const auto offer = [this](std::uint32_t face) {
    if (is_gone(face) || contains(choice_, face)) return;
    choice_.push_back(face);
    choice_corners_.push_back(current_[face]);
  };
  for (const std::uint32_t face : witnesses_[first_face]) offer(face);
  for (const std::uint32_t face : change.beside) offer(face);
  if (!nearness_.all_near(first_[first_face], choice_corners_)) return false;
  for (const std::uint32_t i : nearness_.used()) found_.emplace_back(first_face, choice_[i]);
  return true;
}

bool Witnesses::made_is_near(const Change& change) {
  choice_ = affected_;
  for (const std::uint32_t face : change.beside)
    choice_.insert(choice_.end(), witnessed_[face].begin(), witnessed_[face].end());
  make_unique(choice_);
  choice_corners_.clear();
  for (const std::uint32_t face : choice_) choice_corners_.push_back(first_[face]);
  return std::ranges::all_of(change.made, [this](const Made& each) {
    return cover_.covers(each.corners, choice_) ||
           nearness_.all_near(each.corners, choice_corners_);
  });
}

}  // namespace loft
