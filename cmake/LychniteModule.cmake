# lychnite_module(<name> DEPENDS <modules...> [PUBLIC <libs...>] [PRIVATE <libs...>] [HEADERS <libs...>])
#
# One static library for one folder of src/. Its sources are src/<name>/**.cpp, its public headers
# include/lychnite/<name>/. DEPENDS is checked against the layering by check_layers.cmake on every build.
# HEADERS are header-only and used in sources only, so that who links an installed lychnite needs none of them;
# the other libraries are looked for again by lychnite-config.cmake.in.
function(lychnite_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;PUBLIC;PRIVATE;HEADERS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(target lychnite_${name})
  add_library(${target} STATIC ${sources})
  add_library(lychnite::${name} ALIAS ${target})
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(${target} PUBLIC cxx_std_20)
  foreach(dep ${ARG_DEPENDS})
    target_link_libraries(${target} PUBLIC lychnite::${dep})
  endforeach()
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  foreach(library lychnite_flags ${ARG_HEADERS})
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${library}>)
  endforeach()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT lychnite)
  add_dependencies(${target} lychnite_layers)
  set_property(GLOBAL APPEND PROPERTY LYCHNITE_MODULES ${name})
endfunction()

# Flags every one of our own targets is compiled with.
add_library(lychnite_flags INTERFACE)
# (Members left out of a designated initialiser have their defaults; that is what they are for.)
target_compile_options(lychnite_flags INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-missing-field-initializers
  $<$<BOOL:${LYCHNITE_WERROR}>:-Werror>)
# Release builds must give the same picture on every x86-64 machine, so no -march=native; Embree and the
# driver choose their own instruction set at run time.
if(LYCHNITE_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# A header or source that includes a layer above its own fails every build.
add_custom_target(lychnite_layers
  COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/check_layers.cmake
  COMMENT "Checking that no folder includes a layer above it" VERBATIM)
