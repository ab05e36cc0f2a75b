# find_package(orthoglide_leg_tree) takes any, find_package(orthoglide_leg_tree 2) any of this C interface,
# find_package(orthoglide_leg_tree 2.39934.51549.13257) only what has the signature 9bfec95d33c95e7f.
set(PACKAGE_VERSION 2.39934.51549.13257)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
