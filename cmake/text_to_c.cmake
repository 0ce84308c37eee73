# brc_text_to_c(<out> <text>): the text as string literals of C, one a line. No literal of a C11 compiler need be longer than
# 4095 characters; no line of ours is.
function(brc_text_to_c out text)
    string(REPLACE "\\" "\\\\" text "${text}")
    string(REPLACE "\"" "\\\"" text "${text}")
    string(REPLACE "\n" "\\n\"\n     \"" text "${text}")
    set(${out} "\"${text}\"" PARENT_SCOPE)
endfunction()
