# find_package(sr400_tree) gives the targets sr400_tree::sr400_tree and sr400_tree::batch: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. sr400_tree_SIGNATURE is that of the whole folder.
set(sr400_tree_SIGNATURE 1fb9681687ac8601)

if(sr400_tree_FIND_COMPONENTS)
  set(_modeler_kinds ${sr400_tree_FIND_COMPONENTS})
elseif(BUILD_SHARED_LIBS)
  set(_modeler_kinds shared static)
else()
  set(_modeler_kinds static shared)
endif()
set(_modeler_lib "${CMAKE_CURRENT_LIST_DIR}/../..")

foreach(_modeler_kind IN LISTS _modeler_kinds)
  # A library of another signature that is left in the same place has another file.
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/sr400_tree-${_modeler_kind}-1fb9681687ac8601.cmake")
  if(TARGET sr400_tree::sr400_tree OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET sr400_tree::sr400_tree) # installed by make
    string(TOUPPER ${_modeler_kind} _modeler_type)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/sr400_tree" ABSOLUTE)
    foreach(_modeler_part sr400_tree batch)
      set(_modeler_name libsr400_tree_batch)
      if(_modeler_part STREQUAL "sr400_tree")
        set(_modeler_name libsr400_tree_model)
      endif()
      if(_modeler_kind STREQUAL "shared")
        string(APPEND _modeler_name .so.1fb9681687ac8601)
      else()
        string(APPEND _modeler_name .a)
      endif()
      add_library(sr400_tree::${_modeler_part} ${_modeler_type} IMPORTED)
      get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
      set_target_properties(sr400_tree::${_modeler_part} PROPERTIES
        IMPORTED_LOCATION "${_modeler_location}"
        INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
      if(_modeler_kind STREQUAL "shared")
        set_target_properties(sr400_tree::${_modeler_part} PROPERTIES IMPORTED_SONAME "${_modeler_name}")
      endif()
    endforeach()
    set_target_properties(sr400_tree::batch PROPERTIES INTERFACE_LINK_LIBRARIES sr400_tree::sr400_tree)
  endif()
endforeach()

if(NOT TARGET sr400_tree::sr400_tree)
  set(sr400_tree_FOUND FALSE)
  set(sr400_tree_NOT_FOUND_MESSAGE
    "no library of signature 1fb9681687ac8601 here that is ${_modeler_kinds}; install it again")
endif()
