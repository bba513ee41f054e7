# The target mocapd::lcmtypes: mocapd's messages for C++, with LCM itself.
include(CMakeFindDependencyMacro)
find_dependency(PkgConfig)
pkg_check_modules(mocapd_lcm REQUIRED IMPORTED_TARGET lcm)
if(NOT TARGET mocapd::lcmtypes)
  add_library(mocapd::lcmtypes INTERFACE IMPORTED)
  # From share/cmake/mocapd to include.
  get_filename_component(mocapd_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
  set_target_properties(mocapd::lcmtypes PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${mocapd_prefix}/include"
    INTERFACE_LINK_LIBRARIES PkgConfig::mocapd_lcm)
endif()
