// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <string>

namespace loft::io::testing {

/// What tinygltf reads from a GLB; it has to be without fault.
inline tinygltf::Model load_glb(const std::string& bytes) {
  tinygltf::Model model;
  std::string error;
  std::string warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned>(bytes.size())))
      << error;
  EXPECT_EQ(error + warning, "");
  return model;
}

}  // namespace loft::io::testing
