#!/usr/bin/env python3
"""Prints the flash that each part of a linked program takes, by the linker's map: map_sizes.py probe.map"""
import re
import sys

FLASH = ('.text', '.rodata', '.vectors', '.ARM.exidx', '.ARM.extab')
PARTS = ['core', 'drivers', 'libgcc', 'picolibc', 'models', 'board']


def part_of(path):
    if 'libgcc.a' in path:
        return 'libgcc'
    if re.search(r'lib[cm]\.a', path):
        return 'picolibc'
    folder = re.search(r'/(core|drivers|models|board)/[^/]*\.o$', path)
    return folder.group(1) if folder else None


def read_map(path):
    flash = dict.fromkeys(PARTS, 0)
    text = open(path).read().split('Linker script and memory map', 1)[1]
    # A long name of a section has a line of its own.
    for name, address, size, file in re.findall(r'^ (\S+)\n?[ \t]+0x([0-9a-f]+)[ \t]+0x([0-9a-f]+)[ \t]+(\S+)$', text, re.M):
        part = part_of(file)
        if part is not None and name.startswith(FLASH):
            flash[part] += int(size, 16)
    return flash


def main():
    flash = read_map(sys.argv[1])
    print('  flash: ' + ', '.join('%s %d' % (part, flash[part]) for part in PARTS) + ' bytes')


if __name__ == '__main__':
    main()
