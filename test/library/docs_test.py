#!/usr/bin/env python3
"""A page of docs does what it prints, however old the page is.

    docs_test.py PROGRAM PAGE
"""
import os
import sys
import tempfile

import printed

with open(sys.argv[2], encoding='utf-8') as page, tempfile.TemporaryDirectory() as folder:
    printed.check(os.path.abspath(sys.argv[1]), page.read(), folder)
