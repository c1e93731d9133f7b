/* The font file, byte for byte; PIBLOCKS_FONT is set by the build. */
        .section .rodata
        .global piblocks_font_begin
        .global piblocks_font_end
        .balign 16
piblocks_font_begin:
        .incbin PIBLOCKS_FONT
piblocks_font_end:
        .byte 0
        .section .note.GNU-stack, "", %progbits
