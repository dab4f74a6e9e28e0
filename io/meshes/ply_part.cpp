// SPDX-License-Identifier: MIT
#include "io/meshes/ply_part.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "io/bytes/file.h"
#include "io/meshes/ply_records.h"
#include "io/version.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

// A header of a label a line is this long for 1e5 labels with long names.
constexpr std::size_t longest_part_header = std::size_t{64} << 20U;
/// More of anything is in no file: sums of so many do not overflow.
constexpr std::uint64_t most_in_part = std::uint64_t{1} << 40U;
constexpr std::uint64_t most_vertices = 0x7fff'ffff;  // in a PLY file
constexpr std::string_view part_words = "comment part ";

/// The numbers of PartSizes, as a line of the header has them.
std::array<std::uint64_t, 12> numbers_of(const PartSizes& s) {
  return {s.plain, s.upper,      s.lower_doubled, s.doubled,    s.midpoints,  s.upper_midpoints,
          s.faces, s.lower_cuts, s.cuts,          s.upper_cuts, s.lower_seam, s.upper_seam};
}

PartSizes sizes_of(const std::array<std::uint64_t, 12>& n) {
  const auto small = [&](std::size_t i) { return static_cast<std::uint32_t>(n[i]); };
  return {small(0), small(1), small(2), small(3), small(4),  small(5),
          n[6],     small(7), small(8), small(9), small(10), small(11)};
}

/// Counts of all surfaces together.
struct PartTotals {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t seam_faces = 0;

  [[nodiscard]] bool is_possible() const {
    return vertices < most_in_part && faces < most_in_part && seam_faces < most_in_part;
  }
};

PartTotals total_of(const std::vector<PartSizes>& surfaces) {
  PartTotals totals;
  for (const PartSizes& sizes : surfaces) {
    if (!totals.is_possible()) break;
    if (sizes.faces >= most_in_part) totals.faces = most_in_part;
    totals.vertices += vertex_count(sizes);
    totals.faces += std::min(most_in_part, face_count(sizes));
    totals.seam_faces += seam_face_count(sizes);
  }
  return totals;
}

/// Takes whole numbers off a line, with a space before each but the first.
class PartNumbers {
 public:
  explicit PartNumbers(std::string_view text) : text_(text) {}

  template <std::size_t Count>
  [[nodiscard]] std::optional<std::array<std::uint64_t, Count>> all() {
    std::array<std::uint64_t, Count> numbers{};
    for (std::uint64_t& number : numbers) {
      const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
      if (error != std::errc()) return std::nullopt;
      text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
      if (!text_.empty()) text_.remove_prefix(1);
    }
    if (!text_.empty()) return std::nullopt;
    return numbers;
  }

 private:
  std::string_view text_;
};

/// The word in front of a text and the space behind it are taken off.
std::string_view take_word(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + 1));
  return word;
}

/// Understands what there is; what is amiss shows when the header is written again.
void read_part_line(std::string_view line, PlyPartHeader& header) {
  const std::string_view kind = take_word(line);
  if (kind == "slabs") {
    if (const auto numbers = PartNumbers(line).all<3>()) {
      header.note.range = {(*numbers)[0], (*numbers)[1]};
      header.note.slab_count = (*numbers)[2];
    }
  } else if (kind == "of") {
    const std::string_view what = take_word(line);
    header.note.origin.emplace(what, line);
  } else if (kind == "surface") {
    if (const auto numbers = PartNumbers(line).all<12>())
      header.note.surfaces.push_back(sizes_of(*numbers));
  }
}

void read_label_line(std::string_view line, PlyPartHeader& header) {
  take_word(line);  // its number
  header.labels.emplace_back(line);
}

bool is_plausible(const PlyPartNote& note, const PlyPartHeader& header) {
  const bool is_range = note.range.first < note.range.bound && note.range.bound <= note.slab_count;
  return is_range && note.surfaces.size() == header.labels.size() &&
         total_of(note.surfaces).is_possible() && total_of(note.surfaces).vertices <= most_vertices;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

/// Up to its last line.
std::string read_header_text(std::istream& file, const std::filesystem::path& path,
                             PlyPartHeader& header) {
  constexpr std::string_view label_words = "comment label ";
  std::string text;
  std::string line;
  bool is_part = false;
  for (char c = 0; file.get(c);) {
    line += c;
    if (text.size() + line.size() > longest_part_header) break;
    if (text.empty() && line.size() == 4 && line != "ply\n") break;
    if (c != '\n') continue;
    text += line;
    const std::string_view view = std::string_view(line).substr(0, line.size() - 1);
    if (view == "end_header") {
      if (is_part) return text;
      break;
    }
    if (view.starts_with(part_words)) {
      is_part = true;
      read_part_line(view.substr(part_words.size()), header);
    } else if (view.starts_with(label_words)) {
      read_label_line(view.substr(label_words.size()), header);
    }
    line.clear();
  }
  if (!is_part) fail(path, "is no part that 'loft reconstruct --slabs A..B' has made");
  fail(path, "is damaged: its header has no end");
}

}  // namespace

bool PlyPartHeader::is_labelled() const { return ply_has_labels(labels); }

std::string PlyPartHeader::text() const {
  const PartTotals totals = total_of(note.surfaces);
  std::string text = ply_header(labels, is_labelled(), {totals.vertices, totals.faces});
  std::string said;
  const auto say = [&](const std::string& words) {
    said += part_words;
    said += words + '\n';
  };
  say("slabs " + std::to_string(note.range.first) + ' ' + std::to_string(note.range.bound) + ' ' +
      std::to_string(note.slab_count));
  for (const auto& [what, value] : note.origin) say("of " + what + ' ' + value);
  for (const PartSizes& sizes : note.surfaces) {
    std::string line = "surface";
    for (const std::uint64_t number : numbers_of(sizes)) line += ' ' + std::to_string(number);
    say(line);
  }
  const std::string author = "comment " + std::string(generator()) + '\n';
  text.insert(text.find(author) + author.size(), said);
  text.insert(text.size() - std::string_view("end_header\n").size(),
              "element seam_face " + std::to_string(totals.seam_faces) +
                  "\nproperty uint place\n"
                  "element checksum 1\nproperty uint low\nproperty uint high\n");
  return text;
}

PlyPartHeader read_ply_part_header(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(Access::read, path, last_cause());
  PlyPartHeader header;
  const std::string text = read_header_text(file, path, header);
  if (header.labels.empty()) header.labels.emplace_back();
  if (text.find("\ncomment " + std::string(generator()) + '\n') == std::string::npos)
    fail(path, "was made by another version than this, " + std::string(generator()));
  if (!is_plausible(header.note, header) || header.text() != text)
    fail(path, "is damaged: its header contradicts itself");
  const PartTotals totals = total_of(header.note.surfaces);
  const std::uint64_t size = text.size() + totals.vertices * ply_vertex_size(header.is_labelled()) +
                             totals.faces * ply_face_size(header.is_labelled()) +
                             totals.seam_faces * ply_seam_face_size + ply_checksum_size;
  std::error_code error;
  const std::uint64_t is = std::filesystem::file_size(path, error);
  if (error) throw FileError(Access::read, path, error.message());
  if (is != size)
    fail(path, "is damaged: it has " + std::to_string(is) + " bytes, not " + std::to_string(size));
  return header;
}

}  // namespace loft::io
