# SPDX-License-Identifier: MIT
# Tests of the project itself: layers, style, README, samples, installation.
set(root ${PROJECT_SOURCE_DIR})
set(build ${PROJECT_BINARY_DIR})

add_test(NAME style.layers COMMAND sh ${root}/tests/layers.sh)
add_test(NAME style.format COMMAND sh ${root}/tests/style.sh format)
add_test(NAME style.names COMMAND sh ${root}/tests/style.sh names)
add_test(NAME style.tidy COMMAND sh ${root}/tests/style.sh tidy ${build})
add_test(NAME style.alone COMMAND sh ${root}/tests/style.sh alone ${build})
set_tests_properties(style.layers style.format style.names style.tidy style.alone PROPERTIES LABELS style)
# They keep all cores busy by themselves.
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
set_tests_properties(style.tidy style.alone PROPERTIES PROCESSORS ${cores} TIMEOUT 1200)

# readme_example(NAME FILE LIBRARY): the first C++ example in FILE compiles and runs.
function(readme_example name file library)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${root}/${file})
  file(READ ${root}/${file} readme)
  if(NOT readme MATCHES "```cpp\n([^`]+)```")
    message(FATAL_ERROR "${file} has no ```cpp example")
  endif()
  file(CONFIGURE OUTPUT ${name}_example.cpp CONTENT "${CMAKE_MATCH_1}" @ONLY)
  add_executable(${name}_example ${CMAKE_CURRENT_BINARY_DIR}/${name}_example.cpp)
  target_link_libraries(${name}_example PRIVATE ${library})
  add_test(NAME readme.${name} COMMAND ${name}_example WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
readme_example(loft README.md loft::io)
readme_example(cdt cdt/README.md loft::cdt)
readme_example(overlay overlay/README.md loft::overlay)
readme_example(paths paths/README.md loft::paths)
readme_example(fields fields/README.md loft::fields)

# A project that uses loft builds and runs: with loft installed, and with loft as a subdirectory
# (its lowest layer only; the others would all be compiled again).
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/prefix)
add_test(NAME install.install COMMAND ${CMAKE_COMMAND} --install ${build} --prefix ${prefix})
set_tests_properties(install.install PROPERTIES FIXTURES_SETUP installed LABELS install)

# test_consumer(NAME FOLDER TARGET OPTIONS...): builds TARGET of tests/install and runs it.
function(test_consumer name target)
  add_test(NAME install.${name} COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test
    ${root}/tests/install ${CMAKE_CURRENT_BINARY_DIR}/consumer-${name}
    --build-generator ${CMAKE_GENERATOR} --build-target ${target}
    --build-options -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
      -DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS} ${ARGN}
    --test-command ${target})
  set_tests_properties(install.${name} PROPERTIES LABELS install)
endfunction()
test_consumer(find_package solid -DCMAKE_PREFIX_PATH=${prefix})
test_consumer(subdirectory plane -DLOFT_FOLDER=${root})
test_consumer(headers all_headers -DCMAKE_PREFIX_PATH=${prefix})
test_consumer(pkg_config solid -DCMAKE_PREFIX_PATH=${prefix} -DLOFT_PKG_CONFIG=ON)
test_consumer(paths ways -DCMAKE_PREFIX_PATH=${prefix} -DLOFT_COMPONENT=paths)
test_consumer(fields values -DCMAKE_PREFIX_PATH=${prefix} -DLOFT_COMPONENT=fields)
set_tests_properties(install.find_package install.paths install.fields install.headers install.pkg_config PROPERTIES FIXTURES_REQUIRED installed)

# The manual page, the completions and the licence are where they are looked for, and right.
if(TARGET loft_documents)
  add_test(NAME install.documents COMMAND sh ${root}/tests/install/documents.sh ${prefix})
  set_tests_properties(install.documents PROPERTIES FIXTURES_REQUIRED installed LABELS install)
endif()

# The reference of the public headers is made without a warning.
if(TARGET docs)
  add_test(NAME style.docs COMMAND ${CMAKE_COMMAND} --build ${build} --target docs)
  set_tests_properties(style.docs PROPERTIES LABELS style RESOURCE_LOCK build_folder)
endif()

# The generated stacks in samples/data are what make_stacks makes.
if(TARGET make_stacks)
  foreach(stack vessels shells)
    add_test(NAME samples.${stack} COMMAND sh -c
      "\"$1\" ${stack} | cmp - \"$2\"" sh $<TARGET_FILE:make_stacks> ${root}/samples/data/${stack}.ndjson)
  endforeach()
  add_test(NAME samples.surface_from_circles COMMAND surface_from_circles vase.glb
    WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  add_test(NAME samples.skull_slices COMMAND skull_slices ${root}/samples/data/skull.ndjson
    skull_slices.svg WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  foreach(sample agents classes figures gasket moving_agents moving_shapes room terrain town)
    add_test(NAME samples.${sample} COMMAND ${sample} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endforeach()
  # A rectangle that has passed two triangles has left no crossing behind.
  set_tests_properties(samples.figures PROPERTIES PASS_REGULAR_EXPRESSION
    "10 vertices, 0 of them.*[1-9] of them crossings.*10 vertices, 0 of them")
endif()

# The recipes of docs/scale.md run; the container is built by `ctest -L soak`, where it can be.
add_test(NAME recipes.jobs COMMAND sh ${root}/tests/recipes.sh $<TARGET_FILE:loft>)
add_test(NAME recipes.container COMMAND sh ${root}/tests/recipes.sh container)
set_tests_properties(recipes.container PROPERTIES LABELS soak TIMEOUT 3600)
