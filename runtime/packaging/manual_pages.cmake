# Manual pages from the programs' own --help, where help2man is.
find_program(SAMARA_HELP2MAN help2man)

# samara_manual_pages(PROGRAM COMMAND...): PROGRAM.1, and PROGRAM-COMMAND.1 for each of its commands; installed.
function(samara_manual_pages program)
  if(NOT SAMARA_HELP2MAN)
    return()
  endif()
  set(folder ${PROJECT_BINARY_DIR}/man)
  file(MAKE_DIRECTORY ${folder})
  foreach(command IN ITEMS "" ${ARGN})
    set(name ${program})
    if(command)
      set(name ${program}-${command})
    endif()
    set(page ${folder}/${name}.1)
    add_custom_command(OUTPUT ${page}
      COMMAND ${SAMARA_HELP2MAN} --no-info --section=1 --source=samara --version-string "${name} ${PROJECT_VERSION}"
        --output=${page}
        "$<TARGET_FILE:${program}> ${command}"
      DEPENDS ${program} VERBATIM
      COMMENT "")
    list(APPEND pages ${page})
  endforeach()
  add_custom_target(${program}-manual ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endfunction()
