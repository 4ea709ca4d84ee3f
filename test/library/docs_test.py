#!/usr/bin/env python3
"""A page of docs does what it prints, however old the page is.

    docs_test.py PROGRAM PAGE [FOLDER with the files that the page names]
"""
import os
import shutil
import sys
import tempfile

import printed

with open(sys.argv[2], encoding='utf-8') as page, tempfile.TemporaryDirectory() as folder:
    if len(sys.argv) > 3:
        shutil.copytree(sys.argv[3], folder, dirs_exist_ok=True)
    printed.check(os.path.abspath(sys.argv[1]), page.read(), folder)
