/* The font files, byte for byte; the build sets their names. In the order of Face.
   For ELF on 64-bit processors; embed_fonts.cmake does without an assembler. */
        .section .rodata
        .balign 16
article:
        .incbin PIBLOCKS_ARTICLE_FONT
text:
        .incbin PIBLOCKS_TEXT_FONT
digits:
        .incbin PIBLOCKS_DIGITS_FONT
math:
        .incbin PIBLOCKS_MATH_FONT
end:
        .byte 0

        .section .data.rel.ro, "aw"
        .global piblocks_fonts
        .balign 8
piblocks_fonts:
        .quad article, text
        .quad text, digits
        .quad digits, math
        .quad math, end
        .section .note.GNU-stack, "", %progbits
