# find_package(orthoglide_leg_tree) takes any, find_package(orthoglide_leg_tree 2) any of this C interface,
# find_package(orthoglide_leg_tree 2.31683.2057.13382) only what has the signature 7bc3080934463271.
set(PACKAGE_VERSION 2.31683.2057.13382)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
