// SPDX-License-Identifier: MIT
#include "io/stack.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <utility>

#include "io/bytes/file.h"
#include "io/bytes/natural_order.h"
#include "io/stacks/join.h"
#include "io/stacks/slices_json.h"
#include "io/stacks/stack_format.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

using std::filesystem::path;

/// Some files' bytes, and what readers are told of them.
class Inputs {
 public:
  explicit Inputs(std::span<const path> paths) {
    contents_.reserve(paths.size());
    for (const path& one : paths) {
      contents_.emplace_back(one);
      inputs_.push_back({contents_.back().view(), one.string(), one.parent_path()});
    }
  }
  [[nodiscard]] std::span<const StackInput> all() const { return inputs_; }

 private:
  std::vector<FileBytes> contents_;
  std::vector<StackInput> inputs_;
};

std::string first_bytes(const path& file) {
  std::string bytes(enough_to_tell, '\0');
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

const StackFormat& format_of(const path& file) {
  const StackFormat* const format = find_stack_format(file, first_bytes(file));
  if (format != nullptr) return *format;
  if (const auto advice = advice_for(file); !advice.empty())
    throw InputError(file.string() + ": this format is not yet read; " + std::string(advice));
  throw UnknownFormat(file, stack_extensions());
}

/// The images in a folder.
std::vector<path> images_in(const path& folder) {
  std::vector<path> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const StackFormat* const format = find_stack_format(entry.path());
    if (entry.is_regular_file() && format != nullptr && format->read_series != nullptr)
      images.push_back(entry.path());
  }
  if (images.empty())
    throw FileError(Access::read, folder, "it is a folder without images of a series");
  return images;
}

/// Whatever order a shell has put them in.
Stack read_series(std::vector<path> images, const ReadOptions& options) {
  std::ranges::sort(images, in_natural_order);
  const StackFormat& format = format_of(images.front());
  for (const path& image : images)
    if (&format_of(image) != &format)
      throw InputError(image.string() + ": is not of the format of " + images.front().string() +
                       ", " + std::string(format.name) + "; a series has one");
  const Inputs inputs(images);
  return format.read_series(inputs.all(), options);
}

bool is_image(const path& file) {
  if (file == "-" || std::filesystem::is_directory(file)) return false;
  const StackFormat* const format = find_stack_format(file);
  return format != nullptr && format->read_series != nullptr;
}

}  // namespace

std::string stack_extensions() {
  std::string result;
  for (const StackFormat& format : stack_formats()) {
    if (!result.empty()) result += ' ';
    result += format.extensions;
  }
  return result;
}

bool is_stack_file(const path& file) {
  std::error_code ignored;
  return file == "-" || std::filesystem::is_directory(file, ignored) ||
         find_stack_format(file, first_bytes(file)) != nullptr;
}

Stack read_stack(const path& file, const ReadOptions& options) {
  Stack stack;
  if (file == "-") {
    stack = read_stack_json(std::cin, "standard input", options.threads);
  } else if (std::filesystem::is_directory(file)) {
    stack = read_series(images_in(file), options);
  } else if (const StackFormat& format = format_of(file); format.read == read_ndjson) {
    std::ifstream in(file, std::ios::binary);  // not all of it in memory
    if (!in) throw FileError(Access::read, file, last_cause());
    stack = read_stack_json(in, file.string(), options.threads);
  } else {
    const Inputs inputs({&file, 1});
    stack = format.read(inputs.all().front(), options);
  }
  if (options.fill) stack.fill = options.fill;
  return stack;
}

std::vector<std::string> labels_of(std::span<const path> paths, Unlabelled unlabelled) {
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

Stack read_stack(std::span<const path> paths, const ReadOptions& options) {
  if (paths.size() > 1 && std::ranges::all_of(paths, is_image)) {
    Stack stack = read_series({paths.begin(), paths.end()}, options);
    if (options.fill) stack.fill = options.fill;
    return stack;
  }
  const std::vector<std::string> labels = labels_of(paths, options.unlabelled);
  Stack whole;
  std::string problems;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    try {
      Stack stack = read_stack(paths[i], options);
      for (Slice& slice : stack.slices) label_unlabelled(slice, labels[i]);
      join(whole, std::move(stack), paths[i].string(), i == 0);
    } catch (const InputError& error) {
      if (!problems.empty()) problems += '\n';
      problems += error.what();
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return whole;
}

}  // namespace loft::io
