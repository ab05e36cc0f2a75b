# find_package(wrist) gives the targets wrist::wrist and wrist::batch: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. wrist_SIGNATURE is that of the whole folder.
set(wrist_SIGNATURE 04a9ce4bbacd538f)

if(wrist_FIND_COMPONENTS)
  set(_modeler_kinds ${wrist_FIND_COMPONENTS})
elseif(BUILD_SHARED_LIBS)
  set(_modeler_kinds shared static)
else()
  set(_modeler_kinds static shared)
endif()
set(_modeler_lib "${CMAKE_CURRENT_LIST_DIR}/../..")

foreach(_modeler_kind IN LISTS _modeler_kinds)
  # A library of another signature that is left in the same place has another file.
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/wrist-${_modeler_kind}-04a9ce4bbacd538f.cmake")
  if(TARGET wrist::wrist OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET wrist::wrist) # installed by make
    string(TOUPPER ${_modeler_kind} _modeler_type)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/wrist" ABSOLUTE)
    foreach(_modeler_part wrist batch)
      set(_modeler_name libwrist_batch)
      if(_modeler_part STREQUAL "wrist")
        set(_modeler_name libwrist_model)
      endif()
      if(_modeler_kind STREQUAL "shared")
        string(APPEND _modeler_name .so.04a9ce4bbacd538f)
      else()
        string(APPEND _modeler_name .a)
      endif()
      add_library(wrist::${_modeler_part} ${_modeler_type} IMPORTED)
      get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
      set_target_properties(wrist::${_modeler_part} PROPERTIES
        IMPORTED_LOCATION "${_modeler_location}"
        INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
      if(_modeler_kind STREQUAL "shared")
        set_target_properties(wrist::${_modeler_part} PROPERTIES IMPORTED_SONAME "${_modeler_name}")
      endif()
    endforeach()
    set_target_properties(wrist::batch PROPERTIES INTERFACE_LINK_LIBRARIES wrist::wrist)
  endif()
endforeach()

if(NOT TARGET wrist::wrist)
  set(wrist_FOUND FALSE)
  set(wrist_NOT_FOUND_MESSAGE
    "no library of signature 04a9ce4bbacd538f here that is ${_modeler_kinds}; install it again")
endif()
