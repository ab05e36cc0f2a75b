# find_package(five_bar) takes any, find_package(five_bar 2) any of this C interface,
# find_package(five_bar 2.60957.56982.7278) only what has the signature ee1dde961c6e4a43.
set(PACKAGE_VERSION 2.60957.56982.7278)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
