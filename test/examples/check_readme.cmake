# The page README must show each of the files SHOWN in full.
file(READ ${README} readme)
foreach(path IN LISTS SHOWN)
  file(READ ${path} text)
  string(FIND "${readme}" "\n${text}```" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${README} does not show ${path} as it is")
  endif()
endforeach()
