// SPDX-License-Identifier: MIT
#include "app/capture/history.h"

#include <algorithm>
#include <utility>

namespace loft::app {

namespace {

constexpr std::size_t most_remembered = 1000;
constexpr std::size_t most_points_remembered = 4'000'000;
constexpr std::size_t most_told = 1000;

/// The edit that puts a slice to a height, whatever is there; null: that takes it away.
io::Edit edit_to(double z, const History::SharedSlice& wanted, const io::StackState& stack) {
  using Kind = io::Edit::Kind;
  if (wanted == nullptr) return {Kind::remove, {z, {}}};
  return {stack.find(z) == nullptr ? Kind::insert : Kind::replace, *wanted};
}

const char* name_of(const io::Edit::Kind kind, const std::optional<io::Undo>& undo) {
  if (!undo) return io::name(kind);
  return undo->is_redo ? "redo" : "undo";
}

}  // namespace

std::size_t History::Exchange::points() const {
  return (before ? point_count(*before) : 0) + (after ? point_count(*after) : 0);
}

void History::add(const io::Edit& edit, const std::optional<io::Undo>& undo) {
  const std::uint64_t number = entries_.size();
  entries_.push_back({edit.slice.z, edit.kind, undo});
  // A journal may say anything.
  const bool is_redo = undo && undo->is_redo;
  auto& from = is_redo ? undone_ : done_;
  if (undo && !from.empty() && from.back() == undo->of) {
    entries_[undo->of].is_undone = !is_redo;
    (is_redo ? done_ : undone_).push_back(undo->of);
    from.pop_back();
    return;
  }
  entries_.back().undo.reset();
  done_.push_back(number);
  undone_.clear();
}

void History::remember(SharedSlice before, SharedSlice after) {
  has_journal_ = false;
  exchanges_.push_back({std::move(before), std::move(after)});
  points_ += exchanges_.back().points();
  while (exchanges_.size() > most_remembered || points_ > most_points_remembered) {
    points_ -= exchanges_.front().points();
    exchanges_.pop_front();
  }
}

bool History::is_known(std::uint64_t number) const {
  return has_journal_ || number + exchanges_.size() >= entries_.size();
}

std::optional<std::uint64_t> History::next(Way way) const {
  const auto& numbers = way == Way::undo ? done_ : undone_;
  if (numbers.empty() || !is_known(numbers.back())) return {};
  return numbers.back();
}

io::Edit History::edit(Way way, const io::Session* journal, const io::StackState& stack) const {
  const std::uint64_t number = next(way).value();
  const double z = entries_[number].z;
  if (journal != nullptr) {
    const std::uint64_t count = way == Way::undo ? number : number + 1;
    return edit_to(z, slice(count, z, *journal), stack);
  }
  const Exchange& exchange = exchanges_[number + exchanges_.size() - entries_.size()];
  return edit_to(z, way == Way::undo ? exchange.before : exchange.after, stack);
}

/// What so many edits have left at a height: read from the last one on that left nothing of what
/// was before it.
History::SharedSlice History::slice(std::uint64_t count, double z,
                                    const io::Session& journal) const {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = count; i-- > 0;) {
    if (entries_[i].z != z) continue;
    numbers.push_back(i);
    if (entries_[i].kind != io::Edit::Kind::insert) break;
  }
  io::StackState state;
  for (auto number = numbers.rbegin(); number != numbers.rend(); ++number) {
    io::Edit edit = journal.edit(*number);
    if (edit.kind == io::Edit::Kind::replace) edit.kind = io::Edit::Kind::insert;
    if (edit.kind != io::Edit::Kind::remove) static_cast<void>(state.apply(edit));
  }
  return state.find(z);
}

Json History::to_json() const {
  Json edits = Json::array();
  const std::size_t first = entries_.size() - std::min(entries_.size(), most_told);
  for (std::size_t i = first; i < entries_.size(); ++i) {
    const auto& [z, kind, undo, is_undone] = entries_[i];
    edits.push_back(
        {{"number", i + 1}, {"op", name_of(kind, undo)}, {"z", z}, {"is_undone", is_undone}});
  }
  return {{"edits", std::move(edits)},
          {"can_undo", next(Way::undo).has_value()},
          {"can_redo", next(Way::redo).has_value()}};
}

void for_each_with_undo(const io::Session& session, const TakeUndo& take) {
  const auto undos = session.undos();
  session.for_each([&](std::uint64_t number, io::Edit&& edit) {
    const auto undo = undos.find(number);
    take(number, std::move(edit), undo == undos.end() ? std::nullopt : std::optional(undo->second));
  });
}

History history_of(const io::Session& session) {
  History history;
  for_each_with_undo(session,
                     [&](std::uint64_t, io::Edit&& edit, const std::optional<io::Undo>& undo) {
                       history.add(edit, undo);
                     });
  return history;
}

}  // namespace loft::app
