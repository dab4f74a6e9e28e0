// SPDX-License-Identifier: MIT
#include "io/slices.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <iterator>

#include "io/bytes/file.h"
#include "io/stacks/slices_json.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

using Reader = std::vector<Slice> (*)(std::istream&, std::string_view name, unsigned threads);

struct Format {
  std::string_view extension;
  Reader read;
};

constexpr std::array formats{
    Format{".ndjson", read_slices_json},
    Format{".jsonl", read_slices_json},
    Format{".json", read_slices_json},
};

const Format* find_format(const std::filesystem::path& path) {
  const auto found = std::ranges::find(formats, extension(path), &Format::extension);
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace

std::string slice_extensions() {
  std::string result;
  for (const Format& format : formats) {
    if (!result.empty()) result += ' ';
    result += format.extension;
  }
  return result;
}

bool is_slice_file(const std::filesystem::path& path) {
  return path == "-" || find_format(path) != nullptr;
}

std::vector<Slice> read_slices(const std::filesystem::path& path, unsigned threads) {
  if (path == "-") return read_slices_json(std::cin, "standard input", threads);

  if (std::filesystem::is_directory(path)) {
    throw FileError(Access::read, path, "it is a folder");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(Access::read, path, last_cause());
  const Format* const format = find_format(path);
  if (format == nullptr) throw UnknownFormat(path, slice_extensions());
  return format->read(file, path.string(), threads);
}

std::vector<std::string> labels_of(std::span<const std::filesystem::path> paths,
                                   Unlabelled unlabelled) {
  std::vector<std::string> labels(paths.size());
  if (paths.size() < 2 || unlabelled == Unlabelled::keep) return labels;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto is_alike = [&](const auto& path) { return path.stem() == paths[i].stem(); };
    labels[i] = (std::ranges::count_if(paths, is_alike) == 1 ? paths[i].stem() : paths[i]).string();
  }
  return labels;
}

void label_unlabelled(Slice& slice, const std::string& label) {
  for (Contour& contour : slice.contours)
    if (contour.label.empty()) contour.label = label;
}

std::vector<Slice> read_slices(std::span<const std::filesystem::path> paths, unsigned threads,
                               Unlabelled unlabelled) {
  const std::vector<std::string> labels = labels_of(paths, unlabelled);
  std::vector<Slice> slices;
  std::string problems;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    try {
      std::vector<Slice> some = read_slices(paths[i], threads);
      for (Slice& slice : some) label_unlabelled(slice, labels[i]);
      std::ranges::move(some, std::back_inserter(slices));
    } catch (const InputError& error) {
      if (!problems.empty()) problems += '\n';
      problems += error.what();
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return slices;
}

}  // namespace loft::io
