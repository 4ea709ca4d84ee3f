#!/usr/bin/env python3
"""A page of docs/models has its parts and does what it prints.

    pages_test.py PROGRAM PAGE
"""
import os
import sys
import tempfile

import printed

PROGRAM, PAGE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def main():
    with open(PAGE, encoding='utf-8') as file:
        text = file.read()
    name = os.path.basename(PAGE)[:-len('.md')]
    for part in ('\n## Equations\n', '\n## Source\n', '\n## Numbers\n', 'images/%s.png' % name, '--plot %s.png' % name):
        assert part in text, (PAGE, 'has no', part)
    assert os.path.getsize(os.path.join(os.path.dirname(PAGE), 'images', name + '.png')) > 1000
    with tempfile.TemporaryDirectory() as folder:
        assert any(lines for _, lines in printed.blocks(text)), (PAGE, 'shows no number')
        printed.check(PROGRAM, text, folder)
        assert os.path.getsize(os.path.join(folder, name + '.png')) > 1000


main()
