# vx_join_page(FILE): page.py and its parts as one script that needs no file beside it, for `python3 -`. Joined again
# when a part changes.
function(vx_join_page file)
  set(folder ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  set(script "")
  foreach(part page_data.py page_plots.py page.py)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${part})
    file(READ ${folder}/${part} text)
    string(REGEX REPLACE "\nfrom page_[a-z]+ import (\\([^)]*\\)|[^\n]*)" "" text "${text}")
    string(APPEND script "${text}\n\n")
  endforeach()
  file(CONFIGURE OUTPUT ${file} CONTENT "@script@" @ONLY)
endfunction()
