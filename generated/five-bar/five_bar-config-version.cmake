# find_package(five_bar) takes any, find_package(five_bar 1) any of this C interface,
# find_package(five_bar 1.59957.63362.64734) only what has the signature ea35f782fcdec370.
set(PACKAGE_VERSION 1.59957.63362.64734)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "1")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
