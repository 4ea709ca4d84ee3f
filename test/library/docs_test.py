#!/usr/bin/env python3
"""A page of docs does what it prints, and its pictures are made by its commands.

    docs_test.py PROGRAM PAGE [PICTURES]

Pictures that the commands leave are copied into the folder PICTURES, if one is named.
"""
import os
import shutil
import sys
import tempfile

import printed

with open(sys.argv[2], encoding='utf-8') as page, tempfile.TemporaryDirectory() as folder:
    text = page.read()
    printed.check(os.path.abspath(sys.argv[1]), text, folder)
    names, drawn_in_python = printed.pictures(text)
    for name in names:
        made = os.path.exists(os.path.join(folder, name))
        assert made or name in drawn_in_python, f'{sys.argv[2]}: no command draws {name}'
        if made and len(sys.argv) > 3:
            shutil.copy(os.path.join(folder, name), sys.argv[3])
