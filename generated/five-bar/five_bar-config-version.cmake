# find_package(five_bar) takes any, find_package(five_bar 2) any of this C interface,
# find_package(five_bar 2.53704.12217.55424) only what has the signature d1c82fb9d880dc4b.
set(PACKAGE_VERSION 2.53704.12217.55424)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
