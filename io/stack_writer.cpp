// SPDX-License-Identifier: MIT
#include "io/stack_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/stacks/slices_json.h"
#include "reconstruct/number_text.h"
#include "reconstruct/world.h"

namespace loft::io {

namespace {

using Losses = std::vector<std::string>;

Losses write_ndjson(std::ostream& out, const Stack& stack) {
  write_stack_json(out, stack);
  return {};
}

/// As a field of CSV (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

Losses write_csv(std::ostream& out, const Stack& stack) {
  out << "x,y,z,contour,label\r\n";
  std::size_t number = 0;
  std::size_t empty = 0;
  for (std::uint32_t s = 0; s < stack.slices.size(); ++s) {
    const Slice& slice = stack.slices[s];
    empty += slice.contours.empty() ? 1U : 0U;
    for (std::uint32_t c = 0; c < slice.contours.size(); ++c, ++number) {
      const Contour& contour = slice.contours[c];
      const std::string end = ',' + std::to_string(number) + ',' + field(contour.label) + "\r\n";
      std::string lines;
      for (std::uint32_t p = 0; p < contour.points.size(); ++p) {
        const Vec3 place = world_place(stack, {contour.points[p].x, contour.points[p].y, slice.z},
                                       {VertexKind::contour, s, c, p});
        append_number(lines, place[0]);
        lines += ',';
        append_number(lines, place[1]);
        lines += ',';
        append_number(lines, place[2]);
        lines += end;
      }
      out << lines;
    }
  }
  Losses losses;
  if (empty > 0)
    losses.push_back("CSV has no empty slices: " + std::to_string(empty) + " left out");
  if (!stack.unit.empty() || !stack.labels.empty())
    losses.push_back("CSV has no units and no colours: left out");
  return losses;
}

struct Format {
  std::string_view extension;
  Losses (*write)(std::ostream&, const Stack&);
};
constexpr std::array formats{Format{".ndjson", write_ndjson}, Format{".jsonl", write_ndjson},
                             Format{".csv", write_csv}};

const Format& format_of(const std::filesystem::path& path) {
  const auto found = std::ranges::find(formats, extension(path), &Format::extension);
  if (found == formats.end()) throw UnknownFormat(path, stack_writer_extensions());
  return *found;
}

}  // namespace

std::vector<std::string> write_stack(const std::filesystem::path& path, const Stack& stack) {
  const Format& format = format_of(path);
  AtomicFile file(path);
  Losses losses = format.write(file.stream(), stack);
  file.commit();
  return losses;
}

void check_stack_writable(const std::filesystem::path& path) {
  static_cast<void>(format_of(path));
  const AtomicFile file(path);
}

std::string stack_writer_extensions() {
  std::string result;
  for (const Format& format : formats) {
    if (!result.empty()) result += ' ';
    result += format.extension;
  }
  return result;
}

}  // namespace loft::io
