# What a package has beside what the build makes, and CPack: scripts/package makes .deb and .tar.gz of build/release.
# Components: program (asperity), vision (asperity-vision), feel (libasperity-feel1), dev (libasperity-dev), python
# (python3-asperity). OpenCV's part is a package by itself: with it some 230 packages of Debian
# are installed in a clean root instead of 88.

set(ASPERITY_CONTACT "the Asperity developers <asperity@example.org>" CACHE STRING
    "Maintainer of the packages; the default's address is nobody's")

# Written by the program itself, so that they name what it has.
set(packaging "${CMAKE_BINARY_DIR}/packaging")
add_custom_target(package_files
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${packaging}"
  COMMAND asperity_app --man > "${packaging}/asperity.1"
  COMMAND gzip -9nf "${packaging}/asperity.1"
  COMMAND gzip -9nc "${packaging}/asperity_openhaptics.1" > "${packaging}/asperity_openhaptics.1.gz"
  COMMAND asperity_app --completion bash > "${packaging}/asperity"
  COMMAND asperity_app --completion zsh > "${packaging}/_asperity"
  COMMAND asperity_app --completion fish > "${packaging}/asperity.fish"
  COMMAND gzip -9nc "${CMAKE_SOURCE_DIR}/CHANGELOG.md" > "${packaging}/CHANGELOG.md.gz"
  COMMAND gzip -9nc "${packaging}/changelog" > "${packaging}/changelog.gz"
  DEPENDS asperity_app VERBATIM COMMENT "Manual page and completions")
# Debian's own form of a changelog: that there is this version, of the date that the manual page has.
file(STRINGS modules/base/include/asperity/base/version.h packaging_date REGEX kVersionDate)
string(REGEX REPLACE ".*\"([0-9-]+)\".*" "\\1" packaging_date "${packaging_date}")
set(packaging_day "${packaging_date}")
execute_process(COMMAND date -u -R -d "${packaging_date}" OUTPUT_VARIABLE packaging_date OUTPUT_STRIP_TRAILING_WHITESPACE)
configure_file(packaging/changelog.in "${packaging}/changelog" @ONLY)
configure_file(packaging/asperity_openhaptics.1.in "${packaging}/asperity_openhaptics.1" @ONLY)
# All that is installed.
list(TRANSFORM modules PREPEND asperity_ OUTPUT_VARIABLE installed)
add_dependencies(package_files ${installed} asperity_feel asperity_firmware_core asperity_firmware_drivers)
if(TARGET asperity_python)
  add_dependencies(package_files asperity_python)
endif()
install(FILES "${packaging}/asperity.1.gz" "${packaging}/asperity_openhaptics.1.gz" DESTINATION share/man/man1 COMPONENT program OPTIONAL)
install(FILES "${packaging}/asperity" DESTINATION share/bash-completion/completions COMPONENT program OPTIONAL)
install(FILES "${packaging}/_asperity" DESTINATION share/zsh/vendor-completions COMPONENT program OPTIONAL)
install(FILES "${packaging}/asperity.fish" DESTINATION share/fish/vendor_completions.d COMPONENT program OPTIONAL)
install(FILES "${packaging}/CHANGELOG.md.gz" DESTINATION share/doc/asperity COMPONENT program OPTIONAL)
# scripts/package makes it, where mkdocs is installed.
install(DIRECTORY "${CMAKE_SOURCE_DIR}/build/site/" DESTINATION share/doc/asperity/html COMPONENT program OPTIONAL
  PATTERN "sitemap.xml*" EXCLUDE)  # it has the date of the build
install(FILES packaging/asperity.desktop DESTINATION share/applications COMPONENT program)
install(FILES packaging/70-asperity.rules DESTINATION lib/udev/rules.d COMPONENT program)
set(components program:asperity feel:libasperity-feel1 dev:libasperity-dev python:python3-asperity)
if(ASPERITY_VISION)
  list(APPEND components vision:asperity-vision)
endif()
set(CPACK_COMPONENTS_ALL "")
foreach(pair IN LISTS components)
  string(REPLACE ":" ";" pair "${pair}")
  list(GET pair 0 component)
  list(GET pair 1 name)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  install(FILES packaging/copyright DESTINATION share/doc/${name} COMPONENT ${component})
  install(FILES "${packaging}/changelog.gz" DESTINATION share/doc/${name} COMPONENT ${component} OPTIONAL)
  string(TOUPPER "${component}" upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
endforeach()

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME asperity)
set(CPACK_PACKAGE_CONTACT "${ASPERITY_CONTACT}")
# Each package has a summary of its own, the first line of its description.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_PACKAGE_VENDOR asperity)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_VISION_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FEEL_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# Tracking and calibration need OpenCV's part. The studio is opened by xdg-open, which brings 100 packages where there is no
# desktop.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS asperity-vision)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS xdg-utils)
set(CPACK_DEBIAN_VISION_PACKAGE_DEPENDS "asperity (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libasperity-feel1 (= ${PROJECT_VERSION}), libeigen3-dev, libfmt-dev, nlohmann-json3-dev, libpugixml-dev, libtomlplusplus-dev, libapriltag-dev, zlib1g-dev, libpng-dev, libjpeg62-turbo-dev, libzip-dev, libboost-dev")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
# Of the libraries with a version, which is libasperity_feel alone; CPack itself adds no trigger.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_FEEL_PACKAGE_CONTROL_EXTRA "${CMAKE_SOURCE_DIR}/packaging/triggers")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "measures fine surfaces with a hand-held probe and lets people feel them
A probe with a force sensor and accelerometers is dragged over an object
while a camera tracks it. From both come the height profile, roughness and
compliance with their errors, haptic textures, and forces on a device.
Everything also runs on a virtual bench.")
set(CPACK_COMPONENT_VISION_DESCRIPTION "surface measurement: markers and calibration of cameras by OpenCV
The part of asperity that finds markers in images, poses of single markers
and the calibration of a camera. Commands that track need it.")
set(CPACK_COMPONENT_FEEL_DESCRIPTION "haptic renderer of textured surfaces: library for C
Forces of a textured scene, a step at a time, for programs in C and
languages that call C; nothing is allocated, locked or printed in a step.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "haptic renderer and surface measurement: headers and libraries
Header and link of libasperity_feel for C; headers, static libraries and
CMake files of the C++ modules from recordings to rendering.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "surface measurement and haptic rendering: Python module
Recordings, processing with intervals and verdicts, roughness, textures,
meshes and the renderer as NumPy arrays.")
include(CPack)
