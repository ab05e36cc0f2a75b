# find_package(orthoglide_leg_tree) gives the targets orthoglide_leg_tree::orthoglide_leg_tree and orthoglide_leg_tree::batch: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. orthoglide_leg_tree_SIGNATURE is that of the whole folder.
set(orthoglide_leg_tree_SIGNATURE 3decae1a5d54f2a6)

if(orthoglide_leg_tree_FIND_COMPONENTS)
  set(_modeler_kinds ${orthoglide_leg_tree_FIND_COMPONENTS})
elseif(BUILD_SHARED_LIBS)
  set(_modeler_kinds shared static)
else()
  set(_modeler_kinds static shared)
endif()
set(_modeler_lib "${CMAKE_CURRENT_LIST_DIR}/../..")

foreach(_modeler_kind IN LISTS _modeler_kinds)
  # A library of another signature that is left in the same place has another file.
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/orthoglide_leg_tree-${_modeler_kind}-3decae1a5d54f2a6.cmake")
  if(TARGET orthoglide_leg_tree::orthoglide_leg_tree OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET orthoglide_leg_tree::orthoglide_leg_tree) # installed by make
    string(TOUPPER ${_modeler_kind} _modeler_type)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/orthoglide_leg_tree" ABSOLUTE)
    foreach(_modeler_part orthoglide_leg_tree batch)
      set(_modeler_name liborthoglide_leg_tree_batch)
      if(_modeler_part STREQUAL "orthoglide_leg_tree")
        set(_modeler_name liborthoglide_leg_tree_model)
      endif()
      if(_modeler_kind STREQUAL "shared")
        string(APPEND _modeler_name .so.3decae1a5d54f2a6)
      else()
        string(APPEND _modeler_name .a)
      endif()
      add_library(orthoglide_leg_tree::${_modeler_part} ${_modeler_type} IMPORTED)
      get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
      set_target_properties(orthoglide_leg_tree::${_modeler_part} PROPERTIES
        IMPORTED_LOCATION "${_modeler_location}"
        INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
      if(_modeler_kind STREQUAL "shared")
        set_target_properties(orthoglide_leg_tree::${_modeler_part} PROPERTIES IMPORTED_SONAME "${_modeler_name}")
      endif()
    endforeach()
    set_target_properties(orthoglide_leg_tree::batch PROPERTIES INTERFACE_LINK_LIBRARIES orthoglide_leg_tree::orthoglide_leg_tree)
  endif()
endforeach()

if(NOT TARGET orthoglide_leg_tree::orthoglide_leg_tree)
  set(orthoglide_leg_tree_FOUND FALSE)
  set(orthoglide_leg_tree_NOT_FOUND_MESSAGE
    "no library of signature 3decae1a5d54f2a6 here that is ${_modeler_kinds}; install it again")
endif()
