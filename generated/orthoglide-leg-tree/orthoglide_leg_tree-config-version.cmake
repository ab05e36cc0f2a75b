# find_package(orthoglide_leg_tree) takes any, find_package(orthoglide_leg_tree 2) any of this C interface,
# find_package(orthoglide_leg_tree 2.15852.44570.23892) only what has the signature 3decae1a5d54f2a6.
set(PACKAGE_VERSION 2.15852.44570.23892)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
