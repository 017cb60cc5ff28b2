# vx_join_script(FILE FOLDER PART...): Python files of a folder as one script that needs no file beside it, for
# `python3 -`. What they import of each other (names with an underscore, such as page_data) is left out. Joined again
# when a part changes.
function(vx_join_script file folder)
  set(script "")
  foreach(part ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${part})
    file(READ ${folder}/${part} text)
    string(REGEX REPLACE "\nfrom (page|farm)_[a-z]+ import (\\([^)]*\\)|[^\n]*)" "" text "${text}")
    string(APPEND script "${text}\n\n")
  endforeach()
  file(CONFIGURE OUTPUT ${file} CONTENT "@script@" @ONLY)
endfunction()
