# SPDX-License-Identifier: MIT
# Tests of the Python module, and of its ways to the user. All have the label python.
find_package(Python 3.9 COMPONENTS Interpreter REQUIRED)
set(here ${CMAKE_CURRENT_SOURCE_DIR}/python)
set(package ${PROJECT_SOURCE_DIR}/python)
set(module_folder ${PROJECT_BINARY_DIR}/python)
set(scratch ${CMAKE_CURRENT_BINARY_DIR}/python)
file(MAKE_DIRECTORY ${scratch})
set(environment PYTHONPATH=${module_folder} PYTHONDONTWRITEBYTECODE=1)

# AddressSanitizer wants to be loaded before an interpreter that was built without it. The interpreter
# leaks on purpose. Arrays are from malloc, so that their ends are watched.
string(REGEX MATCH "-fsanitize=[a-z,-]*address" with_asan "${CMAKE_CXX_FLAGS}")
set(program $<$<TARGET_EXISTS:loft>:$<TARGET_FILE:loft>>)
if(with_asan)
  set(runtime libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.so)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    set(runtime libasan.so)
  endif()
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${runtime}
    OUTPUT_VARIABLE runtime OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND environment LD_PRELOAD=${runtime} ASAN_OPTIONS=detect_leaks=0
    UBSAN_OPTIONS=print_stacktrace=1)
  # The program has its own.
  file(GENERATE OUTPUT ${scratch}/loft CONTENT "#!/bin/sh\nunset LD_PRELOAD\nexec '${program}' \"$@\"\n"
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  set(program ${scratch}/loft)
endif()
list(APPEND environment LOFT=${program})

# python_test(NAME COMMAND...): a test with the module of this build.
function(python_test name)
  add_test(NAME python.${name} COMMAND ${ARGN} WORKING_DIRECTORY ${scratch})
  set_tests_properties(python.${name} PROPERTIES LABELS python TIMEOUT 600
    ENVIRONMENT "${environment}")
endfunction()

# Each file of python/tests by itself; one without a test in it is a mistake.
file(GLOB files CONFIGURE_DEPENDS ${package}/tests/test_*.py)
if(with_asan)
  # Schedulers that start processes: nothing of them is ours.
  list(FILTER files EXCLUDE REGEX "test_jobs\\.py$")
endif()
foreach(file IN LISTS files)
  get_filename_component(file ${file} NAME)
  string(REGEX REPLACE "^test_(.*)\\.py$" "unit.\\1" name ${file})
  python_test(${name} ${Python_EXECUTABLE} -W error::ResourceWarning -m unittest discover
    -s ${package}/tests -p ${file})
  set_tests_properties(python.${name} PROPERTIES FAIL_REGULAR_EXPRESSION "Ran 0 tests")
endforeach()
if(with_asan)
  return()
endif()

python_test(docs ${Python_EXECUTABLE} ${here}/docs.py ${PROJECT_SOURCE_DIR})

execute_process(COMMAND ${Python_EXECUTABLE} -c "import mypy.stubtest"
  RESULT_VARIABLE no_mypy OUTPUT_QUIET ERROR_QUIET)
if(no_mypy)
  message(STATUS "Without the test python.stubs: python3-mypy is not installed")
else()
  python_test(stubs sh ${here}/stubs.sh ${Python_EXECUTABLE} ${package} ${scratch}/mypy)
endif()

# The ways to the user: the build folder is given, so that nothing is compiled again.
set(environment LOFT_PYTHON_BUILD=${PROJECT_BINARY_DIR} PYTHONDONTWRITEBYTECODE=1)
python_test(backend ${Python_EXECUTABLE} ${here}/backend_test.py)
python_test(pip sh ${here}/pip.sh ${Python_EXECUTABLE} ${PROJECT_BINARY_DIR} ${scratch}/pip)
python_test(install sh ${here}/install.sh ${Python_EXECUTABLE} ${PROJECT_BINARY_DIR}
  ${scratch}/prefix)
find_program(LOFT_PATCHELF patchelf)
mark_as_advanced(LOFT_PATCHELF)
set(building python.backend python.pip)
if(LOFT_PATCHELF)
  python_test(wheel sh ${here}/wheel.sh ${Python_EXECUTABLE} ${PROJECT_BINARY_DIR} ${scratch}/wheel)
  list(APPEND building python.wheel)
else()
  message(STATUS "Without the test python.wheel: patchelf is not installed")
endif()
# They build, too, though there should be nothing to do.
set_tests_properties(${building} PROPERTIES RESOURCE_LOCK build_folder)
