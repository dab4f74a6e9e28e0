// SPDX-License-Identifier: MIT
#pragma once

#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>

#include "tests/io/shapes.h"

namespace loft::app::testing {

using io::testing::content;
using io::testing::Folder;

/// What a run of the program left.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `loft ARGUMENTS` in the folder, with a shell's quoting, stdin from the file `stdin` there
/// if it exists. The program is the one that the environment variable LOFT names.
inline Outcome run(const Folder& folder, const std::string& arguments) {
  const char* program = std::getenv("LOFT");
  if (program == nullptr) return {-1, "", "set LOFT to the path of the program"};
  const std::string input = std::filesystem::exists(folder / "stdin") ? "stdin" : "/dev/null";
  const std::string command = "cd '" + (folder / "").string() + "' && '" + program + "' " +
                              arguments + " <" + input + " >out.txt 2>err.txt";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder / "out.txt"),
          content(folder / "err.txt")};
}

/// `[[x, y], ...]`: a polygon of n corners on a circle.
inline std::string ring(double radius, int n = 8, double x = 0, double y = 0) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n;
    text << (i == 0 ? "[" : ", ") << '[' << x + radius * std::cos(angle) << ", "
         << y + radius * std::sin(angle) << ']';
  }
  return text.str() + ']';
}

/// A slice with these contours, as a line of a stack.
inline std::string slice(double z, const std::string& contours) {
  std::ostringstream text;
  text << R"({"z": )" << z << R"(, "contours": [)" << contours << "]}\n";
  return text.str();
}

/// Five slices, z = 0 to 4, of a barrel; the middle one as `middle` says.
inline std::string barrel(const std::string& middle) {
  return slice(0, ring(8)) + slice(1, ring(9)) + middle + slice(3, ring(9)) + slice(4, ring(8));
}

inline std::string barrel() { return barrel(slice(2, ring(10))); }

}  // namespace loft::app::testing
