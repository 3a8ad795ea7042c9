# What `cmake --install` puts into a system, and the Debian package made of it (scripts/package.sh).
include(GNUInstallDirs)

# Made by the program, of the tables that it runs by.
set(made ${PROJECT_BINARY_DIR}/made)
file(MAKE_DIRECTORY ${made})
function(scanout_made file folder)
  add_custom_command(OUTPUT ${made}/${file} COMMAND ${ARGN} > ${made}/${file} DEPENDS scanout VERBATIM)
  set_property(GLOBAL APPEND PROPERTY SCANOUT_MADE ${made}/${file})
  install(FILES ${made}/${file} DESTINATION ${folder})
endfunction()
scanout_made(scanout.1.gz ${CMAKE_INSTALL_MANDIR}/man1 sh -c "$<TARGET_FILE:scanout> generate man | gzip -9n")
scanout_made(scanout ${CMAKE_INSTALL_DATADIR}/bash-completion/completions scanout generate bash)
scanout_made(_scanout ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions scanout generate zsh)
scanout_made(scanout.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d scanout generate fish)
scanout_made(changelog.gz ${CMAKE_INSTALL_DOCDIR} gzip -9nc ${PROJECT_SOURCE_DIR}/packaging/changelog)
get_property(files GLOBAL PROPERTY SCANOUT_MADE)
add_custom_target(scanout_made ALL DEPENDS ${files})

install(TARGETS scanout)
install(DIRECTORY models DESTINATION ${CMAKE_INSTALL_DATADIR}/scanout)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES packaging/scanout.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME scanout)
set(CPACK_PACKAGE_CONTACT "the scanout authors <scanout@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "3D model viewer and renderer for the Linux console")
set(CPACK_PACKAGE_DESCRIPTION
    "scanout shows OBJ, STL, PLY and OFF models on a text console and draws\n\
them to files, by the CPU alone: it needs no GPU, no X, no Wayland and no\n\
OpenGL, and its pictures have the same bits on every machine.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS xkb-data)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_CHECKSUM SHA256)
include(CPack)
