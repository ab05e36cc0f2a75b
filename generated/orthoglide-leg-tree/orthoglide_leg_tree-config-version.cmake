# find_package(orthoglide_leg_tree) takes any, find_package(orthoglide_leg_tree 1) any of this C interface,
# find_package(orthoglide_leg_tree 1.24181.55757.30293) only what has the signature 5e75d9cd7655b4d0.
set(PACKAGE_VERSION 1.24181.55757.30293)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "1")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
