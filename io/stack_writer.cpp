// SPDX-License-Identifier: MIT
#include "io/stack_writer.h"

#include <algorithm>
#include <array>
#include <ostream>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/stacks/cli_writer.h"
#include "io/stacks/contour_writer.h"
#include "io/stacks/csv_writer.h"
#include "io/stacks/slices_json.h"

namespace loft::io {

namespace {

using Losses = std::vector<std::string>;

Losses write_ndjson(std::ostream& out, const Stack& stack) {
  write_stack_json(out, stack);
  return {};
}

struct Format {
  std::string_view extension;
  Losses (*write)(std::ostream&, const Stack&);
};
constexpr std::array formats{Format{".ndjson", write_ndjson}, Format{".jsonl", write_ndjson},
                             Format{".csv", write_csv}, Format{".cli", write_cli},
                             Format{".contour", write_contour}};

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
