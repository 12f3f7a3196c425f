#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the module as text for a page, which `unpacked` of unpack.js reads.

usage: pack.py MODULE OUTPUT

The module is compressed by LZMA: it has much of its code several times, once for each kind of motion, at distances
that deflate does not see. The text has two characters for each 13 bits.
"""
import lzma
import pathlib
import sys

# As unpack.js expects them: no bit of the position counts, and three of the byte before a literal.
FILTERS = [{"id": lzma.FILTER_LZMA1, "preset": 9 | lzma.PRESET_EXTREME, "dict_size": 1 << 26, "nice_len": 273,
            "lc": 3, "lp": 0, "pb": 0}]
# All that a page, and a raw literal of C++, may have: without <, " and \\.
ALPHABET = "".join(chr(code) for code in range(33, 127) if chr(code) not in '<"\\')


def text_of(data):
    digits = []
    for begin in range(0, len(data), 13):  # 8 numbers of 13 bits
        piece = int.from_bytes(data[begin:begin + 13].ljust(13, b"\0"), "little")
        for i in range(8):
            high, low = divmod(piece >> 13 * i & 8191, len(ALPHABET))
            digits += (ALPHABET[low], ALPHABET[high])
    return "".join(digits)


def main():
    module, output = map(pathlib.Path, sys.argv[1:])
    data = module.read_bytes()
    packed = lzma.compress(data, format=lzma.FORMAT_RAW, filters=FILTERS)
    output.write_text(text_of(len(data).to_bytes(4, "big") + packed), encoding="ascii")


if __name__ == "__main__":
    main()
