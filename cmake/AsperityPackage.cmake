# What a package has beside what the build makes, and CPack: scripts/package makes .deb and .tar.gz of build/release.
# Components: program (asperity), feel (libasperity-feel1), dev (libasperity-dev), python (python3-asperity).

# Written by the program itself, so that they name what it has.
set(packaging "${CMAKE_BINARY_DIR}/packaging")
add_custom_target(package_files
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${packaging}"
  COMMAND asperity_app --man > "${packaging}/asperity.1"
  COMMAND gzip -9nf "${packaging}/asperity.1"
  COMMAND asperity_app --completion bash > "${packaging}/asperity"
  COMMAND asperity_app --completion zsh > "${packaging}/_asperity"
  COMMAND asperity_app --completion fish > "${packaging}/asperity.fish"
  COMMAND gzip -9nc "${CMAKE_SOURCE_DIR}/CHANGELOG.md" > "${packaging}/changelog.gz"
  DEPENDS asperity_app VERBATIM COMMENT "Manual page and completions")
# All that is installed.
list(TRANSFORM modules PREPEND asperity_ OUTPUT_VARIABLE installed)
add_dependencies(package_files ${installed} asperity_feel asperity_firmware_core asperity_firmware_drivers)
if(TARGET asperity_python)
  add_dependencies(package_files asperity_python)
endif()
install(FILES "${packaging}/asperity.1.gz" DESTINATION share/man/man1 COMPONENT program OPTIONAL)
install(FILES "${packaging}/asperity" DESTINATION share/bash-completion/completions COMPONENT program OPTIONAL)
install(FILES "${packaging}/_asperity" DESTINATION share/zsh/vendor-completions COMPONENT program OPTIONAL)
install(FILES "${packaging}/asperity.fish" DESTINATION share/fish/vendor_completions.d COMPONENT program OPTIONAL)
install(FILES packaging/asperity.desktop DESTINATION share/applications COMPONENT program)
install(FILES packaging/70-asperity.rules DESTINATION lib/udev/rules.d COMPONENT program)
foreach(pair program:asperity feel:libasperity-feel1 dev:libasperity-dev python:python3-asperity)
  string(REPLACE ":" ";" pair "${pair}")
  list(GET pair 0 component)
  list(GET pair 1 name)
  install(FILES packaging/copyright DESTINATION share/doc/${name} COMPONENT ${component})
  install(FILES "${packaging}/changelog.gz" DESTINATION share/doc/${name} COMPONENT ${component} OPTIONAL)
  string(TOUPPER "${component}" upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
endforeach()

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME asperity)
set(CPACK_PACKAGE_CONTACT "the authors of Asperity <asperity@localhost>")
set(CPACK_PACKAGE_VENDOR asperity)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program feel dev python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FEEL_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libasperity-feel1 (= ${PROJECT_VERSION}), libeigen3-dev, libfmt-dev, nlohmann-json3-dev, libpugixml-dev, zlib1g-dev, libpng-dev, libjpeg62-turbo-dev, libzip-dev, libboost-dev")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_FEEL_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FEEL_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "measures fine surfaces with a hand-held probe and lets people feel them
 A probe with a force sensor and accelerometers is dragged over an object
 while a camera tracks it. From both come the height profile, roughness and
 compliance with their errors, haptic textures, and forces on a device.
 Everything also runs on a virtual bench.")
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
