# SPDX-License-Identifier: MIT
# LOFT_3MF: whether io writes 3MF. By default where libzip is found; Debian's CMake package of it
# asks for programs that are in another one, so that it cannot be used.
find_path(LOFT_LIBZIP_INCLUDE_DIR zip.h)
find_library(LOFT_LIBZIP_LIBRARY zip)
mark_as_advanced(LOFT_LIBZIP_INCLUDE_DIR LOFT_LIBZIP_LIBRARY)
set(loft_has_libzip OFF)
if(LOFT_LIBZIP_INCLUDE_DIR AND LOFT_LIBZIP_LIBRARY)
  set(loft_has_libzip ON)
endif()
loft_optional(3MF ${loft_has_libzip} "Write 3MF" 3MF libzip libzip-dev)
