#!/usr/bin/env python3
"""Prints the flash and RAM that each part of a linked program takes, by the linker's map: map_sizes.py probe.map"""
import re
import sys

FLASH = ('.text', '.rodata', '.vectors', '.ARM.exidx', '.ARM.extab')
RAM = ('.data', '.bss', '.world', 'COMMON')
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
    ram = dict.fromkeys(PARTS, 0)
    text = open(path).read().split('Linker script and memory map', 1)[1]
    # A long name of a section has a line of its own.
    for name, address, size, file in re.findall(r'^ (\S+)\s+0x([0-9a-f]+)\s+0x([0-9a-f]+)\s+(\S+)$', text, re.M):
        part = part_of(file)
        if part is None:
            continue
        if name.startswith(FLASH):
            flash[part] += int(size, 16)
        elif name.startswith(RAM):
            ram[part] += int(size, 16)
    return flash, ram


def main():
    flash, ram = read_map(sys.argv[1])
    print('  flash: ' + ', '.join('%s %d' % (part, flash[part]) for part in PARTS) + ' bytes')
    print('  RAM without stack: ' + ', '.join('%s %d' % (part, ram[part]) for part in PARTS if ram[part]) + ' bytes')


if __name__ == '__main__':
    main()
