// SPDX-License-Identifier: MIT
#include "io/session/session_salvage.h"

#include <utility>

#include "io/bytes/checksum.h"

namespace loft::io {

std::uint64_t edit_checksum(std::uint64_t before, std::string_view line) {
  return checksum(line, no_checksum ^ before);
}

void SessionSalvage::add(std::string_view line, std::uint64_t checksum) {
  if (doubtful_) {
    const std::uint64_t before = doubtful_->checksum;
    const bool is_sound = edit_checksum(before, line) == checksum;
    settle_doubt(is_sound);
    if (is_sound) before_ = before;
  }
  EditLine read = parse_edit_line(line);
  const std::uint64_t expected = edit_checksum(before_.value_or(0), line);
  if (!read.problems.empty()) {
    note(number_, Fault::damaged);
  } else if (before_ && expected != checksum) {
    doubtful_ = {number_, std::move(read.edit), expected};
  } else {
    if (!before_) note(number_, Fault::unchecked);
    take_(number_, std::move(read.edit));
  }
  before_ = checksum;
  ++number_;
}

void SessionSalvage::add_hole() {
  if (doubtful_) settle_doubt(false);
  note(number_++, Fault::unreadable);
  before_.reset();
}

/// Sound is the edit if the next checksum goes on from what its own should be.
void SessionSalvage::settle_doubt(bool is_sound) {
  note(doubtful_->number, is_sound ? Fault::mended : Fault::damaged);
  if (is_sound) take_(doubtful_->number, std::move(doubtful_->edit));
  doubtful_.reset();
}

void SessionSalvage::note(std::uint64_t number, Fault fault) {
  if (!faults_.empty() && faults_.back().fault == fault && faults_.back().last + 1 == number) {
    faults_.back().last = number;
  } else {
    faults_.push_back({number, number, fault});
  }
}

std::vector<std::string> SessionSalvage::finish(bool is_end_known) {
  if (doubtful_) settle_doubt(false);
  std::vector<std::string> all;
  for (const Run& run : faults_)
    all.push_back(
        words(run, !is_end_known && run.last + 1 == number_ && run.fault == Fault::unreadable));
  return all;
}

std::string SessionSalvage::words(const Run& run, bool is_open) {
  std::string edits = "edit " + std::to_string(run.first);
  if (is_open) {
    edits = "edits from " + std::to_string(run.first) + " on";
  } else if (run.first != run.last) {
    edits = "edits " + std::to_string(run.first) + " to " + std::to_string(run.last);
  }
  switch (run.fault) {
    case Fault::damaged:
      return edits + ": damaged";
    case Fault::mended:
      return edits + ": only the checksum is damaged; taken";
    case Fault::unreadable:
      return edits + ": cannot be read";
    case Fault::unchecked:
      break;
  }
  return edits + ": cannot be checked, as the one before is lost; taken as it is";
}

}  // namespace loft::io
