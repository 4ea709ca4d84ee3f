# Run by cpack on the staged files: what Debian's policy asks of every package, and no other installation has. Copyright and changelogs,
# compressed texts, and the folder in which Debian's zsh looks.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # or SOURCE_DATE_EPOCH
file(READ ${CPACK_SLAPSTICK_SOURCE}/LICENSE license)
string(REGEX REPLACE "^.*Copyright [^\n]*\n+" "" license "${license}")
string(STRIP "${license}" license)
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license " ${license}")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(share ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share)
  string(TOUPPER ${component} key)
  set(documents ${share}/doc/${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  string(CONCAT copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: slapstick\n\n"
    "Files: *\nCopyright: 2026 The slapstick authors\nLicense: Expat\n\nLicense: Expat\n${license}\n")
  file(WRITE ${documents}/copyright "${copyright}")
  if(component STREQUAL "python")
    file(READ ${CPACK_SLAPSTICK_SOURCE}/packaging/debian/python/copyright_of_nanobind more)
    file(APPEND ${documents}/copyright "${more}")
  endif()
  configure_file(${CPACK_SLAPSTICK_SOURCE}/CHANGELOG.md ${documents}/changelog COPYONLY NO_SOURCE_PERMISSIONS)
  file(WRITE ${documents}/changelog.Debian "slapstick (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
    "  * Version ${CPACK_PACKAGE_VERSION}; changelog.gz has what is new.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  if(EXISTS ${share}/zsh/site-functions)
    file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
  endif()
  file(GLOB texts ${documents}/changelog* ${share}/man/man1/*.1)
  execute_process(COMMAND gzip -9n ${texts} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
